/* Many rays: the methods that promise to lose nothing against the reference, on both cores.
 *
 *     test_agree_soak [RAYS [SEED]]
 *
 * Fires RAYS different rays (10^6 for every kind of field, if not given), each with all methods. A
 * round is one field of every kind, of random size, wrap, registration, bits, surface, sides and
 * placement; round i of seed s is round 0 of seed s + i, so what a complaint names can be repeated
 * with `test_agree_soak 1 SEED`. */
#include "rays.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RAYS_OF_A_SET = 4 * 61, SIDE_BITS = 6, LINES = 20 };

static const hc_trace_method sure[] = { HC_TRACE_FAST, HC_TRACE_SAFE, HC_TRACE_MAXMIP };
enum { SURE = sizeof sure / sizeof *sure };

static const double rays_of_a_kind = 1e6;

typedef struct campaign {
    double      rays;
    uint64_t    seed;
    agree_score scores[SURE];
} campaign;

static campaign campaign_of_main;

/* 1 .. 2^SIDE_BITS + 1, small ones as often as large ones. */
static int some_side(uint64_t *random)
{
    const double side = exp2(SIDE_BITS * agree_uniform(random));
    return (int)side + agree_range(random, 0, 1);
}

/* What a map of so many bits holds. */
static void round_heights(hc_field *field, double codes)
{
    float       *heights = (float *)(uintptr_t)field->heights;
    const size_t count   = (size_t)field->width * (size_t)field->height;
    for (size_t i = 0; i < count; i++) {
        heights[i] = (float)(floor((double)heights[i] * codes + 0.5) / codes);
    }
}

static int kind_count(void)
{
    return hc_synth_count() + 2;
}

static const char *kind_name(int kind)
{
    const int others = kind - hc_synth_count();
    return others < 0 ? hc_synth_name(kind) : others == 0 ? "dem" : "hard";
}

static hc_field some_field(int kind, uint64_t *random)
{
    const int             width        = some_side(random);
    const int             height       = some_side(random);
    const uint64_t        seed         = agree_random(random) >> 32;
    const hc_wrap         wrap         = (hc_wrap)agree_range(random, 0, 3);
    const hc_registration registration = (hc_registration)agree_range(random, 0, 1);
    const int             bits         = agree_range(random, 1, 4) * 8;
    hc_field              field;
    if (kind > hc_synth_count()) {
        field = agree_make_field((agree_shape){ width, height },
                                 agree_range(random, 0, AGREE_KINDS - 1), seed, wrap, registration);
    } else {
        field              = agree_named_field(kind_name(kind), width, height, seed, wrap);
        field.registration = registration;
    }
    if (bits <= 16) {
        round_heights(&field, bits == 8 ? 255.0 : 65535.0);
    }
    return field;
}

static hc_placement some_placement(uint64_t *random)
{
    hc_placement placement = { .scale_z = exp2(20.0 * agree_uniform(random) - 10.0) };
    placement.spacing_x    = placement.scale_z * exp2(6.0 * agree_uniform(random) - 9.0);
    placement.spacing_y    = placement.spacing_x * (0.5 - agree_range(random, 0, 1));
    for (int i = 0; i < 3; i++) {
        placement.offset[i] = placement.scale_z * 100.0 * (agree_uniform(random) - 0.5);
    }
    return placement;
}

static void fire_round(campaign *c, uint64_t seed)
{
    uint64_t random = seed;
    for (int kind = 0; kind < kind_count(); kind++) {
        char     name[64];
        hc_field field = some_field(kind, &random);
        (void)snprintf(name, sizeof name, "%s (seed %llu)", kind_name(kind),
                       (unsigned long long)seed);
        agree_volley volley = {
            .field        = &field,
            .kind         = name,
            .cones        = agree_range(&random, 0, 1) == 0 ? HC_CONES_L1 : HC_CONES_QUAD,
            .method_count = SURE,
            .count        = RAYS_OF_A_SET,
            .alone        = 4,
            .trust_equal  = true,
        };
        volley.options.surface = (hc_surface)agree_range(&random, 0, 1);
        /* Of heights far below the tolerance, rounding alone says whether a ray comes up. */
        volley.options.open_sides = agree_range(&random, 0, 3) == 0 && kind <= hc_synth_count();
        if (agree_range(&random, 0, 3) == 0) {
            volley.options.placement = some_placement(&random);
        }
        memcpy(volley.methods, sure, sizeof sure);
        agree_fire(c->scores, &volley, &random);
        agree_free(&field);
    }
}

static void print_table(const campaign *c)
{
    print_message("%-8s %12s %12s %6s %6s %6s %10s %14s\n", "method", "rays", "hits", "lost",
                  "early", "odd", "undecided", "largest depth");
    for (int m = 0; m < SURE; m++) {
        const agree_score *s = &c->scores[m];
        print_message("%-8s %12zu %12zu %6zu %6zu %6zu %10zu %14.2g\n",
                      hc_trace_method_name(sure[m]), s->fired, s->found, s->lost, s->early, s->odd,
                      s->undecided, s->off);
    }
}

static void no_ray_is_lost_or_early(void **state)
{
    campaign    *c     = *state;
    const double start = (double)time(NULL);
    uint64_t     seed  = c->seed;
    int          lines = 0;
    do {
        fire_round(c, seed++);
        const double part = (double)c->scores[0].fired / c->rays;
        if (part * LINES >= lines + 1) {
            lines = (int)(part * LINES);
            print_message("%3.0f %% %12zu rays, seeds %llu to %llu, %.0f s\n", 100.0 * part,
                          c->scores[0].fired, (unsigned long long)c->seed,
                          (unsigned long long)(seed - 1), (double)time(NULL) - start);
            (void)fflush(NULL);
        }
    } while ((double)c->scores[0].fired < c->rays);
    print_table(c);
    for (int m = 0; m < SURE; m++) {
        agree_expect_right(&c->scores[m]);
        assert_true(c->scores[m].found > c->scores[m].fired / 5);
        assert_true(c->scores[m].undecided <= 2 + c->scores[m].fired / 100000);
    }
}

int main(int argc, char **argv)
{
    campaign_of_main =
        (campaign){ .rays = argc > 1 ? strtod(argv[1], NULL) : rays_of_a_kind * kind_count(),
                    .seed = argc > 2 ? (uint64_t)strtoull(argv[2], NULL, 10) : 1 };
    if (!(campaign_of_main.rays >= 1.0)) {
        (void)fprintf(stderr, "usage: %s [RAYS [SEED]]\n", argv[0]);
        return 2;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(no_ray_is_lost_or_early, &campaign_of_main),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
