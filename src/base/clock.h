#ifndef HC_BASE_CLOCK_H
#define HC_BASE_CLOCK_H

#include <time.h>

/* Seconds since some moment. */
static inline double hc_clock_now(void)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

#endif
