/* The fast caster for AVX-512. */
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
#define HC_SIMD_AVX512
#define HC_FAST_KERNEL hc_fast_march_avx512
#include "fast_kernel.h"
#else
typedef int hc_no_avx512;
#endif
