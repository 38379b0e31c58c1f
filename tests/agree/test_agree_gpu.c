/* Baking on the GPU against the CPU: every method, cones and wrap, odd sizes; pyramids; whole maps.
 * Skipped where there is no OpenGL. */
#include <heightcast/gpu.h>

#ifdef HC_HAVE_GL
#include "gpu/gpu.h"
#endif

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SAMPLES_MAX = 5000 * 3, CHANNELS_MAX = 4 };

static float heights[SAMPLES_MAX];
static float by_cpu[SAMPLES_MAX * CHANNELS_MAX], by_gpu[SAMPLES_MAX * CHANNELS_MAX];

static const int sizes[][2] = { { 1, 1 },   { 2, 1 },   { 1, 9 }, { 7, 5 },
                                { 16, 16 }, { 33, 21 }, { 3, 64 } };
enum { SIZES = sizeof sizes / sizeof *sizes };

static hc_gpu *gpu;

static int open_gpu(void **state)
{
    hc_log          log    = { .text = "" };
    const hc_result result = hc_gpu_create(&gpu, &log);
    (void)state;
    if (result == HC_ERROR_UNSUPPORTED) {
        print_message("%s\n", log.text);
        return 0;
    }
    if (result == HC_OK) {
        print_message("%s, %s, rounds: %d\n", hc_gpu_name(gpu), hc_gpu_driver(gpu),
                      hc_gpu_rounds(gpu));
    }
    return result == HC_OK ? 0 : -1;
}

static int close_gpu(void **state)
{
    (void)state;
    hc_gpu_destroy(gpu);
    return 0;
}

static void skip_without_gpu(void)
{
    if (gpu == NULL) {
        skip();
    }
}

static hc_field field_of(const char *name, int width, int height, hc_wrap wrap)
{
    assert_int_equal(hc_synth(heights, width, height, name, 5, NULL), HC_OK);
    return (hc_field){ .heights = heights, .width = width, .height = height, .wrap = wrap };
}

/* ---- ratios ---------------------------------------------------------------------------------- */

