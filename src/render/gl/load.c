#include "load.h"

#include <math.h>

/* ---- textures ------------------------------------------------------------------------------ */

/* That of qdm is another one than that of the exact caster beside it. */
static hc_result load_bounds(unsigned *texture, int unit, const hc_tracer *tracer, hc_log *log)
{
    const hc_pyramid *bounds = tracer != NULL ? hc_tracer_bounds(tracer) : NULL;
    return bounds != NULL ? hc_upload_pyramid(texture, unit, bounds, log) : HC_OK;
}

static hc_result load_field(unsigned textures[HC_GL_TEXTURES], const hc_stage *stage, hc_log *log)
{
    const hc_relief *relief = &stage->scene.relief;
    const hc_field  *field  = &relief->field;
    const bool       needs  = hc_trace_method_needs(relief->trace.method) != HC_NEEDS_NOTHING;
    hc_result result = hc_upload_image(&textures[HC_GL_HEIGHTS], HC_GL_HEIGHTS, field->heights,
                                       field->width, field->height, 1, "field", log);
    hc_upload_wrap(field->wrap);
    if (result == HC_OK && needs) {
        result = hc_upload_image(&textures[HC_GL_RATIOS], HC_GL_RATIOS, relief->trace.ratios,
                                 field->width, field->height,
                                 hc_cones_channels(relief->trace.cones), "ratios", log);
    }
    return result;
}

hc_result hc_gl_load(unsigned textures[HC_GL_TEXTURES], const hc_stage *stage, hc_log *log)
{
    const hc_material *m      = &stage->scene.material;
    hc_result          result = HC_OK;
    if (stage->scene.relief.baked != NULL) {
        hc_upload_baked(HC_GL_HEIGHTS, HC_GL_RATIOS, stage->scene.relief.baked);
    } else {
        result = load_field(textures, stage, log);
    }
    if (result == HC_OK) {
        result = load_bounds(&textures[HC_GL_BOUNDS], HC_GL_BOUNDS, stage->tracer, log);
    }
    if (result == HC_OK) {
        result = load_bounds(&textures[HC_GL_EXACT_BOUNDS], HC_GL_EXACT_BOUNDS, stage->exact, log);
    }
    if (result == HC_OK) {
        result = hc_upload_blocks(&textures[HC_GL_BLOCKS], HC_GL_BLOCKS, stage->tracer, log);
    }
    if (result == HC_OK && m->albedo != NULL) {
        result = hc_upload_image(&textures[HC_GL_ALBEDO], HC_GL_ALBEDO, m->albedo, m->albedo_width,
                                 m->albedo_height, 3, "albedo", log);
    }
    return result;
}

/* ---- uniforms ------------------------------------------------------------------------------ */

static void set_shape(unsigned program, const hc_stage *stage)
{
    const hc_shape *shape = &stage->shape;
    hc_upload_int(program, "u_body", (int)shape->body);
    hc_upload_int(program, "u_edge", (int)stage->scene.relief.edge);
    hc_upload_float(program, "u_depth", shape->depth);
    hc_upload_pair(program, "u_fade", (double)stage->scene.relief.fade[0],
                   (double)stage->scene.relief.fade[1]);
    hc_upload_pair(program, "u_lod", (double)stage->scene.relief.lod[0],
                   (double)stage->scene.relief.lod[1]);
    hc_upload_int(program, "u_lod_steps", stage->scene.relief.lod_steps);
    hc_upload_float(program, "u_radius", shape->radius);
    hc_upload_float(program, "u_ring", shape->ring);
    hc_upload_pair(program, "u_half", shape->half[0], shape->half[1]);
    hc_upload_pair(program, "u_repeat", shape->repeat[0], shape->repeat[1]);
    hc_upload_float(program, "u_bound", shape->bound);
}

static void set_light(unsigned program, const hc_stage *stage)
{
    const hc_light    *light    = &stage->scene.light;
    const hc_material *m        = &stage->scene.material;
    const double       shares[] = { (double)m->ambient, (double)m->diffuse, (double)m->specular };
    const double colour[] = { (double)m->colour[0], (double)m->colour[1], (double)m->colour[2] };
    hc_upload_int(program, "u_lamp", light->lamp);
    hc_upload_vector(program, "u_light", light->lamp ? light->place : stage->sun);
    hc_upload_int(program, "u_shadows", !light->no_shadows);
    hc_upload_float(program, "u_shadow_slip", stage->shadow_slip);
    hc_upload_int(program, "u_albedo", HC_GL_ALBEDO);
    hc_upload_int(program, "u_textured", m->albedo != NULL);
    hc_upload_vector(program, "u_colour", colour);
    hc_upload_vector(program, "u_shares", shares);
    hc_upload_int(program, "u_gloss", m->gloss);
}

void hc_gl_set(unsigned program, const hc_stage *stage, hc_trace_method method)
{
    const hc_trace_options *trace = &stage->scene.relief.trace;
    const bool              exact = method == HC_TRACE_MAXMIP && trace->method != HC_TRACE_MAXMIP;
    hc_upload_int(program, "hc_heights", HC_GL_HEIGHTS);
    hc_upload_int(program, "hc_ratios", HC_GL_RATIOS);
    hc_upload_int(program, "hc_bounds", exact ? HC_GL_EXACT_BOUNDS : HC_GL_BOUNDS);
    hc_upload_block_shape(program, HC_GL_BLOCKS, stage->tracer);
    hc_upload_field(program, &stage->scene.relief.field, trace, method);
    set_shape(program, stage);
    set_light(program, stage);
    hc_upload_eye(program, &stage->eye);
    hc_upload_pair(program, "u_depth_range", fmax(stage->near, 1e-3), stage->far);
}

/* ---- the program ---------------------------------------------------------------------------- */

hc_result hc_gl_build_relief(unsigned *program, hc_gl_context *context, const char *head,
                             hc_log *log)
{
    const char *const  files[] = { "relief.frag", NULL };
    const hc_gl_recipe recipe  = hc_gl_recipe_of(head, "screen.vert", files);
    return hc_gl_program_of(program, context, &recipe, log);
}
