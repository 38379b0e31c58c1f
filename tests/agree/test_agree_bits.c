/* The same bits from exact, brute and ring, and bounds on them that hold to the last bit. */
#include "support.h"

#include <math.h>
#include <stdlib.h>

static void expect_same(const char *what, const hc_field *field, int number,
                        const hc_cone_options *options, const float *expected)
{
    float *found = agree_bake(field, options);
    agree_expect_same(field, agree_kind_of(number), options->cones, what, expected, found);
    free(found);
}

/* All pairs at this many samples and more only for every 17th field: the kinds and wraps still all
 * have their turn. */
static bool is_too_long(const hc_field *field, int number)
{
    return field->width * field->height > 1000 && number % 17 != 0;
}

static void exact_and_ring_equal_brute(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_middle) * 2; i += AGREE_STRIDE) {
        const int       number  = i / 2; /* two kinds of cones each, round ones for all */
        const hc_cones  cones   = i % 2 == 0 ? HC_CONES_L2 : (hc_cones)(1 + number / 5 % 3);
        hc_cone_options options = { .cones = cones, .method = HC_METHOD_BRUTE };
        hc_field        field   = agree_field(&agree_middle, number);
        if (!is_too_long(&field, number)) {
            float *brute   = agree_bake(&field, &options);
            options.method = HC_METHOD_EXACT;
            expect_same("exact against brute", &field, number, &options, brute);
            options.method = HC_METHOD_RING;
            if (hc_method_makes(HC_METHOD_RING, options.cones)) {
                expect_same("ring against brute", &field, number, &options, brute);
            }
            free(brute);
        }
        agree_free(&field);
    }
}

/* Ratios with a limit are the unlimited ones, cut off. */
static void a_limit_only_cuts_off(void **state)
{
    (void)state;
    const float limit = 0.37F;
    for (int i = 0; i < agree_field_count(&agree_middle); i += 11) {
        hc_field        field   = agree_field(&agree_middle, i);
        hc_cone_options options = { .cones = (hc_cones)(i % 4) };
        float          *ratios  = agree_bake(&field, &options);
        for (size_t at = 0; at < agree_count(&field, options.cones); at++) {
            ratios[at] = fminf(ratios[at], limit);
        }
        options.max_ratio = limit;
        expect_same("with a limit", &field, i, &options, ratios);
        free(ratios);
        agree_free(&field);
    }
}

static void expect_ordered(const hc_field *field, int number, hc_cones cones, hc_method narrow,
                           hc_method wide)
{
    const hc_cone_options narrow_options = { .cones = cones, .method = narrow };
    const hc_cone_options wide_options   = { .cones = cones, .method = wide };
    float                *less           = agree_bake(field, &narrow_options);
    float                *more           = agree_bake(field, &wide_options);
    for (size_t at = 0; at < agree_count(field, cones); at++) {
        if (!(less[at] <= more[at])) {
            fail_msg("%s, %s cones: %s is %.9g where %s is %.9g (float %zu)",
                     agree_describe(agree_kind_of(number), field), hc_cones_name(cones),
                     hc_method_name(narrow), (double)less[at], hc_method_name(wide),
                     (double)more[at], at);
        }
    }
    free(less);
    free(more);
}

/* Bounds made by the canonical formula from shorter distances and higher rises are narrower to the
 * last bit. Not for aniso, where the methods may choose different elongations. */
static void quick_is_never_wider_than_exact(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_middle); i += 5) {
        const hc_cones cones = (hc_cones)(i % 3);
        hc_field       field = agree_field(&agree_middle, i);
        expect_ordered(&field, i, cones, HC_METHOD_QUICK, HC_METHOD_QUICK_IMPROVED);
        expect_ordered(&field, i, cones, HC_METHOD_QUICK_IMPROVED, HC_METHOD_EXACT);
        agree_free(&field);
    }
}

static void made_fields_and_elevations_agree(void **state)
{
    (void)state;
    for (int i = 0; i <= hc_synth_count(); i++) {
        const char     *name    = i < hc_synth_count() ? hc_synth_name(i) : "dem";
        hc_field        field   = agree_named_field(name, 113, 96, 7, (hc_wrap)(i % 4));
        hc_cone_options options = { .cones = (hc_cones)(i / 4 % 4), .method = HC_METHOD_BRUTE };
        float          *brute   = agree_bake(&field, &options);
        options.method          = HC_METHOD_EXACT;
        float *exact            = agree_bake(&field, &options);
        agree_expect_same(&field, name, options.cones, "exact against brute", brute, exact);
        free(exact);
        free(brute);
        agree_free(&field);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_and_ring_equal_brute),
        cmocka_unit_test(a_limit_only_cuts_off),
        cmocka_unit_test(quick_is_never_wider_than_exact),
        cmocka_unit_test(made_fields_and_elevations_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
