/* What the tests of files share: a folder of their own, whole files in memory, made samples. */
#ifndef IO_FIXTURE_H
#define IO_FIXTURE_H

#include <heightcast/io.h>

#include <dirent.h>
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static char fixture_folder[64];

static int fixture_begin(void **state)
{
    (void)state;
    (void)snprintf(fixture_folder, sizeof fixture_folder, "/tmp/heightcast-test-XXXXXX");
    return mkdtemp(fixture_folder) != NULL ? 0 : -1;
}

/* The path of a name in the folder; good until the eighth next call. */
static inline const char *in_folder(const char *name)
{
    static char paths[8][PATH_MAX];
    static int  next;
    char       *path = paths[next];
    next             = (next + 1) % 8;
    (void)snprintf(path, PATH_MAX, "%s/%s", fixture_folder, name);
    return path;
}

static inline int count_files(void)
{
    DIR *folder = opendir(fixture_folder);
    int  count  = 0;
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        count += entry->d_name[0] != '.';
    }
    (void)closedir(folder);
    return count;
}

static inline void empty_folder(void)
{
    DIR *folder = opendir(fixture_folder);
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        if (entry->d_name[0] != '.') {
            (void)unlink(in_folder(entry->d_name));
        }
    }
    (void)closedir(folder);
}

static int fixture_end(void **state)
{
    (void)state;
    empty_folder();
    return rmdir(fixture_folder);
}

static inline void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fwrite(bytes, 1, size, file) == size);
    assert_int_equal(fclose(file), 0);
}

/* A whole file, and a zero behind it; to be freed. */
static inline unsigned char *read_bytes(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *size                = (size_t)ftell(file);
    unsigned char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    rewind(file);
    assert_true(fread(bytes, 1, *size, file) == *size);
    (void)fclose(file);
    bytes[*size] = '\0';
    return bytes;
}

/* Collects warnings, separated by newlines, in a buffer of 4096 bytes. */
enum { WARNINGS_SIZE = 4096 };
static inline void collect_warning(void *user, const char *line)
{
    char *text = user;
    (void)snprintf(text + strlen(text), WARNINGS_SIZE - strlen(text), "%s\n", line);
}

/* Small and reproducible; not random in any serious sense. */
static inline unsigned next_number(unsigned *state)
{
    *state = *state * 1664525U + 1013904223U;
    return *state >> 8;
}

static inline void assert_ok(hc_result result, const hc_log *log)
{
    if (result != HC_OK) {
        fail_msg("%s: %s", hc_result_name(result), log->text);
    }
}

/* The wanted result, with a line that names the file and holds `word`. */
static inline void assert_refused(hc_result result, hc_result wanted, const hc_log *log,
                                  const char *path, const char *word)
{
    if (result != wanted || strstr(log->text, path) == NULL || strstr(log->text, word) == NULL
        || strchr(log->text, '\n') != NULL) {
        fail_msg("wanted %s with \"%s\" and \"%s\", got %s: %s", hc_result_name(wanted), path, word,
                 hc_result_name(result), log->text);
    }
}

#endif
