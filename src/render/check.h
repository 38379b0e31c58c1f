/* Is a number of a scene in its range? HC_ERROR_ARGUMENT names it. */
#ifndef HC_RENDER_CHECK_H
#define HC_RENDER_CHECK_H

#include "base/fail.h"

#include <math.h>

#define HC_FARTHEST 1e30

static inline hc_result check_whole(const char *what, int value, int low, int high, hc_log *log)
{
    return value >= low && value <= high
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "%s is %d; it must be %d .. %d", what, value, low,
                         high);
}

static inline hc_result check_number(const char *what, float value, float low, float high,
                                     hc_log *log)
{
    return value >= low && value <= high /* false for NaN */
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "%s is %g; it must be %g .. %g", what,
                         (double)value, (double)low, (double)high);
}

/* Rays are float, so there is an end. */
static inline hc_result check_point(const char *what, const double point[3], hc_log *log)
{
    return fabs(point[0]) <= HC_FARTHEST && fabs(point[1]) <= HC_FARTHEST
                   && fabs(point[2]) <= HC_FARTHEST /* false for NaN */
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "%s is %g, %g, %g; it must be within %g", what,
                         point[0], point[1], point[2], HC_FARTHEST);
}

static inline bool is_zero(const double point[3])
{
    return point[0] == 0.0 && point[1] == 0.0 && point[2] == 0.0;
}

/* Hand on what a check found wrong. */
#define CHECK(call)                                                                                \
    do {                                                                                           \
        const hc_result checked = (call);                                                          \
        if (checked != HC_OK) {                                                                    \
            return checked;                                                                        \
        }                                                                                          \
    } while (0)

#endif
