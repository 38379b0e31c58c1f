/* Jobs: checks, defaults, which searches they take, and ratios from what those find. For all that
 * bakes cones, on whatever machine. */
#include "cone_job.h"
#include "base/fail.h"
#include "base/parallel.h"
#include "canonical.h"
#include "field/shape.h"

const float hc_aniso_elongation[HC_ANISO_COUNT] = { 0.25F, 0.5F, 1.0F, 2.0F, 4.0F };

void hc_aniso_choose(float *ratios, const float steepness[HC_ANISO_COUNT])
{
    float slope_u = 0.0F;
    float slope_v = 0.0F;
    for (int i = 0; i < HC_ANISO_COUNT; i++) {
        const float u = steepness[i] * hc_aniso_elongation[i];
        const float v = steepness[i] / hc_aniso_elongation[i];
        if (i == 0 || u + v < slope_u + slope_v) {
            slope_u = u;
            slope_v = v;
        }
    }
    ratios[0] = hc_ratio(slope_u);
    ratios[1] = hc_ratio(slope_v);
    ratios[2] = hc_ratio(steepness[HC_ANISO_COUNT / 2]);
}

int hc_cone_searches(hc_cone_search searches[HC_CONE_SEARCHES_MAX], const hc_cone_job *job)
{
    const bool aniso = job->cones == HC_CONES_ANISO;
    const int  count = aniso ? HC_ANISO_COUNT : job->channels;
    for (int i = 0; i < count; i++) {
        const float stretch = aniso ? hc_aniso_elongation[i] : 1.0F;
        searches[i] =
            (hc_cone_search){ .step_u = job->step_u * stretch, .step_v = job->step_v / stretch };
        if (job->cones == HC_CONES_QUAD) {
            searches[i].sign_u = i % 2 == 0 ? 1 : -1;
            searches[i].sign_v = i / 2 == 0 ? 1 : -1;
        }
    }
    return count;
}

void hc_write_ratios(float *ratios, hc_cones cones, const float *steepness)
{
    if (cones == HC_CONES_ANISO) {
        hc_aniso_choose(ratios, steepness);
        return;
    }
    for (int i = 0; i < hc_cones_channels(cones); i++) {
        ratios[i] = hc_ratio(steepness[i]);
    }
}

hc_result hc_cone_job_init(hc_cone_job *job, float *ratios, const hc_field *field,
                           const hc_cone_options *options, hc_log *log)
{
    if (hc_cones_channels(options->cones) == 0 || hc_method_name(options->method) == NULL
        || !hc_method_makes(options->method, options->cones)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "options.method %d does not make cones %d",
                       (int)options->method, (int)options->cones);
    }
    if (!(options->max_ratio >= 0.0F) || options->threads < 0 || options->threads > HC_THREADS_MAX
        || options->gems_steps < 0 || options->gems_steps > 4096) {
        return hc_fail(
            log, HC_ERROR_ARGUMENT,
            "options: max_ratio %g must be at least 0, threads %d in 0..%d, gems_steps %d in "
            "0..4096",
            (double)options->max_ratio, options->threads, HC_THREADS_MAX, options->gems_steps);
    }
    const int       threads = hc_threads_resolve(options->threads);
    const hc_result checked = hc_field_check_on(field, threads, log);
    if (checked != HC_OK) {
        return checked;
    }
    *job = (hc_cone_job){ .ratios     = ratios,
                          .heights    = field->heights,
                          .width      = field->width,
                          .height     = field->height,
                          .wrap_u     = (field->wrap & HC_WRAP_U) != 0,
                          .wrap_v     = (field->wrap & HC_WRAP_V) != 0,
                          .step_u     = (float)hc_field_step_u(field),
                          .step_v     = (float)hc_field_step_v(field),
                          .cones      = options->cones,
                          .channels   = hc_cones_channels(options->cones),
                          .threads    = threads,
                          .isa        = hc_isa_resolve(options->isa),
                          .gems_steps = options->gems_steps == 0 ? 64 : options->gems_steps,
                          .progress   = options->progress,
                          .log        = log };
    return HC_OK;
}

void hc_limit_ratios(float *ratios, size_t count, float max_ratio)
{
    if (max_ratio > 0.0F) {
        for (size_t i = 0; i < count; i++) {
            ratios[i] = ratios[i] < max_ratio ? ratios[i] : max_ratio;
        }
    }
}
