/* Memory and level table of a max pyramid. */
#include "highest.h"

#include "base/fail.h"

#include <stdlib.h>

hc_result hc_highest_allocate(hc_highest *made, int width, int height, hc_log *log)
{
    const size_t floats = hc_pyramid_size(width, height);
    float       *values = floats > 0 ? malloc(floats * sizeof *values) : NULL;
    *made               = (hc_highest){ .width  = width,
                                        .height = height,
                                        .levels = hc_pyramid_levels(width, height),
                                        .values = values };
    if (values == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the pyramid of %d x %d samples", width,
                       height);
    }
    return HC_OK;
}

void hc_highest_fill(hc_highest *made, const float *heights)
{
    hc_pyramid pyramid;
    hc_bake_pyramid(&pyramid, made->values, heights, made->width, made->height, HC_MAXIMUM);
    for (int level = 0; level < made->levels; level++) {
        made->level[level] = hc_pyramid_level(&pyramid, level, NULL, NULL);
    }
}
