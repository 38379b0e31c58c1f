/* Making tracers: checks, memory, and which method answers. */
#include "tracer.h"

#include "methods.h"

#include "base/fail.h"
#include "field/shape.h"

#include <math.h>
#include <stdlib.h>

enum { STEPS_MAX = 65536, REFINEMENTS_MAX = 64, THREADS_MAX = 1024 };

/* ---- checks -------------------------------------------------------------------------------- */

static hc_result check_range(const char *what, int value, int low, int high, hc_log *log)
{
    return value >= low && value <= high
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "options.%s is %d; it must be %d .. %d", what,
                         value, low, high);
}

static bool is_zero(const hc_placement *p)
{
    return p->spacing_x == 0.0 && p->spacing_y == 0.0 && p->scale_z == 0.0 && p->offset[0] == 0.0
           && p->offset[1] == 0.0 && p->offset[2] == 0.0;
}

static hc_result check_placement(const hc_placement *p, hc_log *log)
{
    const bool finite = isfinite(p->spacing_x) && isfinite(p->spacing_y) && isfinite(p->scale_z)
                        && isfinite(p->offset[0]) && isfinite(p->offset[1])
                        && isfinite(p->offset[2]);
    const bool whole = finite && p->spacing_x != 0.0 && p->spacing_y != 0.0 && p->scale_z > 0.0;
    return whole || is_zero(p)
               ? HC_OK
               : hc_fail(
                   log, HC_ERROR_ARGUMENT,
                   "options.placement has spacings %g and %g and scale_z %g; spacings must be "
                   "other than 0, scale_z above 0, all finite, or the whole placement zero",
                   p->spacing_x, p->spacing_y, p->scale_z);
}

static hc_result check_ratios(const hc_trace_options *options, hc_log *log)
{
    const char          *name  = hc_trace_method_name(options->method);
    const hc_trace_needs needs = hc_trace_method_needs(options->method);
    if (needs == HC_NEEDS_NOTHING) {
        return HC_OK;
    }
    if (options->ratios == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "options.ratios is NULL; %s needs %s", name,
                       needs == HC_NEEDS_CELL_RATIOS ? "the cell ratios of l1 or quad cones"
                       : needs == HC_NEEDS_RATIOS    ? "the ratios of l2 cones"
                                                     : "the ratios of relaxed l2 cones");
    }
    const bool diamond = options->cones == HC_CONES_L1 || options->cones == HC_CONES_QUAD;
    if (needs == HC_NEEDS_CELL_RATIOS ? diamond : options->cones == HC_CONES_L2) {
        return HC_OK;
    }
    return hc_fail(log, HC_ERROR_ARGUMENT, "options.cones is %s; %s takes %s",
                   hc_cones_name(options->cones), name,
                   needs == HC_NEEDS_CELL_RATIOS ? "l1 or quad" : "l2");
}

static hc_result check_options(const hc_trace_options *options, hc_log *log)
{
    if ((int)options->method < 0 || (int)options->method >= hc_trace_method_count()) {
        return check_range("method", (int)options->method, 0, hc_trace_method_count() - 1, log);
    }
    const hc_trace_method_facts *facts = &hc_trace_methods[options->method];
    const bool                   steps = options->surface == HC_SURFACE_STEPS;
    hc_result result = check_range("surface", (int)options->surface, 0, HC_SURFACE_STEPS, log);
    if (result == HC_OK && steps && !facts->knows_steps) {
        result =
            hc_fail(log, HC_ERROR_ARGUMENT,
                    "options.surface is steps; fast, safe, maxmip and qdm know it, %s does not",
                    facts->name);
    }
    result = result != HC_OK ? result : check_placement(&options->placement, log);
    result = result != HC_OK ? result : check_ratios(options, log);
    result = result != HC_OK ? result : check_range("steps", options->steps, 0, STEPS_MAX, log);
    result = result != HC_OK
                 ? result
                 : check_range("refinements", options->refinements, -2, REFINEMENTS_MAX, log);
    result =
        result != HC_OK ? result : check_range("isa", (int)options->isa, 0, HC_ISA_AVX512, log);
    return result != HC_OK ? result : check_range("threads", options->threads, 0, THREADS_MAX, log);
}

