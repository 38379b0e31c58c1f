/* Brute force: the rows kernel, compiled once for each instruction set. */
#ifndef HC_BAKE_BRUTE_H
#define HC_BAKE_BRUTE_H

/* best[p] = max(best[p], (others[q] - apexes[p]) * weight(p - q)) for all p and q. */
typedef void (*hc_brute_rows)(float *best, const float *apexes, const float *others,
                              const float *weights, int columns);

void hc_brute_rows_scalar(float *best, const float *apexes, const float *others,
                          const float *weights, int columns);
void hc_brute_rows_avx2(float *best, const float *apexes, const float *others, const float *weights,
                        int columns);
void hc_brute_rows_avx512(float *best, const float *apexes, const float *others,
                          const float *weights, int columns);

#endif
