/* Ray and hit files: what goes out comes back, through files and streams; damage gives an error
 * that names the file, and leaves nothing behind. */
#include "io_fixture.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

enum { RAYS = 5, COLUMNS = 8 };

static hc_ray rays[RAYS];

static void fill_rays(void)
{
    unsigned seed = 3;
    for (int i = 0; i < RAYS * COLUMNS; i++) {
        ((float *)rays)[i] = (float)next_number(&seed) / 4096.0F;
    }
    rays[1].tmax = INFINITY;
}

static void save_rays(const char *path, size_t count)
{
    hc_log       log  = { .text = "" };
    hc_row_file *file = NULL;
    fill_rays();
    assert_ok(hc_row_file_create(&file, path, HC_ROWS_RAYS, count,
                                 &(hc_save_options){ .overwrite = true }, &log),
              &log);
    assert_ok(hc_row_file_append(file, rays, count, &log), &log);
    assert_ok(hc_row_file_close(file, HC_OK, &log), &log);
}

/* An NPY file by hand, version 1. */
static void write_npy(const char *path, const char *dictionary, const void *values, size_t size)
{
    unsigned char bytes[4096] = { 0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0 };
    const size_t  length      = strlen(dictionary);
    bytes[8]                  = (unsigned char)(length % 256);
    bytes[9]                  = (unsigned char)(length / 256);
    memcpy(bytes + 10, dictionary, length);
    memcpy(bytes + 10 + length, values, size);
    write_bytes(path, bytes, 10 + length + size);
}

/* All rays of the file, read `room` at a time, must be the first `count` of `rays`. */
static void assert_rays(const char *path, size_t count, size_t room)
{
    hc_log       log  = { .text = "" };
    hc_ray_file *file = NULL;
    hc_ray       read[RAYS];
    size_t       got  = 0;
    size_t       done = 0;
    assert_ok(hc_ray_file_open(&file, path, NULL, &log), &log);
    assert_int_equal(hc_ray_file_count(file), count);
    do {
        assert_true(done + room <= RAYS || done <= count);
        assert_ok(hc_ray_file_read(file, read, room, &got, &log), &log);
        assert_memory_equal(read, rays + done, got * sizeof *read);
        done += got;
    } while (got > 0);
    assert_int_equal(done, count);
    hc_ray_file_close(file);
}

static void test_round_trip(void **state)
{
    (void)state;
    const char *path = in_folder("rays.npy");
    for (size_t count = 0; count <= RAYS; count++) {
        save_rays(path, count);
        assert_rays(path, count, RAYS);
        assert_rays(path, count, 2);
    }
}

static void test_types_and_orders(void **state)
{
    (void)state;
    const char   *path = in_folder("typed.npy");
    double        wide[2 * COLUMNS];
    unsigned char turned[sizeof(double) * 2 * COLUMNS];
    fill_rays();
    for (int i = 0; i < 2 * COLUMNS; i++) {
        wide[i] = (double)((const float *)rays)[i];
    }
    write_npy(path, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 8)}", wide, sizeof wide);
    assert_rays(path, 2, 1);
    for (size_t i = 0; i < sizeof wide; i++) {
        turned[i] = ((unsigned char *)wide)[i / 8 * 8 + 7 - i % 8];
    }
    write_npy(path, "{'descr': '>f8', 'fortran_order': False, 'shape': (2, 8)}", turned,
              sizeof turned);
    assert_rays(path, 2, 2);
    for (size_t i = 0; i < 2 * sizeof *rays; i++) {
        turned[i] = ((unsigned char *)rays)[i / 4 * 4 + 3 - i % 4];
    }
    write_npy(path, "{'descr': '>f4', 'fortran_order': False, 'shape': (2, 8), }", turned,
              2 * sizeof *rays);
    assert_rays(path, 2, 2);
}

/* Halfway between two floats, and beyond the largest one. */
static void test_wide_is_rounded(void **state)
{
    (void)state;
    const char  *path            = in_folder("wide.npy");
    const double wide[COLUMNS]   = { 1.0 + 0x1p-24, 1.0 + 0x3p-24, 0.1, 0, 1, 2, 3, 1e300 };
    const float  wanted[COLUMNS] = { 1.0F, 1.0F + 0x1p-22F, 0.1F, 0, 1, 2, 3, INFINITY };
    hc_log       log             = { .text = "" };
    hc_ray_file *file            = NULL;
    hc_ray       ray;
    size_t       got;
    write_npy(path, "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 8)}", wide, sizeof wide);
    assert_ok(hc_ray_file_open(&file, path, NULL, &log), &log);
    assert_ok(hc_ray_file_read(file, &ray, 1, &got, &log), &log);
    assert_int_equal(got, 1);
    assert_memory_equal(&ray, wanted, sizeof wanted);
    hc_ray_file_close(file);
}