/* The same bits; from drivers that do not round, never wider, and narrower by 2^-16 at the most. */
static void expect_ratios(const hc_field *field, const hc_cone_options *options, bool rounds)
{
    const size_t count =
        (size_t)field->width * (size_t)field->height * (size_t)hc_cones_channels(options->cones);
    hc_log log = { .text = "" };
    assert_int_equal(hc_bake_cone_map(by_cpu, field, options, NULL), HC_OK);
    if (hc_gpu_bake_cone_map(gpu, by_gpu, field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    for (size_t i = 0; i < count; i++) {
        const bool same = by_gpu[i] == by_cpu[i];
        const bool near =
            !rounds && by_gpu[i] <= by_cpu[i] && by_gpu[i] >= by_cpu[i] * (1.0F - 0x1p-16F);
        if (!same && !near) {
            fail_msg("%s, %s, wrap %s, %d x %d, number %zu: %.9g is not %.9g",
                     hc_method_name(options->method), hc_cones_name(options->cones),
                     hc_wrap_name(field->wrap), field->width, field->height, i, (double)by_gpu[i],
                     (double)by_cpu[i]);
        }
    }
}

/* Elongated diamonds may be of another elongation where two are about as good, so they are left out
 * unless bits are the same. */
static void expect_method(hc_method method, bool rounds)
{
    static const char *const names[] = { "fbm", "spikes", "noise", "steps" };
    for (int cones = 0; cones <= HC_CONES_ANISO; cones++) {
        if (!hc_method_makes(method, (hc_cones)cones) || (cones == HC_CONES_ANISO && !rounds)) {
            continue;
        }
        for (int i = 0; i < 4 * SIZES; i++) {
            const int            *size    = sizes[i % SIZES];
            const hc_wrap         wrap    = (hc_wrap)((i + i / SIZES) % 4);
            const hc_field        field   = field_of(names[i / SIZES], size[0], size[1], wrap);
            const hc_cone_options options = { .cones = (hc_cones)cones, .method = method };
            expect_ratios(&field, &options, rounds);
        }
    }
}

static void every_method(void **state)
{
    (void)state;
    skip_without_gpu();
    for (int method = 0; hc_method_name((hc_method)method) != NULL; method++) {
        if (method != HC_METHOD_RING) {
            expect_method((hc_method)method, hc_gpu_rounds(gpu));
        }
    }
}

/* Every wrap with every kind of cone and both registrations, on a field of many blocks. */
static void every_wrap(void **state)
{
    (void)state;
    skip_without_gpu();
    for (int i = 0; i < 4 * 4 * 2; i++) {
        hc_field field          = field_of("ridged", 61, 47, (hc_wrap)(i % 4));
        field.registration      = i / 16 == 0 ? HC_TEXEL : HC_GRID;
        hc_cone_options options = { .cones = (hc_cones)(i / 4 % 4), .max_ratio = 0.2F };
        if (options.cones == HC_CONES_ANISO && !hc_gpu_rounds(gpu)) {
            continue;
        }
        expect_ratios(&field, &options, hc_gpu_rounds(gpu));
        options.method = HC_METHOD_QUICK_IMPROVED;
        expect_ratios(&field, &options, hc_gpu_rounds(gpu));
    }
}

static void drivers_that_do_not_round(void **state)
{
    (void)state;
    skip_without_gpu();
#ifdef HC_HAVE_GL
    const bool before = gpu->rounds;
    gpu->rounds       = false;
    expect_method(HC_METHOD_EXACT, false);
    expect_method(HC_METHOD_FALLING_EDGE, false);
    const hc_field        field   = field_of("fbm", 33, 21, HC_WRAP_UV);
    const hc_cone_options options = { .cones = HC_CONES_L2 };
    expect_ratios(&field, &options, false);
    assert_true(by_gpu[5] < by_cpu[5]); /* the seam works */
    gpu->rounds = before;
#endif
}

/* The longest texture that every driver of OpenGL 4.3 has; none is a sample longer than it says. */
static void the_largest_fields(void **state)
{
    enum { LONG = 16384 };
    (void)state;
    skip_without_gpu();
    float *samples = calloc(2 * LONG, sizeof *samples);
    float *ratios  = malloc(2 * 2 * LONG * sizeof *ratios);
    assert_true(samples != NULL && ratios != NULL);
    assert_int_equal(hc_synth(samples, LONG, 2, "fbm", 1, NULL), HC_OK);
    for (int i = 0; i < 4; i++) {
        hc_field field = { .heights = samples,
                           .width   = i % 2 == 0 ? LONG : 2,
                           .height  = i % 2 == 0 ? 2 : LONG,
                           .wrap    = i < 2 ? HC_WRAP_NONE : HC_WRAP_UV };
        assert_int_equal(hc_bake_cone_map(ratios, &field, NULL, NULL), HC_OK);
        assert_int_equal(hc_gpu_bake_cone_map(gpu, ratios + 2 * LONG, &field, NULL, NULL), HC_OK);
        if (hc_gpu_rounds(gpu)) {
            assert_memory_equal(ratios, ratios + 2 * LONG, 2 * LONG * sizeof *ratios);
        }
    }
    free(ratios);
    free(samples);
}

/* As many levels as there are in large fields. */
static void long_fields(void **state)
{
    (void)state;
    skip_without_gpu();
    for (int i = 0; i < 8; i++) {
        const int             length  = i % 2 == 0 ? 5000 : 3;
        const hc_field        field   = field_of("fbm", length, 15000 / length, (hc_wrap)(i % 4));
        const hc_cone_options options = { .cones  = (hc_cones)(i / 2 % 3),
                                          .method = i < 6 ? HC_METHOD_EXACT : HC_METHOD_QUICK };
        expect_ratios(&field, &options, hc_gpu_rounds(gpu));
    }
}

#ifdef HC_HAVE_GL

typedef struct waits {
    int reports, most;
} waits;

static bool count_waits(void *user, double fraction)
{
    waits *w = user;
    (void)fraction;
    return ++w->reports < w->most;
}

#endif

/* Where a dispatch allows few looks, searches wait for the next one, and find the same; they can be
 * cancelled there. */
static void searches_of_many_dispatches(void **state)
{
    (void)state;
    skip_without_gpu();
#ifdef HC_HAVE_GL
    const int       before  = gpu->looks;
    waits           seen    = { .most = 1 << 30 };
    hc_field        field   = field_of("funnel", 64, 61, HC_WRAP_U);
    hc_cone_options options = { .progress = { .report = count_waits, .user = &seen } };
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, NULL), HC_OK);
    const int usual = seen.reports;
    gpu->looks      = 3;
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, NULL), HC_OK);
    assert_true(seen.reports > 20 * usual);
    seen = (waits){ .most = 20 };
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, NULL), HC_ERROR_CANCELLED);
    options.progress = (hc_progress){ 0 };
    expect_ratios(&field, &options, hc_gpu_rounds(gpu));
    field   = field_of("fbm", 1500, 10, HC_WRAP_U);
    options = (hc_cone_options){ .cones = HC_CONES_L1 };
    expect_ratios(&field, &options, hc_gpu_rounds(gpu));
    for (int i = 0; i < 6; i++) {
        static const hc_method methods[] = { HC_METHOD_EXACT, HC_METHOD_GEMS,
                                             HC_METHOD_FALLING_EDGE };
        field                            = field_of("spikes", 33, 21, (hc_wrap)(i % 4));
        options = (hc_cone_options){ .method = methods[i % 3], .gems_steps = 5 };
        expect_ratios(&field, &options, hc_gpu_rounds(gpu));
        options.cones = i % 3 == 0 ? HC_CONES_QUAD : HC_CONES_L2;
        expect_ratios(&field, &options, hc_gpu_rounds(gpu));
    }
    gpu->looks = before;
