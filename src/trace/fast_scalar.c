/* The fast caster in portable C. */
#define HC_FAST_KERNEL hc_fast_march_scalar
#include "fast_kernel.h"
