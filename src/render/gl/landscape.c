#include "landscape.h"

#include "../stage.h"
#include "bands.h"
#include "details.h"
#include "polygons.h"
#include "upload.h"

#include "base/clock.h"
#include "gl/context.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEIGHTS = 0,
    RATIOS,
    BOUNDS,
    EXACT_BOUNDS,
    BLOCKS,
    IMAGE,
    BODIES,
    SUNVIEW,
    DETAILS,
    TEXTURES = DETAILS + HC_DETAIL_UNITS
};

enum { BODY_COLUMNS = 4096 };

struct hc_terrain_gl {
    hc_gl_context context;
    unsigned      textures[TEXTURES];
    unsigned      program, exact; /* exact: 0 unless the view compares */
    hc_gl_bodies  bodies;
    unsigned      corners; /* of them: a buffer */

    hc_gl_polygons polygons; /* where the scene has them */
    bool           warm;     /* something has been drawn  */
};

/* ---- making -------------------------------------------------------------------------------- */

static hc_result load_bounds(unsigned *texture, int unit, const hc_tracer *tracer, hc_log *log)
{
    const hc_pyramid *bounds = tracer != NULL ? hc_tracer_bounds(tracer) : NULL;
    return bounds != NULL ? hc_upload_pyramid(texture, unit, bounds, log) : HC_OK;
}

static hc_result load(unsigned textures[TEXTURES], const hc_terrain *terrain, hc_log *log)
{
    const hc_terrain_scene *scene = &terrain->scene;
    const hc_field         *field = &scene->field;
    const bool              needs = hc_trace_method_needs(scene->trace.method) != HC_NEEDS_NOTHING;
    hc_result result = hc_upload_image(&textures[HEIGHTS], HEIGHTS, field->heights, field->width,
                                       field->height, 1, "field", log);
    hc_upload_wrap(HC_WRAP_NONE);
    if (result == HC_OK && needs) {
        result =
            hc_upload_image(&textures[RATIOS], RATIOS, scene->trace.ratios, field->width,
                            field->height, hc_cones_channels(scene->trace.cones), "ratios", log);
    }
    if (result == HC_OK) {
        result = load_bounds(&textures[BOUNDS], BOUNDS, terrain->tracer, log);
    }
    if (result == HC_OK) {
        result = load_bounds(&textures[EXACT_BOUNDS], EXACT_BOUNDS, terrain->exact, log);
    }
    if (result == HC_OK) {
        result = hc_upload_blocks(&textures[BLOCKS], BLOCKS, terrain->tracer, log);
    }
    if (result == HC_OK && terrain->sunview.side > 0 && !hc_terrain_gl_sees_sun(terrain)) {
        result =
            hc_upload_image(&textures[SUNVIEW], SUNVIEW, terrain->sunview.depths,
                            terrain->sunview.side, terrain->sunview.side, 1, "shadow map", log);
    }
    if (result == HC_OK && scene->ground == HC_GROUND_IMAGE) {
        result = hc_upload_image(&textures[IMAGE], IMAGE, scene->image, scene->image_width,
                                 scene->image_height, 3, "image", log);
    }
    return result == HC_OK ? hc_details_upload(&textures[DETAILS], DETAILS, terrain, log) : result;
}

/* ---- bodies -------------------------------------------------------------------------------- */

/* The tree and its triangles, for shadows. */
static hc_result load_tree(unsigned *texture, const hc_terrain *terrain, hc_log *log)
{
    const int count  = hc_bodies_texel_count(terrain->bodies);
    const int rows   = (count + BODY_COLUMNS - 1) / BODY_COLUMNS;
    float    *texels = calloc((size_t)rows * BODY_COLUMNS * 4, sizeof *texels);
    if (texels == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the objects' triangles");
    }
    hc_bodies_texels(texels, terrain->bodies, terrain->low);
    const hc_result result =
        hc_upload_image(texture, BODIES, texels, BODY_COLUMNS, rows, 4, "objects", log);
    free(texels);
    return result;
}

