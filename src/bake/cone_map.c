/* hc_bake_cone_map: the method that was asked for. */
#include "base/fail.h"
#include "cone_job.h"

static hc_result run(const hc_cone_job *job, hc_method method)
{
    switch (method) {
    case HC_METHOD_EXACT: return hc_cone_exact(job);
    case HC_METHOD_BRUTE: return hc_cone_brute(job);
    case HC_METHOD_RING: return hc_cone_ring(job);
    case HC_METHOD_QUICK: return hc_cone_quick(job, false, false);
    case HC_METHOD_QUICK_IMPROVED: return hc_cone_quick(job, true, false);
    case HC_METHOD_QUICK_CENTRE: return hc_cone_quick(job, true, true);
    case HC_METHOD_QUICK_NAIVE_CENTRE: return hc_cone_quick(job, false, true);
    case HC_METHOD_GEMS: return hc_cone_gems(job);
    case HC_METHOD_FALLING_EDGE: return hc_cone_falling_edge(job);
    }
    return hc_fail(job->log, HC_ERROR_ARGUMENT, "options.method %d is not known", (int)method);
}

hc_result hc_bake_cone_map(float *ratios, const hc_field *field, const hc_cone_options *options,
                           hc_log *log)
{
    const hc_cone_options defaults = { 0 };
    const hc_cone_options given    = options == NULL ? defaults : *options;
    hc_cone_job           job;
    hc_result             result = hc_cone_job_init(&job, ratios, field, &given, log);
    if (result == HC_OK) {
        result = run(&job, given.method);
    }
    if (result == HC_OK) {
        const size_t count = (size_t)job.width * (size_t)job.height * (size_t)job.channels;
        hc_limit_ratios(ratios, count, given.max_ratio);
    }
    return result;
}
