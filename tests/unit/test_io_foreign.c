/* Files that other programs wrote (tests/files): every variant gives the samples it should. */
#include "io_fixture.h"

#include "io/io_internal.h"

#include <fcntl.h>
#include <locale.h>
#include <sys/wait.h>

typedef double formula(int x, int y);

static double wide(int x, int y)
{
    return 1000.0 + 37.0 * x + 411.0 * y;
}

static double byte(int x, int y)
{
    return 3.0 * x + 5.0 * y;
}

static double byte_channels(int x, int y)
{
    return byte(x / 3, y) + 40.0 * (x % 3);
}

static double wide_channels(int x, int y)
{
    return wide(x / 3, y) + 10.0 * (x % 3);
}

static double white_is_zero(int x, int y)
{
    return 255.0 - byte(x, y);
}

static double nodata(int x, int y)
{
    return x == 3 && y == 1 ? -9999.0 : wide(x, y) - 5000.0;
}

static double large(int x, int y)
{
    return wide(x, y) * 100000.0;
}

static double negative(int x, int y)
{
    return (wide(x, y) - 5000.0) * 100000.0;
}

static double eighths(int x, int y)
{
    return wide(x, y) / 8.0 - 100.5;
}

static double thirds(int x, int y)
{
    return wide(x, y) / 3.0;
}

static double small_floats(int x, int y)
{
    return wide(x, y) / 8192.0;
}

/* as half floats hold them: 11 bits */
static double halves(int x, int y)
{
    const double value = small_floats(x, y);
    int          exponent;
    const double mantissa = frexp(value, &exponent);
    return ldexp(nearbyint(mantissa * 2048.0), exponent - 11);
}

static double mixed_channels(int x, int y)
{
    const double value = small_floats(x / 3, y);
    return x % 3 == 0 ? halves(x / 3, y) : x % 3 == 1 ? value / 2.0 : halves(x / 3, y) / 4.0;
}

static double low(int x, int y, int codes)
{
    return (double)((x + y) % codes) * (255.0 / (codes - 1));
}

static double one_bit(int x, int y)
{
    return low(x, y, 2);
}

static double two_bits(int x, int y)
{
    return low(x, y, 4);
}

static double four_bits(int x, int y)
{
    return low(x, y, 16);
}

static double shifted(int x, int y)
{
    return wide(x, y) - 2000.0;
}

static double tens(int x, int y)
{
    return 10.0 * byte(x, y);
}

/* libtiff sees them as signed */
static double signed_byte(int x, int y)
{
    return byte(x, y) > 127.0 ? byte(x, y) - 256.0 : byte(x, y);
}

typedef struct sample_file {
    const char    *name;
    int            width, height, channels;
    hc_sample_type type;
    int            bits;
    formula       *wanted;
} sample_file;

