/* Raw samples to heights: types, channels, ranges, inversion, holes, and what the messages say. */
#include <heightcast/field.h>

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Normalise samples that must go through. */
static void normalise(float *heights, hc_sample_type type, const void *data, int width, int height,
                      int channels, const hc_normalise_options *options, hc_elevation *elevation)
{
    const hc_samples samples = { data, type, width, height, channels };
    hc_log           log     = { 0 };
    if (hc_normalise(heights, &samples, options, elevation, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
}

static void expect_heights(const float *heights, const float *wanted, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (memcmp(&heights[i], &wanted[i], sizeof *heights) != 0) { /* tells 0 from -0 */
            fail_msg("height %zu is %.9g, not %.9g", i, (double)heights[i], (double)wanted[i]);
        }
    }
}

static void expect_refused(const hc_samples *samples, const hc_normalise_options *options,
                           hc_elevation *elevation, hc_result result, const char *words)
{
    float  heights[64];
    hc_log log = { 0 };
    assert_int_equal(hc_normalise(heights, samples, options, elevation, &log), result);
    if (strstr(log.text, words) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, words);
    }
    assert_int_equal(hc_normalise(heights, samples, options, elevation, NULL), result);
}

static void keep_line(void *user, const char *line)
{
    (void)snprintf(user, HC_LOG_TEXT_SIZE, "%s", line);
}

/* ---- types and ranges ---- */

static void test_unsigned_types_by_type(void **state)
{
    (void)state;
    float          heights[3];
    const uint8_t  u8[]     = { 0, 51, 255 };
    const uint16_t u16[]    = { 0, 13107, 65535 };
    const uint32_t u32[]    = { 0, 858993459, UINT32_MAX };
    const float    wanted[] = { 0.0F, 0.2F, 1.0F };
    normalise(heights, HC_U8, u8, 3, 1, 1, NULL, NULL);
    expect_heights(heights, wanted, 3);
    normalise(heights, HC_U16, u16, 1, 3, 1, NULL, NULL);
    expect_heights(heights, wanted, 3);
    normalise(heights, HC_U32, u32, 3, 1, 1, NULL, NULL);
    expect_heights(heights, wanted, 3);
}

/* 16 bits must come through without losing a code. */
static void test_every_code_of_16_bits_stays(void **state)
{
    (void)state;
    enum { CODES = 65536 };
    uint16_t *codes   = malloc(CODES * sizeof *codes);
    float    *heights = malloc(CODES * sizeof *heights);
    for (int i = 0; i < CODES; i++) {
        codes[i] = (uint16_t)i;
    }
    normalise(heights, HC_U16, codes, 256, 256, 1, NULL, NULL);
    for (int i = 0; i < CODES; i++) {
        assert_true(heights[i] == (float)(i / 65535.0));
        assert_int_equal(lrint((double)heights[i] * 65535.0), i);
    }
    free(codes);
    free(heights);
}

static void test_signed_types_clamp_below_zero(void **state)
{
    (void)state;
    float         heights[4];
    char          line[HC_LOG_TEXT_SIZE] = "";
    hc_log        log                    = { .warn = keep_line, .user = line };
    const int16_t i16[]                  = { INT16_MIN, 0, INT16_MAX, -1 };
    const int32_t i32[]                  = { INT32_MIN, 0, INT32_MAX, -1 };
    const float   wanted[]               = { 0.0F, 0.0F, 1.0F, 0.0F };
    assert_int_equal(hc_normalise(heights, &(hc_samples){ i16, HC_I16, 2, 2, 1 }, NULL, NULL, &log),
                     HC_OK);
    expect_heights(heights, wanted, 4);
    assert_non_null(strstr(line, "from -32768 to 32767"));
    assert_non_null(strstr(line, "clamped"));
    normalise(heights, HC_I32, i32, 2, 2, 1, NULL, NULL);
    expect_heights(heights, wanted, 4);
}

static void test_floats_by_data(void **state)
{
    (void)state;
    float        heights[4];
    hc_elevation elevation = { 0 };
    const float  f32[]     = { -100.0F, 300.0F, 0.0F, 200.0F };
    const double f64[]     = { -1e-300, 3e-300, 0.0, 2e-300 };
    const float  wanted[]  = { 0.0F, 1.0F, 0.25F, 0.75F };
    normalise(heights, HC_F32, f32, 4, 1, 1, NULL, &elevation);
    expect_heights(heights, wanted, 4);
    assert_true(elevation.low == -100.0 && elevation.high == 300.0);
    assert_int_equal(elevation.source_bits, 32);
    normalise(heights, HC_F64, f64, 4, 1, 1, NULL, &elevation);
    expect_heights(heights, wanted, 4);
    assert_int_equal(elevation.source_bits, 64);
}

