/* Brute force in portable C. */
#define HC_BRUTE_ROWS hc_brute_rows_scalar
#include "brute_kernel.h"