static const sample_file files[] = {
    { "grey16.png", 5, 3, 1, HC_U16, 16, wide },
    { "interlaced16.png", 5, 3, 1, HC_U16, 16, wide },
    { "grey1.png", 5, 3, 1, HC_U8, 1, one_bit },
    { "grey2.png", 5, 3, 1, HC_U8, 2, two_bits },
    { "grey4.png", 5, 3, 1, HC_U8, 4, four_bits },
    { "rgb8.png", 5, 3, 3, HC_U8, 8, byte_channels },
    { "palette.png", 5, 3, 3, HC_U8, 4, byte_channels },
    { "srgb.png", 5, 3, 1, HC_U8, 8, byte },
    { "icc_srgb.png", 5, 3, 1, HC_U8, 8, byte },
    { "tiles_u16.tif", 37, 21, 1, HC_U16, 16, wide },
    { "strips_lzw_u8.tif", 37, 21, 1, HC_U8, 8, byte },
    { "white_is_zero_u8.tif", 37, 21, 1, HC_U8, 8, white_is_zero },
    { "nodata_point_i16.tif", 37, 21, 1, HC_I16, 16, nodata },
    { "big_endian_u32.tif", 37, 21, 1, HC_U32, 32, large },
    { "bigtiff_i32.tif", 37, 21, 1, HC_I32, 32, negative },
    { "tiles_predictor3_f32.tif", 37, 21, 1, HC_F32, 32, eighths },
    { "strips_f64.tif", 37, 21, 1, HC_F64, 64, thirds },
    { "strips_i8.tif", 37, 21, 1, HC_I16, 8, signed_byte },
    { "planes_rgb_u16.tif", 37, 21, 3, HC_U16, 16, wide_channels },
    { "tiles_rgb_u16.tif", 37, 21, 3, HC_U16, 16, wide_channels },
    { "half.exr", 5, 3, 1, HC_F32, 16, halves },
    { "float_z_window.exr", 5, 3, 1, HC_F32, 32, small_floats },
    { "uint.exr", 5, 3, 1, HC_U32, 32, wide },
    { "mixed_bgr.exr", 5, 3, 3, HC_F32, 32, mixed_channels },
    { "tiles.exr", 37, 21, 1, HC_F32, 32, small_floats },
    { "tiles_rle.exr", 37, 21, 1, HC_F32, 32, small_floats },
    { "tiles_b44.exr", 37, 21, 1, HC_F32, 32, small_floats }, /* packs half floats only */
    { "tiles_mips.exr", 37, 21, 1, HC_F32, 32, small_floats },
    { "big_endian_f8.npy", 5, 3, 1, HC_F64, 64, thirds },
    { "fortran_u2.npy", 5, 3, 1, HC_U16, 16, wide },
    { "version2_i2.npy", 5, 3, 1, HC_I16, 16, shifted },
    { "rgb_u1.npy", 5, 3, 3, HC_U8, 8, byte_channels },
    { "plain.pgm", 5, 3, 1, HC_U16, 16, wide },
    { "plain.ppm", 5, 3, 3, HC_U8, 8, byte_channels },
    { "maxval_1000.pgm", 5, 3, 1, HC_U16, 16, tens },
};
enum { FILES = sizeof files / sizeof *files };

static const char *path_of(const char *name)
{
    static char path[PATH_MAX];
    (void)snprintf(path, sizeof path, "%s/%s", HC_FILES_DIR, name);
    return path;
}

static double value_at(const hc_image *image, size_t i)
{
    switch (image->type) {
    case HC_U8: return ((const uint8_t *)image->data)[i];
    case HC_U16: return ((const uint16_t *)image->data)[i];
    case HC_I16: return ((const int16_t *)image->data)[i];
    case HC_U32: return ((const uint32_t *)image->data)[i];
    case HC_I32: return ((const int32_t *)image->data)[i];
    case HC_F32: return (double)((const float *)image->data)[i];
    case HC_F64: return ((const double *)image->data)[i];
    }
    return NAN;
}

static void assert_samples(const hc_image *image, const sample_file *file)
{
    const int row = file->width * file->channels;
    for (int y = 0; y < file->height; y++) {
        for (int x = 0; x < row; x++) {
            const double got    = value_at(image, (size_t)y * (size_t)row + (size_t)x);
            const double wanted = file->wanted(x, y);
            if (!(got == wanted || (file->type == HC_F32 && got == (double)(float)wanted))) {
                fail_msg("%s: (%d, %d) is %.17g, not %.17g", file->name, x, y, got, wanted);
            }
        }
    }
}

static void test_samples(void **state)
{
    (void)state;
    for (int i = 0; i < FILES; i++) {
        hc_log    log = { .text = "" };
        hc_source source;
        hc_image  image;
        assert_ok(hc_source_open(&source, path_of(files[i].name), NULL, &log), &log);
        assert_ok(hc_read_image(&image, NULL, &source, false, &log), &log);
        if (image.width != files[i].width || image.height != files[i].height
            || image.channels != files[i].channels || image.type != files[i].type
            || image.bits != files[i].bits) {
            fail_msg("%s: %d x %d x %d of type %d, %d bits", files[i].name, image.width,
                     image.height, image.channels, (int)image.type, image.bits);
        }
        assert_samples(&image, &files[i]);
        hc_image_free(&image);
        hc_source_close(&source);

        hc_file_info info;
        assert_ok(hc_read_file_info(&info, path_of(files[i].name), NULL, &log), &log);
        assert_int_equal(info.width, files[i].width);
        assert_int_equal(info.height, files[i].height);
        assert_int_equal(info.channels, files[i].channels);
        assert_int_equal(info.type, files[i].type);
        assert_int_equal(info.bits, files[i].bits);
        assert_false(info.has_map);
    }
}