static hc_result load_corners(hc_terrain_gl *gl, const hc_terrain *terrain, hc_log *log)
{
    const int    count   = hc_bodies_corner_count(terrain->bodies);
    const size_t bytes   = (size_t)count * HC_CORNER_FLOATS * sizeof(float);
    float       *corners = malloc(bytes);
    if (corners == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the objects' triangles");
    }
    hc_bodies_corners(corners, terrain->bodies, terrain->low, (const float(*)[3])terrain->colours);
    glGenVertexArrays(1, &gl->bodies.array);
    glBindVertexArray(gl->bodies.array);
    glGenBuffers(1, &gl->corners);
    glBindBuffer(GL_ARRAY_BUFFER, gl->corners);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, corners, GL_STATIC_DRAW);
    for (unsigned i = 0; i < 3; i++) {
        const size_t offset = 3 * i * sizeof *corners;
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, HC_CORNER_FLOATS * sizeof *corners,
                              (const void *)offset);
    }
    free(corners);
    gl->bodies.count = count;
    return hc_gl_check("objects", log);
}

/* ---- programs ------------------------------------------------------------------------------ */

/* Texture space per world unit. */
static void scale_of(double scale[3], const hc_terrain *terrain)
{
    const hc_placement *p = &terrain->placement;
    scale[0]              = hc_field_step_u(&terrain->scene.field) / p->spacing_x;
    scale[1]              = hc_field_step_v(&terrain->scene.field) / p->spacing_y;
    scale[2]              = 1.0 / p->scale_z;
}

static void set_sunview(unsigned program, const hc_sunview *view)
{
    hc_upload_int(program, "u_map", SUNVIEW);
    hc_upload_int(program, "u_map_side", view->side);
    hc_upload_vector(program, "u_map_across", view->across);
    hc_upload_vector(program, "u_map_along", view->along);
    hc_upload_pair(program, "u_map_first", view->first[0], view->first[1]);
    hc_upload_pair(program, "u_map_texel", view->texel[0], view->texel[1]);
    hc_upload_float(program, "u_map_top", view->top);
}

static void set_scene(unsigned program, const hc_terrain *terrain, bool exact)
{
    const hc_terrain_scene *scene  = &terrain->scene;
    const hc_trace_method   method = exact ? HC_TRACE_MAXMIP : scene->trace.method;
    double                  scale[3];
    scale_of(scale, terrain);
    hc_upload_field(program, &scene->field, &scene->trace, method);
    hc_upload_int(program, "hc_heights", HEIGHTS);
    hc_upload_int(program, "hc_ratios", RATIOS);
    hc_upload_int(program, "hc_bounds", exact ? EXACT_BOUNDS : BOUNDS);
    hc_upload_block_shape(program, BLOCKS, terrain->tracer);
    set_sunview(program, &terrain->sunview);
    hc_upload_int(program, "u_image", IMAGE);
    hc_upload_int(program, "u_bodies", BODIES);
    hc_upload_int(program, "u_node_count",
                  terrain->bodies != NULL ? hc_bodies_node_count(terrain->bodies) : 0);
    hc_upload_float(program, "u_body_slip", hc_terrain_body_slip(terrain));
    hc_upload_float(program, "u_depth_unit", fmin(scene->spacing[0], scene->spacing[1]));
    hc_upload_vector(program, "u_scale", scale);
    hc_upload_vector(program, "u_sun", terrain->sun);
    hc_upload_int(program, "u_shadows", !scene->no_shadows && !exact);
    hc_upload_float(program, "u_shadow_slip", terrain->shadow_slip);
    hc_upload_float(program, "u_haze", fmin((double)scene->haze, 1e30)); /* infinity is no number */
    hc_upload_pair(program, "u_spacing", scene->spacing[0], scene->spacing[1]);
    hc_upload_int(program, "u_ground", (int)scene->ground);
    hc_upload_int(program, "u_blocky", scene->blocky);
    hc_upload_float(program, "u_details_left", HC_BY_DISTANCE);
    hc_details_set_uniforms(program, DETAILS, terrain);
}

/* The exact program finds details safely. */
static const char *details_of(const hc_terrain *terrain, bool exact)
{
    return terrain->details.count == 0                               ? ""
           : exact || terrain->scene.detail_method == HC_DETAIL_SAFE ? "#define DETAILS\n"
                                                                     : "#define DETAILS\n"
                                                                       "#define HC_DETAIL_STEPS\n";
}

/* What shaders are told beside the method. */
static void add_choices(char *head, size_t size, const hc_terrain *terrain, const char *part,
                        bool exact)
{
    const hc_trace_options *trace = &terrain->scene.trace;
    (void)snprintf(head + strlen(head), size - strlen(head), "#define %s\n%s%s%s", part,
                   details_of(terrain, exact),
                   trace->surface == HC_SURFACE_STEPS ? "#define HC_STEPS\n" : "",
                   trace->open_sides ? "#define HC_OPEN_SIDES\n" : "");
}

