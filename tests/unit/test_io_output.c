/* Outputs are complete or not there: names that are taken, folders that refuse, disks that are
 * full. */
#include "io_fixture.h"

#include "io/io_internal.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

static const float    heights[] = { 0.0F, 0.25F, 0.5F, 0.75F, 1.0F, 0.125F };
static const hc_field field     = { heights, 3, 2, .wrap = HC_WRAP_NONE };
static const uint8_t  pixels[]  = { 255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30 };

static const char *const endings[] = { "png", "tif", "exr", "pgm", "pfm", "npy", "raw" };
enum { ENDINGS = sizeof endings / sizeof *endings };

static void assert_content(const char *path, const char *wanted)
{
    size_t         size;
    unsigned char *bytes = read_bytes(path, &size);
    assert_string_equal((char *)bytes, wanted);
    free(bytes);
}

static void test_existing(void **state)
{
    (void)state;
    empty_folder();
    for (int i = 0; i < ENDINGS; i++) {
        char name[32];
        (void)snprintf(name, sizeof name, "taken.%s", endings[i]);
        const char *path = in_folder(name);
        hc_log      log  = { .text = "" };
        write_bytes(path, "precious", 8);
        assert_refused(hc_save_field(&field, path, NULL, &log), HC_ERROR_EXISTS, &log, path,
                       "overwrite");
        assert_content(path, "precious");
        assert_ok(hc_save_field(&field, path, &(hc_save_options){ .overwrite = true }, &log), &log);
        struct stat status;
        assert_int_equal(stat(path, &status), 0);
        assert_true(status.st_size > 8);
    }
    assert_int_equal(count_files(), ENDINGS);
}

static void test_map_and_picture_rules(void **state)
{
    (void)state;
    empty_folder();
    hc_log      log = { .text = "" };
    uint8_t     codes[6];
    const char *path = in_folder("taken.png");
    hc_map      map  = { .info   = { .layout    = HC_LAYOUT_HEIGHT,
                                     .bits      = 8,
                                     .width     = 3,
                                     .height    = 2,
                                     .channels  = 1,
                                     .levels    = 1,
                                     .max_ratio = 1.0F },
                         .texels = codes };
    memset(codes, 7, sizeof codes);
    write_bytes(path, "precious", 8);
    assert_refused(hc_save_map(&map, path, NULL, &log), HC_ERROR_EXISTS, &log, path, "overwrite");
    assert_refused(hc_save_picture(pixels, 2, 2, path, NULL, &log), HC_ERROR_EXISTS, &log, path,
                   "overwrite");
    assert_content(path, "precious");
    const hc_save_options overwrite = { .overwrite = true };
    assert_ok(hc_save_map(&map, path, &overwrite, &log), &log);
    assert_ok(hc_save_picture(pixels, 2, 2, path, &overwrite, &log), &log);
    assert_int_equal(count_files(), 1);
}

static void test_picture(void **state)
{
    (void)state;
    empty_folder();
    hc_log      log  = { .text = "" };
    const char *path = in_folder("picture.png");
    const char *tif  = in_folder("picture.tif");
    hc_source   source;
    hc_image    image;
    assert_ok(hc_save_picture(pixels, 2, 2, path, NULL, &log), &log);
    assert_ok(hc_source_open(&source, path, NULL, &log), &log);
    assert_ok(hc_read_image(&image, NULL, &source, false, &log), &log);
    assert_int_equal(image.channels, 3);
    assert_int_equal(image.type, HC_U8);
    assert_memory_equal(image.data, pixels, sizeof pixels);
    assert_string_equal(image.text, "");
    hc_image_free(&image);
    hc_source_close(&source);
    assert_refused(hc_save_picture(pixels, 2, 2, tif, NULL, &log), HC_ERROR_UNSUPPORTED, &log, tif,
                   ".png");
    assert_refused(hc_save_picture(pixels, 0, 2, path, NULL, &log), HC_ERROR_ARGUMENT, &log, path,
                   "0 x 2");
    assert_refused(hc_save_picture(NULL, 2, 2, path, NULL, &log), HC_ERROR_ARGUMENT, &log, path,
                   "NULL");
}

