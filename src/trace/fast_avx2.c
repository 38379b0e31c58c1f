/* The fast caster for AVX2. */
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
#define HC_SIMD_AVX2
#define HC_FAST_KERNEL hc_fast_march_avx2
#include "fast_kernel.h"
#else
typedef int hc_no_avx2;
#endif
