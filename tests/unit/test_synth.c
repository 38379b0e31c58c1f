/* Made fields: the same bytes everywhere, the promised shapes, no seams, clear errors.
 *
 * With the argument --print the program prints the table of golden hashes instead. */
#define _GNU_SOURCE
#include <heightcast/field.h>

#include "field/synth.h"

#include <math.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static float *make(const char *name, int width, int height, uint64_t seed)
{
    float *heights = malloc((size_t)width * (size_t)height * sizeof *heights);
    hc_log log     = { 0 };
    if (hc_synth(heights, width, height, name, seed, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    return heights;
}

/* ---- golden hashes ---- */

/* FNV-1a over the bytes of the heights, least significant byte first. */
static uint64_t hash_field(const char *name, int width, int height, uint64_t seed)
{
    float   *heights = make(name, width, height, seed);
    uint64_t hash    = 0xCBF29CE484222325U;
    for (int i = 0; i < width * height; i++) {
        uint32_t bits;
        memcpy(&bits, &heights[i], sizeof bits);
        for (int k = 0; k < 32; k += 8) {
            hash = (hash ^ (bits >> k & 0xFFU)) * 0x100000001B3U;
        }
    }
    free(heights);
    return hash;
}

/* The last one is wider than a run and worth threads. */
static const int golden_sizes[][2] = { { 1, 1 },   { 1, 7 },   { 9, 1 },
                                       { 37, 23 }, { 64, 64 }, { 300, 230 } };

enum { GOLDEN_SIZES = sizeof golden_sizes / sizeof *golden_sizes, GOLDEN_SEED = 7 };

static const struct {
    const char *name;
    uint64_t    hashes[GOLDEN_SIZES];
} golden[] = {
    { "fbm",
      { 0x4D25767F9DCE13F5U, 0xD9E0F75F6549A66CU, 0xA0886BD37C0CED83U, 0xCA325B34D862A48AU,
        0x2554E8F37283F755U, 0x928343FF94030421U } },
    { "ridged",
      { 0x4D25767F9DCE13F5U, 0x9DAF1406B0DA2283U, 0xD0FB738084B2638FU, 0x8872648263AA0DD9U,
        0x4441FC8191E34316U, 0x584D15A34168C8A4U } },
    { "dunes",
      { 0x4D25767F9DCE13F5U, 0xE92FD7A6191487B9U, 0x59223ACAE31E8859U, 0x613C023BD9BEAC8EU,
        0xF0C6A2B08A0D7F5CU, 0xAD202928267370CDU } },
    { "spikes",
      { 0x4D25767F9DCE13F5U, 0x0F961F599CFAA964U, 0x943CF28841434E75U, 0xE101DB71BEFFA489U,
        0xC2B6891F8415A7CDU, 0xCA6F7BFCAFFACB93U } },
    { "noise",
      { 0xA40570A9C9F31010U, 0xC589F7113814260AU, 0x344D8A52DDDE31E4U, 0xB9EC0F03D11875D8U,
        0x6A05EFFCF294891FU, 0xE838993333F6A8B0U } },
    { "ridge",
      { 0x4B72477F9C5C2F98U, 0xD1D54592659453A8U, 0xE894AF49AE8023D8U, 0x3D39A90E51A4BCC8U,
        0x1EDAF83472745925U, 0x78E0292BF1DD4DC5U } },
    { "funnel",
      { 0x4D25767F9DCE13F5U, 0xD57951A868B54341U, 0x076C5F95DE96F0D5U, 0xDC1230CCFA984A89U,
        0xF8B999C51C4663E8U, 0x1366918FFC95E0E8U } },
    { "saddle",
      { 0x4D25767F9DCE13F5U, 0xF15B9E29A54BE2A8U, 0xFE1DB128740E4E35U, 0xCB270ADFA5B594C8U,
        0xF9938BB2A1D4A325U, 0x7B9CC12202549865U } },
    { "steps",
      { 0x4B72477F9C5C2F98U, 0xA870229841817810U, 0xEE0B0515E6598F38U, 0x4F0CABCE7EC94D48U,
        0x0E6A8E1B32A80AA5U, 0xE785AC0C3ECD118DU } },
    { "sinc",
      { 0x4D25767F9DCE13F5U, 0x640EC4240FDBE128U, 0xFDF6AFFA7340F150U, 0x13F2D51D41BD17A8U,
        0x23690F0F8EA3D65DU, 0x5B613CFFD059BB3DU } },
    { "spheres",
      { 0x4D25767F9DCE13F5U, 0x7F1167E9016EE358U, 0x48DB5CAF8F6055E5U, 0xD491BCD993BA7960U,
        0x3AA102735620514DU, 0xF9A104E9C609605FU } },
    { "bricks",
      { 0x4D25767F9DCE13F5U, 0x3BEA13339CEB6898U, 0x3C6ACEDBCF01824BU, 0x2B9D75E8C99F1D61U,
        0x3295052A86EECDB3U, 0xDBE326298BC29385U } },
    { "cobbles",
      { 0x4D25767F9DCE13F5U, 0x7A14C6F323463A65U, 0x623BA0C38C486F56U, 0x54FFEB607C0F3A16U,
        0x397CF4462C77A709U, 0xC70CC91158B603E0U } },
    { "fur",
      { 0x4D25767F9DCE13F5U, 0xED7948E7BA6211F1U, 0x0ABF5105E44DA585U, 0xF99E40E9C2EDC278U,
        0x0E909D0FB958E148U, 0x06DD3B00E0B44D88U } },
    { "flat",
      { 0x4D25477F9DCDC418U, 0x8A9CDDF281CD6928U, 0x15670AEEDC047158U, 0x97C3C2494C321248U,
        0xD5B9884A8674A325U, 0x93561B5454953865U } },
};

enum { GOLDEN_FIELDS = sizeof golden / sizeof *golden };

static void print_golden(void)
{
    for (int field = 0; field < hc_synth_count(); field++) {
        const char *name = hc_synth_name(field);
        printf("    { \"%s\",\n      {", name);
        for (int i = 0; i < GOLDEN_SIZES; i++) {
            const uint64_t hash =
                hash_field(name, golden_sizes[i][0], golden_sizes[i][1], GOLDEN_SEED);
            printf(" 0x%016llXU%s", (unsigned long long)hash,
                   i + 1 < GOLDEN_SIZES ? "," : " } },\n");
        }
    }
}

static void test_golden(void **state)
{
    (void)state;
    assert_int_equal(hc_synth_count(), GOLDEN_FIELDS);
    for (int field = 0; field < GOLDEN_FIELDS; field++) {
        assert_string_equal(hc_synth_name(field), golden[field].name);
        for (int i = 0; i < GOLDEN_SIZES; i++) {
            const int      width = golden_sizes[i][0], height = golden_sizes[i][1];
            const uint64_t hash = hash_field(golden[field].name, width, height, GOLDEN_SEED);
            if (hash != golden[field].hashes[i]) {
                fail_msg("%s at %d x %d has other bytes", golden[field].name, width, height);
            }
        }
    }
}

/* The library takes as many threads as the process may use processors: allow one. */
static void test_threads_do_not_show(void **state)
{
    (void)state;
    enum { WIDTH = 517, HEIGHT = 301 };
    cpu_set_t all, one;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    CPU_ZERO(&one);
    CPU_SET((size_t)sched_getcpu(), &one);
    for (int field = 0; field < hc_synth_count(); field++) {
        float *many = make(hc_synth_name(field), WIDTH, HEIGHT, 1);
        assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
        float *single = make(hc_synth_name(field), WIDTH, HEIGHT, 1);
        assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
        assert_memory_equal(many, single, WIDTH * HEIGHT * sizeof *many);
        free(many);
        free(single);
    }
}

static void test_sine(void **state)
{
    (void)state;
    const double turn = 6.283185307179586;
    for (int i = -3000; i <= 3000; i++) {
        const double turns = i / 997.0;
        /* libm gets a reduced angle, so that its own rounding of turns * 2 pi does not count. */
        const double wanted = sin((turns - floor(turns + 0.5)) * turn);
        assert_true(fabs(hc_sine(turns) - wanted) <= 0x1p-43);
    }
    assert_true(hc_sine(0.0) == 0.0);
    assert_true(hc_sine(12345678.0) == 0.0);
}

/* ---- what all of them promise ---- */

static const int any_sizes[][2] = {
    { 1, 1 },    { 2, 1 },    { 1, 2 },   { 2, 2 },    { 3, 3 },
    { 1, 1000 }, { 1000, 1 }, { 7, 301 }, { 256, 31 }, { 257, 33 }
};

static void test_heights_in_range(void **state)
{
    (void)state;
    for (int field = 0; field < hc_synth_count(); field++) {
        for (size_t i = 0; i < sizeof any_sizes / sizeof *any_sizes; i++) {
            const int      width = any_sizes[i][0], height = any_sizes[i][1];
            float         *heights = make(hc_synth_name(field), width, height, i);
            const hc_field made    = { .heights = heights, .width = width, .height = height };
            hc_log         log     = { 0 };
            if (hc_field_check(&made, &log) != HC_OK) {
                fail_msg("%s: %s", hc_synth_name(field), log.text);
            }
            free(heights);
        }
    }
}

static bool is_one_of(const char *name, const char *const *names)
{
    while (*names != NULL && strcmp(name, *names) != 0) {
        names++;
    }
    return *names != NULL;
}

static void test_whole_range_is_used(void **state)
{
    (void)state;
    enum { SIDE = 200 };
    static const char *const exceptions[] = { "noise", "spikes", "flat", NULL };
    for (int field = 0; field < hc_synth_count(); field++) {
        const char *name    = hc_synth_name(field);
        float      *heights = make(name, SIDE, SIDE, 11);
        float       lowest = 1.0F, highest = 0.0F;
        for (int i = 0; i < SIDE * SIDE; i++) {
            lowest  = fminf(lowest, heights[i]);
            highest = fmaxf(highest, heights[i]);
        }
        if (!is_one_of(name, exceptions) && (lowest != 0.0F || highest != 1.0F)) {
            fail_msg("%s spans %g to %g", name, (double)lowest, (double)highest);
        }
        free(heights);
    }
}

/* A field has another variant for another seed exactly if its description does not deny it. */
static void test_seeds(void **state)
{
    (void)state;
    for (int field = 0; field < hc_synth_count(); field++) {
        const char *name   = hc_synth_name(field);
        const bool  seeded = strstr(hc_synth_description(field), "no seed") == NULL;
        assert_true(hash_field(name, 90, 70, 1) == hash_field(name, 90, 70, 1));
        assert_true((hash_field(name, 90, 70, 1) != hash_field(name, 90, 70, 2)) == seeded);
        assert_true((hash_field(name, 90, 70, 0) != hash_field(name, 90, 70, UINT64_MAX))
                    == seeded);
    }
}

/* Steepest step between neighbours along u or v: across the seam, or inside. */
static float steepest(const float *heights, int side, bool along_u, bool seam)
{
    float most = 0.0F;
    for (int j = 0; j < side; j++) {
        for (int i = 0; i < side; i++) {
            const int from = along_u ? j * side + i : i * side + j;
            const int next = (i + 1) % side;
            const int to   = along_u ? j * side + next : next * side + j;
            if ((next == 0) == seam) {
                most = fmaxf(most, fabsf(heights[to] - heights[from]));
            }
        }
    }
    return most;
}

static void test_tiles_have_no_seam(void **state)
{
    (void)state;
    enum { SIDE = 192 };
    int tiling = 0;
    for (int field = 0; field < hc_synth_count(); field++) {
        const char *name    = hc_synth_name(field);
        float      *heights = make(name, SIDE, SIDE, 5);
        const bool  tiles   = strstr(hc_synth_description(field), "tiles") != NULL;
        for (int axis = 0; tiles && axis < 2; axis++) {
            const float across = steepest(heights, SIDE, axis == 0, true);
            const float inside = steepest(heights, SIDE, axis == 0, false);
            if (across > inside) {
                fail_msg("%s has a step of %g across its seam, %g inside", name, (double)across,
                         (double)inside);
            }
        }
        tiling += tiles;
        free(heights);
    }
    assert_int_equal(tiling, 13); /* all but funnel and sinc */
}

/* ---- single fields ---- */

/* Each octave half as high on half the distance: mean steps grow with the distance, almost as
 * fast. */
static void test_fbm_is_fractal(void **state)
{
    (void)state;
    enum { SIDE = 1024 };
    float *heights  = make("fbm", SIDE, SIDE, 3);
    double last_sum = 0.0;
    for (int distance = 1; distance <= 64; distance *= 2) {
        double sum = 0.0;
        for (int y = 0; y < SIDE; y++) {
            for (int x = 0; x < SIDE; x++) {
                const int to = y * SIDE + (x + distance) % SIDE;
                sum += fabs((double)heights[to] - (double)heights[y * SIDE + x]);
            }
        }
        if (distance > 1) {
            assert_true(sum > 1.4 * last_sum && sum < 2.0 * last_sum);
        }
        last_sum = sum;
    }
    free(heights);
}

static void test_spikes(void **state)
{
    (void)state;
    enum { SIDE = 512 };
    float *heights = make("spikes", SIDE, SIDE, 9);
    int    towers  = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        towers += heights[i] > 0.0F;
        assert_true(heights[i] == 0.0F || heights[i] >= 0.25F);
    }
    /* 1311 expected, standard deviation 36 */
    assert_in_range(towers, 1311 - 4 * 36, 1311 + 4 * 36);
    free(heights);
}

static void test_noise_is_even(void **state)
{
    (void)state;
    enum { SIDE = 512, BINS = 16 };
    float *heights    = make("noise", SIDE, SIDE, 9);
    int    bins[BINS] = { 0 };
    for (int i = 0; i < SIDE * SIDE; i++) {
        bins[(int)(heights[i] * BINS)]++;
    }
    for (int i = 0; i < BINS; i++) { /* 16384 expected, standard deviation 124 */
        assert_in_range(bins[i], 16384 - 5 * 124, 16384 + 5 * 124);
    }
    free(heights);
}

static void test_ridge(void **state)
{
    (void)state;
    static const int sizes[][2] = { { 64, 64 }, { 50, 20 }, { 20, 51 }, { 1, 9 }, { 9, 1 } };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const int width = sizes[k][0], height = sizes[k][1];
        float    *heights = make("ridge", width, height, 0);
        int       wall    = 0;
        for (int i = 0; i < width * height; i++) {
            assert_true(heights[i] == 0.0F || heights[i] == 1.0F);
            wall += heights[i] == 1.0F;
        }
        assert_int_equal(wall, width > height ? width : height);
        assert_true(heights[0] == 1.0F || width != height);
        assert_true(heights[width * height - 1] == 1.0F || width != height);
        free(heights);
    }
}

