/* fast, safe and maxmip, which promise to lose nothing, against the reference, two-sided (rays.h).
 * The first argument multiplies the number of rays. */
#include "rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const hc_trace_method sure[] = { HC_TRACE_FAST, HC_TRACE_SAFE, HC_TRACE_MAXMIP };
enum { SURE = sizeof sure / sizeof *sure };

static size_t      times = 1;
static agree_score scores[SURE]; /* of the present test */

static void fire_all(const hc_field *field, const char *kind, const hc_trace_options *options,
                     hc_cones cones, size_t count, uint64_t *random)
{
    agree_volley volley = { .field        = field,
                            .kind         = kind,
                            .options      = *options,
                            .cones        = cones,
                            .method_count = SURE,
                            .count        = count * times,
                            .threads      = 1 };
    memcpy(volley.methods, sure, sizeof sure);
    agree_fire(scores, &volley, random);
}

/* The judge must have had something to judge. */
static void check_scores(void)
{
    for (int m = 0; m < SURE; m++) {
        const agree_score *s = &scores[m];
        print_message("%-6s %zu rays, %zu hits, %zu undecided, %zu lost, %zu early, %zu odd\n",
                      hc_trace_method_name(sure[m]), s->fired, s->found, s->undecided, s->lost,
                      s->early, s->odd);
    }
    agree_score judged[SURE];
    memcpy(judged, scores, sizeof scores);
    memset(scores, 0, sizeof scores);
    for (int m = 0; m < SURE; m++) {
        agree_expect_right(&judged[m]);
        assert_true(judged[m].found > judged[m].fired / 5);
        assert_true(judged[m].found < judged[m].fired);
        assert_true(judged[m].undecided < judged[m].fired / 1000);
    }
}

static void hard_fields(hc_surface surface)
{
    uint64_t random = 21 + (uint64_t)surface;
    for (int i = 0; i < agree_field_count(&agree_small); i += 5 * AGREE_STRIDE) {
        hc_field field = agree_field(&agree_small, i);
        /* Of heights far below the tolerance, rounding alone says whether a ray comes up. */
        const bool             decided = strcmp(agree_kind_of(i), "denormal rises") != 0;
        const hc_trace_options options = { .surface    = surface,
                                           .open_sides = i % 3 == 0 && decided };
        fire_all(&field, agree_kind_of(i), &options, i % 2 == 0 ? HC_CONES_L1 : HC_CONES_QUAD, 3,
                 &random);
        agree_free(&field);
    }
    check_scores();
}

static void hard_fields_bilinear(void **state)
{
    (void)state;
    hard_fields(HC_SURFACE_BILINEAR);
}

static void hard_fields_steps(void **state)
{
    (void)state;
    hard_fields(HC_SURFACE_STEPS);
}

static void made_fields_and_elevations(void **state)
{
    (void)state;
    uint64_t random = 23;
    for (int i = 0; i <= hc_synth_count(); i++) {
        const char *name               = i < hc_synth_count() ? hc_synth_name(i) : "dem";
        hc_field    field              = agree_named_field(name, 61, 47, 3, (hc_wrap)(i % 4));
        field.registration             = i % 3 == 0 ? HC_GRID : HC_TEXEL;
        const hc_trace_options options = { .surface    = (hc_surface)(i % 5 == 0),
                                           .open_sides = i % 7 == 0 };
        fire_all(&field, name, &options, i % 2 == 0 ? HC_CONES_QUAD : HC_CONES_L1, 40, &random);
        agree_free(&field);
    }
    check_scores();
}

static void placed_fields(void **state)
{
    (void)state;
    static const hc_placement places[] = {
        { 30.0, -30.0, 812.5, { 500000.0, 4100000.0, 210.0 } },
        { -0.1, 0.3, 0.01, { 0.1, -7.0, -1.0 } },
        { 1e-6, 1e-6, 1e3, { 0.0, 0.0, 0.0 } },
    };
    uint64_t random = 24;
    for (int i = 0; i < 12; i++) {
        hc_field field =
            agree_named_field(i % 2 == 0 ? "fbm" : "spikes", 33, 50, 5, (hc_wrap)(i % 4));
        field.registration             = i % 3 == 0 ? HC_GRID : HC_TEXEL;
        const hc_trace_options options = { .placement = places[i % 3],
                                           .surface   = (hc_surface)(i / 6) };
        fire_all(&field, "placed", &options, HC_CONES_L1, 40, &random);
        agree_free(&field);
    }
    check_scores();
}

/* Towers of one to six samples, some next to each other, on a floor that is flat or has holes. */
static void raise_towers(float *heights, int width, int height, bool holes, uint64_t *random)
{
    for (int i = 0; i < width * height; i++) {
        heights[i] = holes && agree_range(random, 0, 9) > 0 ? 0.125F : 0.0F;
    }
    for (int i = 0; i < width * height / 300; i++) {
        const int   left = agree_range(random, 0, width - 1);
        const int   top  = agree_range(random, 0, height - 1);
        const int   wide = agree_range(random, 0, 3) == 0 ? agree_range(random, 1, 3) : 1;
        const int   high = agree_range(random, 0, 3) == 0 ? 2 : 1;
        const float rise = 0.25F + 0.75F * (float)agree_uniform(random);
        for (int k = 0; k < wide * high; k++) {
            const int x = left + k % wide;
            const int y = top + k / wide;
            if (x < width && y < height) {
                heights[y * width + x] = agree_range(random, 0, 1) == 0 ? rise : 0.5F * rise;
            }
        }
    }
}

static bool is_sparse(const hc_field *field)
{
    hc_tracer   *tracer;
    hc_block_map map;
    assert_int_equal(hc_tracer_create(&tracer, field, NULL, NULL), HC_OK);
    assert_true(hc_tracer_block_map(tracer, &map, NULL));
    hc_tracer_destroy(tracer);
    return map.sparse;
}

static void towers(void **state)
{
    enum { WIDTH = 200, HEIGHT = 131 };
    static float heights[WIDTH * HEIGHT];
    (void)state;
    uint64_t random = 25;
    for (int i = 0; i < 8; i++) {
        const hc_field field = { .width        = i % 4 < 2 ? WIDTH : HEIGHT,
                                 .height       = i % 4 < 2 ? HEIGHT : WIDTH,
                                 .registration = i % 3 == 0 ? HC_GRID : HC_TEXEL,
                                 .heights      = heights };
        raise_towers(heights, field.width, field.height, i % 2 == 1, &random);
        assert_true(is_sparse(&field));
        fire_all(&field, "towers", &(hc_trace_options){ .threads = 1 }, HC_CONES_L1, 60, &random);
    }
    check_scores();
}

int main(int argc, char **argv)
{
    times                           = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hard_fields_bilinear),
        cmocka_unit_test(hard_fields_steps),
        cmocka_unit_test(made_fields_and_elevations),
        cmocka_unit_test(placed_fields),
        cmocka_unit_test(towers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
