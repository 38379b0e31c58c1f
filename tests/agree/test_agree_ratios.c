/* Every cone method against the real numbers: never wider, and not needlessly narrow. */
#include "support.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>

/* What hc_bake_cone_map promises. */
#define KEPT (1.0 - 0x1p-18)
#define UNLIMITED 0x1p60

typedef double (*twin)(const hc_field *field, const hc_ref_cone *cone, hc_method method, int x,
                       int y);

typedef struct judged {
    const hc_field *field;
    const char     *kind;
    hc_method       method;
    hc_cones        cones;
    twin            at_most;  /* the truth for methods that are safe   */
    twin            at_least; /* what the method's definition comes to */
} judged;

static double all_pairs(const hc_field *field, const hc_ref_cone *cone, hc_method method, int x,
                        int y)
{
    (void)method;
    return hc_ref_ratio(field, cone, x, y);
}

static double by_blocks(const hc_field *field, const hc_ref_cone *cone, hc_method method, int x,
                        int y)
{
    switch (method) {
    case HC_METHOD_QUICK: return hc_ref_quick_ratio(field, cone, HC_REF_QUICK_NAIVE, x, y);
    case HC_METHOD_QUICK_IMPROVED:
        return hc_ref_quick_ratio(field, cone, HC_REF_QUICK_IMPROVED, x, y);
    case HC_METHOD_QUICK_CENTRE: return hc_ref_quick_ratio(field, cone, HC_REF_QUICK_CENTRE, x, y);
    default: return hc_ref_quick_ratio(field, cone, HC_REF_QUICK_NAIVE_CENTRE, x, y);
    }
}

/* Widest value that may stand for a ratio. */
static double widest(double truth)
{
    return truth > UNLIMITED * KEPT ? INFINITY : truth;
}

static void check_channel(const judged *j, const hc_ref_cone *cone, float stored, int x, int y,
                          int channel)
{
    const double defined = j->at_least(j->field, cone, j->method, x, y);
    const double truth =
        j->at_most == j->at_least ? defined : j->at_most(j->field, cone, j->method, x, y);
    const double least = KEPT * defined;
    const double most  = widest(truth);
    if (!((double)stored <= most) || !((double)stored >= least)) {
        fail_msg("%s, %s, %s: ratio[%d, %d] channel %d is %.9g, not in %.17g .. %.17g",
                 agree_describe(j->kind, j->field), hc_method_name(j->method),
                 hc_cones_name(j->cones), x, y, channel, (double)stored, least, most);
    }
}

/* Whether the pair is no wider than one of the five elongations allows. */
static bool pair_is_free(const judged *j, const float *stored, int x, int y)
{
    bool free = false;
    for (int i = 0; i < HC_REF_ELONGATIONS; i++) {
        const hc_ref_cone cone = { .metric = HC_REF_DIAMOND, .elongation = hc_ref_elongation[i] };
        const double      most = j->at_most(j->field, &cone, j->method, x, y);
        free                   = free
               || ((double)stored[0] <= widest(most / cone.elongation)
                   && (double)stored[1] <= widest(most * cone.elongation));
    }
    return free;
}

/* Which elongation was taken is a matter of rounding where two are equally good; the sum of the
 * slopes is not. */
static void check_two_slopes(const judged *j, const float *stored, int x, int y)
{
    double least_sum = INFINITY;
    for (int i = 0; i < HC_REF_ELONGATIONS; i++) {
        const hc_ref_cone cone  = { .metric = HC_REF_DIAMOND, .elongation = hc_ref_elongation[i] };
        const double      ratio = j->at_least(j->field, &cone, j->method, x, y);
        least_sum = fmin(least_sum, (cone.elongation + 1.0 / cone.elongation) / ratio);
    }
    const double sum  = 1.0 / (double)stored[0] + 1.0 / (double)stored[1];
    const bool   free = pair_is_free(j, stored, x, y);
    if (!free || !(sum * KEPT <= least_sum)) {
        fail_msg("%s, %s: aniso[%d, %d] is %.9g, %.9g, %s; least sum of slopes %.9g",
                 agree_describe(j->kind, j->field), hc_method_name(j->method), x, y,
                 (double)stored[0], (double)stored[1],
                 free ? "steeper than need be" : "wider than the truth", least_sum);
    }
}