/* ---- making -------------------------------------------------------------------------------- */

static hc_tracer plan(const hc_field *field, const hc_trace_options *options)
{
    const hc_trace_method_facts *facts  = &hc_trace_methods[options->method];
    const bool                   placed = options->placement.scale_z != 0.0;
    hc_tracer                    made   = { .options = *options,
                                            .heights = field->heights,
                                            .width   = field->width,
                                            .height  = field->height,
                                            .march   = facts->march };
    made.tops          = options->surface == HC_SURFACE_STEPS || options->method == HC_TRACE_QDM;
    made.options.steps = options->steps != 0 ? options->steps : facts->steps;
    made.options.refinements =
        options->refinements != 0 ? options->refinements : HC_REFINEMENTS_DEFAULT;
    made.height_offset = placed ? options->placement.offset[2] : 0.0;
    made.height_scale  = placed ? options->placement.scale_z : 1.0;
    hc_axis_make(&made.axes[0], field, options, made.tops, false);
    hc_axis_make(&made.axes[1], field, options, made.tops, true);
    return made;
}

static size_t bounds_bytes(const hc_field *field, const hc_trace_options *options)
{
    return hc_trace_methods[options->method].bounds
               ? hc_pyramid_size(field->width, field->height) * sizeof(float)
               : 0;
}

static hc_result take_bounds(hc_tracer *tracer, size_t bytes, hc_log *log)
{
    float *values = malloc(bytes);
    if (values == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the %zu bytes of a pyramid", bytes);
    }
    hc_bounds_fill(tracer, values);
    return HC_OK;
}

hc_result hc_tracer_create(hc_tracer **tracer, const hc_field *field,
                           const hc_trace_options *options, hc_log *log)
{
    static const hc_trace_options zero   = { .method = HC_TRACE_FAST };
    const hc_trace_options       *given  = options != NULL ? options : &zero;
    hc_result                     result = hc_field_check(field, log);
    result                               = result != HC_OK ? result : check_options(given, log);
    if (result != HC_OK) {
        return result;
    }
    hc_tracer *made = malloc(sizeof *made);
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a tracer");
    }
    *made              = plan(field, given);
    const size_t bytes = bounds_bytes(field, given);
    if (bytes != 0) {
        result = take_bounds(made, bytes, log);
    } else if (made->march == NULL) {
        result = hc_fast_create(&made->fast, made, field, given, log);
    }
    if (result != HC_OK) {
        hc_tracer_destroy(made);
        return result;
    }
    *tracer = made;
    return HC_OK;
}

void hc_tracer_destroy(hc_tracer *tracer)
{
    if (tracer != NULL) {
        hc_fast_destroy(tracer->fast);
        free(tracer->bounds.values);
        free(tracer->owned);
        free(tracer);
    }
}

size_t hc_tracer_bytes(const hc_field *field, const hc_trace_options *options)
{
    static const hc_trace_options zero  = { .method = HC_TRACE_FAST };
    const hc_trace_options       *given = options != NULL ? options : &zero;
    if (hc_field_check(field, NULL) != HC_OK || check_options(given, NULL) != HC_OK) {
        return 0;
    }
    if (given->method == HC_TRACE_FAST) {
        const size_t bytes = hc_fast_bytes(field, given);
        return bytes != 0 ? sizeof(hc_tracer) + bytes : 0;
    }
    return sizeof(hc_tracer) + bounds_bytes(field, given);
}

const hc_pyramid *hc_tracer_bounds(const hc_tracer *tracer)
{
    return tracer->bounds.values != NULL ? &tracer->bounds : NULL;
}

/* docs/algorithms.md, section 19, counts the roundings. */
void hc_tracer_tolerance(const hc_tracer *tracer, double *rise, double *reach)
{
    if (tracer->fast != NULL) {
        hc_fast_tolerance(tracer->fast, rise, reach);
        return;
    }
    double span = 0.0;
    for (int i = 0; i < 2; i++) {
        const double periods = tracer->axes[i].wraps ? HC_PERIODS_MAX + 1.0 : 1.0;
        span                 = fmax(span, periods * (tracer->axes[i].size + 1.0));
    }
    *rise  = 0x1p-45;
    *reach = 0x1p-48 * span;
}
