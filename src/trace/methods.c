/* The table of methods: names, needs, defaults, and where each is. */
#include "methods.h"

#include <math.h>

const hc_trace_method_facts hc_trace_methods[] = {
    { "fast", HC_NEEDS_NOTHING, NULL, true, 0, false },
    { "safe", HC_NEEDS_CELL_RATIOS, hc_march_safe, true, 0, false },
    { "maxmip", HC_NEEDS_NOTHING, hc_march_maxmip, true, 0, true },
    { "qdm", HC_NEEDS_NOTHING, hc_march_maxmip, true, 0, true },
    { "parallax", HC_NEEDS_NOTHING, hc_march_parallax, false, 0, false },
    { "linear", HC_NEEDS_NOTHING, hc_march_linear, false, 32, false },
    { "relief", HC_NEEDS_NOTHING, hc_march_relief, false, 32, false },
    { "occlusion", HC_NEEDS_NOTHING, hc_march_occlusion, false, 32, false },
    { "cone-fixed", HC_NEEDS_RATIOS, hc_march_cone_fixed, false, 10, false },
    { "cone-loop", HC_NEEDS_RATIOS, hc_march_cone_loop, false, 256, false },
    { "cone-exact", HC_NEEDS_RATIOS, hc_march_cone_exact, false, 256, false },
    { "relaxed", HC_NEEDS_RELAXED, hc_march_relaxed, false, 256, false },
    { "robust", HC_NEEDS_RATIOS, hc_march_robust, false, 256, false },
    { "quick", HC_NEEDS_RATIOS, hc_march_quick, false, 256, false },
    { "pdm", HC_NEEDS_NOTHING, hc_march_pdm, false, 0, true },
};

enum { COUNT = sizeof hc_trace_methods / sizeof *hc_trace_methods };

int hc_trace_method_count(void)
{
    return COUNT;
}

const char *hc_trace_method_name(hc_trace_method method)
{
    return (unsigned)method < COUNT ? hc_trace_methods[method].name : "unknown";
}

hc_trace_needs hc_trace_method_needs(hc_trace_method method)
{
    return (unsigned)method < COUNT ? hc_trace_methods[method].needs : HC_NEEDS_NOTHING;
}

int hc_trace_method_steps(hc_trace_method method)
{
    return (unsigned)method < COUNT ? hc_trace_methods[method].steps : 0;
}

const char *hc_surface_name(hc_surface surface)
{
    static const char *const names[] = { "bilinear", "steps" };
    return (unsigned)surface < 2 ? names[surface] : "unknown";
}
