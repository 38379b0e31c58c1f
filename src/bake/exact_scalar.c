/* The exact search in portable C. Sixteen lanes make sixteen times the code: inlined everywhere, it
 * takes compilers minutes. */
#define INLINE static inline
#define HC_EXACT_TILE hc_exact_tile_scalar
#include "exact_kernel.h"
