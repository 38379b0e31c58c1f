/* The same bytes from every instruction set and every number of threads, for every method. */
#include "support.h"

#include <stdlib.h>

static void expect_same(const char *what, const hc_field *field, int number,
                        const hc_cone_options *options, const float *expected)
{
    float *found = agree_bake(field, options);
    agree_expect_same(field, agree_kind_of(number), options->cones, what, expected, found);
    free(found);
}

static void check_isas(const hc_field *field, int number, hc_cone_options options,
                       const float *expected)
{
    static const hc_isa isas[] = { HC_ISA_SCALAR, HC_ISA_AVX2, HC_ISA_AVX512 };
    for (size_t i = 0; i < sizeof isas / sizeof *isas; i++) {
        if (hc_isa_resolve(isas[i]) == isas[i]) {
            options.isa     = isas[i];
            options.threads = 1 + (int)i;
            expect_same(hc_isa_name(isas[i]), field, number, &options, expected);
        }
    }
}

static void check_threads(const hc_field *field, int number, hc_cone_options options,
                          const float *expected)
{
    static const int threads[] = { 1, 2, 3, 7 };
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        options.threads = threads[i];
        expect_same("another number of threads", field, number, &options, expected);
    }
}

static bool is_slow(hc_method method)
{
    return method == HC_METHOD_BRUTE || method == HC_METHOD_GEMS
           || method == HC_METHOD_FALLING_EDGE;
}

static void every_isa_and_thread_count_gives_the_same_bytes(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_middle); i += 35 * AGREE_STRIDE) {
        hc_field field = agree_field(&agree_middle, i);
        for (int method = 0; hc_method_name((hc_method)method) != NULL; method++) {
            const hc_cone_options options = { .cones   = (hc_cones)((i + method) % 4),
                                              .method  = (hc_method)method,
                                              .isa     = HC_ISA_SCALAR,
                                              .threads = 1 };
            if (hc_method_makes(options.method, options.cones)
                && !(is_slow(options.method) && field.width * field.height > 1100)) {
                float *expected = agree_bake(&field, &options);
                check_isas(&field, i, options, expected);
                check_threads(&field, i, options, expected);
                free(expected);
            }
        }
        agree_free(&field);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_isa_and_thread_count_gives_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
