/* Damaged, cut and lying files: an error that names the file, or the right samples; never more
 * memory than the limits allow. Run under the sanitizers these tests say that nothing undefined
 * happens either. */
#include "io_fixture.h"

#include "io/io_internal.h"

enum { WIDTH = 7, HEIGHT = 5, SAMPLES = WIDTH * HEIGHT };

static const char *const endings[] = { "png", "tif",  "exr", "pgm",       "pfm",
                                       "npy", "ktx2", "dds", "mips.ktx2", "mips.tif" };
enum { ENDINGS = sizeof endings / sizeof *endings };

/* No damaged file of this size may ask for more. */
static const hc_limits limits = { .max_samples = 1 << 20, .max_bytes = 1 << 20 };

static float heights[SAMPLES];

static bool ends(const char *name, const char *ending)
{
    const size_t length = strlen(name);
    const size_t wanted = strlen(ending);
    return length >= wanted && strcmp(name + length - wanted, ending) == 0;
}

static void save(const char *path, const char *ending)
{
    hc_log                log       = { .text = "" };
    const hc_save_options overwrite = { .overwrite = true };
    unsigned              seed      = 11;
    for (int i = 0; i < SAMPLES; i++) {
        heights[i] = (float)(next_number(&seed) % 256U) / 255.0F;
    }
    if (!ends(ending, "ktx2") && !ends(ending, "dds") && strchr(ending, '.') == NULL) {
        const hc_field field = { heights, WIDTH, HEIGHT, .elevation = { .high = 255.0 } };
        assert_ok(hc_save_field(&field, path, &overwrite, &log), &log);
        return;
    }
    const bool mips = strchr(ending, '.') != NULL;
    hc_map     map  = { .info = { .kind      = mips ? HC_MAP_PYRAMID : HC_MAP_CONE,
                                  .layout    = HC_LAYOUT_HEIGHT,
                                  .bits      = 32,
                                  .width     = WIDTH,
                                  .height    = HEIGHT,
                                  .channels  = 1,
                                  .levels    = mips ? hc_pyramid_levels(WIDTH, HEIGHT) : 1,
                                  .elevation = { .high = 255.0 } } };
    map.texels      = calloc(1, hc_map_bytes(&map.info));
    assert_non_null(map.texels);
    memcpy(map.texels, heights, sizeof heights);
    assert_ok(hc_save_map(&map, path, &overwrite, &log), &log);
    hc_free_map(&map);
}

static unsigned char *make_file(const char *ending, size_t *size)
{
    char name[32];
    (void)snprintf(name, sizeof name, "good.%s", ending);
    save(in_folder(name), ending);
    return read_bytes(in_folder(name), size);
}

/* Load bytes in every way there is; true if the result is the field that was saved. */
static bool load_all(const void *bytes, size_t size, hc_result *result, hc_log *log)
{
    const hc_source       source  = hc_source_memory(bytes, size, "the file", &limits);
    const hc_load_options lenient = { .normalise.holes = HC_HOLES_LOWEST };
    hc_field              field;
    hc_map                map;
    hc_file_info          info;
    *result   = hc_load_field_source(&field, &source, &lenient, log);
    bool same = *result == HC_OK && field.width == WIDTH && field.height == HEIGHT;
    for (int i = 0; same && i < SAMPLES; i++) {
        same = fabsf(field.heights[i] - heights[i]) < 1e-5F;
    }
    if (*result == HC_OK) {
        assert_int_equal(hc_field_check(&field, NULL), HC_OK);
    } else {
        assert_null(field.heights);
        assert_non_null(strstr(log->text, "the file"));
        assert_null(strchr(log->text, '\n'));
    }
    hc_free_field(&field);
    if (hc_load_map_source(&map, &source, NULL) == HC_OK) {
        hc_free_map(&map);
    } else {
        assert_null(map.texels);
    }
    (void)hc_read_source_info(&info, &source, NULL);
    return same;
}