static void test_huge_values(void **state)
{
    (void)state;
    float        heights[3];
    hc_elevation elevation = { 0 };
    const double f64[]     = { -DBL_MAX, DBL_MAX, 0.0 }; /* their difference is no double */
    const float  f32[]     = { -FLT_MAX, FLT_MAX, 0.0F };
    const float  wanted[]  = { 0.0F, 1.0F, 0.5F };
    normalise(heights, HC_F64, f64, 3, 1, 1, NULL, &elevation);
    expect_heights(heights, wanted, 3);
    assert_true(elevation.low == -DBL_MAX && elevation.high == DBL_MAX);
    normalise(heights, HC_F32, f32, 3, 1, 1, NULL, NULL);
    expect_heights(heights, wanted, 3);
    const double tiny[] = { 0.0, DBL_TRUE_MIN, 0.0 };
    const float  ends[] = { 0.0F, 1.0F, 0.0F };
    normalise(heights, HC_F64, tiny, 3, 1, 1, NULL, NULL);
    expect_heights(heights, ends, 3);
}

static void test_range_given(void **state)
{
    (void)state;
    float                heights[4];
    const uint8_t        u8[]      = { 0, 100, 150, 255 };
    const float          wanted[]  = { 0.0F, 0.0F, 0.5F, 1.0F };
    const float          falling[] = { 1.0F, 1.0F, 0.5F, 0.0F };
    hc_elevation         elevation = { 0 };
    hc_normalise_options options   = { .range = HC_RANGE_GIVEN, .low = 100.0, .high = 200.0 };
    normalise(heights, HC_U8, u8, 4, 1, 1, &options, &elevation);
    expect_heights(heights, wanted, 4);
    assert_true(elevation.low == 100.0 && elevation.high == 200.0);
    options.low  = 200.0;
    options.high = 100.0;
    normalise(heights, HC_U8, u8, 4, 1, 1, &options, &elevation);
    expect_heights(heights, falling, 4);
}

/* low lands on -0 in the arithmetic of a falling range; heights must not show it. */
static void test_no_negative_zero(void **state)
{
    (void)state;
    float                      height;
    const double               value   = 5.0;
    const hc_normalise_options options = { .range = HC_RANGE_GIVEN, .low = 5.0, .high = 1.0 };
    normalise(&height, HC_F64, &value, 1, 1, 1, &options, NULL);
    expect_heights(&height, &(float){ 0.0F }, 1);
}

static void test_range_type(void **state)
{
    (void)state;
    float                heights[3];
    const uint16_t       u16[]     = { 0, 511, 1023 };
    hc_elevation         elevation = { 0 };
    hc_normalise_options options   = { .range = HC_RANGE_TYPE, .type_max = 1023.0 };
    normalise(heights, HC_U16, u16, 3, 1, 1, &options, &elevation);
    expect_heights(heights, (const float[]){ 0.0F, (float)(511.0 / 1023.0), 1.0F }, 3);
    assert_true(elevation.low == 0.0 && elevation.high == 1023.0);
    /* Float types: 0 and 1, whatever type_max says. */
    const float f32[] = { -2.0F, 0.25F, 7.0F };
    normalise(heights, HC_F32, f32, 3, 1, 1, &options, &elevation);
    expect_heights(heights, (const float[]){ 0.0F, 0.25F, 1.0F }, 3);
    assert_true(elevation.high == 1.0);
}

/* A georeferenced source holds elevations, so its integers are measured, not taken for
 * brightness. */
static void test_placed_sources_by_data(void **state)
{
    (void)state;
    float         heights[3];
    const int16_t i16[]     = { -20, 980, 480 };
    hc_elevation  elevation = { .placed = true };
    normalise(heights, HC_I16, i16, 3, 1, 1, NULL, &elevation);
    expect_heights(heights, (const float[]){ 0.0F, 1.0F, 0.5F }, 3);
    assert_true(elevation.low == -20.0 && elevation.high == 980.0);
    assert_int_equal(elevation.source_bits, 16);
}