#endif
}

/* Both timers count; how well is not for tests to judge. */
static void timers(void **state)
{
    (void)state;
    skip_without_gpu();
#ifdef HC_HAVE_GL
    const bool     before = gpu->timer;
    const hc_field field  = field_of("fbm", 61, 47, HC_WRAP_UV);
    for (int timer = 0; timer < 2; timer++) {
        gpu->timer = timer == 1;
        assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, NULL, NULL), HC_OK);
        assert_true(hc_gpu_seconds(gpu) > 0.0 && hc_gpu_seconds(gpu) < 60.0);
        assert_non_null(strstr(hc_gpu_timer(gpu), timer == 1 ? "time stamps" : "wall clock"));
    }
    gpu->timer = before;
#endif
}

/* ---- pyramids and maps ----------------------------------------------------------------------- */

static void pyramids(void **state)
{
    static float values[2 * SAMPLES_MAX], wanted[2 * SAMPLES_MAX];
    (void)state;
    skip_without_gpu();
    for (int i = 0; i < 2 * SIZES; i++) {
        const int       *size    = sizes[i % SIZES];
        const hc_extreme extreme = i < SIZES ? HC_MAXIMUM : HC_MINIMUM;
        hc_pyramid       pyramid, reference;
        (void)field_of("noise", size[0], size[1], HC_WRAP_NONE);
        hc_bake_pyramid(&reference, wanted, heights, size[0], size[1], extreme);
        assert_int_equal(
            hc_gpu_bake_pyramid(gpu, &pyramid, values, heights, size[0], size[1], extreme, NULL),
            HC_OK);
        assert_int_equal(pyramid.levels, reference.levels);
        assert_memory_equal(values, wanted, hc_pyramid_size(size[0], size[1]) * sizeof *values);
    }
}

static void bounds_and_slopes(void **state)
{
    (void)state;
    skip_without_gpu();
    for (int i = 0; i < 4 * SIZES; i++) {
        const int   *size  = sizes[i % SIZES];
        const size_t count = (size_t)size[0] * (size_t)size[1];
        hc_field     field = field_of("noise", size[0], size[1], (hc_wrap)(i / SIZES));
        for (int extreme = HC_MAXIMUM; extreme <= HC_MINIMUM; extreme++) {
            hc_bake_bounds(by_cpu, &field, (hc_extreme)extreme);
            assert_int_equal(hc_gpu_bake_bounds(gpu, by_gpu, &field, (hc_extreme)extreme, NULL),
                             HC_OK);
            assert_memory_equal(by_gpu, by_cpu, count * sizeof *by_cpu);
        }
        field.registration = i % 2 == 0 ? HC_TEXEL : HC_GRID;
        hc_bake_gradient(by_cpu, &field);
        assert_int_equal(hc_gpu_bake_gradient(gpu, by_gpu, &field, NULL), HC_OK);
        for (size_t k = 0; k < 2 * count; k++) {
            assert_true(by_gpu[k] == by_cpu[k]);
        }
    }
}

/* False: there is no such map. */
static bool compare_maps(const hc_field *field, const hc_map_options *wanted)
{
    static uint8_t texels[2][33 * 21 * 32];
    for (int by = 0; by < 2; by++) {
        hc_map_options options = *wanted;
        hc_map         map     = { .texels = texels[by] };
        options.baker          = by == 1 ? hc_gpu_map_baker(gpu) : NULL;
        if (hc_map_info_for(&map.info, field, &options, NULL) != HC_OK) {
            return false;
        }
        assert_true(hc_map_bytes(&map.info) <= sizeof texels[by]);
        memset(texels[by], by, sizeof texels[by]);
        assert_int_equal(hc_bake_map(&map, field, &options, NULL), HC_OK);
        memset(texels[by] + hc_map_bytes(&map.info), 0,
               sizeof texels[by] - hc_map_bytes(&map.info));
    }
    if (hc_gpu_rounds(gpu) && memcmp(texels[0], texels[1], sizeof texels[0]) != 0) {
        fail_msg("%s, %s, %d bits, wrap %s", hc_map_kind_name(wanted->kind),
                 hc_layout_name(wanted->layout), wanted->bits, hc_wrap_name(field->wrap));
    }
    return true;
}

