/* Bernstein coefficients bound a polynomial: where all are above 0 it has no root. Pieces of the
 * interval that they cannot clear are halved, from the left, and pieces that they can are left
 * behind, so the first piece that is small enough has the first root in it, or comes as near to one
 * as rounding can tell.
 * Source: Farouki, Rajan. On the numerical condition of polynomials in Bernstein form. 1987 */
#include "quartic.h"

#include <math.h>
#include <stdbool.h>

enum { LEVELS = 24 }; /* a piece is at least 2^-LEVELS of the interval */

/* Of c on x .. x + h, with its ends at 0 and 1. */
static void bernstein(double b[HC_QUARTIC], const double c[HC_QUARTIC], double x, double h)
{
    const double a0 = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
    const double a1 = h * (c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * 4.0 * c[4])));
    const double a2 = h * h * (c[2] + x * (3.0 * c[3] + x * 6.0 * c[4]));
    const double a3 = h * h * h * (c[3] + x * 4.0 * c[4]);
    const double a4 = h * h * h * h * c[4];
    b[0]            = a0;
    b[1]            = a0 + a1 / 4.0;
    b[2]            = a0 + a1 / 2.0 + a2 / 6.0;
    b[3]            = a0 + 3.0 * a1 / 4.0 + a2 / 2.0 + a3 / 4.0;
    b[4]            = a0 + a1 + a2 + a3 + a4;
}

static bool is_above(const double b[HC_QUARTIC])
{
    return fmin(fmin(fmin(b[0], b[1]), fmin(b[2], b[3])), b[4]) > 0.0;
}

double hc_quartic_first(const double c[HC_QUARTIC], double length)
{
    double       unit[HC_QUARTIC], b[HC_QUARTIC];
    double       power = 1.0;
    unsigned int piece = 0; /* of 2^level */
    int          level = 0;
    if (c[0] <= 0.0) {
        return 0.0;
    }
    for (int k = 0; k < HC_QUARTIC; k++, power *= length) {
        unit[k] = c[k] * power;
    }
    while (piece >> level == 0) {
        const double h = 1.0 / (double)(1U << level);
        bernstein(b, unit, piece * h, h);
        if (is_above(b)) {
            piece++;
            while (level > 0 && piece % 2 == 0) {
                piece /= 2;
                level--;
            }
        } else if (level == LEVELS) {
            return length * piece * h;
        } else {
            piece *= 2;
            level++;
        }
    }
    return INFINITY;
}
