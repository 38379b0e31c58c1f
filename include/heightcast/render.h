/* Rendering: relief on bodies, as pictures. A library of its own (heightcast-render), on top of
 * libheightcast.
 *
 * A scene is a height field wrapped round a body, a material, a light and a camera. Every pixel is
 * a ray: it is followed through the shell between the body's hull and its core, by any method of
 * trace.h, and so is the ray from where it hits to the light. The silhouette is that of the relief.
 *
 *     hc_scene   scene   = { .relief = { .field = field } };
 *     hc_picture picture = { .width = 960, .height = 540, .rgb = rgb };
 *     if (hc_render(&picture, &scene, NULL, &log) == HC_OK) { hc_picture_bytes(bytes, &picture); }
 *
 * The world: x to the right, y away from the camera's usual place, z up; the body stands in the
 * origin. Zero is a good default of every member. */
#ifndef HEIGHTCAST_RENDER_H
#define HEIGHTCAST_RENDER_H

#include <heightcast/trace.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The hull, on which height 1 lies. Height 0, the core, lies relief.depth below it.
 * plane     in z = 0, 2 wide along x and 2 * aspect along y; u goes with x, v against y
 * cylinder  about the z axis, radius 0.6, 1.8 high with flat ends; v goes down
 * sphere    radius 1; u is the longitude, v goes from the north pole (z = 1) to the south pole
 * torus     about the z axis: a tube of radius 0.4 along a circle of radius 0.8; v goes round the
 *           tube, from its inside over its top
 * Round bodies close upon themselves: there the field must wrap, along u (cylinder, sphere) or both
 * axes (torus). */
typedef enum hc_body { HC_BODY_PLANE = 0, HC_BODY_CYLINDER, HC_BODY_SPHERE, HC_BODY_TORUS } hc_body;
HC_API const char *hc_body_name(hc_body body); /* "plane", ...; static */

/* What becomes of rays that come to the plane beside its top face.
 * wall     the plane is a block: they hit its sides
 * discard  as on a polygon in an engine: only rays that enter through the top face are drawn, and
 *          those that leave the texture below it are dropped
 * clamp    likewise, but those that leave the texture go on: the heights of its rim continue
 *          outwards for ever, as texture units clamp. Each ray through the top face hits */
typedef enum hc_edge { HC_EDGE_WALL = 0, HC_EDGE_DISCARD, HC_EDGE_CLAMP } hc_edge;
HC_API const char *hc_edge_name(hc_edge edge); /* "wall", "discard", "clamp"; static */

struct hc_gpu; /* gpu.h */
struct hc_gpu_map;

typedef struct hc_relief {
    hc_field         field; /* heights are borrowed */
    hc_trace_options trace; /* method and what it needs, steps, refinements. The ratios are those of
                               `field`. The placement must be zero, the surface bilinear;
                               open_sides and threads do not count */
    const struct hc_gpu_map *baked; /* NULL; or field and ratios in place of those above, in
                               textures that are drawn as they are: backend gl, the thread of its
                               hc_gpu, methods but fast, maxmip, qdm and pdm, views but
                               missed and error */
    hc_body                  body;
    hc_edge                  edge;
    float                    depth; /* from hull to core  [> 0]  0: 0.16, cylinder and torus 0.12 */
    float                    aspect; /* plane: y side over x side; 0: height / width of the field */
    float fade[2];   /* distances from the eye, to where a ray comes to the body's box or ball, at
                          which the relief begins to sink into the hull and is gone; so there is no
                          seam where an engine takes a plain polygon. 0 0: never */
    float lod[2];    /* likewise: rays take trace.steps before the first, lod_steps beyond the
                        second, in methods that count them. 0 0: trace.steps everywhere */
    int   lod_steps; /* [1 .. trace.steps]  0: a quarter of trace.steps, rounded up */
    int   repeat[2]; /* tiles along u and v  [1 .. 256]  0: plane 1 1, cylinder 2 1, sphere 4 2,
                          torus 4 2 */
} hc_relief;

/* colour = albedo * (ambient * (0.7 + 0.3 * n_z) + diffuse * cos) + specular * cos_half ^ (2 ^
 * gloss), in linear light, n being the normal; in shadow only the ambient part. Cut faces (sides
 * of the plane, ends of the cylinder) have `colour`, never the texture. All of ambient, diffuse,
 * specular zero: 0.22, 0.9, 0.12. */
typedef struct hc_material {
    const float *albedo; /* albedo_width * albedo_height * 3, row-major, filtered bilinearly; one
                            per tile. NULL: `colour` everywhere                                 */
    int          albedo_width, albedo_height;
    float        colour[3]; /* all zero: 0.55 0.5 0.45 */
    float        ambient, diffuse, specular;
    int          gloss; /* [0 .. 12]  0: 5 */
} hc_material;

/* A sun, or a lamp. */
typedef struct hc_light {
    bool   lamp;
    double place[3]; /* sun: direction to it, any length; lamp: where it is. All zero: a sun
                        from the left, -0.75 -0.1 0.5                                    */
    bool   no_shadows;
} hc_light;