static void test_constant_field(void **state)
{
    (void)state;
    float                      heights[4];
    hc_elevation               elevation = { 0 };
    const float                f32[]     = { 7.5F, 7.5F, 7.5F, 7.5F };
    const hc_normalise_options invert    = { .invert = true };
    normalise(heights, HC_F32, f32, 2, 2, 1, NULL, &elevation);
    expect_heights(heights, (const float[]){ 0.0F, 0.0F, 0.0F, 0.0F }, 4);
    assert_true(elevation.low == 7.5 && elevation.high == 7.5);
    normalise(heights, HC_F32, f32, 2, 2, 1, &invert, NULL);
    expect_heights(heights, (const float[]){ 1.0F, 1.0F, 1.0F, 1.0F }, 4);
}

static void test_invert_keeps_originals(void **state)
{
    (void)state;
    float                      heights[3];
    hc_elevation               elevation = { 0 };
    const double               f64[]     = { 10.0, 40.0, 25.0 };
    const hc_normalise_options invert    = { .invert = true };
    normalise(heights, HC_F64, f64, 3, 1, 1, &invert, &elevation);
    expect_heights(heights, (const float[]){ 1.0F, 0.0F, 0.5F }, 3);
    for (int i = 0; i < 3; i++) {
        const double span = elevation.high - elevation.low;
        assert_true(elevation.low + (double)heights[i] * span == f64[i]);
    }
}

static void test_warns_about_poor_use(void **state)
{
    (void)state;
    float          heights[2];
    char           line[HC_LOG_TEXT_SIZE] = "";
    hc_log         log                    = { .warn = keep_line, .user = line };
    const uint16_t metres[]               = { 236, 1076 };
    const uint16_t enough[]               = { 1000, 1000 + 4096 };
    hc_samples     samples                = { metres, HC_U16, 2, 1, 1 };
    assert_int_equal(hc_normalise(heights, &samples, NULL, NULL, &log), HC_OK);
    assert_non_null(strstr(line, "1.3 %"));
    assert_non_null(strstr(line, "236 to 1076 of 0 to 65535"));
    line[0]                              = '\0';
    const hc_normalise_options stretched = { .range = HC_RANGE_DATA };
    assert_int_equal(hc_normalise(heights, &samples, &stretched, NULL, &log), HC_OK);
    assert_string_equal(line, "");
    samples.data = enough;
    assert_int_equal(hc_normalise(heights, &samples, NULL, NULL, &log), HC_OK);
    assert_string_equal(line, "");
}

static void test_unaligned_rows(void **state)
{
    (void)state;
    float         heights[2];
    unsigned char bytes[1 + 2 * sizeof(double)];
    const double  values[] = { 3.0, 5.0 };
    memcpy(bytes + 1, values, sizeof values);
    normalise(heights, HC_F64, bytes + 1, 2, 1, 1, NULL, NULL);
    expect_heights(heights, (const float[]){ 0.0F, 1.0F }, 2);
}

/* ---- channels ---- */

static float one_channel(const uint8_t *texel, int channels, hc_channel channel)
{
    float                      height;
    const hc_normalise_options options = { .channel = channel };
    normalise(&height, HC_U8, texel, 1, 1, channels, &options, NULL);
    return height;
}

static void test_channel_choice(void **state)
{
    (void)state;
    const uint8_t texel[] = { 51, 102, 153, 204 };
    const float   luma    = (float)((0.2126 * 51 + 0.7152 * 102 + 0.0722 * 153) / 255.0);
    assert_true(one_channel(texel, 4, HC_CHANNEL_R) == 0.2F);
    assert_true(one_channel(texel, 4, HC_CHANNEL_G) == 0.4F);
    assert_true(one_channel(texel, 4, HC_CHANNEL_B) == 0.6F);
    assert_true(one_channel(texel, 4, HC_CHANNEL_A) == 0.8F);
    assert_true(one_channel(texel, 3, HC_CHANNEL_LUMA) == luma);
    assert_true(one_channel(texel, 3, HC_CHANNEL_AUTO) == luma);
    assert_true(one_channel(texel, 2, HC_CHANNEL_AUTO) == 0.2F);
    assert_true(one_channel(texel, 2, HC_CHANNEL_G) == 0.4F);
    assert_true(one_channel(texel, 2, HC_CHANNEL_A) == 0.4F);
    assert_true(one_channel(texel, 2, HC_CHANNEL_LUMA) == 0.2F);
    assert_true(one_channel(texel, 1, HC_CHANNEL_AUTO) == 0.2F);
    const uint8_t white[] = { 255, 255, 255 };
    assert_true(one_channel(white, 3, HC_CHANNEL_LUMA) == 1.0F);
}

