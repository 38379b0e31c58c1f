/* libFuzzer target of the ray reader, on a file and on a stream. Beyond not crashing: the rays that
 * were announced must come, all of them or an error that names the file. */
#include "base/fail.h"
#include "io/io_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

enum { PIECE = 7, PIPE_ROOM = 1 << 16 };

static void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

/* Returns whether all rays came. */
static bool read_rays(const char *path)
{
    hc_log       log    = { .text = "" };
    hc_ray_file *file   = NULL;
    uint64_t     done   = 0;
    size_t       got    = 1;
    hc_result    result = hc_ray_file_open(&file, path, NULL, &log);
    require((result == HC_OK) == (file != NULL));
    while (result == HC_OK && got > 0) {
        hc_ray rays[PIECE];
        result = hc_ray_file_read(file, rays, PIECE, &got, &log);
        done += got;
    }
    require(result != HC_OK || done == hc_ray_file_count(file));
    require(result == HC_OK || strstr(log.text, path) != NULL);
    hc_ray_file_close(file);
    return result == HC_OK;
}

static bool read_as_file(const uint8_t *bytes, size_t size)
{
    char  path[64];
    FILE *file = tmpfile();
    require(file != NULL && fwrite(bytes, 1, size, file) == size && fflush(file) == 0);
    rewind(file);
    (void)snprintf(path, sizeof path, "/dev/fd/%d", fileno(file));
    const bool all = read_rays(path);
    (void)fclose(file);
    return all;
}

static bool read_as_stream(const uint8_t *bytes, size_t size)
{
    char path[64];
    int  ends[2];
    require(pipe(ends) == 0 && write(ends[1], bytes, size) == (ssize_t)size);
    (void)close(ends[1]);
    (void)snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
    const bool all = read_rays(path);
    (void)close(ends[0]);
    return all;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size <= PIPE_ROOM) {
        require(read_as_file(bytes, size) == read_as_stream(bytes, size));
    }
    return 0;
}
