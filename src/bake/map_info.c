/* What a map will be: options and defaults resolved, and what makes no sense refused. */
#include "base/fail.h"

#include <heightcast/bake.h>

#include <math.h>
#include <stdio.h>

static bool has_ratios(const hc_map_info *info)
{
    return (info->kind == HC_MAP_CONE || info->kind == HC_MAP_RELAXED)
           && info->layout != HC_LAYOUT_HEIGHT;
}

static hc_layout usual_layout(hc_map_kind kind, hc_cones cones)
{
    switch (kind) {
    case HC_MAP_CONE:
    case HC_MAP_RELAXED:
        return cones == HC_CONES_QUAD    ? HC_LAYOUT_QUAD
               : cones == HC_CONES_ANISO ? HC_LAYOUT_ANISO
                                         : HC_LAYOUT_RG;
    case HC_MAP_PYRAMID:
    case HC_MAP_BOUNDS: return HC_LAYOUT_MINMAX;
    case HC_MAP_GRADIENT: return HC_LAYOUT_GRADIENT;
    }
    return HC_LAYOUT_AUTO;
}

/* A limit is what the largest code stands for, so codes cannot do without one. */
static float usual_limit(const hc_map_info *info, float wanted)
{
    if (!has_ratios(info)) {
        return 0.0F;
    }
    return wanted == 0.0F && info->bits < 32 ? 1.0F : wanted;
}

static bool is_relaxed(hc_method method)
{
    return method == HC_METHOD_GEMS || method == HC_METHOD_FALLING_EDGE;
}

/* The method that a map of this kind uses when `wanted` was asked for. */
static hc_method usual_method(hc_map_kind kind, hc_method wanted)
{
    return kind == HC_MAP_RELAXED && wanted == HC_METHOD_EXACT ? HC_METHOD_FALLING_EDGE : wanted;
}

static hc_result check_method(const hc_map_info *info, hc_method method, hc_log *log)
{
    const char *name = hc_method_name(method);
    if (name == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "method is %d; known are 0 .. %d", (int)method,
                       (int)HC_METHOD_FALLING_EDGE);
    }
    if (info->kind == HC_MAP_RELAXED && !is_relaxed(method)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "method %s does not make relaxed cones; gems and falling-edge do", name);
    }
    if (info->kind == HC_MAP_CONE && is_relaxed(method)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "method %s makes relaxed cones: ask for that kind",
                       name);
    }
    if (!hc_method_makes(method, info->cones)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "method %s does not make %s cones", name,
                       hc_cones_name(info->cones));
    }
    return HC_OK;
}

/* The original knew one way and one limit. */
static hc_result check_compat2006(const hc_map_info *info, const hc_cone_options *cone, hc_log *log)
{
    if (info->cones != HC_CONES_L2 || cone->method != HC_METHOD_EXACT) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "compat2006 makes l2 cones by its own search; leave cones and method alone");
    }
    if (cone->max_ratio != 0.0F && cone->max_ratio != 1.0F) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "max_ratio is %g; compat2006 has 1",
                       (double)cone->max_ratio);
    }
    if (info->width < 2 || info->height < 2) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "compat2006 needs 2 x 2 samples; the field has %d x %d", info->width,
                       info->height);
    }
    return HC_OK;
}

static hc_result name_method(hc_map_info *info, const hc_cone_options *cone, hc_log *log)
{
    if (!has_ratios(info)) {
        return HC_OK;
    }
    const hc_method method = usual_method(info->kind, cone->method);
    const hc_result result =
        info->compat2006 ? check_compat2006(info, cone, log) : check_method(info, method, log);
    if (result == HC_OK) {
        (void)snprintf(info->method, sizeof info->method, "%s",
                       info->compat2006 ? "2006" : hc_method_name(method));
    }
    return result;
}

static hc_map_info with_defaults(const hc_field *field, const hc_map_options *options)
{
    const bool  blocks = options->kind == HC_MAP_PYRAMID || options->kind == HC_MAP_BOUNDS;
    hc_map_info info   = { .kind         = options->kind,
                           .layout       = options->layout,
                           .cones        = options->cone.cones,
                           .bits         = options->bits,
                           .width        = field->width,
                           .height       = field->height,
                           .wrap         = field->wrap,
                           .registration = field->registration,
                           .compat2006   = options->compat2006,
                           .elevation    = field->elevation };
    if (info.layout == HC_LAYOUT_AUTO) {
        info.layout =
            info.compat2006 ? HC_LAYOUT_DUMMER : usual_layout(options->kind, options->cone.cones);
    }
    if (info.bits == 0) {
        info.bits = info.layout == HC_LAYOUT_DUMMER ? 8 : 32;
    }
    info.channels  = hc_layout_channels(info.layout);
    info.levels    = blocks ? hc_pyramid_levels(field->width, field->height) : 1;
    info.max_ratio = usual_limit(&info, options->cone.max_ratio);
    return info;
}

hc_result hc_map_info_for(hc_map_info *info, const hc_field *field, const hc_map_options *options,
                          hc_log *log)
{
    static const hc_map_options usual = { .bits = 0 };

    hc_result result = hc_field_check(field, log);
    if (result != HC_OK) {
        return result;
    }
    options = options != NULL ? options : &usual;
    *info   = with_defaults(field, options);
    result  = hc_map_info_check(info, log);
    return result == HC_OK ? name_method(info, &options->cone, log) : result;
}
