/* Fields written and read back: every container, type and size; what the elevations were comes
 * along. */
#include "io_fixture.h"

typedef struct container {
    const char *ending;
    const char *format;
    int         bits[3];
    bool        metadata;
} container;

static const container containers[] = {
    { "png", "PNG", { 8, 16 }, true },     { "tif", "TIFF", { 8, 16, 32 }, true },
    { "tiff", "TIFF", { 32 }, true },      { "exr", "EXR", { 32 }, true },
    { "pgm", "PNM", { 8, 16 }, true },     { "pfm", "PFM", { 32 }, false },
    { "npy", "NPY", { 8, 16, 32 }, true }, { "raw", "", { 8, 16, 32 }, false },
};
enum { CONTAINERS = sizeof containers / sizeof *containers };

static const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 13, 1 }, { 2, 2 }, { 5, 3 }, { 67, 129 } };
enum { SIZES = sizeof sizes / sizeof *sizes, SAMPLES_MAX = 67 * 129 };

static const hc_elevation elevation = { .low         = -12.5,
                                        .high        = 1076.25,
                                        .spacing_x   = 0.1,
                                        .spacing_y   = 1.0 / 3.0,
                                        .origin_x    = -84.41375,
                                        .origin_y    = 36.73292,
                                        .placed      = true,
                                        .has_nodata  = true,
                                        .nodata      = -9999.0,
                                        .source_bits = 16,
                                        .unit        = "US ft=%" };

/* Heights that codes of `bits` hold exactly; never 0 or 1 alone, so that stretching would show. */
static void make_heights(float *heights, int count, int bits)
{
    unsigned state = 1;
    for (int i = 0; i < count; i++) {
        const double n    = bits == 8 ? 255.0 : bits == 16 ? 65535.0 : 8388608.0;
        const double code = floor(n * 0.25) + next_number(&state) % (unsigned)(n / 2.0);
        heights[i]        = (float)(code / n);
    }
}

static void assert_same_bits(const float *got, const float *wanted, int count)
{
    for (int i = 0; i < count; i++) {
        if (memcmp(&got[i], &wanted[i], sizeof *got) != 0) {
            fail_msg("sample %d is %.9g, not %.9g", i, (double)got[i], (double)wanted[i]);
        }
    }
}

static void assert_elevation(const hc_elevation *got, const hc_elevation *wanted)
{
    assert_true(got->low == wanted->low);
    assert_true(got->high == wanted->high);
    assert_true(got->spacing_x == wanted->spacing_x);
    assert_true(got->spacing_y == wanted->spacing_y);
    assert_true(got->placed == wanted->placed);
    assert_true(got->origin_x == wanted->origin_x);
    assert_true(got->origin_y == wanted->origin_y);
    assert_true(got->has_nodata == wanted->has_nodata);
    assert_true(got->nodata == wanted->nodata);
    assert_int_equal(got->source_bits, wanted->source_bits);
    assert_string_equal(got->unit, wanted->unit);
}

static void round_trip(const container *in, int bits, int width, int height)
{
    static float heights[SAMPLES_MAX];
    const int    count = width * height;
    make_heights(heights, count, bits);
    const hc_field field = { heights, width, height, .elevation = elevation };
    hc_log         log   = { .text = "" };
    char           name[32];
    (void)snprintf(name, sizeof name, "f.%s", in->ending);
    const char *path = in_folder(name);
    assert_ok(
        hc_save_field(&field, path, &(hc_save_options){ .overwrite = true, .bits = bits }, &log),
        &log);

    hc_load_options options = { .wrap = HC_WRAP_V, .registration = HC_GRID };
    if (!in->metadata) {
        options.normalise.range = HC_RANGE_TYPE;
    }
    if (strcmp(in->ending, "raw") == 0) {
        options.raw_width  = width;
        options.raw_height = height;
        options.raw_type   = bits == 8 ? HC_U8 : bits == 16 ? HC_U16 : HC_F32;
    }
    hc_field read;
    assert_ok(hc_load_field(&read, path, &options, &log), &log);
    assert_int_equal(read.width, width);
    assert_int_equal(read.height, height);
    assert_int_equal(read.wrap, HC_WRAP_V);
    assert_int_equal(read.registration, HC_GRID);
    assert_same_bits(read.heights, heights, count);
    if (in->metadata) {
        assert_elevation(&read.elevation, &elevation);
    }
    hc_free_field(&read);
    assert_null(read.heights);
}

static void test_round_trips(void **state)
{
    (void)state;
    for (int i = 0; i < CONTAINERS; i++) {
        for (int b = 0; b < 3 && containers[i].bits[b] != 0; b++) {
            for (int s = 0; s < SIZES; s++) {
                round_trip(&containers[i], containers[i].bits[b], sizes[s][0], sizes[s][1]);
            }
        }
    }
}