static void test_funnel(void **state)
{
    (void)state;
    float *heights = make("funnel", 8, 4, 0);
    assert_true(heights[2 * 8 + 4] == 0.0F);
    assert_true(heights[0] == 1.0F);
    assert_true(heights[2 * 8 + 5] == (float)(0.125 / sqrt(0.5)));
    assert_true(heights[1 * 8 + 4] == (float)(0.25 / sqrt(0.5)));
    free(heights);
}

static void test_saddle_and_flat(void **state)
{
    (void)state;
    float *saddle = make("saddle", 5, 3, 0);
    float *flat   = make("flat", 5, 3, 0);
    for (int i = 0; i < 15; i++) {
        assert_true(saddle[i] == (float)((i % 5 + i / 5) % 2));
        assert_true(flat[i] == 0.5F);
    }
    free(saddle);
    free(flat);
}

static void test_steps(void **state)
{
    (void)state;
    float *heights = make("steps", 16, 32, 0);
    for (int x = 0; x < 8; x++) { /* one texel for a step along u, two along v */
        assert_true(heights[16 * 16 + x] == (float)(x / 7.0));
        assert_true(heights[16 * 16 + 15 - x] == (float)(x / 7.0));
        assert_true(heights[(2 * x) * 16 + 8] == (float)(x / 7.0));
        assert_true(heights[(2 * x + 1) * 16 + 8] == (float)(x / 7.0));
    }
    free(heights);
}

