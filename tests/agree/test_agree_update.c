/* hc_cone_baker_update against a full bake after each edit, bit for bit. */
#include "edits.h"
#include "support.h"

#include <stdio.h>
#include <stdlib.h>

static void compare(const hc_field *field, const char *kind, const hc_cone_options *options,
                    const float *ratios, hc_rect rect, agree_edit how)
{
    char   what[80];
    float *full = agree_bake(field, options);
    (void)snprintf(what, sizeof what, "%s %d,%d %dx%d", agree_edit_name(how), rect.x, rect.y,
                   rect.width, rect.height);
    agree_expect_same(field, kind, options->cones, what, full, ratios);
    free(full);
}

/* Edits pile up on one baker, so that what an update leaves behind is tested too. */
static void edit_repeatedly(hc_field *field, float *heights, const char *kind,
                            const hc_cone_options *options, int edits, uint64_t *random)
{
    hc_log          log    = { .text = "" };
    hc_cone_baker  *baker  = NULL;
    float          *ratios = malloc(agree_count(field, options->cones) * sizeof *ratios);
    const hc_result made   = hc_cone_baker_create(&baker, ratios, field, options, &log);
    assert_int_equal(made, HC_OK);
    compare(field, kind, options, ratios, (hc_rect){ .width = 0 }, AGREE_TOUCH_NOTHING);
    for (int turn = 0; turn < edits; turn++) {
        const agree_edit how     = agree_some_edit(random);
        const hc_rect    rect    = agree_some_rect(field, turn, random);
        size_t           rebaked = 0;
        agree_apply(heights, field->width, rect, how, random);
        assert_int_equal(hc_cone_baker_update(baker, ratios, heights, rect, &rebaked, &log), HC_OK);
        assert_true(rebaked <= (size_t)field->width * (size_t)field->height);
        compare(field, kind, options, ratios, rect, how);
    }
    hc_cone_baker_destroy(baker);
    free(ratios);
}

static void run(hc_cones cones, const agree_shapes *shapes, int edits, int stride)
{
    uint64_t random = 99 + (uint64_t)cones;
    for (int i = (int)cones; i < agree_field_count(shapes); i += stride * AGREE_STRIDE) {
        const hc_cone_options options = { .cones     = cones,
                                          .threads   = 1 + i % 2,
                                          .max_ratio = i % 3 == 0 ? 1.0F : 0.0F };
        hc_field              field   = agree_field(shapes, i);
        float                *heights = (float *)(uintptr_t)field.heights;
        edit_repeatedly(&field, heights, agree_kind_of(i), &options, edits, &random);
        agree_free(&field);
    }
}

static void update_equals_a_full_bake_l2(void **state)
{
    (void)state;
    run(HC_CONES_L2, &agree_small, 6, 5);
    run(HC_CONES_L2, &agree_middle, 6, 31);
}

static void update_equals_a_full_bake_l1(void **state)
{
    (void)state;
    run(HC_CONES_L1, &agree_small, 6, 5);
    run(HC_CONES_L1, &agree_middle, 6, 31);
}

static void update_equals_a_full_bake_quad(void **state)
{
    (void)state;
    run(HC_CONES_QUAD, &agree_small, 6, 11);
    run(HC_CONES_QUAD, &agree_middle, 6, 61);
}

static void update_equals_a_full_bake_aniso(void **state)
{
    (void)state;
    run(HC_CONES_ANISO, &agree_small, 6, 11);
    run(HC_CONES_ANISO, &agree_middle, 6, 61);
}

/* Cost follows what is affected: a sample that sinks below its neighbours' sight lines concerns
 * few. */
static void a_small_change_rebakes_little(void **state)
{
    (void)state;
    hc_field              field   = agree_named_field("fbm", 256, 256, 5, HC_WRAP_UV);
    float                *heights = (float *)(uintptr_t)field.heights;
    const hc_cone_options options = { .cones = HC_CONES_L1 };
    float                *ratios  = malloc(agree_count(&field, HC_CONES_L1) * sizeof *ratios);
    hc_cone_baker        *baker   = NULL;
    size_t                rebaked = 0;
    assert_int_equal(hc_cone_baker_create(&baker, ratios, &field, &options, NULL), HC_OK);
    size_t sum = 0;
    for (int i = 0; i < 16; i++) {
        const int at       = 3000 + 3917 * i;
        heights[at]        = heights[at] * 0.999F;
        const hc_rect rect = { at % 256, at / 256, 1, 1 };
        assert_int_equal(hc_cone_baker_update(baker, ratios, heights, rect, &rebaked, NULL), HC_OK);
        sum += rebaked;
    }
    assert_true(sum / 16 < 256 * 256 / 20);
    compare(&field, "fbm", &options, ratios, (hc_rect){ 0, 0, 1, 1 }, AGREE_LOWER);
    hc_cone_baker_destroy(baker);
    free(ratios);
    agree_free(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(update_equals_a_full_bake_l2),
        cmocka_unit_test(update_equals_a_full_bake_l1),
        cmocka_unit_test(update_equals_a_full_bake_quad),
        cmocka_unit_test(update_equals_a_full_bake_aniso),
        cmocka_unit_test(a_small_change_rebakes_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