static void test_transparent_palette(void **state)
{
    (void)state;
    hc_log    log = { .text = "" };
    hc_source source;
    hc_image  image;
    assert_ok(hc_source_open(&source, path_of("palette_alpha.png"), NULL, &log), &log);
    assert_ok(hc_read_image(&image, NULL, &source, false, &log), &log);
    assert_int_equal(image.channels, 4);
    const uint8_t *texels = image.data;
    for (int i = 0; i < 15; i++) {
        assert_int_equal(texels[4 * i + 3], i == 1 ? 0 : 255);
        assert_true(texels[4 * i + 2] == byte(i % 5, i / 5) + 80.0);
    }
    hc_image_free(&image);
    hc_source_close(&source);
}

static void test_lossy_exr(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double      share; /* of the value that the packing may lose */
    } lossy[] = { { "tiles_pxr24.exr", 1.0 / 65536.0 }, { "tiles_dwaa.exr", 0.02 } };
    for (int i = 0; i < 2; i++) {
        hc_log    log = { .text = "" };
        hc_source source;
        hc_image  image;
        assert_ok(hc_source_open(&source, path_of(lossy[i].name), NULL, &log), &log);
        const hc_result result = hc_read_image(&image, NULL, &source, false, &log);
        if (i == 1 && result != HC_OK) { /* OpenEXRCore learnt DWA later */
            assert_refused(result, HC_ERROR_UNSUPPORTED, &log, path_of(lossy[i].name), "ZIP");
            hc_source_close(&source);
            continue;
        }
        assert_ok(result, &log);
        for (int k = 0; k < 37 * 21; k++) {
            const double wanted = small_floats(k % 37, k / 37);
            const double got    = value_at(&image, (size_t)k);
            assert_true(fabs(got - wanted) <= wanted * lossy[i].share);
        }
        hc_image_free(&image);
        hc_source_close(&source);
    }
}

static void test_pfm_is_bottom_up(void **state)
{
    (void)state;
    hc_log   log = { .text = "" };
    hc_field field;
    assert_ok(hc_load_field(&field, path_of("grey.pfm"), NULL, &log), &log);
    for (int i = 0; i < 15; i++) {
        const double wanted = (wide(i % 5, i / 5) - 1000.0) / (wide(4, 2) - 1000.0);
        assert_true(fabs((double)field.heights[i] - wanted) < 1e-4);
    }
    hc_free_field(&field);
}

static void test_places(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double      x, y;
    } places[] = {
        { "tiles_u16.tif", 505.0, 990.0 }, /* corners are placed: the sample is half a cell in */
        { "nodata_point_i16.tif", 505.0,
          990.0 }, /* GDAL moves its corner for points                 */
    };
    for (int i = 0; i < 2; i++) {
        hc_log       log = { .text = "" };
        hc_file_info info;
        assert_ok(hc_read_file_info(&info, path_of(places[i].name), NULL, &log), &log);
        assert_true(info.elevation.placed);
        assert_true(info.elevation.spacing_x == 10.0 && info.elevation.spacing_y == 20.0);
        assert_true(info.elevation.origin_x == places[i].x);
        assert_true(info.elevation.origin_y == places[i].y);
        assert_true(info.elevation.has_nodata == (i == 1));
    }
}

