/* The first root of a polynomial. */
#ifndef HC_RENDER_TERRAIN_QUARTIC_H
#define HC_RENDER_TERRAIN_QUARTIC_H

enum { HC_QUARTIC = 5 }; /* coefficients */

/* Least x in 0 .. length where a polynomial of the fourth degree is 0 or less, c[0] + c[1] x + ...;
 * INFINITY: it is above 0 everywhere. Exact but for rounding: see quartic.c. */
double hc_quartic_first(const double c[HC_QUARTIC], double length);

#endif