/* before: the vertex shader. */
static hc_result build(unsigned *program, const hc_terrain *terrain, const char *before, bool exact,
                       hc_log *log)
{
    const hc_trace_options *trace = &terrain->scene.trace;
    char                    head[256];
    hc_gl_head(head, sizeof head, exact ? HC_TRACE_MAXMIP : trace->method, trace->cones,
               terrain->tracer);
    const char *part = strcmp(before, "bodies.vert") == 0                      ? "BODIES"
                       : strcmp(before, "ground.vert") == 0                    ? "POLYGONS"
                       : terrain->scene.polygons != HC_POLYGONS_NONE && !exact ? "SKY"
                                                                               : "RAYS";
    add_choices(head, sizeof head, terrain, part, exact);
    const char *const  plain[]    = { "ground.glsl", "terrain.frag", NULL };
    const char *const  detailed[] = { "detail.glsl", "dig.glsl", "ground.glsl", "terrain.frag",
                                      NULL };
    const hc_gl_recipe recipe =
        hc_gl_recipe_of(head, before, terrain->details.count > 0 ? detailed : plain);
    const hc_result result = hc_gl_build(program, &recipe, log);
    if (result == HC_OK) {
        glUseProgram(*program);
        set_scene(*program, terrain, exact);
    }
    return result;
}

static hc_result add_bodies(hc_terrain_gl *gl, const hc_terrain *terrain, hc_log *log)
{
    hc_result result = build(&gl->bodies.program, terrain, "bodies.vert", false, log);
    result           = result != HC_OK ? result : load_tree(&gl->textures[BODIES], terrain, log);
    return result != HC_OK ? result : load_corners(gl, terrain, log);
}

static hc_result add_polygons(hc_terrain_gl *gl, const hc_terrain *terrain, hc_log *log)
{
    const hc_result result = hc_polygons_make(&gl->polygons, terrain, log);
    gl->bodies.ground      = &gl->polygons;
    return result != HC_OK ? result
                           : build(&gl->bodies.ground_program, terrain, "ground.vert", false, log);
}

void hc_terrain_gl_free(hc_terrain_gl *gl)
{
    if (gl == NULL) {
        return;
    }
    if (gl->context.context != NULL && hc_gl_use(&gl->context, NULL) == HC_OK) {
        glDeleteProgram(gl->program);
        glDeleteProgram(gl->exact);
        glDeleteProgram(gl->bodies.program);
        glDeleteProgram(gl->bodies.ground_program);
        glDeleteVertexArrays(1, &gl->bodies.array);
        glDeleteBuffers(1, &gl->corners);
        glDeleteTextures(TEXTURES, gl->textures);
        hc_polygons_free(&gl->polygons);
    }
    hc_gl_close(&gl->context);
    free(gl);
}

/* ---- drawing ------------------------------------------------------------------------------- */

/* The eye goes to texture space in double precision, where the world may be large. */
static void set_eye(unsigned program, const hc_terrain *terrain, const hc_eye *eye)
{
    const hc_placement *p     = &terrain->placement;
    const hc_field     *field = &terrain->scene.field;
    const double        first = field->registration == HC_GRID ? 0.0 : 0.5;
    double              scale[3], place[3], anchor[3];
    scale_of(scale, terrain);
    for (int k = 0; k < 3; k++) {
        place[k]  = (eye->place[k] - p->offset[k]) * scale[k];
        anchor[k] = eye->place[k] - terrain->low[k];
    }
    place[0] += first * hc_field_step_u(field);
    place[1] += first * hc_field_step_v(field);
    hc_upload_eye(program, eye);
    hc_upload_vector(program, "u_place", place);
    hc_upload_vector(program, "u_anchor", anchor);
    hc_upload_float(program, "u_footprint", hc_terrain_footprint(eye));
    hc_upload_float(program, "u_haze_top", hc_haze_top(terrain) - eye->place[2]);
}

/* ---- what the sun sees ----------------------------------------------------------------------- */

/* With nothing in its way, and all details however far they are from the eye. */
static void look_from_sun(unsigned program, const hc_terrain *terrain, const hc_eye *eye)
{
    glUseProgram(program);
    set_eye(program, terrain, eye);
    hc_upload_int(program, "u_shadows", 0);
    hc_upload_float(program, "u_details_left", 1.0);
}

static void look_from_eye(unsigned program)
{
    glUseProgram(program);
    hc_upload_int(program, "u_shadows", 1);
    hc_upload_float(program, "u_details_left", HC_BY_DISTANCE);
}

