#include "load.h"

#include "base/fail.h"
#include "gl/context.h"
#include "gl/program.h"

#include <epoxy/gl.h>

#include <math.h>

/* ---- textures ------------------------------------------------------------------------------ */

static hc_result check_size(int width, int height, const char *what, hc_log *log)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return width <= most && height <= most
               ? HC_OK
               : hc_fail(
                   log, HC_ERROR_LIMIT,
                   "%s of %d x %d: textures of this driver have at most %d texels a side; use "
                   "cpu",
                   what, width, height, most);
}

static void begin_texture(unsigned *texture, int unit, int levels)
{
    glGenTextures(1, texture);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, *texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                    levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
}

static hc_result load_image(unsigned *texture, int unit, const float *texels, int width, int height,
                            int channels, const char *what, hc_log *log)
{
    static const GLenum inner[] = { 0, GL_R32F, 0, GL_RGB32F, GL_RGBA32F };
    static const GLenum outer[] = { 0, GL_RED, 0, GL_RGB, GL_RGBA };
    const hc_result     result  = check_size(width, height, what, log);
    if (result != HC_OK) {
        return result;
    }
    begin_texture(texture, unit, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, (GLint)inner[channels], width, height, 0, outer[channels],
                 GL_FLOAT, texels);
    return hc_gl_check(what, log);
}

