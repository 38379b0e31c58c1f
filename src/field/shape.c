/* The size check that fields, raw samples and made fields share. */
#include "shape.h"

hc_result hc_check_shape(const char *what, int width, int height, size_t element_bytes, hc_log *log)
{
    if (width < 1 || width > HC_SIDE_MAX || height < 1 || height > HC_SIDE_MAX) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s size is %d x %d; sides are 1 .. %d", what, width,
                       height, HC_SIDE_MAX);
    }
    const uint64_t elements = (uint64_t)width * (uint64_t)height;
    if (elements > PTRDIFF_MAX / element_bytes) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s of %d x %d does not fit this machine's memory",
                       what, width, height);
    }
    return HC_OK;
}
