/* A max pyramid of its own memory for the length of a bake, with its levels at hand. */
#ifndef HC_BAKE_HIGHEST_H
#define HC_BAKE_HIGHEST_H

#include <heightcast/bake.h>

enum { HC_LEVELS_MAX = 21 }; /* of a pyramid with a side of HC_SIDE_MAX */

typedef struct hc_highest {
    float       *values; /* give back with free; NULL is none */
    int          width, height;
    int          levels;
    const float *level[HC_LEVELS_MAX];
} hc_highest;

/* Allocate; `values` may be filled with the base level before hc_highest_fill takes it from
 * there. */
hc_result hc_highest_allocate(hc_highest *made, int width, int height, hc_log *log);
void      hc_highest_fill(hc_highest *made, const float *heights);

#endif