/* Each container ends where its last needed byte is, give or take a trailer. */
static void test_cut_files(void **state)
{
    (void)state;
    for (int i = 0; i < ENDINGS; i++) {
        size_t         size;
        unsigned char *bytes = make_file(endings[i], &size);
        hc_log         log   = { .text = "" };
        hc_result      result;
        assert_true(load_all(bytes, size, &result, &log) || ends(endings[i], "pfm"));
        for (size_t cut = 0; cut < size; cut++) {
            unsigned char *part = malloc(cut + 1); /* so that reading beyond is seen */
            assert_non_null(part);
            memcpy(part, bytes, cut);
            const bool same = load_all(part, cut, &result, &log);
            if (result == HC_OK && !same) {
                fail_msg("%s cut to %zu of %zu bytes gives other heights", endings[i], cut, size);
            }
            if (cut * 2 < size && result != HC_ERROR_FORMAT) {
                fail_msg("%s cut to %zu of %zu bytes: %s", endings[i], cut, size,
                         hc_result_name(result));
            }
            free(part);
        }
        free(bytes);
    }
}

/* Every byte in turn takes values that mean something: 0, all ones, one more, the sign turned. */
static void test_changed_bytes(void **state)
{
    (void)state;
    for (int i = 0; i < ENDINGS; i++) {
        size_t         size;
        unsigned char *bytes = make_file(endings[i], &size);
        for (size_t at = 0; at < size; at++) {
            const unsigned char kept     = bytes[at];
            const unsigned char values[] = { 0, 0xFF, (unsigned char)(kept + 1), kept ^ 0x80 };
            for (int k = 0; k < 4; k++) {
                hc_log    log = { .text = "" };
                hc_result result;
                bytes[at] = values[k];
                (void)load_all(bytes, size, &result, &log);
            }
            bytes[at] = kept;
        }
        free(bytes);
    }
}

static void test_no_format(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x", "hello, world", "P", "P5", "P9\n", "\x89PNF\r\n\x1A\n"
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        hc_log    log = { .text = "" };
        hc_result result;
        assert_false(load_all(texts[i], strlen(texts[i]), &result, &log));
        assert_int_equal(result, HC_ERROR_FORMAT);
        const char *path = in_folder("no_format.png");
        hc_field    field;
        write_bytes(path, texts[i], strlen(texts[i]));
        assert_refused(hc_load_field(&field, path, NULL, &log), HC_ERROR_FORMAT, &log, path,
                       "no known format");
    }
    hc_log      log  = { .text = "" };
    const char *path = in_folder("empty.png");
    hc_field    field;
    write_bytes(path, "", 0);
    assert_refused(hc_load_field(&field, path, NULL, &log), HC_ERROR_FORMAT, &log, path, "empty");
}

/* Header fields as they stand in the files, to be replaced by absurd ones. */
typedef struct patch {
    const char *ending;
    const char *find; /* bytes to look for, with zeros written as '.' */
    int         skip; /* from there to the field */
    const char *put;
    int         length;
    hc_result   wanted;
} patch;