/* Floats come back bit for bit, infinities too. */
static void test_floats(void **state)
{
    (void)state;
    empty_folder();
    static const float values[6] = { -1.5F, INFINITY, 0.0F, 1e-30F, 3.0F, 7.25F };
    const char *const  names[]   = { "one.exr", "one.pfm", "one.npy", "three.exr" };
    hc_log             log       = { .text = "" };
    for (int i = 0; i < 4; i++) {
        const int   channels = i == 3 ? 3 : 1;
        const char *path     = in_folder(names[i]);
        hc_source   source;
        hc_image    image;
        assert_ok(hc_save_floats(values, 6 / channels / 2, 2, channels, path, NULL, &log), &log);
        assert_ok(hc_source_open(&source, path, NULL, &log), &log);
        assert_ok(hc_read_image(&image, NULL, &source, false, &log), &log);
        assert_int_equal(image.channels, channels);
        assert_memory_equal(image.data, values, sizeof values);
        hc_image_free(&image);
        hc_source_close(&source);
    }
    const char *pfm = in_folder("three.pfm");
    assert_refused(hc_save_floats(values, 1, 2, 3, pfm, NULL, &log), HC_ERROR_UNSUPPORTED, &log,
                   pfm, ".exr");
    assert_refused(hc_save_floats(values, 1, 3, 2, pfm, NULL, &log), HC_ERROR_ARGUMENT, &log, pfm,
                   "2 channels");
    assert_refused(hc_save_floats(NULL, 1, 3, 1, pfm, NULL, &log), HC_ERROR_ARGUMENT, &log, pfm,
                   "NULL");
}

static void test_bad_places(void **state)
{
    (void)state;
    empty_folder();
    const hc_save_options overwrite = { .overwrite = true };
    hc_log                log       = { .text = "" };
    const char           *missing   = in_folder("no/such/folder.png");
    const char           *folder    = in_folder("folder.png");
    const char           *pipe_path = in_folder("pipe.png");
    assert_refused(hc_save_field(&field, missing, NULL, &log), HC_ERROR_IO, &log, missing,
                   "folder");
    assert_int_equal(mkdir(folder, 0777), 0);
    assert_refused(hc_save_field(&field, folder, &overwrite, &log), HC_ERROR_IO, &log, folder,
                   "regular");
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(mkfifo(pipe_path, 0666), 0);
    assert_refused(hc_save_field(&field, pipe_path, &overwrite, &log), HC_ERROR_IO, &log, pipe_path,
                   "regular");
    assert_int_equal(count_files(), 1);
    assert_int_equal(unlink(pipe_path), 0);

    hc_output output;
    assert_refused(hc_output_open(&output, "-", true, &log), HC_ERROR_ARGUMENT, &log, "-", "name");
    assert_refused(hc_output_open(&output, "/dev/full", true, &log), HC_ERROR_IO, &log, "/dev/full",
                   "regular");
}

/* As somebody who may not write there; the superuser may everywhere. */
static void test_read_only_folder(void **state)
{
    (void)state;
    empty_folder();
    assert_int_equal(chmod(fixture_folder, 0555), 0);
    const pid_t child = fork();
    if (child == 0) {
        hc_log          log    = { .text = "" };
        const bool      safe   = geteuid() != 0 || setuid(65534) == 0;
        const hc_result result = hc_save_field(&field, in_folder("f.png"), NULL, &log);
        _exit(!safe || (result == HC_ERROR_IO && strstr(log.text, "f.png: cannot create") != NULL)
                  ? 0
                  : 1);
    }
    int status = -1;
    assert_true(waitpid(child, &status, 0) == child);
    assert_int_equal(status, 0);
    assert_int_equal(chmod(fixture_folder, 0777), 0);
    assert_int_equal(count_files(), 0);
}

static void limit_file_size(rlim_t size)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = size;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

/* A limit on the size of files stands for a full disk: the write fails after some bytes. Whatever
 * the length at which it happens, nothing is left behind and the old file stays. */