/* The same bytes of every kind of map in every layout and number of bits with every wrap. */
static void whole_maps(void **state)
{
    int compared = 0;
    (void)state;
    skip_without_gpu();
    for (int i = 0; i < 5 * 8 * 3 * 4 * 4; i++) {
        static const int     bits[]  = { 8, 16, 32 };
        const hc_field       field   = field_of("fbm", 33, 21, (hc_wrap)(i % 4));
        const hc_map_options options = { .kind   = (hc_map_kind)(i / 4 % 5),
                                         .layout = (hc_layout)(i / 20 % 8),
                                         .bits   = bits[i / 160 % 3],
                                         .cone   = { .cones = (hc_cones)(i / 480) } };
        compared += compare_maps(&field, &options) ? 1 : 0;
    }
    print_message("%d maps\n", compared);
    assert_true(compared > 200);
}

/* ---- a larger field, progress, errors -------------------------------------------------------- */

static void a_larger_field(void **state)
{
    enum { SIDE = 300 };
    (void)state;
    skip_without_gpu();
    float *field_heights = malloc(sizeof(float) * SIDE * SIDE);
    float *ratios[2]     = { malloc(sizeof(float) * SIDE * SIDE * 4),
                             malloc(sizeof(float) * SIDE * SIDE * 4) };
    assert_non_null(field_heights);
    assert_int_equal(hc_synth(field_heights, SIDE, SIDE, "cobbles", 1, NULL), HC_OK);
    const hc_field field = {
        .heights = field_heights, .width = SIDE, .height = SIDE, .wrap = HC_WRAP_UV
    };
    const hc_cone_options options = { .cones = HC_CONES_QUAD };
    assert_int_equal(hc_bake_cone_map(ratios[0], &field, &options, NULL), HC_OK);
    assert_int_equal(hc_gpu_bake_cone_map(gpu, ratios[1], &field, &options, NULL), HC_OK);
    assert_true(hc_gpu_seconds(gpu) > 0.0);
    if (hc_gpu_rounds(gpu)) {
        assert_memory_equal(ratios[0], ratios[1], sizeof(float) * SIDE * SIDE * 4);
    }
    free(ratios[0]);
    free(ratios[1]);
    free(field_heights);
}

typedef struct reports {
    int    count;
    double last;
} reports;

static bool count_up(void *user, double fraction)
{
    reports *r = user;
    assert_true(fraction >= r->last && fraction <= 1.0);
    r->last = fraction;
    return ++r->count < 3;
}

static void progress_and_cancelling(void **state)
{
    (void)state;
    skip_without_gpu();
    reports         seen    = { .count = -1000 };
    const hc_field  field   = field_of("fbm", 61, 47, HC_WRAP_NONE);
    hc_cone_options options = { .method   = HC_METHOD_BRUTE,
                                .cones    = HC_CONES_QUAD,
                                .progress = { .report = count_up, .user = &seen } };
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, NULL), HC_OK);
    assert_true(seen.count >= -1000 + 4);
    assert_true(seen.last == 1.0);
    seen = (reports){ .count = 0 };
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, NULL), HC_ERROR_CANCELLED);
}

static void refusals(void **state)
{
    static float long_heights[40000];
    (void)state;
    skip_without_gpu();
    hc_log          log     = { .text = "" };
    hc_field        field   = field_of("fbm", 16, 16, HC_WRAP_NONE);
    hc_cone_options options = { .method = HC_METHOD_RING };
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, &log),
                     HC_ERROR_UNSUPPORTED);
    assert_non_null(strstr(log.text, "ring is the CPU's alone"));
    options = (hc_cone_options){ .max_ratio = -1.0F };
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, &options, &log), HC_ERROR_ARGUMENT);
    field.heights = long_heights;
    field.width   = 40000;
    field.height  = 1;
    assert_int_equal(hc_gpu_bake_cone_map(gpu, by_gpu, &field, NULL, &log), HC_ERROR_LIMIT);
    assert_non_null(strstr(log.text, "field of 40000 x 1: textures of this driver"));
    hc_pyramid pyramid;
    assert_int_equal(hc_gpu_bake_pyramid(gpu, &pyramid, by_gpu, heights, 0, 3, HC_MAXIMUM, &log),
                     HC_ERROR_ARGUMENT);
    field = field_of("fbm", 16, 16, HC_WRAP_NONE);
    expect_ratios(&field, &(hc_cone_options){ .cones = HC_CONES_L1 }, hc_gpu_rounds(gpu));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method),
        cmocka_unit_test(every_wrap),
        cmocka_unit_test(drivers_that_do_not_round),
        cmocka_unit_test(the_largest_fields),
        cmocka_unit_test(long_fields),
        cmocka_unit_test(searches_of_many_dispatches),
        cmocka_unit_test(timers),
        cmocka_unit_test(pyramids),
        cmocka_unit_test(bounds_and_slopes),
        cmocka_unit_test(whole_maps),
        cmocka_unit_test(a_larger_field),
        cmocka_unit_test(progress_and_cancelling),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests_name("agree_gpu", tests, open_gpu, close_gpu);
}
