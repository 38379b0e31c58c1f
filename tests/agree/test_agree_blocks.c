/* Pyramids, bounds, cells, gradients and the surface against their definitions. */
#include "support.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static hc_ref_extreme judge_of(hc_extreme extreme)
{
    return extreme == HC_MAXIMUM ? HC_REF_MAXIMUM : HC_REF_MINIMUM;
}

static void check_pyramid(const hc_pyramid *pyramid, const hc_field *field, hc_extreme extreme)
{
    for (int level = 0; level < pyramid->levels; level++) {
        int          width;
        int          height;
        const float *values = hc_pyramid_level(pyramid, level, &width, &height);
        assert_int_equal(width, hc_ref_level_size(field->width, level));
        assert_int_equal(height, hc_ref_level_size(field->height, level));
        for (int i = 0; i < width * height; i++) {
            assert_true(values[i]
                        == hc_ref_block_extreme(field->heights, field->width, field->height, level,
                                                i % width, i / width, judge_of(extreme)));
        }
    }
}

static void pyramids_drop_nothing_and_updates_keep_them_so(void **state)
{
    (void)state;
    uint64_t random = 21;
    for (int i = 0; i < agree_field_count(&agree_small); i += 3) {
        const hc_extreme extreme = i % 2 == 0 ? HC_MAXIMUM : HC_MINIMUM;
        hc_field         field   = agree_field(&agree_small, i);
        float           *heights = (float *)(uintptr_t)field.heights;
        float     *values = malloc(hc_pyramid_size(field.width, field.height) * sizeof *values);
        hc_pyramid pyramid;
        hc_bake_pyramid(&pyramid, values, heights, field.width, field.height, extreme);
        check_pyramid(&pyramid, &field, extreme);
        for (int edit = 0; edit < 3; edit++) {
            hc_rect rect = { .x = agree_range(&random, 0, field.width - 1),
                             .y = agree_range(&random, 0, field.height - 1) };
            rect.width   = agree_range(&random, 1, field.width - rect.x);
            rect.height  = agree_range(&random, 1, field.height - rect.y);
            for (int at = 0; at < rect.width * rect.height; at++) {
                heights[(rect.y + at / rect.width) * field.width + rect.x + at % rect.width] =
                    (float)agree_uniform(&random);
            }
            hc_update_pyramid(&pyramid, heights, rect, extreme);
            check_pyramid(&pyramid, &field, extreme);
        }
        free(values);
        agree_free(&field);
    }
}

/* Bilinear patches stay between their lowest and their highest corner. */
static void bounds_are_the_corners(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_small); i++) {
        const hc_extreme extreme = i % 2 == 0 ? HC_MAXIMUM : HC_MINIMUM;
        hc_field         field   = agree_field(&agree_small, i);
        float           *bounds  = malloc(agree_count(&field, HC_CONES_L2) * sizeof *bounds);
        hc_bake_bounds(bounds, &field, extreme);
        for (int at = 0; at < field.width * field.height; at++) {
            assert_true(bounds[at]
                        == hc_ref_cell_extreme(field.heights, 1, 0, field.width, field.height,
                                               field.wrap, at % field.width, at / field.width,
                                               judge_of(extreme)));
        }
        free(bounds);
        agree_free(&field);
    }
}

static void cells_have_their_least_corner(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_small); i++) {
        const hc_cones        cones    = (hc_cones)(i % 4);
        const int             channels = hc_cones_channels(cones);
        const hc_cone_options options  = { .cones = cones };
        hc_field              field    = agree_field(&agree_small, i);
        float                *ratios   = agree_bake(&field, &options);
        float                *cells    = malloc(agree_count(&field, cones) * sizeof *cells);
        hc_bake_cell_ratios(cells, ratios, field.width, field.height, cones, field.wrap);
        for (int at = 0; at < field.width * field.height * channels; at++) {
            assert_true(cells[at]
                        == hc_ref_cell_extreme(ratios, channels, at % channels, field.width,
                                               field.height, field.wrap,
                                               at / channels % field.width,
                                               at / channels / field.width, HC_REF_MINIMUM));
        }
        free(cells);
        free(ratios);
        agree_free(&field);
    }
}

static void gradients_are_differences(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_small); i++) {
        hc_field field     = agree_field(&agree_small, i);
        float   *gradients = malloc(agree_count(&field, HC_CONES_L2) * 2 * sizeof *gradients);
        hc_bake_gradient(gradients, &field);
        for (int at = 0; at < field.width * field.height; at++) {
            double g[2];
            hc_ref_gradient(g, &field, at % field.width, at / field.width);
            assert_true(fabs((double)gradients[2 * at] - g[0]) <= fabs(g[0]) * 0x1p-23 + 0x1p-148);
            assert_true(fabs((double)gradients[2 * at + 1] - g[1])
                        <= fabs(g[1]) * 0x1p-23 + 0x1p-148);
        }
        free(gradients);
        agree_free(&field);
    }
}

static void surfaces_are_the_same(void **state)
{
    (void)state;
    uint64_t random = 22;
    for (int i = 0; i < agree_field_count(&agree_small); i++) {
        hc_field field = agree_field(&agree_small, i);
        for (int k = 0; k < 20; k++) {
            const double u = agree_uniform(&random) * 5.0 - 2.0;
            const double v = agree_uniform(&random) * 5.0 - 2.0;
            assert_true(fabs(hc_field_surface(&field, u, v) - hc_ref_surface(&field, u, v))
                        <= 0x1p-44);
        }
        agree_free(&field);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pyramids_drop_nothing_and_updates_keep_them_so),
        cmocka_unit_test(bounds_are_the_corners),
        cmocka_unit_test(cells_have_their_least_corner),
        cmocka_unit_test(gradients_are_differences),
        cmocka_unit_test(surfaces_are_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