/* zero eye and target: a view that shows the whole body, `fov` across. Up is z. */
typedef struct hc_camera {
    double eye[3], at[3];
    float  fov;          /* degrees across the picture  [> 0, <= 170]  0: 32                    */
    float  orthographic; /* > 0: parallel rays, and this is the picture's width in the world    */
    int    samples;      /* rays per pixel  [1 .. 256]  0: 1                                    */
} hc_camera;

typedef struct hc_scene {
    hc_relief   relief;
    hc_material material;
    hc_light    light;
    hc_camera   camera;
} hc_scene;

/* Of terrain (terrain.h) there are shaded, height, normal, depth, missed and crossings; of relief
 * all but crossings.
 * shaded       as described, before a dark background
 * height       of the hit, black to white
 * normal       of the surface in the world, xyz as rgb, 0 in the middle
 * depth        along the view, near bright and far dark
 * steps        of the view ray, as a heat map that ends at `top`
 * unconverged  shaded, magenta where the method ran out of steps
 * missed       shaded in grey; red where the first hit was lost (the exact one lies nearer by more
 *              than depth / 64, or there is one where the method has none), yellow where one was
 *              made up
 * error        distance from the exact hit, as a heat map that ends at `top`; red where it alone
 *              hits, yellow where the method alone does
 * crossings    moves of the view ray from node to node as a spectrum: blue to sky-blue up to 16,
 *              green to yellow up to 35, to red at 85, darker beyond */
typedef enum hc_view {
    HC_VIEW_SHADED = 0,
    HC_VIEW_HEIGHT,
    HC_VIEW_NORMAL,
    HC_VIEW_DEPTH,
    HC_VIEW_STEPS,
    HC_VIEW_UNCONVERGED,
    HC_VIEW_MISSED,
    HC_VIEW_ERROR,
    HC_VIEW_CROSSINGS
} hc_view;
HC_API const char *hc_view_name(hc_view view); /* as above; NULL beyond the last. Static */

/* cpu  what all others are compared with; every method
 * gl   OpenGL 4.3 core through EGL, without a window, by the shaders in shaders/; every method, in
 *      float32. On the GPU, or where there is none in Mesa's software renderer */
typedef enum hc_backend { HC_BACKEND_CPU = 0, HC_BACKEND_GL } hc_backend;

typedef struct hc_render_options {
    hc_view     view;
    hc_backend  backend;
    float       top; /* of heat maps: steps, or world units; 0: the 99 % quantile of those found */
    int         threads; /* cpu  [0 .. 1024]  0: one per core; same bytes for every number        */
    hc_progress progress;
    struct hc_gpu *gpu; /* gl, relief: draw in its context, on its thread; shaders that it has
                           compiled are there for the next picture, as they are with relief.baked.
                           NULL: in a context that lives as long as the call */
} hc_render_options;

/* What was seen. Counts are of view rays: width * height * samples. */
typedef struct hc_render_figures {
    uint64_t rays, hits;
    uint64_t entered; /* come to the hull, or to a cut face */
    uint64_t unconverged;
    uint64_t lost, made_up;  /* views missed and error: against the exact caster      */
    double   mean_steps;     /* of view rays that come to the hull                   */
    double   mean_error;     /* view error: over rays that hit in both [world units] */
    double   mean_fetches;   /* gl: texels read by them; cpu: 0                      */
    double   mean_crossings; /* terrain: moves from node to node                    */
    double   within[3];      /* terrain: shares of them with up to 16, 35, 85       */
    double   top;            /* of the heat map, as it was drawn                     */
    double   seconds;        /* spent drawing, less building, compiling and loading  */
} hc_render_figures;

typedef struct hc_picture {
    int    width, height; /* [1 .. 65536] */
    float *rgb;           /* [out] width * height * 3, linear light */
    float *depth; /* [out] NULL, or width * height: of the nearest ray of each pixel, along the
                     view axis in world units; INFINITY where there is nothing */
    hc_render_figures figures; /* [out] */
} hc_picture;

/* Draw `scene` into `picture`. The CPU gives the same bytes on every machine and for every number
 * of threads; GL agrees with it but for rounding in float32 (docs/algorithms.md, section 21.4).
 *
 * On round bodies the ray is bent in texture space: it is followed in straight pieces that are
 * nowhere farther than 1/512 of the relief's depth from it, and a method starts anew on each. So
 * cones stay as safe as they are on the plane; docs/algorithms.md has the bound.
 *
 * Memory: 92 bytes per pixel; the tracers. Errors: hc_tracer_create's; HC_ERROR_ARGUMENT for
 * numbers out of range and fields that do not wrap as the body needs; HC_ERROR_MEMORY, on the GPU
 * too; HC_ERROR_CANCELLED. gl: HC_ERROR_UNSUPPORTED where there is no EGL, or no OpenGL 4.3, or
 * this build has none, and for fast; HC_ERROR_LIMIT for fields and pictures that are too large for
 * it; HC_ERROR_IO if the context is lost. */
HC_API hc_result hc_render(hc_picture *picture, const hc_scene *scene,
                           const hc_render_options *options, hc_log *log);

/* sRGB codes of picture->rgb. rgb8 [out] width * height * 3. */
HC_API void hc_picture_bytes(uint8_t *rgb8, const hc_picture *picture);

/* Colour of the heat maps at 0 .. 1, linear light: for legends. */
HC_API void hc_heat_colour(float rgb[3], double value);

#ifdef __cplusplus
}
#endif

#endif