static void assert_not_opened(const char *path, const hc_limits *limits, hc_result wanted,
                              const char *word)
{
    hc_log          log    = { .text = "" };
    hc_ray_file    *file   = (hc_ray_file *)&log;
    const hc_result result = hc_ray_file_open(&file, path, limits, &log);
    assert_null(file);
    assert_refused(result, wanted, &log, path, word);
}

static void test_wrong_files(void **state)
{
    (void)state;
    static const struct {
        const char *dictionary;
        hc_result   result;
        const char *word;
    } wrong[] = {
        { "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 7)}", HC_ERROR_FORMAT, "(n, 8)" },
        { "{'descr': '<f4', 'fortran_order': False, 'shape': (16,)}", HC_ERROR_FORMAT, "(n, 8)" },
        { "{'descr': '<f4', 'fortran_order': False, 'shape': ()}", HC_ERROR_FORMAT, "(n, 8)" },
        { "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 8)}", HC_ERROR_FORMAT,
          "(n, 8)" },
        { "{'descr': '<f4', 'fortran_order': True, 'shape': (2, 8)}", HC_ERROR_UNSUPPORTED,
          "ascontiguousarray" },
        { "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 8)}", HC_ERROR_UNSUPPORTED,
          "\"i4\"" },
        { "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 8)}", HC_ERROR_FORMAT, "cut off" },
        { "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 8)}", HC_ERROR_FORMAT,
          "128 are needed" },
        { "{'descr': '<f4', 'fortran_order': False, 'shape': (1152921504606846977, 8)}",
          HC_ERROR_LIMIT, "the limit is 1099511627776" },
        { "{'descr': '<f4', 'fortran_order': False}", HC_ERROR_FORMAT, "makes no sense" },
        { "rays", HC_ERROR_FORMAT, "makes no sense" },
    };
    const char *path = in_folder("wrong.npy");
    fill_rays();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        write_npy(path, wrong[i].dictionary, rays, 2 * sizeof *rays);
        assert_not_opened(path, NULL, wrong[i].result, wrong[i].word);
    }
    write_bytes(path, "P5 1 1 255 x", 12);
    assert_not_opened(path, NULL, HC_ERROR_FORMAT, "not an NPY file");
    write_bytes(path, "", 0);
    assert_not_opened(path, NULL, HC_ERROR_FORMAT, "header");
    assert_not_opened(in_folder("missing.npy"), NULL, HC_ERROR_IO, "No such file");
    assert_not_opened(fixture_folder, NULL, HC_ERROR_IO, "directory");
}

static void test_limit(void **state)
{
    (void)state;
    const char *path = in_folder("five.npy");
    save_rays(path, RAYS);
    assert_not_opened(path, &(hc_limits){ .max_samples = RAYS * COLUMNS - 1 }, HC_ERROR_LIMIT,
                      "max_samples");
    hc_log       log  = { .text = "" };
    hc_ray_file *file = NULL;
    assert_ok(hc_ray_file_open(&file, path, &(hc_limits){ .max_samples = RAYS * COLUMNS }, &log),
              &log);
    hc_ray_file_close(file);
}

/* Cut anywhere: refused at once. */
static void test_every_cut(void **state)
{
    (void)state;
    size_t      size;
    const char *good = in_folder("good.npy");
    const char *path = in_folder("cut.npy");
    save_rays(good, RAYS);
    unsigned char *bytes = read_bytes(good, &size);
    for (size_t kept = 0; kept < size; kept++) {
        write_bytes(path, bytes, kept);
        hc_log       log  = { .text = "" };
        hc_ray_file *file = NULL;
        assert_int_equal(hc_ray_file_open(&file, path, NULL, &log), HC_ERROR_FORMAT);
        assert_non_null(strstr(log.text, path));
    }
    free(bytes);
}

