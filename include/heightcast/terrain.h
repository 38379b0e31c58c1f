/* Terrain: landscapes drawn by rays, from any eye in any direction. Part of heightcast-render.
 *
 * A terrain is a height field in world units under a sun and a sky. Every pixel is a ray, followed
 * by any method of trace.h, whether the eye is outside the field's box, inside it, on the ground
 * or in a valley looking up; so is the ray to the sun.
 *
 *     hc_terrain_scene scene = { .field = field };
 *     hc_terrain      *terrain;
 *     if (hc_terrain_create(&terrain, &scene, NULL, &log) == HC_OK) {
 *         hc_camera camera;
 *         hc_terrain_tour(&camera, terrain, HC_TOUR_FLY, 0.0);
 *         hc_terrain_draw(&picture, terrain, &camera, &log);
 *         hc_terrain_destroy(terrain);
 *     }
 *
 * The field is a block: it has walls, which end a quarter of its height below height 0.
 * The world: sample (0, 0) stands at `offset`, x goes to the right (east) with the columns, y to
 * the top row (north), against the rows, z up. Zero is a good default of every member. */
#ifndef HEIGHTCAST_TERRAIN_H
#define HEIGHTCAST_TERRAIN_H

#include <heightcast/mesh.h>
#include <heightcast/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the ground's colour comes from.
 * natural    meadows and woods low, grass and rock high, rock where it is steep, speckled
 * elevation  a ramp of map colours from low to high
 * slope      level green, over yellow to red at 45 degrees, violet beyond
 * image      scene.image, draped over the field
 * plain      the same grey everywhere */
typedef enum hc_ground {
    HC_GROUND_NATURAL = 0,
    HC_GROUND_ELEVATION,
    HC_GROUND_SLOPE,
    HC_GROUND_IMAGE,
    HC_GROUND_PLAIN
} hc_ground;
HC_API const char *hc_ground_name(hc_ground ground); /* as above; NULL beyond the last. Static */

/* Triangles instead of rays, as what rays are measured against: gl only, without the block's walls,
 * flat tops and details; shadows are rays' as ever.
 * none   rays
 * full   two triangles for each square of four samples
 * lod    blocks of 32 x 32 squares that the eye sees, each as coarse as it can be without moving a
 *        sample by more than a pixel (de Boer 2000) */
typedef enum hc_polygons { HC_POLYGONS_NONE = 0, HC_POLYGONS_FULL, HC_POLYGONS_LOD } hc_polygons;
HC_API const char *hc_polygons_name(
    hc_polygons polygons); /* as above; NULL beyond the last. Static */

/* A mesh in the landscape. It and the terrain hide each other, and throw shadows on each other. */
typedef struct hc_object {
    const hc_mesh *mesh;      /* read by hc_terrain_create only               */
    double         place[3];  /* of the mesh's origin, in the world           */
    bool           grounded;  /* place[2] counts from the ground there        */
    double         size;      /* world units per unit of the mesh  [> 0] 0: 1 */
    double         turn;      /* degrees about z, from x towards y            */
    float          colour[3]; /* linear light. All zero: 0.45 0.16 0.10       */
} hc_object;

/* A small height map that repeats over the ground and is cut into it: where it is 1 the ground
 * stays as it is, where it is 0 it lies `depth` lower, each times the mask's share there. Bilinear
 * between its texels, as the ground is between its samples. Tiles begin in the field's north-west
 * corner. */
typedef struct hc_detail {
    const float *heights; /* width * height, row-major, row 0 north  [0 .. 1]                    */
    const float *colour;  /* likewise * 3, linear light, or NULL: it leaves the ground's         */
    int          width, height;
    double       tile;  /* world units across it, from west to east  [>= 0]  0: 16 samples. The
                             terrain is at most 2^24 texels wide                                  */
    double       depth; /* world units, times the exaggeration  [>= 0]       0: a 16th of `tile` */
} hc_detail;

#define HC_DETAILS_MAX 4

/* How a ray that has come to the coarse ground looks for the detail in it.
 * safe   all patches and texels on its way, each by the polynomial that the gap is there: loses no
 *        first hit, makes none up (docs/algorithms.md, section 22.9)
 * steps  the RaycastTerrain sample's: equal steps, then bisection. What lies between two steps it
 *        does not see; if it comes to nothing the coarse hit stands and counts as unconverged */
typedef enum hc_detail_method { HC_DETAIL_SAFE = 0, HC_DETAIL_STEPS } hc_detail_method;
HC_API const char *hc_detail_method_name(
    hc_detail_method method); /* as above; NULL beyond the last. Static */