/* Grey images keep their exact codes; one coloured texel turns the whole image to luma. */
static void test_channel_auto_looks_at_all_texels(void **state)
{
    (void)state;
    float         heights[3];
    const uint8_t grey[]     = { 0, 0, 0, 33, 33, 33, 255, 255, 255 };
    const uint8_t coloured[] = { 0, 0, 0, 33, 33, 33, 255, 255, 0 };
    normalise(heights, HC_U8, grey, 3, 1, 3, NULL, NULL);
    expect_heights(heights, (const float[]){ 0.0F, (float)(33 / 255.0), 1.0F }, 3);
    normalise(heights, HC_U8, coloured, 3, 1, 3, NULL, NULL);
    expect_heights(&heights[2], &(float){ (float)((0.2126 * 255 + 0.7152 * 255) / 255.0) }, 1);
}

static void test_missing_channels(void **state)
{
    (void)state;
    static const struct {
        int        channels;
        hc_channel wanted;
    } cases[]             = { { 1, HC_CHANNEL_G }, { 1, HC_CHANNEL_B }, { 1, HC_CHANNEL_A },
                              { 2, HC_CHANNEL_B }, { 3, HC_CHANNEL_A }, { 4, (hc_channel)6 } };
    const uint8_t texel[] = { 1, 2, 3, 4 };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const hc_samples           samples = { texel, HC_U8, 1, 1, cases[i].channels };
        const hc_normalise_options options = { .channel = cases[i].wanted };
        expect_refused(&samples, &options, NULL, HC_ERROR_ARGUMENT, "is not there");
    }
}

/* ---- holes ---- */

static const float three_holes[] = { 4.0F, 8.0F, 2.0F, 6.0F, 4.0F, NAN, INFINITY, 6.0F, -INFINITY };

static void test_holes_are_an_error(void **state)
{
    (void)state;
    const hc_samples samples = { three_holes, HC_F32, 3, 3, 1 };
    expect_refused(
        &samples, NULL, NULL, HC_ERROR_FIELD,
        "3 of 9 samples have no height (NaN, infinite or nodata), the first at [2, 1]: nan");
    const int16_t    i16[]     = { 7, 9, -9999, -9999 };
    hc_elevation     elevation = { .placed = true, .has_nodata = true, .nodata = -9999.0 };
    const hc_samples integers  = { i16, HC_I16, 2, 2, 1 };
    expect_refused(
        &integers, NULL, &elevation, HC_ERROR_FIELD,
        "2 of 4 samples have no height (NaN, infinite or nodata), the first at [0, 1]: -9999");
    assert_true(elevation.low == 0.0 && elevation.high == 0.0); /* untouched */
}

static void test_holes_take_the_lowest(void **state)
{
    (void)state;
    float                heights[9];
    hc_elevation         elevation = { 0 };
    hc_normalise_options options   = { .holes = HC_HOLES_LOWEST };
    normalise(heights, HC_F32, three_holes, 3, 3, 1, &options, &elevation);
    const float wanted[] = {
        (float)(1.0 / 3.0), 1.0F, 0.0F, (float)(2.0 / 3.0), (float)(1.0 / 3.0), 0.0F, 0.0F,
        (float)(2.0 / 3.0), 0.0F
    };
    expect_heights(heights, wanted, 9);
    assert_true(elevation.low == 2.0 && elevation.high == 8.0); /* of the valid samples */
    /* Lowest as a height: of the inverted field, and not below a given range. */
    options.invert = true;
    normalise(heights, HC_F32, three_holes, 3, 3, 1, &options, NULL);
    assert_true(heights[5] == 0.0F);
    options =
        (hc_normalise_options){ .holes = HC_HOLES_LOWEST, .range = HC_RANGE_GIVEN, .high = 16.0 };
    normalise(heights, HC_F32, three_holes, 3, 3, 1, &options, NULL);
    assert_true(heights[5] == 0.125F && heights[6] == 0.125F);
}

static void test_holes_are_filled(void **state)
{
    (void)state;
    float                      heights[9];
    const hc_normalise_options options = { .holes = HC_HOLES_FILL };
    normalise(heights, HC_F32, three_holes, 3, 3, 1, &options, NULL);
    /* (2, 1): mean of 8, 2, 4, 6; (0, 2): of 6, 4, 6; (2, 2): of 4, 6. */
    const double third = 1.0 / 3.0;
    assert_true(fabs((double)heights[5] - third * (3.0 + 0.0 + 1.0 + 2.0) / 4.0) < 1e-7);
    assert_true(fabs((double)heights[6] - third * (2.0 + 1.0 + 2.0) / 3.0) < 1e-7);
    assert_true(fabs((double)heights[8] - third * (1.0 + 2.0) / 2.0) < 1e-7);
}