static const patch patches[] = {
    { "pgm", "7 5\n6", 0, "0 5\n6", 5, HC_ERROR_FORMAT },
    { "pgm", "7 5\n6", 0, "7 0\n6", 5, HC_ERROR_FORMAT },
    { "pgm", "65535", 0, "65536", 5, HC_ERROR_FORMAT },
    { "pgm", "65535", 0, "00000", 5, HC_ERROR_FORMAT },
    { "pgm", "7 5\n65535", 0, "9999 9999", 9, HC_ERROR_FORMAT },
    { "pfm", "7 5\n-1.0", 0, "0 5\n-1.0", 8, HC_ERROR_FORMAT },
    { "pfm", "7 5\n-1.0", 0, "7 5\n 0.0", 8, HC_ERROR_FORMAT },
    { "pfm", "7 5\n-1.0", 0, "7 5\n-inf", 8, HC_ERROR_FORMAT },
    { "pfm", "7 5\n-1.0", 0, "9e9 9 -1", 8, HC_ERROR_FORMAT },
    { "pfm", "7 5\n-1.0", 0, "2.5 5 -1", 8, HC_ERROR_FORMAT },
    { "npy", "(5, 7)", 0, "(0, 7)", 6, HC_ERROR_FORMAT },
    { "npy", "(5, 7)", 0, "(9,99)", 6, HC_ERROR_FORMAT },
    { "npy", "(5, 7)", 0, "(5,  )", 6, HC_ERROR_UNSUPPORTED },
    { "npy", "(5, 7)", 0, "(5  7)", 6, HC_ERROR_FORMAT },
    { "npy", "(5, 7)", 0, "(-5,7)", 6, HC_ERROR_FORMAT },
    { "npy", "<f4", 0, "<f9", 3, HC_ERROR_UNSUPPORTED },
    { "npy", "<f4", 0, "?f4", 3, HC_ERROR_FORMAT },
    { "npy", "False", 0, "Fulse", 5, HC_ERROR_FORMAT },
    { "npy", "'shape'", 0, "'shapf'", 7, HC_ERROR_FORMAT },
    { "npy", "NUMPY", 5, "\x09", 1, HC_ERROR_UNSUPPORTED },
    { "exr", "dataWindow.box2i.", 21, "\xFF\xFF\xFF\x7F", 4, HC_ERROR_FORMAT },
    { "exr", "dataWindow.box2i.", 29, "\xFF\xFF\xFF\x7F", 4, HC_ERROR_FORMAT },
    { "exr", "dataWindow.box2i.", 33, "\xFF\xFF\x0F", 4, HC_ERROR_FORMAT },
    { "ktx2", "KTX 20", 11 + 8, "\0\0\0\0", 4, HC_ERROR_FORMAT },
    { "ktx2", "KTX 20", 11 + 8, "\xFF\xFF\xFF\x7F", 4, HC_ERROR_FORMAT },
    { "ktx2", "KTX 20", 11, "\x63\0\0\0", 4, HC_ERROR_UNSUPPORTED },
    { "ktx2", "KTX 20", 11 + 16, "\1", 1, HC_ERROR_UNSUPPORTED },
    { "ktx2", "KTX 20", 11 + 28, "\x7F", 1, HC_ERROR_FORMAT },
    { "ktx2", "KTX 20", 11 + 32, "\2", 1, HC_ERROR_UNSUPPORTED },
    { "ktx2", "KTX 20", 11 + 68 + 8, "\1", 1, HC_ERROR_FORMAT },
    { "dds", "DDS ", 12, "\0\0\0\0", 4, HC_ERROR_FORMAT },
    { "dds", "DDS ", 12, "\xFF\xFF\x0F", 4, HC_ERROR_FORMAT },
    { "dds", "DDS ", 28, "\x30", 1, HC_ERROR_FORMAT },
    { "dds", "DDS ", 84, "DXT1", 4, HC_ERROR_UNSUPPORTED },
    { "dds", "DDS ", 80, "\x40", 1, HC_ERROR_UNSUPPORTED },
    { "dds", "DDS ", 128, "\x63", 1, HC_ERROR_UNSUPPORTED },
    { "dds", "DDS ", 132, "\4", 1, HC_ERROR_UNSUPPORTED },
    { "dds", "DDS ", 140, "\6", 1, HC_ERROR_UNSUPPORTED },
};

static unsigned char *find_bytes(unsigned char *bytes, size_t size, const char *wanted)
{
    const size_t length = strlen(wanted);
    for (size_t at = 0; at + length <= size; at++) {
        size_t same = 0;
        while (same < length
               && (bytes[at + same] == (unsigned char)wanted[same]
                   || (wanted[same] == '.' && bytes[at + same] == 0))) {
            same++;
        }
        if (same == length) {
            return bytes + at;
        }
    }
    return NULL;
}