typedef struct hc_terrain_scene {
    /* Heights are borrowed until the terrain is destroyed; no wrap. */
    hc_field field;
    /* Method and what it needs, surface, open_sides, steps, refinements; steps 0 of cone-loop: 512.
     * The placement must be zero, threads do not count. */
    hc_trace_options trace;
    /* World units between samples along x and y  [>= 0]. 0 0: those of field.elevation; where that
     * has none, the longer side is 32 times the height of the terrain. */
    double spacing[2];
    /* z of heights 0 and 1  [low < high]. 0 0: those of field.elevation; where that has none, 0 and
     * 1. */
    double low, high;
    double exaggeration; /* of z  [> 0, <= 1000]  0: 1 */
    double offset[3];    /* of the whole               */

    hc_ground ground;
    /* ground image: image_width * image_height * 3, row-major, linear light, over the whole field;
     * borrowed like the heights. */
    const float *image;
    int          image_width, image_height;
    /* Nothing is smoothed: colours are those of the nearest sample or texel, normals those of the
     * patch. */
    bool blocky;

    hc_polygons polygons;

    /* detail_count of them [0 .. HC_DETAILS_MAX], read by hc_terrain_create only; what they point
     * to is borrowed until the terrain is destroyed. Not of polygons, which are too coarse for
     * them. */
    const hc_detail *details;
    int              detail_count;
    /* mask_width * mask_height * 4: how much of each detail there is at each sample, of 255; as
     * many texels as the field has samples, bilinear between them, or the same on all of a flat
     * top; borrowed. NULL: the same share of each everywhere, all of them together 1. */
    const uint8_t   *mask;
    int              mask_width, mask_height;
    hc_detail_method detail_method;
    int              detail_steps; /* of steps  [1 .. 65536]  0: 32 */
    /* Distances from the eye, to where a ray comes to the coarse ground, at which details begin to
     * sink into it and are gone: their colours become the mean of theirs  [near < far]. 0 0: 24 and
     * 48 times the widest tile. */
    double detail_fade[2];

    const hc_object *objects; /* object_count of them, read by hc_terrain_create only */
    int              object_count;

    double sun[3]; /* direction to it, any length. All zero: -0.75 0.5 0.36 */
    bool   no_shadows;
    /* Side in texels  [0 .. 16384] of a map of what the sun sees, from which shadows are read
     * instead of cast: soft by a texel, and coarse where that is large. Takes 4 bytes a texel. 0:
     * they are cast, exactly. */
    int shadow_map;
    /* Distance in the air over the terrain that leaves about 1 / e of the light  [> 0]  0: 2.2
     * times the longer side; INFINITY: clear air. */
    float haze;
} hc_terrain_scene;

typedef struct hc_terrain hc_terrain;

/* Make a scene ready to be drawn. Destroy with hc_terrain_destroy, which accepts NULL.
 *
 * options  view: shaded, height, normal, depth, crossings or missed; top does not count. NULL or
 *          zero: shaded, by the CPU
 *
 * Errors: hc_tracer_create's; HC_ERROR_ARGUMENT for numbers out of range and a mask of another size
 * than the field; HC_ERROR_UNSUPPORTED for polygons and details where they cannot be. gl: also
 * those of hc_render. */
HC_API hc_result hc_terrain_create(hc_terrain **terrain, const hc_terrain_scene *scene,
                                   const hc_render_options *options, hc_log *log);
HC_API void      hc_terrain_destroy(hc_terrain *terrain);

/* Draw what `camera` sees. Zero eye and target: hc_terrain_tour's fly at 0; fov 0: 60.
 *
 * The CPU gives the same bytes on every machine and for every number of threads, and draws for many
 * callers at once. GL agrees with it but for rounding in float32 (docs/algorithms.md, section
 * 22.8); the caller's thread has another context current afterwards, and a terrain draws for one
 * caller at a time. An eye under the ground sees
 * only that. picture->figures: `entered` counts rays that come to the field's box, `within` those
 * of them that moved at most 16, 35 and 85 times from node to node (steps, with methods that do not
 * tell).
 *
 * Memory: 92 bytes per pixel, a megabyte per thread. Errors: HC_ERROR_ARGUMENT for
 * numbers out of range and an eye and a target in the same place; HC_ERROR_MEMORY;
 * HC_ERROR_CANCELLED. */
HC_API hc_result hc_terrain_draw(hc_picture *picture, const hc_terrain *terrain,
                                 const hc_camera *camera, hc_log *log);

/* z of the surface, without details, at (x, y); beyond the field's sides that of the nearest place
 * on them. */
HC_API double hc_terrain_ground(const hc_terrain *terrain, double x, double y);

/* The field's place: spacings, scale and offset as they were resolved. */
HC_API hc_placement hc_terrain_placement(const hc_terrain *terrain);

/* ---- cameras --------------------------------------------------------------------------------- */

/* Ways through a terrain, each closed upon itself.
 * fly    a loop in the air, ahead and a little down
 * walk   a loop on the ground, following it, ahead
 * up     in the deepest valley around the middle, turning, looking up
 * orbit  round the whole terrain, looking at its middle */
typedef enum hc_tour { HC_TOUR_FLY = 0, HC_TOUR_WALK, HC_TOUR_UP, HC_TOUR_ORBIT } hc_tour;
HC_API const char *hc_tour_name(hc_tour tour); /* as above; NULL beyond the last. Static */

/* The camera at `moment` of a tour, in rounds. */
HC_API void hc_terrain_tour(hc_camera *camera, const hc_terrain *terrain, hc_tour tour,
                            double moment);

/* The camera on a smooth way through `count` [>= 1] keys, from the first at moment 0 to the last at
 * 1: eye, target and fov by Catmull-Rom splines, the rest as in the first. */
HC_API void hc_camera_between(hc_camera *camera, const hc_camera *keys, int count, double moment);

#ifdef __cplusplus
}
#endif

#endif