/* Mean over the valid samples of the smallest square around (x, y) that has any; scans ring by
 * ring. */
static double filled_by_brute_force(const float *samples, int width, int height, int x, int y)
{
    for (int radius = 0;; radius++) {
        double sum   = 0.0;
        int    count = 0;
        for (int j = 0; j < height; j++) {
            for (int i = 0; i < width; i++) {
                const int   across = abs(i - x), down = abs(j - y);
                const float sample = samples[j * width + i];
                if ((across > down ? across : down) == radius && !isnan(sample)) {
                    sum += (double)sample;
                    count++;
                }
            }
        }
        if (count > 0) {
            return sum / count;
        }
    }
}

static void test_fill_equals_brute_force(void **state)
{
    (void)state;
    static const struct {
        int      width, height;
        unsigned valid_in_256;
    } cases[]       = { { 31, 23, 128 }, { 23, 31, 8 }, { 40, 40, 1 },
                        { 1, 37, 20 },   { 37, 1, 20 }, { 29, 17, 250 } };
    uint32_t random = 1;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const int width = cases[k].width, height = cases[k].height;
        float     samples[1600], heights[1600];
        for (int i = 0; i < width * height; i++) {
            random     = random * 1664525U + 1013904223U;
            samples[i] = (random >> 24) < cases[k].valid_in_256
                             ? (float)(random >> 8 & 0xFFFF) / 65536.0F
                             : NAN;
        }
        samples[0]                         = 0.0F;
        samples[width * height - 1]        = 1.0F;
        const hc_normalise_options options = { .holes = HC_HOLES_FILL };
        normalise(heights, HC_F32, samples, width, height, 1, &options, NULL);
        for (int i = 0; i < width * height; i++) {
            const double wanted =
                filled_by_brute_force(samples, width, height, i % width, i / width);
            assert_true(fabs((double)heights[i] - wanted) <= 0x1p-24);
        }
    }
}

/* Far apart: one valid height for a million holes, and it arrives unchanged. */
static void test_fill_reaches_far(void **state)
{
    (void)state;
    enum { SIDE = 1000 };
    uint8_t     *samples               = calloc(SIDE, SIDE);
    float       *heights               = malloc(SIDE * SIDE * sizeof *heights);
    hc_elevation elevation             = { .has_nodata = true, .nodata = 0.0 };
    samples[SIDE * 3 + 990]            = 123;
    const hc_normalise_options options = { .holes = HC_HOLES_FILL };
    normalise(heights, HC_U8, samples, SIDE, SIDE, 1, &options, &elevation);
    for (int i = 0; i < SIDE * SIDE; i++) {
        assert_true(heights[i] == (float)(123 / 255.0));
    }
    free(samples);
    free(heights);
}

static void test_nothing_valid(void **state)
{
    (void)state;
    const float      f32[]   = { NAN, INFINITY, NAN, NAN };
    const hc_samples samples = { f32, HC_F32, 2, 2, 1 };
    for (int holes = 0; holes < 3; holes++) {
        const hc_normalise_options options = { .holes = (hc_holes)holes };
        expect_refused(&samples, &options, NULL, HC_ERROR_FIELD, "none of 4 samples has a height");
    }
}

/* Files give nodata in decimal; float32 samples hold its rounded form. */
static void test_nodata_of_float_samples(void **state)
{
    (void)state;
    float                      heights[2];
    const float                f32[]     = { -9999.9F, 3.0F };
    hc_elevation               elevation = { .has_nodata = true, .nodata = -9999.9 };
    const hc_normalise_options options   = { .holes = HC_HOLES_LOWEST };
    normalise(heights, HC_F32, f32, 2, 1, 1, &options, &elevation);
    assert_true(elevation.low == 3.0 && elevation.high == 3.0);
    elevation = (hc_elevation){ .has_nodata = true, .nodata = NAN };
    normalise(heights, HC_F32, f32, 2, 1, 1, &options, &elevation);
    assert_true(elevation.high == 3.0);
    elevation = (hc_elevation){ .nodata = 3.0 }; /* not in force */
    normalise(heights, HC_F32, f32, 2, 1, 1, NULL, &elevation);
    assert_true(elevation.high == 3.0);
}

