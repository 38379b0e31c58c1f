/* 4096^2: every 509th row of the exact ratios against the judge (judge.h, which test_agree_big
 * holds against brute force), on the made fields and the real elevations. Not on the funnel: every
 * sample limits its tip alike, which takes the exact search half an hour at this size;
 * test_agree_big has all its texels at 1024^2. */
#include "judge.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 4096, FIRST = 255, STEP = 509 };

static void compare(const char *name, hc_cones cones, hc_wrap wrap)
{
    hc_field              field    = agree_named_field(name, SIDE, SIDE, 41, wrap);
    const hc_cone_options options  = { .cones = cones };
    float                *exact    = agree_bake(&field, &options);
    float                *judge    = malloc(agree_count(&field, cones) * sizeof *judge);
    const size_t          channels = (size_t)hc_cones_channels(cones);
    agree_judge_rows(judge, exact, &field, cones, FIRST, STEP);
    for (size_t y = FIRST; y < SIDE; y += STEP) {
        const size_t row = y * SIDE * channels;
        const size_t at  = agree_first_difference(judge + row, exact + row, SIDE * channels);
        if (at < SIDE * channels) {
            fail_msg("%s, %s cones: exact at [%zu, %zu] is %.9g instead of %.9g",
                     agree_describe(name, &field), hc_cones_name(cones), at / channels, y,
                     (double)exact[row + at], (double)judge[row + at]);
        }
    }
    free(judge);
    free(exact);
    agree_free(&field);
}

static void exact_is_right_at_4096(void **state)
{
    (void)state;
    for (int i = 0; i < hc_synth_count(); i++) {
        if (strcmp(hc_synth_name(i), "funnel") != 0) {
            compare(hc_synth_name(i), HC_CONES_L2, HC_WRAP_NONE);
        }
    }
    compare("dem", HC_CONES_L2, HC_WRAP_NONE);
}

static void so_are_diamonds_and_wrapped_fields(void **state)
{
    (void)state;
    compare("fbm", HC_CONES_L1, HC_WRAP_UV);
    compare("dunes", HC_CONES_QUAD, HC_WRAP_NONE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_is_right_at_4096),
        cmocka_unit_test(so_are_diamonds_and_wrapped_fields),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
