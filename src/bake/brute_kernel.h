/* Brute force for one row of samples against one row of samples, in a form that compilers turn into
 * vectors: element by element, nothing reduced. Included with HC_BRUTE_ROWS defined. */
#include "brute.h"

/* weights[columns - 1 + d]: weight of a sample d columns to the right, d from -(columns - 1). */
void HC_BRUTE_ROWS(float *restrict best, const float *restrict apexes, const float *restrict others,
                   const float *restrict weights, int columns)
{
    const float *centre = weights + columns - 1;
    for (int q = 0; q < columns; q++) {
        const float  height = others[q];
        const float *mirror = centre - q; /* weights fall the same way to both sides: d = p - q */
        for (int p = 0; p < columns; p++) {
            const float steepness = (height - apexes[p]) * mirror[p];
            best[p]               = steepness > best[p] ? steepness : best[p];
        }
    }
}
