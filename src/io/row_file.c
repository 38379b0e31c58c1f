/* Rays and hits out: NPY rows to a file under a temporary name, or to standard output. */
#include "npy_header.h"

#include "base/fail.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { COLUMNS = 8 };

struct hc_row_file {
    hc_output output; /* of a file                        */
    bool      stream; /* standard output instead          */
    int       error;  /* errno of the stream; 0: none     */
    hc_rows   rows;
    uint64_t  count, done;
    uint8_t   header[HC_NPY_TEXT_MAX];
};

static bool write_stream(hc_row_file *file, const void *bytes, size_t size)
{
    for (size_t done = 0; done < size && file->error == 0;) {
        const ssize_t wrote = write(STDOUT_FILENO, (const uint8_t *)bytes + done, size - done);
        /* A signal ends the wait for a full pipe too. */
        file->error = wrote < 0 ? errno : 0;
        done += wrote > 0 ? (size_t)wrote : 0;
    }
    return file->error == 0;
}

static bool put(hc_row_file *file, const void *bytes, size_t size)
{
    return file->stream ? write_stream(file, bytes, size)
                        : hc_output_append(&file->output, bytes, size);
}

static hc_result report(const hc_row_file *file, hc_log *log)
{
    if (file->stream) {
        return hc_fail(log, HC_ERROR_IO, "cannot write to standard output: %s",
                       strerror(file->error));
    }
    return hc_fail(log, HC_ERROR_IO, "%s: cannot write it: %s", file->output.path,
                   strerror(file->output.error));
}

static hc_result put_header(hc_row_file *file, hc_log *log)
{
    char        shape[48];
    const bool  flat = file->rows == HC_ROWS_ANY;
    const char *type = flat ? "|u1" : hc_host_is_big_endian() ? ">f4" : "<f4";
    (void)snprintf(shape, sizeof shape, flat ? "%llu," : "%llu, 8",
                   (unsigned long long)file->count);
    const size_t size = hc_npy_format_header(file->header, sizeof file->header, type, shape, "");
    return put(file, file->header, size) ? HC_OK : report(file, log);
}

hc_result hc_row_file_create(hc_row_file **file, const char *path, hc_rows rows, uint64_t count,
                             const hc_save_options *options, hc_log *log)
{
    const bool   overwrite = options != NULL && options->overwrite;
    hc_row_file *made      = malloc(sizeof *made);
    *file                  = NULL;
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to write it", path);
    }
    *made = (hc_row_file){ .stream = strcmp(path, "-") == 0, .rows = rows, .count = count };
    hc_result result = HC_OK;
    if (!made->stream) {
        result = hc_output_open(&made->output, path, overwrite, log);
    }
    if (result != HC_OK) {
        free(made);
        return result;
    }
    result = put_header(made, log);
    if (result != HC_OK) {
        return hc_row_file_close(made, result, log);
    }
    *file = made;
    return HC_OK;
}

hc_result hc_row_file_append(hc_row_file *file, const void *rows, size_t count, hc_log *log)
{
    const size_t size = file->rows == HC_ROWS_ANY ? 1 : COLUMNS * sizeof(float);
    file->done += count;
    return put(file, rows, count * size) ? HC_OK : report(file, log);
}

hc_result hc_row_file_close(hc_row_file *file, hc_result result, hc_log *log)
{
    if (file == NULL) {
        return result;
    }
    if (result == HC_OK && file->done != file->count) {
        result = hc_fail(log, HC_ERROR_ARGUMENT, "%s: %llu rows were appended, %llu were announced",
                         file->stream ? "standard output" : file->output.path,
                         (unsigned long long)file->done, (unsigned long long)file->count);
    }
    if (!file->stream) {
        result = hc_output_close(&file->output, result, log);
    } else if (result == HC_OK && file->error != 0) {
        result = report(file, log);
    }
    free(file);
    return result;
}
