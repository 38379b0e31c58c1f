/* hc_cone_baker_update against a full bake after each edit, bit for bit. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef enum edit { RAISE, LOWER, MIX, CLEAR, TOUCH_NOTHING, EDIT_COUNT } edit;
static const char *const edit_names[] = { "raise", "lower", "mix", "clear", "touch nothing" };

static float edited(float height, edit how, uint64_t *random)
{
    const float by = (float)agree_uniform(random) * 0.5F;
    switch (how) {
    case RAISE: return fminf(1.0F, height + by);
    case LOWER: return fmaxf(0.0F, height - by);
    case MIX: return agree_range(random, 0, 1) == 0 ? height : (float)agree_uniform(random);
    case CLEAR: return 0.0F;
    default: return height;
    }
}

static void apply(float *heights, int width, hc_rect rect, edit how, uint64_t *random)
{
    for (int y = rect.y; y < rect.y + rect.height; y++) {
        for (int x = rect.x; x < rect.x + rect.width; x++) {
            heights[y * width + x] = edited(heights[y * width + x], how, random);
        }
    }
}

/* Single samples, rectangles anywhere, at the far corner, across one axis, everything: in turn. */
static hc_rect random_rect(const hc_field *field, int turn, uint64_t *random)
{
    hc_rect rect = { .x = agree_range(random, 0, field->width - 1),
                     .y = agree_range(random, 0, field->height - 1) };
    rect.width   = agree_range(random, 1, field->width - rect.x);
    rect.height  = agree_range(random, 1, field->height - rect.y);
    switch (turn % 6) {
    case 0: rect.width = rect.height = 1; break;
    case 1: return (hc_rect){ field->width - 1, field->height - 1, 1, 1 };
    case 2: return (hc_rect){ 0, rect.y, field->width, rect.height };
    case 3: return (hc_rect){ 0, 0, field->width, field->height };
    case 4: return (hc_rect){ 0, 0, (rect.width + 1) / 2, 1 };
    default: break;
    }
    return rect;
}

static void compare(const hc_field *field, const char *kind, const hc_cone_options *options,
                    const float *ratios, hc_rect rect, edit how)
{
    char   what[80];
    float *full = agree_bake(field, options);
    (void)snprintf(what, sizeof what, "%s %d,%d %dx%d", edit_names[how], rect.x, rect.y, rect.width,
                   rect.height);
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
    compare(field, kind, options, ratios, (hc_rect){ .width = 0 }, TOUCH_NOTHING);
    for (int turn = 0; turn < edits; turn++) {
        const edit    how     = (edit)agree_range(random, 0, EDIT_COUNT - 1);
        const hc_rect rect    = random_rect(field, turn, random);
        size_t        rebaked = 0;
        apply(heights, field->width, rect, how, random);
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
    compare(&field, "fbm", &options, ratios, (hc_rect){ 0, 0, 1, 1 }, LOWER);
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
