/* Exact is brute force, for every texel at 1024^2, on every made field and the real elevations.
 *
 * All pairs are 10^12 there, so a judge with shortcuts stands in (judge.h). It earns its place
 * first: at 256^2 it has the bits of plain brute force on all fields. At 512^2 brute force itself
 * judges. */
#include "judge.h"
#include "support.h"

#include <stdlib.h>

static int field_count(void)
{
    return hc_synth_count() + 1;
}

static const char *field_name(int index)
{
    return index < hc_synth_count() ? hc_synth_name(index) : "dem";
}

static float *judged(const hc_field *field, hc_cones cones)
{
    float *ratios = malloc(agree_count(field, cones) * sizeof *ratios);
    assert_non_null(ratios);
    agree_judge_rows(ratios, field, cones, 0, 1);
    return ratios;
}

static void the_judge_is_brute_force(void **state)
{
    (void)state;
    for (int i = 0; i < field_count(); i++) {
        static const hc_cones cones[] = { HC_CONES_L2, HC_CONES_L1, HC_CONES_L2, HC_CONES_QUAD };
        hc_field field = agree_named_field(field_name(i), 256, 256, 31, (hc_wrap)(i / 4 % 4));
        const hc_cone_options options = { .cones = cones[i % 4], .method = HC_METHOD_BRUTE };
        float                *brute   = agree_bake(&field, &options);
        float                *judge   = judged(&field, options.cones);
        agree_expect_same(&field, field_name(i), options.cones, "the judge", brute, judge);
        free(judge);
        free(brute);
        agree_free(&field);
    }
}

static void exact_is_brute_force_at_512(void **state)
{
    (void)state;
    hc_field              field = agree_named_field("fbm", 512, 512, 32, HC_WRAP_NONE);
    const hc_cone_options slow  = { .method = HC_METHOD_BRUTE };
    const hc_cone_options fast  = { .method = HC_METHOD_EXACT };
    float                *brute = agree_bake(&field, &slow);
    float                *exact = agree_bake(&field, &fast);
    agree_expect_same(&field, "fbm", HC_CONES_L2, "exact", brute, exact);
    free(exact);
    free(brute);
    agree_free(&field);
}

static void compare_at_1024(const char *name, hc_cones cones, hc_wrap wrap)
{
    hc_field              field   = agree_named_field(name, 1024, 1024, 33, wrap);
    const hc_cone_options options = { .cones = cones };
    float                *exact   = agree_bake(&field, &options);
    float                *judge   = judged(&field, cones);
    agree_expect_same(&field, name, cones, "exact", judge, exact);
    free(judge);
    free(exact);
    agree_free(&field);
}

static void exact_is_the_judge_at_1024(void **state)
{
    (void)state;
    for (int i = 0; i < field_count(); i++) {
        compare_at_1024(field_name(i), HC_CONES_L2, HC_WRAP_NONE);
    }
}

static void so_are_diamonds_and_quadrants_and_wrapped_fields(void **state)
{
    (void)state;
    compare_at_1024("fbm", HC_CONES_L1, HC_WRAP_UV);
    compare_at_1024("dem", HC_CONES_L1, HC_WRAP_NONE);
    compare_at_1024("spikes", HC_CONES_L2, HC_WRAP_U);
    compare_at_1024("cobbles", HC_CONES_QUAD, HC_WRAP_V);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_judge_is_brute_force),
        cmocka_unit_test(exact_is_brute_force_at_512),
        cmocka_unit_test(exact_is_the_judge_at_1024),
        cmocka_unit_test(so_are_diamonds_and_quadrants_and_wrapped_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
