/* The exact search for AVX-512. */
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
#define HC_SIMD_AVX512
#define HC_EXACT_TILE hc_exact_tile_avx512
#include "exact_kernel.h"
#else
typedef int hc_no_avx512;
#endif
