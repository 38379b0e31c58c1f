/* Relaxed cones against their definitions, and against exact ones, than which they are wider. */
#include "support.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>

#define KEPT (1.0 - 0x1p-18)

/* Places along a ray are rounded to floats; so small a miss or hit may go either way. */
#define LENIENCY 0x1p-17

static void expect_within(const hc_field *field, int number, const char *method, int at,
                          float ratio, double least, double most)
{
    const double limit = most > 0x1p60 * KEPT ? INFINITY : most;
    if (!((double)ratio >= least * KEPT) || !((double)ratio <= limit)) {
        fail_msg("%s, %s: ratio[%d, %d] is %.9g, not in %.17g .. %.17g",
                 agree_describe(agree_kind_of(number), field), method, at % field->width,
                 at / field->width, (double)ratio, least, most);
    }
}

static void falling_edge_is_what_limits(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_small); i += 5) {
        const hc_cone_options options = { .method = HC_METHOD_FALLING_EDGE };
        hc_field              field   = agree_field(&agree_small, i);
        float                *ratios  = agree_bake(&field, &options);
        for (int at = 0; at < field.width * field.height; at++) {
            const double truth =
                hc_ref_falling_edge_ratio(&field, at % field.width, at / field.width);
            expect_within(&field, i, "falling edge", at, ratios[at], truth, truth);
        }
        free(ratios);
        agree_free(&field);
    }
}

static void gems_rays_end_where_they_come_out(void **state)
{
    (void)state;
    static const int steps[] = { 1, 7, 64, 0 };
    for (int i = 0; i < agree_field_count(&agree_small); i += 11) {
        const int             taken   = steps[i % 4] == 0 ? 64 : steps[i % 4];
        const hc_cone_options options = { .method = HC_METHOD_GEMS, .gems_steps = steps[i % 4] };
        hc_field              field   = agree_field(&agree_small, i);
        float                *ratios  = agree_bake(&field, &options);
        for (int at = 0; at < field.width * field.height; at++) {
            const int    x     = at % field.width;
            const int    y     = at / field.width;
            const double least = hc_ref_gems_ratio(&field, taken, LENIENCY, x, y);
            const double most  = hc_ref_gems_ratio(&field, taken, -LENIENCY, x, y);
            expect_within(&field, i, "gems", at, ratios[at], least, most);
        }
        free(ratios);
        agree_free(&field);
    }
}

static void relaxed_is_never_narrower_than_exact(void **state)
{
    (void)state;
    static const hc_method methods[] = { HC_METHOD_FALLING_EDGE, HC_METHOD_GEMS };
    for (int i = 0; i < hc_synth_count() * 2; i++) {
        hc_field field = agree_named_field(hc_synth_name(i / 2), 41, 36, 4, (hc_wrap)(i / 2 % 4));
        const hc_cone_options safe    = { .method = HC_METHOD_EXACT };
        const hc_cone_options loose   = { .method = methods[i % 2] };
        float                *exact   = agree_bake(&field, &safe);
        float                *relaxed = agree_bake(&field, &loose);
        for (int at = 0; at < field.width * field.height; at++) {
            assert_true((double)relaxed[at] >= (double)exact[at] * KEPT);
        }
        free(exact);
        free(relaxed);
        agree_free(&field);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(falling_edge_is_what_limits),
        cmocka_unit_test(gems_rays_end_where_they_come_out),
        cmocka_unit_test(relaxed_is_never_narrower_than_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
