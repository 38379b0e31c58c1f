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

/* Sixteen rays like one: from the same eye, or from places side by side. */
static void make_tile(hc_ray rays[16], const hc_ray *like, uint64_t *random)
{
    const bool   eye   = agree_range(random, 0, 1) == 1;
    const double width = ldexp(1.0, -agree_range(random, 2, 14));
    double       sides[2][3];
    for (int k = 0; k < 6; k++) {
        sides[k / 3][k % 3] = width * (double)agree_range(random, -16, 16) / 16.0;
    }
    for (int i = 0; i < 16; i++) {
        rays[i] = *like;
        for (int k = 0; k < 3; k++) {
            float *const moved = eye ? &rays[i].direction[k] : &rays[i].origin[k];
            const double size  = eye ? fabs((double)like->direction[k]) : 1.0;
            *moved += (float)(size * (sides[0][k] * (i % 4) + sides[1][k] * (double)(i / 4)));
        }
    }
}

typedef struct sums {
    double among, alone;
} sums;

/* Rays that are beams at first hit, bit for bit, what each hits on its own. */
static void compare_tiles(sums *steps, const char *kind, const hc_field *field, uint64_t *random)
{
    enum { TILES = 40, COUNT_MAX = 4096 }; /* more tiles than are beams at one time */
    static hc_ray rays[16 * TILES];
    static hc_hit hits[16 * TILES];
    hc_tracer    *tracer;
    assert_int_equal(hc_tracer_create(&tracer, field, NULL, NULL), HC_OK);
    for (int i = 0; i < TILES; i++) {
        const hc_ray like = agree_ray(field, (agree_rays)(i % RAYS_SETS), random);
        make_tile(rays + 16 * (size_t)i, &like, random);
    }
    memset(hits, 0xff, sizeof hits);
    hc_trace_nearest_many(tracer, hits, rays, 16 * TILES);
    for (int i = 0; i < 16 * TILES; i++) {
        hc_hit alone;
        (void)hc_trace_nearest(tracer, &alone, &rays[i]);
        if (memcmp(&alone, &hits[i], offsetof(hc_hit, steps)) != 0) {
            fail_msg("%s: a ray like %s hits at %.9g on its own, at %.9g in a beam",
                     agree_describe(kind, field), agree_rays_name((agree_rays)(i / 16 % RAYS_SETS)),
                     (double)alone.t, (double)hits[i].t);
        }
        assert_in_range(hits[i].steps, 0, COUNT_MAX);
        assert_in_range(hits[i].crossings, 0, COUNT_MAX);
        if (i / 16 % RAYS_SETS == RAYS_CAMERA) {
            steps->among += hits[i].steps;
            steps->alone += alone.steps;
        }
    }
    hc_tracer_destroy(tracer);
}

static void beams_hit_like_their_rays(void **state)
{
    static const int sizes[][2] = { { 1, 1 },   { 1, 9 },         { 7, 1 },    { 5, 3 },
                                    { 33, 17 }, { SIDE_MAX, 61 }, { 300, 210 } };
    (void)state;
    uint64_t random = 43;
    sums     steps  = { 0.0, 0.0 };
    for (int kind = 0; kind <= hc_synth_count(); kind += AGREE_STRIDE) {
        const char *name = kind < hc_synth_count() ? hc_synth_name(kind) : "dem";
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            hc_field field     = agree_named_field(name, sizes[s][0], sizes[s][1], 3, HC_WRAP_NONE);
            field.registration = (hc_registration)(s % 2);
            sums       unused  = { 0.0, 0.0 };
            const bool large   = s + 1 == sizeof sizes / sizeof *sizes;
            compare_tiles(large ? &steps : &unused, name, &field, &random);
            agree_free(&field);
        }
    }
    print_message("steps: %.0f in beams, %.0f alone, for cameras on the largest fields\n",
                  steps.among, steps.alone);
    assert_true(steps.among < 0.8 * steps.alone); /* there are beams, and they help */
}

/* Along columns of samples on which bins of towers end: to a tower there a ray comes from one bin
 * alone, whichever it is. */
static hc_ray ray_along(int width, uint64_t *random)
{
    const double beside =
        64.0 * agree_range(random, 1, width / 64) + 2.0 * agree_uniform(random) - 1.0;
    const double turn = agree_range(random, 0, 1) == 0 ? 0.0 : 0.01 * (agree_uniform(random) - 0.5);
    return (
        hc_ray){ .origin = { (float)((beside - 0.5) / width), 0.0F, (float)agree_uniform(random) },
                 .direction = { (float)turn, 1.0F, 0.1F * (float)agree_uniform(random) },
                 .tmax      = INFINITY };
}