/* textureGather reads over the edges that repeat. */
static void set_wrap(hc_wrap wrap)
{
    const bool u = ((unsigned)wrap & HC_WRAP_U) != 0;
    const bool v = ((unsigned)wrap & HC_WRAP_V) != 0;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, u ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, v ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

static hc_result load_pyramid(unsigned *texture, int unit, const hc_pyramid *pyramid, hc_log *log)
{
    begin_texture(texture, unit, pyramid->levels);
    for (int level = 0; level < pyramid->levels; level++) {
        int          width, height;
        const float *values = hc_pyramid_level(pyramid, level, &width, &height);
        glTexImage2D(GL_TEXTURE_2D, level, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, values);
    }
    return hc_gl_check("pyramid", log);
}

/* That of qdm is another one than that of the exact caster beside it. */
static hc_result load_bounds(unsigned *texture, int unit, const hc_tracer *tracer, hc_log *log)
{
    const hc_pyramid *bounds = tracer != NULL ? hc_tracer_bounds(tracer) : NULL;
    return bounds != NULL ? load_pyramid(texture, unit, bounds, log) : HC_OK;
}

hc_result hc_gl_load(unsigned textures[HC_GL_TEXTURES], const hc_stage *stage, hc_log *log)
{
    const hc_relief   *relief = &stage->scene.relief;
    const hc_material *m      = &stage->scene.material;
    const hc_field    *field  = &relief->field;
    const bool         needs  = hc_trace_method_needs(relief->trace.method) != HC_NEEDS_NOTHING;
    hc_result          result = load_image(&textures[HC_GL_HEIGHTS], HC_GL_HEIGHTS, field->heights,
                                           field->width, field->height, 1, "field", log);
    set_wrap(field->wrap);
    if (result == HC_OK && needs) {
        result =
            load_image(&textures[HC_GL_RATIOS], HC_GL_RATIOS, relief->trace.ratios, field->width,
                       field->height, hc_cones_channels(relief->trace.cones), "ratios", log);
    }
    if (result == HC_OK) {
        result = load_bounds(&textures[HC_GL_BOUNDS], HC_GL_BOUNDS, stage->tracer, log);
    }
    if (result == HC_OK) {
        result = load_bounds(&textures[HC_GL_EXACT_BOUNDS], HC_GL_EXACT_BOUNDS, stage->exact, log);
    }
    if (result == HC_OK && m->albedo != NULL) {
        result = load_image(&textures[HC_GL_ALBEDO], HC_GL_ALBEDO, m->albedo, m->albedo_width,
                            m->albedo_height, 3, "albedo", log);
    }
    return result;
}

/* ---- uniforms ------------------------------------------------------------------------------ */

int hc_gl_method(hc_trace_method method)
{
    static const int numbers[] = {
        [HC_TRACE_SAFE] = 1,        [HC_TRACE_MAXMIP] = 2,     [HC_TRACE_QDM] = 3,
        [HC_TRACE_PARALLAX] = 4,    [HC_TRACE_LINEAR] = 5,     [HC_TRACE_RELIEF] = 6,
        [HC_TRACE_OCCLUSION] = 7,   [HC_TRACE_CONE_FIXED] = 8, [HC_TRACE_CONE_LOOP] = 9,
        [HC_TRACE_CONE_EXACT] = 10, [HC_TRACE_RELAXED] = 11,   [HC_TRACE_ROBUST] = 12,
        [HC_TRACE_QUICK] = 13
    };
    return numbers[method];
}

/* Uniforms that the compiler has thrown away have the location -1, which GL ignores. */
static void set_int(unsigned program, const char *name, int value)
{
    glUniform1i(glGetUniformLocation(program, name), value);
}

static void set_float(unsigned program, const char *name, double value)
{
    glUniform1f(glGetUniformLocation(program, name), (float)value);
}

static void set_pair(unsigned program, const char *name, double x, double y)
{
    glUniform2f(glGetUniformLocation(program, name), (float)x, (float)y);
}

static void set_vector(unsigned program, const char *name, const double v[3])
{
    glUniform3f(glGetUniformLocation(program, name), (float)v[0], (float)v[1], (float)v[2]);
}

static void set_field(unsigned program, const hc_stage *stage, hc_trace_method method)
{
    const hc_field         *field = &stage->scene.relief.field;
    const hc_trace_options *trace = &stage->scene.relief.trace;
    const unsigned          wrap  = (unsigned)field->wrap;
    const double            zero =
        (field->registration == HC_GRID ? 0.0 : 0.5) - (method == HC_TRACE_QDM ? 0.5 : 0.0);
    const bool exact = method == HC_TRACE_MAXMIP && trace->method != HC_TRACE_MAXMIP;
    set_int(program, "hc_heights", HC_GL_HEIGHTS);
    set_int(program, "hc_ratios", HC_GL_RATIOS);
    set_int(program, "hc_bounds", exact ? HC_GL_EXACT_BOUNDS : HC_GL_BOUNDS);
    set_int(program, "hc_levels", hc_pyramid_levels(field->width, field->height));
    glUniform2i(glGetUniformLocation(program, "hc_size"), field->width, field->height);
    glUniform2i(glGetUniformLocation(program, "hc_wraps"), (wrap & HC_WRAP_U) != 0,
                (wrap & HC_WRAP_V) != 0);
    set_pair(program, "hc_steps", floor(1.0 / hc_field_step_u(field) + 0.5),
             floor(1.0 / hc_field_step_v(field) + 0.5));
    set_pair(program, "hc_zero", zero, zero);
    set_int(program, "hc_step_count", trace->steps);
    set_int(program, "hc_refinements", trace->refinements);
}

static void set_shape(unsigned program, const hc_stage *stage)
{
    const hc_shape *shape = &stage->shape;
    set_int(program, "u_body", (int)shape->body);
    set_int(program, "u_edge", (int)stage->scene.relief.edge);
    set_float(program, "u_depth", shape->depth);
    set_pair(program, "u_fade", (double)stage->scene.relief.fade[0],
             (double)stage->scene.relief.fade[1]);
    set_pair(program, "u_lod", (double)stage->scene.relief.lod[0],
             (double)stage->scene.relief.lod[1]);
    set_int(program, "u_lod_steps", stage->scene.relief.lod_steps);
    set_float(program, "u_radius", shape->radius);
    set_float(program, "u_ring", shape->ring);
    set_pair(program, "u_half", shape->half[0], shape->half[1]);
    set_pair(program, "u_repeat", shape->repeat[0], shape->repeat[1]);
    set_float(program, "u_bound", shape->bound);
}

static void set_light(unsigned program, const hc_stage *stage)
{
    const hc_light    *light    = &stage->scene.light;
    const hc_material *m        = &stage->scene.material;
    const double       shares[] = { (double)m->ambient, (double)m->diffuse, (double)m->specular };
    const double colour[] = { (double)m->colour[0], (double)m->colour[1], (double)m->colour[2] };
    set_int(program, "u_lamp", light->lamp);
    set_vector(program, "u_light", light->lamp ? light->place : stage->sun);
    set_int(program, "u_shadows", !light->no_shadows);
    set_float(program, "u_shadow_slip", stage->shadow_slip);
    set_int(program, "u_albedo", HC_GL_ALBEDO);
    set_int(program, "u_textured", m->albedo != NULL);
    set_vector(program, "u_colour", colour);
    set_vector(program, "u_shares", shares);
    set_int(program, "u_gloss", m->gloss);
}

void hc_gl_set(unsigned program, const hc_stage *stage, hc_trace_method method)
{
    set_field(program, stage, method);
    set_shape(program, stage);
    set_light(program, stage);
    set_vector(program, "u_eye", stage->eye.place);
    set_vector(program, "u_forward", stage->eye.forward);
    set_vector(program, "u_right", stage->eye.right);
    set_vector(program, "u_down", stage->eye.down);
    set_int(program, "u_orthographic", stage->scene.camera.orthographic > 0.0F);
    set_pair(program, "u_picture", stage->width, stage->height);
    set_pair(program, "u_depth_range", fmax(stage->near, 1e-3), stage->far);
}

/* ---- the program ---------------------------------------------------------------------------- */

static hc_shader_text text(const char *name)
{
    return (hc_shader_text){ name, hc_shader_text_named(name) };
}

hc_result hc_gl_build_relief(unsigned *program, const char *head, hc_log *log)
{
    const hc_shader_text vertex[]   = { text("relief.vert"), { NULL, NULL } };
    const hc_shader_text fragment[] = { text("heightcast.glsl"),
                                        text("relief.frag"),
                                        { NULL, NULL } };
    return hc_gl_build(program, head, vertex, fragment, log);
}