static hc_result draw_sunview(hc_terrain_gl *gl, const hc_terrain *terrain, hc_log *log)
{
    const hc_sunview *view = &terrain->sunview;
    hc_bands          bands;
    hc_eye            eye;
    hc_sunview_eye(&eye, terrain);
    hc_result result = hc_bands_make(&bands, view->side, view->side, TEXTURES, log);
    result           = result != HC_OK ? result : hc_bands_take_bodies(&bands, &gl->bodies, log);
    bands.program    = gl->program;
    if (result == HC_OK) {
        look_from_sun(gl->program, terrain, &eye);
        if (gl->bodies.count > 0) {
            look_from_sun(gl->bodies.program, terrain, &eye);
        }
        result = hc_bands_distances(view->depths, &bands, &eye, &terrain->options.progress, log);
    }
    if (result == HC_OK) {
        look_from_eye(gl->program);
        if (gl->bodies.count > 0) {
            look_from_eye(gl->bodies.program);
        }
        result = hc_upload_image(&gl->textures[SUNVIEW], SUNVIEW, view->depths, view->side,
                                 view->side, 1, "shadow map", log);
    }
    hc_bands_free(&bands);
    return result;
}

hc_result hc_terrain_gl_make(hc_terrain_gl **gl, const hc_terrain *terrain, hc_log *log)
{
    *gl = calloc(1, sizeof **gl);
    if (*gl == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for OpenGL");
    }
    hc_result result = hc_gl_open(&(*gl)->context, log);
    result           = result != HC_OK ? result : load((*gl)->textures, terrain, log);
    result = result != HC_OK ? result : build(&(*gl)->program, terrain, "screen.vert", false, log);
    if (result == HC_OK && terrain->exact != NULL) {
        result = build(&(*gl)->exact, terrain, "screen.vert", true, log);
    }
    if (result == HC_OK && terrain->bodies != NULL) {
        result = add_bodies(*gl, terrain, log);
    }
    if (result == HC_OK && terrain->scene.polygons != HC_POLYGONS_NONE) {
        result = add_polygons(*gl, terrain, log);
    }
    if (result == HC_OK && terrain->sunview.side > 0 && hc_terrain_gl_sees_sun(terrain)) {
        result = draw_sunview(*gl, terrain, log);
    }
    return result; /* hc_terrain_destroy frees what there is */
}

/* ---- pictures ------------------------------------------------------------------------------- */

typedef struct job {
    const hc_terrain *terrain;
    const hc_eye     *eye;
} job;

static void add(void *user, hc_pixel *pixel, const hc_sample *sample, const double direction[3],
                int row)
{
    const job *j = user;
    (void)row;
    hc_terrain_add(pixel, j->terrain, j->eye, sample, direction);
}

static hc_result draw(hc_pixel *pixels, double *seconds, const hc_terrain *terrain,
                      const hc_eye *eye, hc_bands *bands, hc_log *log)
{
    job j                     = { terrain, eye };
    bands->program            = terrain->gl->program;
    bands->exact              = terrain->gl->exact;
    const unsigned programs[] = { bands->program, bands->exact, bands->bodies.program,
                                  bands->bodies.ground_program };
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        if (programs[i] != 0) {
            glUseProgram(programs[i]);
            set_eye(programs[i], terrain, eye);
        }
    }
    const double start = hc_clock_now();
    if (bands->bodies.ground != NULL) {
        hc_polygons_aim(&terrain->gl->polygons, terrain, eye);
    }
    const double aimed = hc_clock_now() - start; /* it is a part of drawing them */
    if (!terrain->gl->warm) { /* as much work as a picture, where the ground is triangles */
        hc_bands_warm(bands);
        terrain->gl->warm = true;
    }
    const hc_result result =
        hc_bands_draw(pixels, seconds, bands, eye, &terrain->options.progress, add, &j, log);
    *seconds += aimed;
    return result;
}

hc_result hc_terrain_gl_draw(hc_pixel *pixels, double *seconds, const hc_terrain *terrain,
                             const hc_eye *eye, hc_log *log)
{
    hc_bands  bands;
    hc_result result = hc_gl_use(&terrain->gl->context, log);
    if (result != HC_OK) {
        return result;
    }
    result = hc_bands_make(&bands, eye->width, eye->height, TEXTURES, log);
    if (result == HC_OK) {
        result = hc_bands_take_bodies(&bands, &terrain->gl->bodies, log);
    }
    if (result == HC_OK) {
        result = draw(pixels, seconds, terrain, eye, &bands, log);
    }
    hc_bands_free(&bands);
    return result;
}