static void test_nodata(void **state)
{
    (void)state;
    hc_log          log  = { .text = "" };
    const char     *path = path_of("nodata_point_i16.tif");
    hc_field        field;
    hc_load_options options = { .wrap = HC_WRAP_NONE };
    assert_refused(hc_load_field(&field, path, &options, &log), HC_ERROR_FIELD, &log, path,
                   "[3, 1]");
    assert_null(field.heights);
    options.normalise.holes = HC_HOLES_LOWEST;
    assert_ok(hc_load_field(&field, path, &options, &log), &log);
    assert_true(field.heights[0] == 0.0F && field.heights[40] == 0.0F);
    assert_true(field.heights[37 * 21 - 1] == 1.0F);
    assert_true(field.elevation.low == -4000.0);
    assert_true(field.elevation.high == wide(36, 20) - 5000.0);
    assert_true(field.elevation.nodata == -9999.0);
    hc_free_field(&field);
}

static void test_maxval_and_channels(void **state)
{
    (void)state;
    hc_log          log = { .text = "" };
    hc_field        field;
    hc_load_options options = { .wrap = HC_WRAP_NONE };
    assert_ok(hc_load_field(&field, path_of("maxval_1000.pgm"), &options, &log), &log);
    for (int i = 0; i < 15; i++) {
        assert_true(field.heights[i] == (float)(tens(i % 5, i / 5) / 1000.0));
    }
    hc_free_field(&field);
    options.normalise.channel = HC_CHANNEL_B;
    assert_ok(hc_load_field(&field, path_of("rgb8.png"), &options, &log), &log);
    for (int i = 0; i < 15; i++) {
        assert_true(field.heights[i] == (float)((byte(i % 5, i / 5) + 80.0) / 255.0));
    }
    hc_free_field(&field);
    options.normalise.channel = HC_CHANNEL_A;
    const char *path          = path_of("rgb8.png");
    assert_refused(hc_load_field(&field, path, &options, &log), HC_ERROR_ARGUMENT, &log, path,
                   "channel");
}

static void test_warnings(void **state)
{
    (void)state;
    static const char *const tagged[] = { "srgb.png", "icc_srgb.png" };
    char                     warnings[WARNINGS_SIZE];
    hc_log                   log = { .warn = collect_warning, .user = warnings };
    hc_field                 field;
    hc_file_info             info;
    for (int i = 0; i < 2; i++) {
        const char *path = path_of(tagged[i]);
        warnings[0]      = '\0';
        assert_ok(hc_load_field(&field, path, NULL, &log), &log);
        assert_non_null(strstr(warnings, path));
        assert_non_null(strstr(warnings, "sRGB"));
        hc_free_field(&field);
        assert_ok(hc_read_file_info(&info, path, NULL, &log), &log);
        assert_true(info.srgb);
    }
    /* codes 1000 to 1970 of 65535: little of the range, and the warning says in which file */
    warnings[0] = '\0';
    assert_ok(hc_load_field(&field, path_of("grey16.png"), NULL, &log), &log);
    assert_non_null(strstr(warnings, path_of("grey16.png")));
    assert_null(strstr(warnings, "sRGB"));
    hc_free_field(&field);
}

static void test_unsupported(void **state)
{
    (void)state;
    static const struct {
        const char *name, *word;
    } refused[] = {
        { "complex.npy", "c8" },
        { "one_axis_f4.npy", "1 axes" },
        { "uint_and_half.exr", "mixed" },
        { "five_others.exr", "channels" },
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        hc_log      log  = { .text = "" };
        const char *path = path_of(refused[i].name);
        hc_field    field;
        assert_refused(hc_load_field(&field, path, NULL, &log), HC_ERROR_UNSUPPORTED, &log, path,
                       refused[i].word);
    }
}

