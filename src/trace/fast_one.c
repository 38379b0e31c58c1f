/* The fast caster in a single lane, for single rays. */
#define HC_LANES 1
#define HC_FAST_KERNEL hc_fast_march_one
#include "fast_kernel.h"