static void test_sinc(void **state)
{
    (void)state;
    enum { SIDE = 101 };
    float       *heights = make("sinc", SIDE, SIDE, 0);
    const double low     = -0.217233628; /* least value of sin(r) / r */
    for (int x = 0; x < SIDE; x++) {
        const double r      = 2.0 * 3.14159265358979 * 5.0 * fabs((2.0 * x + 1.0) / SIDE - 1.0);
        const double wanted = ((r > 0.0 ? sin(r) / r : 1.0) - low) / (1.0 - low);
        assert_true(fabs((double)heights[50 * SIDE + x] - wanted) < 2e-3); /* low falls between */
    }
    free(heights);
}

/* 4 x 2 cells: every sphere stands alone, round, and leaves the plane free at the cell's
 * corners. */
static void test_spheres(void **state)
{
    (void)state;
    enum { WIDTH = 400, HEIGHT = 200, CELL = 100 };
    float *heights = make("spheres", WIDTH, HEIGHT, 2);
    for (int cell = 0; cell < 8; cell++) {
        const int    x0 = cell % 4 * CELL, y0 = cell / 4 * CELL;
        const float *top = heights + (y0 + CELL / 2) * WIDTH + x0 + CELL / 2;
        assert_true(heights[y0 * WIDTH + x0] == 0.0F);
        for (int k = 0; k < CELL / 2; k++) { /* symmetric about the cell's middle */
            assert_true(fabsf(top[k] - top[-1 - k]) < 1e-6F);
            assert_true(fabsf(top[k] - top[k * WIDTH]) < 1e-6F);
            assert_true(k == 0 || top[k] <= top[k - 1]);
        }
        assert_true(*top > 0.45F);
    }
    free(heights);
}