static void test_absurd_headers(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof patches / sizeof *patches; i++) {
        size_t         size;
        unsigned char *bytes = make_file(patches[i].ending, &size);
        unsigned char *found = find_bytes(bytes, size, patches[i].find);
        hc_log         log   = { .text = "" };
        hc_result      result;
        assert_non_null(found);
        memcpy(found + patches[i].skip, patches[i].put, (size_t)patches[i].length);
        (void)load_all(bytes, size, &result, &log);
        if (result != patches[i].wanted) {
            fail_msg("patch %zu of %s: wanted %s, got %s: %s", i, patches[i].ending,
                     hc_result_name(patches[i].wanted), hc_result_name(result), log.text);
        }
        free(bytes);
    }
}

static uint32_t crc_of(const unsigned char *bytes, size_t size)
{
    uint32_t crc = 0xFFFFFFFFU;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++) {
            crc = (crc >> 1) ^ (0xEDB88320U & (0U - (crc & 1U)));
        }
    }
    return ~crc;
}

/* PNG headers are protected by a checksum, so they are patched with a new one. */
static void test_absurd_png(void **state)
{
    (void)state;
    static const struct {
        unsigned char size[8];
        hc_result     wanted;
    } sides[] = {
        { { 0, 0, 0, 0, 0, 0, 0, 5 }, HC_ERROR_FORMAT },
        { { 0, 0, 0, 7, 0x7F, 0xFF, 0xFF, 0xFF }, HC_ERROR_FORMAT },
        { { 0x7F, 0xFF, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF }, HC_ERROR_FORMAT },
        { { 0, 0, 0x30, 0, 0, 0, 0x30, 0 }, HC_ERROR_FORMAT },
        { { 0, 0, 0, 7, 0, 0, 0, 6 }, HC_ERROR_FORMAT },
    };
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        size_t         size;
        unsigned char *bytes = make_file("png", &size);
        hc_log         log   = { .text = "" };
        hc_result      result;
        memcpy(bytes + 16, sides[i].size, 8);
        const uint32_t crc = crc_of(bytes + 12, 17);
        for (int k = 0; k < 4; k++) {
            bytes[29 + k] = (unsigned char)(crc >> (24 - 8 * k));
        }
        (void)load_all(bytes, size, &result, &log);
        assert_int_equal(result, sides[i].wanted);
        free(bytes);
    }
}

static void test_nan_samples(void **state)
{
    (void)state;
    static const char *const floats[] = { "tif", "exr", "pfm", "npy", "raw" };
    const float              broken[] = { 0.5F, NAN, 1.0F, INFINITY };
    for (int i = 0; i < 5; i++) {
        /* such heights are never saved, so the file is made through the format itself */
        char name[32];
        (void)snprintf(name, sizeof name, "nan.%s", floats[i]);
        const char     *path = in_folder(name);
        hc_log          log  = { .text = "" };
        hc_output       output;
        hc_field        field;
        hc_load_options options = { .raw_type = HC_F32 };
        const hc_image  image   = { .data     = (void *)(uintptr_t)broken,
                                    .type     = HC_F32,
                                    .width    = 2,
                                    .height   = 2,
                                    .channels = 1,
                                    .levels   = 1,
                                    .bits     = 32 };
        assert_ok(hc_output_open(&output, path, false, &log), &log);
        assert_ok(
            hc_output_close(&output, hc_format_by_ending(path)->write(&output, &image, &log), &log),
            &log);
        options.raw_width  = strcmp(floats[i], "raw") == 0 ? 2 : 0;
        options.raw_height = options.raw_width;
        assert_refused(hc_load_field(&field, path, &options, &log), HC_ERROR_FIELD, &log, path,
                       "[1, 0]");
        options.normalise.holes = HC_HOLES_LOWEST;
        assert_ok(hc_load_field(&field, path, &options, &log), &log);
        assert_true(field.heights[1] == 0.0F && field.heights[2] == 1.0F);
        hc_free_field(&field);
    }
}