static void test_full_disk(void **state)
{
    (void)state;
    empty_folder();
    static float noise[60 * 60];
    unsigned     seed = 3;
    for (int i = 0; i < 60 * 60; i++) {
        noise[i] = (float)(next_number(&seed) & 0xFFFFU) / 65535.0F;
    }
    const hc_field large    = { noise, 60, 60, .wrap = HC_WRAP_NONE };
    void (*const kept)(int) = signal(SIGXFSZ, SIG_IGN);
    for (int i = 0; i < ENDINGS; i++) {
        for (rlim_t size = 1; size < 5000; size += 997) {
            char name[32];
            (void)snprintf(name, sizeof name, "full.%s", endings[i]);
            const char           *path    = in_folder(name);
            hc_log                log     = { .text = "" };
            const hc_save_options options = { .overwrite = true };
            limit_file_size(RLIM_INFINITY);
            write_bytes(path, "precious", 8);
            limit_file_size(size);
            const hc_result result = hc_save_field(&large, path, &options, &log);
            limit_file_size(RLIM_INFINITY);
            assert_refused(result, HC_ERROR_IO, &log, path, "File too large");
            assert_content(path, "precious");
            assert_int_equal(count_files(), 1);
            assert_int_equal(unlink(path), 0);
        }
    }
    (void)signal(SIGXFSZ, kept);
}

/* The name may be taken while the file is being written. */
static void test_race(void **state)
{
    (void)state;
    empty_folder();
    hc_log      log  = { .text = "" };
    const char *path = in_folder("race.raw");
    hc_output   output;
    assert_ok(hc_output_open(&output, path, false, &log), &log);
    assert_true(hc_output_append(&output, "late", 4));
    write_bytes(path, "first", 5);
    assert_refused(hc_output_close(&output, HC_OK, &log), HC_ERROR_EXISTS, &log, path, "overwrite");
    assert_content(path, "first");
    assert_int_equal(count_files(), 1);
}

/* An encoder that gives up leaves nothing, and its own message. */
static void test_given_up(void **state)
{
    (void)state;
    empty_folder();
    hc_log    log = { .text = "its own message" };
    hc_output output;
    assert_ok(hc_output_open(&output, in_folder("gone.raw"), false, &log), &log);
    assert_true(hc_output_append(&output, "half", 4));
    assert_int_equal(count_files(), 1);
    assert_int_equal(hc_output_close(&output, HC_ERROR_MEMORY, &log), HC_ERROR_MEMORY);
    assert_string_equal(log.text, "its own message");
    assert_int_equal(count_files(), 0);
}

/* Names as long as a folder can hold; and without a folder. */
static void test_long_and_bare_names(void **state)
{
    (void)state;
    empty_folder();
    char   name[256];
    char   kept[PATH_MAX];
    hc_log log = { .text = "" };
    memset(name, 'n', sizeof name);
    (void)snprintf(name + 251, 5, ".raw");
    assert_ok(hc_save_field(&field, in_folder(name), NULL, &log), &log);
    assert_non_null(getcwd(kept, sizeof kept));
    assert_int_equal(chdir(fixture_folder), 0);
    const hc_result result = hc_save_field(&field, "bare.raw", NULL, &log);
    assert_int_equal(chdir(kept), 0);
    assert_ok(result, &log);
    assert_int_equal(access(in_folder("bare.raw"), F_OK), 0);
    assert_int_equal(count_files(), 2);
}

static void test_log_is_optional(void **state)
{
    (void)state;
    empty_folder();
    hc_field read;
    assert_int_equal(hc_save_field(&field, in_folder("quiet.png"), NULL, NULL), HC_OK);
    assert_int_equal(hc_save_field(&field, in_folder("quiet.png"), NULL, NULL), HC_ERROR_EXISTS);
    assert_int_equal(hc_load_field(&read, in_folder("none.png"), NULL, NULL), HC_ERROR_IO);
    assert_int_equal(hc_load_field(&read, in_folder("quiet.png"), NULL, NULL), HC_OK);
    hc_free_field(&read);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_existing),        cmocka_unit_test(test_map_and_picture_rules),
        cmocka_unit_test(test_picture),         cmocka_unit_test(test_floats),
        cmocka_unit_test(test_bad_places),      cmocka_unit_test(test_read_only_folder),
        cmocka_unit_test(test_full_disk),       cmocka_unit_test(test_race),
        cmocka_unit_test(test_given_up),        cmocka_unit_test(test_long_and_bare_names),
        cmocka_unit_test(test_log_is_optional),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