static void check_texel(const judged *j, const float *stored, int x, int y)
{
    const hc_ref_cone round   = { .metric = HC_REF_ROUND };
    const hc_ref_cone diamond = { .metric = HC_REF_DIAMOND };
    switch (j->cones) {
    case HC_CONES_L2: check_channel(j, &round, stored[0], x, y, 0); break;
    case HC_CONES_L1: check_channel(j, &diamond, stored[0], x, y, 0); break;
    case HC_CONES_QUAD:
        for (int quadrant = 1; quadrant <= 4; quadrant++) {
            const hc_ref_cone cone = { .metric = HC_REF_DIAMOND, .quadrant = quadrant };
            check_channel(j, &cone, stored[quadrant - 1], x, y, quadrant - 1);
        }
        break;
    case HC_CONES_ANISO:
        check_two_slopes(j, stored, x, y);
        check_channel(j, &diamond, stored[2], x, y, 2);
        break;
    }
}

static void check_map(const judged *j)
{
    const hc_cone_options options  = { .cones = j->cones, .method = j->method, .threads = 1 };
    const int             channels = hc_cones_channels(j->cones);
    float                *ratios   = agree_bake(j->field, &options);
    for (int y = 0; y < j->field->height; y++) {
        for (int x = 0; x < j->field->width; x++) {
            check_texel(j, ratios + (y * j->field->width + x) * channels, x, y);
        }
    }
    free(ratios);
}

/* Every `stride`-th small field. */
static void check_fields(judged j, int stride)
{
    for (int i = (int)j.cones; i < agree_field_count(&agree_small); i += stride * AGREE_STRIDE) {
        hc_field field = agree_field(&agree_small, i);
        j.field        = &field;
        j.kind         = agree_kind_of(i);
        check_map(&j);
        agree_free(&field);
    }
}

static void check_method(hc_method method, twin at_most, twin at_least, int stride)
{
    for (int cones = HC_CONES_L2; cones <= HC_CONES_ANISO; cones++) {
        if (hc_method_makes(method, (hc_cones)cones)) {
            check_fields((judged){ .method   = method,
                                   .cones    = (hc_cones)cones,
                                   .at_most  = at_most,
                                   .at_least = at_least },
                         stride);
        }
    }
}

static void exact_is_right(void **state)
{
    (void)state;
    check_method(HC_METHOD_EXACT, all_pairs, all_pairs, 7);
}

static void brute_is_right(void **state)
{
    (void)state;
    check_method(HC_METHOD_BRUTE, all_pairs, all_pairs, 11);
}

static void ring_is_right(void **state)
{
    (void)state;
    check_method(HC_METHOD_RING, all_pairs, all_pairs, 7);
}

static void quick_is_safe_and_as_wide_as_its_sets(void **state)
{
    (void)state;
    check_method(HC_METHOD_QUICK, all_pairs, by_blocks, 61);
}

static void quick_improved_is_safe_and_as_wide_as_its_sets(void **state)
{
    (void)state;
    check_method(HC_METHOD_QUICK_IMPROVED, all_pairs, by_blocks, 61);
}

static void centres_are_what_they_are_said_to_be(void **state)
{
    (void)state;
    check_method(HC_METHOD_QUICK_CENTRE, by_blocks, by_blocks, 125);
    check_method(HC_METHOD_QUICK_NAIVE_CENTRE, by_blocks, by_blocks, 125);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_is_right),
        cmocka_unit_test(brute_is_right),
        cmocka_unit_test(ring_is_right),
        cmocka_unit_test(quick_is_safe_and_as_wide_as_its_sets),
        cmocka_unit_test(quick_improved_is_safe_and_as_wide_as_its_sets),
        cmocka_unit_test(centres_are_what_they_are_said_to_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