static void towers_between_bins_are_met_from_both(void **state)
{
    enum { WIDTH = 200, HEIGHT = 150, COUNT = 4000 };
    static float          heights[WIDTH * HEIGHT];
    static hc_ray         rays[COUNT];
    static hc_hit         hits[2][COUNT];
    const hc_field        field     = { .width = WIDTH, .height = HEIGHT, .heights = heights };
    const hc_trace_method methods[] = { HC_TRACE_FAST, HC_TRACE_MAXMIP };
    int                   found     = 0;
    uint64_t              random    = 44;
    (void)state;
    for (int i = 0; i < 150; i++) { /* sample 63 is corner 64 */
        const int x =
            i % 3 == 0 ? 64 * agree_range(&random, 1, 3) - 1 : agree_range(&random, 0, 199);
        heights[WIDTH * agree_range(&random, 0, HEIGHT - 1) + x] =
            0.25F + 0.75F * (float)agree_uniform(&random);
    }
    for (int i = 0; i < COUNT; i++) {
        rays[i] = ray_along(WIDTH, &random);
    }
    for (int m = 0; m < 2; m++) {
        hc_tracer *tracer;
        assert_int_equal(
            hc_tracer_create(&tracer, &field, &(hc_trace_options){ .method = methods[m] }, NULL),
            HC_OK);
        hc_block_map map = { .sparse = false };
        assert_true(hc_tracer_block_map(tracer, &map, NULL) == (m == 0));
        assert_true(map.sparse == (m == 0));
        hc_trace_nearest_many(tracer, hits[m], rays, COUNT);
        hc_tracer_destroy(tracer);
    }
    for (int i = 0; i < COUNT; i++) {
        found += hits[1][i].t < INFINITY;
        assert_true(hits[0][i].t == hits[1][i].t || fabsf(hits[0][i].t - hits[1][i].t) < 1e-5F);
    }
    assert_in_range(found, COUNT / 10, COUNT * 9 / 10);
}

/* Fields large enough for the lowest heights of squares, of 2 and 4 cells a side. */
static void any_hit_is_a_hit_on_large_fields(void **state)
{
    enum { COUNT = 6000 };
    static const char *const names[]    = { "fbm", "noise", "cobbles", "dem", "steps" };
    static const int         sizes[][2] = { { 800, 700 }, { 3, 200000 }, { 1500, 1400 } };
    static hc_ray            rays[COUNT];
    static hc_hit            hits[COUNT];
    static uint8_t           any[COUNT];
    uint64_t                 random = 45;
    (void)state;
    for (int i = 0; i < 15; i += AGREE_STRIDE) {
        hc_field field =
            agree_named_field(names[i / 3], sizes[i % 3][0], sizes[i % 3][1], 3, HC_WRAP_NONE);
        hc_tracer *tracer;
        int        found = 0;
        assert_int_equal(hc_tracer_create(&tracer, &field, NULL, NULL), HC_OK);
        for (int k = 0; k < COUNT; k++) {
            rays[k] = agree_ray(&field, (agree_rays)(k / 16 % RAYS_SETS), &random);
        }
        hc_trace_nearest_many(tracer, hits, rays, COUNT);
        hc_trace_any_many(tracer, any, rays, COUNT);
        for (int k = 0; k < COUNT; k++) {
            if ((any[k] != 0) != (hits[k].t < INFINITY)
                || (k % 10 == 0 && hc_trace_any(tracer, &rays[k]) != (any[k] != 0))) {
                fail_msg(
                    "%s: ray %d, %s, hits at %.9g, any %d", agree_describe(names[i / 3], &field), k,
                    agree_rays_name((agree_rays)(k / 16 % RAYS_SETS)), (double)hits[k].t, any[k]);
            }
            found += any[k];
        }
        assert_in_range(found, COUNT / 10, COUNT * 9 / 10);
        hc_tracer_destroy(tracer);
        agree_free(&field);
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
        cmocka_unit_test(beams_hit_like_their_rays),
        cmocka_unit_test(any_hit_is_a_hit_on_large_fields),
        cmocka_unit_test(towers_between_bins_are_met_from_both),
        cmocka_unit_test(steps_grow_as_the_logarithm_of_the_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
