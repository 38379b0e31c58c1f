/* Brute force for AVX-512. */
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
#define HC_BRUTE_ROWS hc_brute_rows_avx512
#include "brute_kernel.h"
#else
typedef int hc_no_avx512;
#endif
