/* Rows of the bakers' table, whoever bakes. */
#include "bake_bench.h"

#include <math.h>

hc_bench_row hc_bench_row_of(const char *field, int side, const char *method, const char *cones)
{
    return (hc_bench_row){ .field       = field,
                           .side        = side,
                           .method      = method,
                           .cones       = cones,
                           .seconds     = NAN,
                           .fastest     = NAN,
                           .slowest     = NAN,
                           .mean_kept   = NAN,
                           .mean_ratio  = NAN,
                           .wider       = NAN,
                           .wider_share = NAN };
}

static void compare(hc_bench_row *row, const float *ratios, const float *exact, size_t count)
{
    double kept = 0.0, sum = 0.0;
    size_t wider = 0;
    for (size_t i = 0; i < count; i++) {
        const double ratio = (double)fminf(ratios[i], 1.0F);
        sum += ratio;
        kept += ratio / (double)fminf(exact[i], 1.0F);
        wider += ratios[i] > exact[i];
    }
    row->mean_kept   = kept / (double)count;
    row->mean_ratio  = sum / (double)count;
    row->wider       = (double)wider;
    row->wider_share = row->wider / (double)count;
}

void hc_bench_row_done(const hc_bench_options *options, hc_bench_row *row, const float *ratios,
                       const float *exact, size_t count)
{
    if (ratios != NULL && exact != NULL) {
        compare(row, ratios, exact, count);
    }
    options->row_done(options->user, row);
}