static void test_gdal(void **state)
{
    (void)state;
    hc_log       log  = { .text = "" };
    const char  *path = path_of("grid.asc");
    hc_field     field;
    hc_file_info info;
    if (!hc_io_has_gdal()) {
        assert_refused(hc_load_field(&field, path, NULL, &log), HC_ERROR_FORMAT, &log, path,
                       "GDAL");
        return;
    }
    assert_ok(hc_read_file_info(&info, path, NULL, &log), &log);
    assert_string_equal(info.format, "GDAL: AAIGrid");
    assert_true(info.elevation.has_nodata && info.elevation.nodata == -1.0);
    assert_ok(hc_load_field(&field, path, NULL, &log), &log);
    assert_int_equal(field.width, 5);
    assert_int_equal(field.height, 3);
    assert_true(field.elevation.low == 125.0 && field.elevation.high == 246.25);
    assert_true(field.elevation.origin_x == 505.0 && field.elevation.origin_y == 995.0);
    assert_true(field.heights[6] == (float)((181.0 - 125.0) / (246.25 - 125.0)));
    hc_free_field(&field);

    /* neither a text nor the name of a file elsewhere is a raster */
    static const char text[] = "<VRTDataset rasterXSize=\"5\" rasterYSize=\"3\"></VRTDataset>";
    const char       *vrt    = in_folder("text.vrt");
    write_bytes(vrt, text, sizeof text - 1);
    assert_refused(hc_load_field(&field, vrt, NULL, &log), HC_ERROR_FORMAT, &log, vrt,
                   "no known format");
}

/* Standard input is a pipe here, so nothing can be read twice. */
static void test_standard_input(void **state)
{
    (void)state;
    static const char *const names[] = { "tiles_u16.tif", "grey16.png", "half.exr", "plain.pgm" };
    for (int i = 0; i < 4; i++) {
        int            ends[2];
        size_t         size;
        unsigned char *bytes = read_bytes(path_of(names[i]), &size);
        const int      kept  = dup(STDIN_FILENO);
        assert_int_equal(pipe(ends), 0);
        assert_true(write(ends[1], bytes, size) == (ssize_t)size);
        (void)close(ends[1]);
        assert_true(dup2(ends[0], STDIN_FILENO) == STDIN_FILENO);
        (void)close(ends[0]);
        hc_log          log = { .text = "" };
        hc_field        from_pipe;
        hc_field        from_file;
        hc_load_options options = { .normalise.range = HC_RANGE_DATA };
        const hc_result result  = hc_load_field(&from_pipe, "-", &options, &log);
        assert_true(dup2(kept, STDIN_FILENO) == STDIN_FILENO);
        (void)close(kept);
        free(bytes);
        assert_ok(result, &log);
        assert_ok(hc_load_field(&from_file, path_of(names[i]), &options, &log), &log);
        assert_memory_equal(from_pipe.heights, from_file.heights,
                            sizeof(float) * (size_t)(from_file.width * from_file.height));
        hc_free_field(&from_pipe);
        hc_free_field(&from_file);
    }
}

/* What a comma means in the user's country changes nothing in a file. */
static void test_locale(void **state)
{
    (void)state;
    static const char *const commas[] = { "de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "C.UTF-8" };
    int                      i        = 0;
    while (setlocale(LC_ALL, commas[i]) == NULL) {
        i++;
    }
    const float    heights[] = { 0.25F, 0.5F };
    const hc_field field     = { heights, 2, 1,
                                 .elevation = { .low = 0.5, .high = 1.5, .nodata = 0.1 } };
    hc_log         log       = { .text = "" };
    hc_field       read;
    assert_ok(hc_save_field(&field, in_folder("locale.pgm"), NULL, &log), &log);
    assert_ok(hc_load_field(&read, in_folder("locale.pgm"), NULL, &log), &log);
    assert_true(read.elevation.low == 0.5 && read.elevation.high == 1.5);
    hc_free_field(&read);
    size_t         size;
    unsigned char *bytes = read_bytes(in_folder("locale.pgm"), &size);
    assert_non_null(strstr((char *)bytes, "low=0.5 high=1.5 nodata=0.1\n"));
    free(bytes);
    (void)setlocale(LC_ALL, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_transparent_palette),
        cmocka_unit_test(test_lossy_exr),
        cmocka_unit_test(test_pfm_is_bottom_up),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_nodata),
        cmocka_unit_test(test_maxval_and_channels),
        cmocka_unit_test(test_warnings),
        cmocka_unit_test(test_unsupported),
        cmocka_unit_test(test_gdal),
        cmocka_unit_test(test_standard_input),
        cmocka_unit_test(test_locale),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
