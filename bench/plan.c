#include "plan.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

int hc_bench_repeat(const hc_bench_plan *plan)
{
    return plan->repeat > 0 ? plan->repeat : HC_BENCH_REPEAT;
}

bool hc_bench_stopped(const hc_bench_plan *plan)
{
    return plan->stop != NULL && plan->stop();
}

bool hc_bench_chosen(const hc_bench_plan *plan, const char *method)
{
    for (int i = 0; i < plan->method_count; i++) {
        if (strcmp(plan->methods[i], method) == 0) {
            return true;
        }
    }
    return plan->method_count == 0;
}

/* ---- fields ---------------------------------------------------------------------------------- */

static int mirrored(int i, int side)
{
    const int at = i % (2 * side);
    return at < side ? at : 2 * side - 1 - at;
}

static hc_result fill(float *heights, int side, const hc_bench_ground *ground, uint64_t seed,
                      hc_log *log)
{
    const hc_field *tile = ground->tile;
    if (tile == NULL) {
        return hc_synth(heights, side, side, ground->name, seed, log);
    }
    for (int y = 0; y < side; y++) {
        const float *row = tile->heights + (size_t)mirrored(y, tile->height) * (size_t)tile->width;
        for (int x = 0; x < side; x++) {
            heights[(size_t)y * (size_t)side + (size_t)x] = row[mirrored(x, tile->width)];
        }
    }
    return HC_OK;
}

static hc_result measure(const hc_bench_plan *plan, const hc_bench_ground *ground, int side,
                         hc_bench_body *body, void *job, hc_log *log)
{
    float         *heights = malloc((size_t)side * (size_t)side * sizeof *heights);
    const hc_field field   = { .heights = heights, .width = side, .height = side };
    hc_result      result  = HC_ERROR_MEMORY;
    if (heights != NULL) {
        result = fill(heights, side, ground, plan->seed, log);
        result = result == HC_OK ? body(job, ground->name, &field) : result;
    }
    free(heights);
    return result;
}

hc_result hc_bench_each_field(const hc_bench_plan *plan, hc_bench_body *body, void *job,
                              hc_log *log)
{
    hc_result result = HC_OK;
    for (int i = 0; i < plan->field_count; i++) {
        for (int s = 0; s < plan->side_count && result == HC_OK; s++) {
            result = measure(plan, &plan->fields[i], plan->sides[s], body, job, log);
        }
    }
    return result;
}

/* ---- ratios ---------------------------------------------------------------------------------- */

static hc_result turn_to_cells(float **ratios, const hc_field *field, hc_cones cones, size_t bytes)
{
    float *cells = malloc(bytes);
    if (cells == NULL) {
        return HC_ERROR_MEMORY;
    }
    hc_bake_cell_ratios(cells, *ratios, field->width, field->height, cones, field->wrap);
    free(*ratios);
    *ratios = cells;
    return HC_OK;
}

hc_result hc_bench_bake_ratios(float **ratios, const hc_field *field,
                               const hc_cone_options *options, bool cells, hc_log *log)
{
    const size_t samples = (size_t)field->width * (size_t)field->height;
    const size_t bytes   = samples * (size_t)hc_cones_channels(options->cones) * sizeof **ratios;
    *ratios              = malloc(bytes);
    if (*ratios == NULL) {
        return HC_ERROR_MEMORY;
    }
    const hc_result result = hc_bake_cone_map(*ratios, field, options, log);
    return result == HC_OK && cells ? turn_to_cells(ratios, field, options->cones, bytes) : result;
}