/* Any byte of the header changed: refused, or rays that can be read to the end. */
static void test_every_header_byte(void **state)
{
    (void)state;
    size_t      size;
    hc_ray      read[RAYS];
    size_t      got  = 0;
    const char *good = in_folder("good.npy");
    const char *path = in_folder("changed.npy");
    save_rays(good, RAYS);
    unsigned char *bytes = read_bytes(good, &size);
    for (size_t i = 0; i < size - sizeof rays; i++) {
        const unsigned char kept = bytes[i];
        for (unsigned change = 1; change < 256; change = change * 2 + 1) {
            bytes[i] = (unsigned char)(kept ^ change);
            write_bytes(path, bytes, size);
            hc_log          log    = { .text = "" };
            hc_ray_file    *file   = NULL;
            const hc_result result = hc_ray_file_open(&file, path, NULL, &log);
            assert_true((result == HC_OK) == (file != NULL));
            assert_true(result == HC_OK || strstr(log.text, path) != NULL);
            for (got = 1; file != NULL && got > 0;) {
                assert_ok(hc_ray_file_read(file, read, RAYS, &got, &log), &log);
            }
            hc_ray_file_close(file);
        }
        bytes[i] = kept;
    }
    free(bytes);
}

/* ---- out ------------------------------------------------------------------------------------- */

static void assert_header(const char *path, const char *dictionary, size_t rows_size)
{
    size_t         size;
    unsigned char *bytes = read_bytes(path, &size);
    assert_non_null(strstr((char *)bytes + 10, dictionary));
    assert_int_equal(size % 64, rows_size % 64);
    assert_int_equal(bytes[size - rows_size - 1], '\n');
    free(bytes);
}

static void test_hits_and_any(void **state)
{
    (void)state;
    const hc_hit_row rows[2] = { { 1, 0.5F, 0.25F, 0.125F, { 0, 0, 1 }, 7 },
                                 { .t = INFINITY, .steps = 3 } };
    const uint8_t    any[3]  = { 1, 0, 1 };
    const char      *hits    = in_folder("hits.npy");
    const char      *bits    = in_folder("any.npy");
    hc_log           log     = { .text = "" };
    hc_row_file     *file    = NULL;
    assert_ok(hc_row_file_create(&file, hits, HC_ROWS_HITS, 2, NULL, &log), &log);
    assert_ok(hc_row_file_append(file, rows, 1, &log), &log);
    assert_ok(hc_row_file_append(file, rows + 1, 1, &log), &log);
    assert_ok(hc_row_file_close(file, HC_OK, &log), &log);
    assert_header(hits, "'shape': (2, 8)", sizeof rows);
    assert_ok(hc_row_file_create(&file, bits, HC_ROWS_ANY, 3, NULL, &log), &log);
    assert_ok(hc_row_file_append(file, any, 3, &log), &log);
    assert_ok(hc_row_file_close(file, HC_OK, &log), &log);
    assert_header(bits, "'descr': '|u1', 'fortran_order': False, 'shape': (3,)", sizeof any);
    size_t         size;
    unsigned char *bytes = read_bytes(bits, &size);
    assert_memory_equal(bytes + size - 3, any, 3);
    free(bytes);
}

/* Taken names, failed work and missing rows leave what was there. */
static void test_nothing_half(void **state)
{
    (void)state;
    empty_folder();
    hc_log       log  = { .text = "" };
    hc_row_file *file = NULL;
    const char  *path = in_folder("out.npy");
    write_bytes(path, "precious", 8);
    assert_refused(hc_row_file_create(&file, path, HC_ROWS_RAYS, 1, NULL, &log), HC_ERROR_EXISTS,
                   &log, path, "overwrite");
    assert_null(file);
    const hc_save_options overwrite = { .overwrite = true };
    assert_ok(hc_row_file_create(&file, path, HC_ROWS_RAYS, 2, &overwrite, &log), &log);
    assert_ok(hc_row_file_append(file, rays, 1, &log), &log);
    assert_refused(hc_row_file_close(file, HC_OK, &log), HC_ERROR_ARGUMENT, &log, path, "2 were");
    assert_ok(hc_row_file_create(&file, path, HC_ROWS_RAYS, 1, &overwrite, &log), &log);
    assert_ok(hc_row_file_append(file, rays, 1, &log), &log);
    assert_int_equal(hc_row_file_close(file, HC_ERROR_CANCELLED, &log), HC_ERROR_CANCELLED);
    size_t         size;
    unsigned char *bytes = read_bytes(path, &size);
    assert_string_equal((char *)bytes, "precious");
    free(bytes);
    assert_int_equal(count_files(), 1);
    assert_int_equal(hc_row_file_close(NULL, HC_OK, &log), HC_OK);
    hc_ray_file_close(NULL);
}