static void test_limits(void **state)
{
    (void)state;
    const hc_limits few_samples = { .max_samples = SAMPLES - 1 };
    const hc_limits few_bytes   = { .max_bytes = 20 };
    const hc_limits enough      = { .max_samples = SAMPLES, .max_bytes = 1 << 16 };
    for (int i = 0; i < ENDINGS; i++) {
        char name[32];
        (void)snprintf(name, sizeof name, "limit.%s", endings[i]);
        const char  *path = in_folder(name);
        hc_log       log  = { .text = "" };
        hc_file_info info;
        hc_field     field;
        save(path, endings[i]);
        assert_refused(hc_read_file_info(&info, path, &few_samples, &log), HC_ERROR_LIMIT, &log,
                       path, "max_samples");
        assert_refused(
            hc_load_field(&field, path, &(hc_load_options){ .limits = few_samples }, &log),
            HC_ERROR_LIMIT, &log, path, "max_samples");
        assert_refused(hc_load_field(&field, path, &(hc_load_options){ .limits = few_bytes }, &log),
                       HC_ERROR_LIMIT, &log, path, "max_bytes");
        if (strchr(endings[i], '.') == NULL) {
            assert_ok(hc_read_file_info(&info, path, &enough, &log), &log);
        }
    }
}

static void test_raw(void **state)
{
    (void)state;
    const char     *path = in_folder("plain.bin");
    hc_log          log  = { .text = "" };
    hc_field        field;
    hc_load_options options = { .raw_width = 2, .raw_height = 3, .raw_type = HC_U16 };
    write_bytes(path, "\0\0\0\1\1\0\x80\0\xFF\xFF\0\x80", 12);
    options.raw_big_endian = true;
    assert_ok(hc_load_field(&field, path, &options, &log), &log);
    assert_true(field.heights[1] == (float)(1.0 / 65535.0) && field.heights[4] == 1.0F);
    hc_free_field(&field);
    options.raw_big_endian = false;
    assert_ok(hc_load_field(&field, path, &options, &log), &log);
    assert_true(field.heights[1] == (float)(256.0 / 65535.0));
    hc_free_field(&field);
    options.raw_height = 4;
    assert_refused(hc_load_field(&field, path, &options, &log), HC_ERROR_FORMAT, &log, path, "12");
    options.raw_height = 0;
    assert_refused(hc_load_field(&field, path, &options, &log), HC_ERROR_ARGUMENT, &log, path,
                   "2 x 0");
    options.raw_height = 1 << 30;
    options.raw_width  = 1 << 30;
    assert_refused(hc_load_field(&field, path, &options, &log), HC_ERROR_FORMAT, &log, path, "12");
}

/* Neither a file's name nor its bytes get control characters into a message. */
static void test_one_line(void **state)
{
    (void)state;
    hc_log      log  = { .text = "" };
    const char *path = in_folder("two\nlines\x1B[2J.npy");
    hc_field    field;
    write_bytes(path, "\x93NUMPY\1\0\x10\0{'a\nb\x1B[2J': True}", 26);
    assert_int_equal(hc_load_field(&field, path, NULL, &log), HC_ERROR_FORMAT);
    assert_non_null(strstr(log.text, "two?lines?[2J.npy"));
    assert_non_null(strstr(log.text, "a?b?[2J"));
}

static void test_missing(void **state)
{
    (void)state;
    hc_log       log  = { .text = "" };
    const char  *path = in_folder("not_there.png");
    hc_field     field;
    hc_map       map;
    hc_file_info info;
    assert_refused(hc_load_field(&field, path, NULL, &log), HC_ERROR_IO, &log, path,
                   "No such file");
    assert_refused(hc_load_map(&map, path, NULL, &log), HC_ERROR_IO, &log, path, "No such file");
    assert_refused(hc_read_file_info(&info, path, NULL, &log), HC_ERROR_IO, &log, path,
                   "No such file");
    assert_refused(hc_load_field(&field, fixture_folder, NULL, &log), HC_ERROR_IO, &log,
                   fixture_folder, "directory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cut_files),  cmocka_unit_test(test_changed_bytes),
        cmocka_unit_test(test_no_format),  cmocka_unit_test(test_absurd_headers),
        cmocka_unit_test(test_absurd_png), cmocka_unit_test(test_nan_samples),
        cmocka_unit_test(test_limits),     cmocka_unit_test(test_raw),
        cmocka_unit_test(test_one_line),   cmocka_unit_test(test_missing),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