/* ---- the list, and errors ---- */

static void test_names_and_descriptions(void **state)
{
    (void)state;
    for (int i = 0; i < hc_synth_count(); i++) {
        assert_true(strlen(hc_synth_name(i)) > 0);
        assert_true(strlen(hc_synth_description(i)) > 0);
        assert_true(strlen(hc_synth_description(i)) < 100);
        assert_null(strchr(hc_synth_description(i), '\n'));
        for (int j = 0; j < i; j++) {
            assert_string_not_equal(hc_synth_name(i), hc_synth_name(j));
        }
    }
    assert_null(hc_synth_name(-1));
    assert_null(hc_synth_name(hc_synth_count()));
    assert_null(hc_synth_description(-1));
    assert_null(hc_synth_description(hc_synth_count()));
}

static void test_errors(void **state)
{
    (void)state;
    float  height;
    hc_log log = { 0 };
    assert_int_equal(hc_synth(&height, 1, 1, "hills", 0, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "'hills'"));
    for (int i = 0; i < hc_synth_count(); i++) {
        assert_non_null(strstr(log.text, hc_synth_name(i)));
    }
    assert_int_equal(hc_synth(&height, 1, 1, NULL, 0, &log), HC_ERROR_ARGUMENT);
    assert_int_equal(hc_synth(NULL, 1, 1, "fbm", 0, &log), HC_ERROR_ARGUMENT);
    assert_int_equal(hc_synth(&height, 0, 1, "fbm", 0, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "0 x 1"));
    assert_int_equal(hc_synth(&height, 1, HC_SIDE_MAX + 1, "fbm", 0, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "1 x 1048577"));
    assert_int_equal(hc_synth(&height, 1, -1, "fbm", 0, NULL), HC_ERROR_ARGUMENT);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_golden),
        cmocka_unit_test(test_threads_do_not_show),
        cmocka_unit_test(test_sine),
        cmocka_unit_test(test_heights_in_range),
        cmocka_unit_test(test_whole_range_is_used),
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_tiles_have_no_seam),
        cmocka_unit_test(test_fbm_is_fractal),
        cmocka_unit_test(test_spikes),
        cmocka_unit_test(test_noise_is_even),
        cmocka_unit_test(test_ridge),
        cmocka_unit_test(test_funnel),
        cmocka_unit_test(test_saddle_and_flat),
        cmocka_unit_test(test_steps),
        cmocka_unit_test(test_sinc),
        cmocka_unit_test(test_spheres),
        cmocka_unit_test(test_names_and_descriptions),
        cmocka_unit_test(test_errors),
    };
    if (argc > 1 && strcmp(argv[1], "--print") == 0) {
        print_golden();
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
