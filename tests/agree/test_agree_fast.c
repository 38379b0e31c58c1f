/* The fast caster alone: what it answers does not depend on the instruction set, and how much it
 * has to look at grows slowly. That it is right is test_agree_rays' claim. */
#include "rays.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { RAYS = 12 * RAYS_SETS, SIDE_MAX = 97 };

typedef struct answers {
    hc_hit  hits[RAYS];
    uint8_t any[RAYS];
} answers;

static void ask(answers *a, const hc_field *field, const hc_trace_options *options, hc_isa isa,
                const hc_ray *rays)
{
    hc_trace_options with = *options;
    hc_tracer       *tracer;
    with.isa = isa;
    assert_int_equal(hc_tracer_create(&tracer, field, &with, NULL), HC_OK);
    hc_trace_nearest_many(tracer, a->hits, rays, RAYS);
    hc_trace_any_many(tracer, a->any, rays, RAYS);
    hc_tracer_destroy(tracer);
}

/* The same hits, but for counts of steps: bounds of the march may differ by rounding. */
static void expect_same(const answers *a, const answers *b, const char *kind, const hc_field *field)
{
    for (int i = 0; i < RAYS; i++) {
        if (memcmp(&a->hits[i], &b->hits[i], offsetof(hc_hit, steps)) != 0
            || a->any[i] != b->any[i]) {
            fail_msg("%s: a ray of %s hits at %.9g (%d) and at %.9g (%d)",
                     agree_describe(kind, field), agree_rays_name((agree_rays)(i % RAYS_SETS)),
                     (double)a->hits[i].t, a->any[i], (double)b->hits[i].t, b->any[i]);
        }
    }
}

static void compare_sets(const char *kind, const hc_field *field, const hc_trace_options *options,
                         uint64_t *random)
{
    static hc_ray  rays[RAYS];
    static answers plain;
    static answers other;
    for (int i = 0; i < RAYS; i++) {
        rays[i] = agree_ray(field, (agree_rays)(i % RAYS_SETS), random);
    }
    ask(&plain, field, options, HC_ISA_SCALAR, rays);
    for (int isa = HC_ISA_SCALAR + 1; isa <= (int)HC_ISA_AVX512; isa++) {
        ask(&other, field, options, (hc_isa)isa, rays);
        expect_same(&plain, &other, kind, field);
    }
}

static void the_same_hits_with_every_instruction_set(void **state)
{
    static const int sizes[][2] = { { 1, 1 }, { 1, 9 },   { 7, 1 },        { 2, 2 },
                                    { 5, 3 }, { 33, 17 }, { SIDE_MAX, 61 } };
    (void)state;
    uint64_t random = 41;
    for (int kind = 0; kind <= hc_synth_count(); kind++) {
        const char *name = kind < hc_synth_count() ? hc_synth_name(kind) : "dem";
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            for (int surface = 0; surface < 2; surface++) {
                const hc_wrap wrap  = (hc_wrap)((kind + (int)s) % 4);
                hc_field      field = agree_named_field(name, sizes[s][0], sizes[s][1], 3, wrap);
                const hc_trace_options options = { .surface    = (hc_surface)surface,
                                                   .open_sides = agree_range(&random, 0, 1) == 1 };
                field.registration             = (hc_registration)(s % 2);
                compare_sets(name, &field, &options, &random);
                agree_free(&field);
            }
        }
    }
}

static double mean_steps(int side)
{
    enum { COUNT = 4000 };
    uint64_t   random = 42;
    hc_field   field  = agree_named_field("fbm", side, side, 1, HC_WRAP_NONE);
    hc_tracer *tracer;
    double     steps = 0.0;
    assert_int_equal(hc_tracer_create(&tracer, &field, NULL, NULL), HC_OK);
    for (int i = 0; i < COUNT; i++) {
        hc_hit       hit;
        const hc_ray ray = agree_ray(&field, RAYS_RANDOM, &random);
        (void)hc_trace_nearest(tracer, &hit, &ray);
        steps += hit.steps;
    }
    hc_tracer_destroy(tracer);
    agree_free(&field);
    return steps / COUNT;
}

static void steps_grow_as_the_logarithm_of_the_side(void **state)
{
    (void)state;
    const double at_128 = mean_steps(128);
    const double at_512 = mean_steps(512);
    print_message("mean steps: %.2f at 128^2, %.2f at 512^2\n", at_128, at_512);
    assert_true(at_128 > 0.5);
    assert_true(at_512 <= at_128 * 9.0 / 7.0 + 0.25); /* log2 of the sides: 9 and 7 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_hits_with_every_instruction_set),
        cmocka_unit_test(steps_grow_as_the_logarithm_of_the_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
