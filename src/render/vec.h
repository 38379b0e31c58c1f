/* Small vectors, in double precision. */
#ifndef HC_RENDER_VEC_H
#define HC_RENDER_VEC_H

#include <math.h>

static inline double hc_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out = a + s * b; out may be a. */
static inline void hc_add_scaled(double out[3], const double a[3], double s, const double b[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] + s * b[i];
    }
}

/* False, and `v` as it was, if it has no direction. */
static inline int hc_unit(double v[3])
{
    const double length = sqrt(hc_dot(v, v));
    for (int i = 0; i < 3 && length > 0.0; i++) {
        v[i] /= length;
    }
    return length > 0.0;
}

static inline void hc_cross(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

#endif
