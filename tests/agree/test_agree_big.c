/* Exact is brute force, for every texel at 1024^2, on every made field and the real elevations.
 *
 * All pairs are 10^12 there, so a judge with shortcuts stands in (judge.h). It earns its place
 * first: on smaller fields of all kinds it tells the bits of plain brute force from others. At
 * 512^2 brute force itself judges. Of the funnel, on which no shortcut helps, every fourth row. */
#include "judge.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

static int field_count(void)
{
    return hc_synth_count() + 1;
}

static const char *field_name(int index)
{
    return index < hc_synth_count() ? hc_synth_name(index) : "dem";
}

/* Every `step`-th row judged, the others as claimed. */
static float *judged(const float *claimed, const hc_field *field, hc_cones cones, int step)
{
    float *ratios = malloc(agree_count(field, cones) * sizeof *ratios);
    assert_non_null(ratios);
    memcpy(ratios, claimed, agree_count(field, cones) * sizeof *ratios);
    agree_judge_rows(ratios, claimed, field, cones, 0, step);
    return ratios;
}

/* The truth is confirmed; what is a little too much or too little is not. */
static void expect_judgement(const hc_field *field, const char *name, hc_cones cones,
                             const float *truth)
{
    static const float factors[] = { 1.0F, 1.0F - 0x1p-22F, 1.0F + 0x1p-22F, 0.5F, 2.0F };
    const size_t       count     = agree_count(field, cones);
    float             *claimed   = malloc(count * sizeof *claimed);
    assert_non_null(claimed);
    for (size_t k = 0; k < sizeof factors / sizeof *factors; k++) {
        for (size_t i = 0; i < count; i++) {
            claimed[i] = truth[i] * factors[k];
        }
        float *judge = judged(claimed, field, cones, 1);
        for (size_t i = 0; i < count; i++) {
            if ((judge[i] == claimed[i]) != (claimed[i] == truth[i])) {
                fail_msg("%s: of %.9g at %zu the judge says %.9g, the truth is %.9g",
                         agree_describe(name, field), (double)claimed[i], i, (double)judge[i],
                         (double)truth[i]);
            }
        }
        free(judge);
    }
    free(claimed);
}

static void the_judge_knows_what_is_not_true(void **state)
{
    (void)state;
    for (int i = 0; i < field_count(); i++) {
        static const hc_cones cones[] = { HC_CONES_QUAD, HC_CONES_L2, HC_CONES_L1 };
        hc_field field = agree_named_field(field_name(i), 161, 192, 34, (hc_wrap)(i % 4));
        const hc_cone_options options = { .cones = cones[i % 3], .method = HC_METHOD_BRUTE };
        float                *brute   = agree_bake(&field, &options);
        expect_judgement(&field, field_name(i), options.cones, brute);
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

static void compare_at_1024(const char *name, hc_cones cones, hc_wrap wrap, int step)
{
    hc_field              field   = agree_named_field(name, 1024, 1024, 33, wrap);
    const hc_cone_options options = { .cones = cones };
    float                *exact   = agree_bake(&field, &options);
    float                *judge   = judged(exact, &field, cones, step);
    agree_expect_same(&field, name, cones, "exact", judge, exact);
    free(judge);
    free(exact);
    agree_free(&field);
}

static void exact_is_the_judge_at_1024(void **state)
{
    (void)state;
    for (int i = 0; i < field_count(); i++) {
        const int step = strcmp(field_name(i), "funnel") == 0 ? 4 : 1;
        compare_at_1024(field_name(i), HC_CONES_L2, HC_WRAP_NONE, step);
    }
}

static void so_are_diamonds_and_quadrants_and_wrapped_fields(void **state)
{
    (void)state;
    compare_at_1024("fbm", HC_CONES_L1, HC_WRAP_UV, 1);
    compare_at_1024("dem", HC_CONES_L1, HC_WRAP_NONE, 1);
    compare_at_1024("spikes", HC_CONES_L2, HC_WRAP_U, 1);
    compare_at_1024("cobbles", HC_CONES_QUAD, HC_WRAP_V, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_judge_knows_what_is_not_true),
        cmocka_unit_test(exact_is_brute_force_at_512),
        cmocka_unit_test(exact_is_the_judge_at_1024),
        cmocka_unit_test(so_are_diamonds_and_quadrants_and_wrapped_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
