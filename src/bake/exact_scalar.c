/* The exact search in portable C. */
#define HC_EXACT_TILE hc_exact_tile_scalar
#include "exact_kernel.h"
