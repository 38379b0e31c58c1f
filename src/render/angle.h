/* Angles without libm, whose last bits differ between machines. */
#ifndef HC_RENDER_ANGLE_H
#define HC_RENDER_ANGLE_H

#define HC_PI 3.14159265358979323846

/* As atan2, within 2^-50 of it; 0 at the origin. */
double hc_angle(double y, double x);

/* |x| < 1.49, in radians. */
double hc_tangent(double x);

/* Cosine and sine of an angle in full turns. */
void hc_turn(double *cosine, double *sine, double turns);

#endif
