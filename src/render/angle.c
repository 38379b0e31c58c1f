#include "angle.h"

#include <math.h>

enum { SERIES_TERMS = 20, FRACTION_TERMS = 24 };

/* 0 <= x <= 1: the series of the arctangent, after a turn by pi / 4 where it would converge slowly:
 * then |x| <= 0.42, and the first term left out is below 2^-56. */
static double arctangent(double x)
{
    const int    turned = x > 0.4142;
    const double y      = turned ? (x - 1.0) / (x + 1.0) : x;
    double       sum    = 0.0;
    for (int i = SERIES_TERMS; i >= 0; i--) {
        sum = 1.0 / (2 * i + 1) - y * y * sum;
    }
    return (turned ? HC_PI / 4.0 : 0.0) + y * sum;
}

double hc_angle(double y, double x)
{
    const double a = fabs(x);
    const double b = fabs(y);
    if (!(a > 0.0) && !(b > 0.0)) {
        return 0.0;
    }
    double angle = b > a ? HC_PI / 2.0 - arctangent(a / b) : arctangent(b / a);
    angle        = x < 0.0 ? HC_PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}

/* Lambert's continued fraction. */
double hc_tangent(double x)
{
    double rest = 2 * FRACTION_TERMS + 1;
    for (int i = FRACTION_TERMS - 1; i >= 0; i--) {
        rest = 2 * i + 1 - x * x / rest;
    }
    return x / rest;
}

/* From the tangent of half the angle, in the quarter of the circle that is nearest. */
void hc_turn(double *cosine, double *sine, double turns)
{
    const double quarters = floor(4.0 * turns + 0.5);
    const double t        = hc_tangent((turns - 0.25 * quarters) * HC_PI);
    const double c        = (1.0 - t * t) / (1.0 + t * t);
    const double s        = 2.0 * t / (1.0 + t * t);
    const int    quarter  = (int)(quarters - 4.0 * floor(quarters / 4.0));
    const double x[4]     = { c, -s, -c, s };
    *cosine               = x[quarter];
    *sine                 = x[(quarter + 3) % 4];
}
