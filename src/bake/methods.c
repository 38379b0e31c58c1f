/* Which methods there are, and which cones each can make. */
#include <heightcast/bake.h>

#include <stddef.h>

const char *hc_method_name(hc_method method)
{
    static const char *const names[] = { "exact",
                                         "brute",
                                         "ring",
                                         "quick",
                                         "quick-improved",
                                         "quick-centre",
                                         "quick-naive-centre",
                                         "gems",
                                         "falling-edge" };
    const unsigned           index   = (unsigned)method;
    return index < sizeof names / sizeof *names ? names[index] : NULL;
}

bool hc_method_makes(hc_method method, hc_cones cones)
{
    switch (method) {
    case HC_METHOD_EXACT:
    case HC_METHOD_BRUTE:
    case HC_METHOD_QUICK:
    case HC_METHOD_QUICK_IMPROVED:
    case HC_METHOD_QUICK_CENTRE:
    case HC_METHOD_QUICK_NAIVE_CENTRE: return hc_cones_channels(cones) > 0;
    case HC_METHOD_RING: return cones == HC_CONES_L2 || cones == HC_CONES_L1;
    case HC_METHOD_GEMS:
    case HC_METHOD_FALLING_EDGE: return cones == HC_CONES_L2;
    }
    return false;
}