/* Black is a hole only where all channels are. */
static void test_nodata_of_luma(void **state)
{
    (void)state;
    const uint8_t    rgb[]     = { 0, 0, 0, 255, 0, 0, 0, 0, 9, 0, 0, 0 };
    hc_elevation     elevation = { .has_nodata = true };
    const hc_samples samples   = { rgb, HC_U8, 4, 1, 3 };
    expect_refused(&samples, NULL, &elevation, HC_ERROR_FIELD, "2 of 4 samples");
    const float      broken[] = { 0.5F, NAN, 0.25F, 1.0F, 0.0F, 0.5F };
    const hc_samples floats   = { broken, HC_F32, 2, 1, 3 };
    expect_refused(&floats, NULL, NULL, HC_ERROR_FIELD, "1 of 2 samples");
}

/* ---- arguments ---- */

static void test_bad_samples(void **state)
{
    (void)state;
    const uint8_t    data[] = { 1, 2, 3, 4 };
    const hc_samples good   = { data, HC_U8, 2, 2, 1 };
    expect_refused(NULL, NULL, NULL, HC_ERROR_ARGUMENT, "NULL");
    hc_samples bad = good;
    bad.data       = NULL;
    expect_refused(&bad, NULL, NULL, HC_ERROR_ARGUMENT, "NULL");
    bad      = good;
    bad.type = (hc_sample_type)7;
    expect_refused(&bad, NULL, NULL, HC_ERROR_ARGUMENT, "samples.type is 7");
    bad          = good;
    bad.channels = 5;
    expect_refused(&bad, NULL, NULL, HC_ERROR_ARGUMENT, "samples.channels is 5");
    bad       = good;
    bad.width = -2;
    expect_refused(&bad, NULL, NULL, HC_ERROR_ARGUMENT, "-2 x 2");
    bad        = good;
    bad.height = HC_SIDE_MAX + 1;
    expect_refused(&bad, NULL, NULL, HC_ERROR_ARGUMENT, "2 x 1048577");
    assert_int_equal(hc_normalise(NULL, &good, NULL, NULL, NULL), HC_ERROR_ARGUMENT);
}

static void test_bad_options(void **state)
{
    (void)state;
    const uint8_t                     data[]    = { 1, 2, 3, 4 };
    const hc_samples                  samples   = { data, HC_U8, 2, 2, 1 };
    static const hc_normalise_options refused[] = {
        { .range = HC_RANGE_GIVEN },
        { .range = HC_RANGE_GIVEN, .low = 3.0, .high = 3.0 },
        { .range = HC_RANGE_GIVEN, .low = NAN, .high = 3.0 },
        { .range = HC_RANGE_GIVEN, .low = 0.0, .high = INFINITY },
        { .range = (hc_range)4 },
        { .holes = (hc_holes)3 },
        { .type_max = -1.0 },
        { .type_max = NAN },
    };
    static const char *const words[] = { "0 to 0",     "3 to 3",     "range is",       "0 to inf",
                                         "range is 4", "holes is 3", "type_max is -1", "type_max" };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        expect_refused(&samples, &refused[i], NULL, HC_ERROR_ARGUMENT, words[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unsigned_types_by_type),
        cmocka_unit_test(test_every_code_of_16_bits_stays),
        cmocka_unit_test(test_signed_types_clamp_below_zero),
        cmocka_unit_test(test_floats_by_data),
        cmocka_unit_test(test_huge_values),
        cmocka_unit_test(test_range_given),
        cmocka_unit_test(test_no_negative_zero),
        cmocka_unit_test(test_range_type),
        cmocka_unit_test(test_placed_sources_by_data),
        cmocka_unit_test(test_constant_field),
        cmocka_unit_test(test_invert_keeps_originals),
        cmocka_unit_test(test_warns_about_poor_use),
        cmocka_unit_test(test_unaligned_rows),
        cmocka_unit_test(test_channel_choice),
        cmocka_unit_test(test_channel_auto_looks_at_all_texels),
        cmocka_unit_test(test_missing_channels),
        cmocka_unit_test(test_holes_are_an_error),
        cmocka_unit_test(test_holes_take_the_lowest),
        cmocka_unit_test(test_holes_are_filled),
        cmocka_unit_test(test_fill_equals_brute_force),
        cmocka_unit_test(test_fill_reaches_far),
        cmocka_unit_test(test_nothing_valid),
        cmocka_unit_test(test_nodata_of_float_samples),
        cmocka_unit_test(test_nodata_of_luma),
        cmocka_unit_test(test_bad_samples),
        cmocka_unit_test(test_bad_options),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