/* Without a wish for bits, what a container can hold best. */
static void test_most_bits(void **state)
{
    (void)state;
    const float    heights[] = { 0.0F, 0.123456789F, 1.0F, 0.5F, 0.25F, 0.75F };
    const hc_field field     = { heights, 3, 2, .elevation = elevation };
    for (int i = 0; i < CONTAINERS; i++) {
        hc_log       log = { .text = "" };
        hc_file_info info;
        char         name[32];
        (void)snprintf(name, sizeof name, "most.%s", containers[i].ending);
        assert_ok(hc_save_field(&field, in_folder(name), NULL, &log), &log);
        if (containers[i].format[0] == '\0') {
            continue;
        }
        assert_ok(hc_read_file_info(&info, in_folder(name), NULL, &log), &log);
        const bool codes_only = containers[i].bits[0] == 8 && containers[i].bits[2] == 0;
        assert_int_equal(info.bits, codes_only ? 16 : 32);
        assert_string_equal(info.format, containers[i].format);
        assert_int_equal(info.width, 3);
        assert_int_equal(info.height, 2);
        assert_int_equal(info.channels, 1);
        assert_int_equal(info.type, codes_only ? HC_U16 : HC_F32);
        assert_false(info.srgb);
        assert_false(info.has_map);
        if (containers[i].metadata) {
            assert_elevation(&info.elevation, &elevation);
        }
    }
}

/* The stored heights are turned round or stretched on request, and the original values follow. */
static void test_original_values(void **state)
{
    (void)state;
    const float    heights[] = { 0.25F, 0.5F, 0.75F, 0.5F };
    const hc_field field     = { heights, 2, 2, .elevation = { .low = 100.0, .high = 300.0 } };
    hc_log         log       = { .text = "" };
    const hc_normalise_options wishes[] = { { .range = HC_RANGE_AUTO },
                                            { .invert = true },
                                            { .range = HC_RANGE_DATA } };
    const char                *path     = in_folder("original.npy");
    assert_ok(hc_save_field(&field, path, &(hc_save_options){ .bits = 32 }, &log), &log);
    for (int i = 0; i < 3; i++) {
        const hc_load_options options = { .normalise = wishes[i] };
        hc_field              read;
        assert_ok(hc_load_field(&read, path, &options, &log), &log);
        const double low  = read.elevation.low;
        const double high = read.elevation.high;
        for (int k = 0; k < 4; k++) {
            assert_true(low + (double)read.heights[k] * (high - low)
                        == 100.0 + 200.0 * (double)heights[k]);
        }
        assert_true(i != 1 || read.heights[0] == 0.75F);
        assert_true(i != 2 || read.heights[0] == 0.0F);
        hc_free_field(&read);
    }
}

/* A file does not depend on the program's locale, nor on what was there before. */
static void test_same_bytes(void **state)
{
    (void)state;
    static float heights[35];
    make_heights(heights, 35, 32);
    const hc_field field = { heights, 5, 7, .elevation = elevation };
    for (int i = 0; i < CONTAINERS; i++) {
        hc_log         log = { .text = "" };
        char           name[32];
        size_t         sizes_of[2];
        unsigned char *bytes[2];
        for (int k = 0; k < 2; k++) {
            (void)snprintf(name, sizeof name, "same%d.%s", k, containers[i].ending);
            assert_ok(hc_save_field(&field, in_folder(name), NULL, &log), &log);
            bytes[k] = read_bytes(in_folder(name), &sizes_of[k]);
        }
        assert_true(sizes_of[0] == sizes_of[1]);
        assert_memory_equal(bytes[0], bytes[1], sizes_of[0]);
        free(bytes[0]);
        free(bytes[1]);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    const float    heights[] = { 0.5F, 0.25F };
    const float    broken[]  = { 0.5F, NAN };
    const hc_field good      = { heights, 2, 1, .wrap = HC_WRAP_NONE };
    const hc_field bad       = { broken, 2, 1, .wrap = HC_WRAP_NONE };
    hc_log         log       = { .text = "" };
    const char    *png       = in_folder("refused.png");
    const char    *other     = in_folder("refused.ktx2");
    const int      files     = count_files();
    assert_refused(hc_save_field(&good, png, &(hc_save_options){ .bits = 32 }, &log),
                   HC_ERROR_UNSUPPORTED, &log, png, "32");
    assert_refused(hc_save_field(&good, png, &(hc_save_options){ .bits = 12 }, &log),
                   HC_ERROR_UNSUPPORTED, &log, png, "12");
    assert_refused(hc_save_field(&good, other, NULL, &log), HC_ERROR_UNSUPPORTED, &log, other,
                   ".png");
    assert_refused(hc_save_field(&good, "-", NULL, &log), HC_ERROR_UNSUPPORTED, &log, "-", ".png");
    assert_int_equal(hc_save_field(&bad, png, NULL, &log), HC_ERROR_FIELD);
    assert_int_equal(count_files(), files);
    hc_free_field(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trips),     cmocka_unit_test(test_most_bits),
        cmocka_unit_test(test_original_values), cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