/* A limit on the size of files stands for a full disk. */
static void test_full_disk(void **state)
{
    (void)state;
    empty_folder();
    const pid_t child = fork();
    if (child == 0) {
        static hc_ray many[4096];
        hc_log        log  = { .text = "" };
        hc_row_file  *file = NULL;
        const char   *path = in_folder("full.npy");
        (void)signal(SIGXFSZ, SIG_IGN);
        (void)setrlimit(RLIMIT_FSIZE, &(struct rlimit){ 4096, 4096 });
        (void)hc_row_file_create(&file, path, HC_ROWS_RAYS, 4096, NULL, &log);
        const bool refused = hc_row_file_append(file, many, 4096, &log) == HC_ERROR_IO;
        const bool stays =
            hc_row_file_close(file, HC_OK, &log) == HC_ERROR_IO && strstr(log.text, path) != NULL;
        _exit(refused && stays ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_int_equal(count_files(), 0);
}

/* ---- streams --------------------------------------------------------------------------------- */

/* Rays in and out through pipes, a few bytes at a time: nothing may seek or want more. */
static void test_streams(void **state)
{
    (void)state;
    save_rays(in_folder("piped.npy"), RAYS);
    size_t         size;
    unsigned char *bytes = read_bytes(in_folder("piped.npy"), &size);
    int            in[2];
    int            out[2];
    assert_int_equal(pipe(in), 0);
    assert_int_equal(pipe(out), 0);
    const pid_t child = fork();
    if (child == 0) {
        hc_log       log    = { .text = "" };
        hc_ray_file *source = NULL;
        hc_row_file *target = NULL;
        hc_ray       piece[2];
        size_t       got = 1;
        (void)dup2(in[0], STDIN_FILENO);
        (void)dup2(out[1], STDOUT_FILENO);
        (void)close(in[1]);
        hc_result result = hc_ray_file_open(&source, "-", NULL, &log);
        if (result == HC_OK) {
            result = hc_row_file_create(&target, "-", HC_ROWS_RAYS, hc_ray_file_count(source), NULL,
                                        &log);
        }
        while (result == HC_OK && got > 0) {
            result = hc_ray_file_read(source, piece, 2, &got, &log);
            result = result == HC_OK ? hc_row_file_append(target, piece, got, &log) : result;
        }
        result = hc_row_file_close(target, result, &log);
        hc_ray_file_close(source);
        _exit(result == HC_OK ? 0 : 1);
    }
    (void)close(out[1]);
    for (size_t i = 0; i < size; i += 7) {
        const size_t part = size - i < 7 ? size - i : 7;
        assert_int_equal(write(in[1], bytes + i, part), part);
    }
    (void)close(in[1]);
    unsigned char back[1024];
    size_t        length = 0;
    for (ssize_t got = 1; got > 0; length += (size_t)got) {
        got = read(out[0], back + length, sizeof back - length);
        assert_true(got >= 0);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_int_equal(length, size);
    assert_memory_equal(back, bytes, size);
    (void)close(in[0]);
    (void)close(out[0]);
    free(bytes);
}

/* The header of a stream cannot be checked against its length. */
static void test_short_stream(void **state)
{
    (void)state;
    save_rays(in_folder("piped.npy"), RAYS);
    size_t         size;
    unsigned char *bytes = read_bytes(in_folder("piped.npy"), &size);
    int            ends[2];
    hc_log         log  = { .text = "" };
    hc_ray_file   *file = NULL;
    hc_ray         read[RAYS];
    size_t         got;
    char           name[64];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], bytes, size - 1), size - 1);
    (void)close(ends[1]);
    (void)snprintf(name, sizeof name, "/dev/fd/%d", ends[0]);
    assert_ok(hc_ray_file_open(&file, name, NULL, &log), &log);
    assert_ok(hc_ray_file_read(file, read, 3, &got, &log), &log);
    assert_int_equal(got, 3);
    assert_refused(hc_ray_file_read(file, read, 3, &got, &log), HC_ERROR_FORMAT, &log, name,
                   "3 of 5");
    assert_int_equal(got, 0);
    hc_ray_file_close(file);
    (void)close(ends[0]);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_types_and_orders),
        cmocka_unit_test(test_wide_is_rounded),
        cmocka_unit_test(test_wrong_files),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_every_cut),
        cmocka_unit_test(test_every_header_byte),
        cmocka_unit_test(test_hits_and_any),
        cmocka_unit_test(test_nothing_half),
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_streams),
        cmocka_unit_test(test_short_stream),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
