/* Bytes in: a regular file by position, anything else through memory. */
#include "io_internal.h"

#include "base/fail.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PIPE_FIRST = 1 << 16 };

static hc_limits resolve(const hc_limits *limits)
{
    hc_limits resolved = limits != NULL ? *limits : (hc_limits){ 0 };
    if (resolved.max_samples == 0) {
        resolved.max_samples = UINT64_C(1) << 30;
    }
    if (resolved.max_bytes == 0) {
        resolved.max_bytes = UINT64_C(1) << 33;
    }
    return resolved;
}

static hc_result too_large(const hc_source *source, hc_log *log)
{
    return hc_fail(log, HC_ERROR_LIMIT,
                   "%s: has more bytes than the limit of %llu; raise max_bytes if you trust it",
                   source->name, (unsigned long long)source->limits.max_bytes);
}

static hc_result io_error(const hc_source *source, const char *what, hc_log *log)
{
    return hc_fail(log, HC_ERROR_IO, "%s: cannot %s: %s", source->name, what, strerror(errno));
}

static ssize_t read_again(int fd, void *buffer, size_t size)
{
    ssize_t got = read(fd, buffer, size);
    while (got < 0 && errno == EINTR) {
        got = read(fd, buffer, size);
    }
    return got;
}

/* Pipes have no size: the buffer doubles, and stops at the limit before the reader's memory
 * does. */
static hc_result read_pipe(hc_source *source, hc_log *log)
{
    size_t capacity = 0;
    for (;;) {
        if (source->size == capacity) {
            capacity       = capacity == 0 ? PIPE_FIRST : capacity * 2;
            uint8_t *grown = realloc(source->owned, capacity);
            if (grown == NULL) {
                return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for %zu bytes", source->name,
                               capacity);
            }
            source->owned = grown;
        }
        const size_t  room = capacity - (size_t)source->size;
        const ssize_t got  = read_again(source->fd, source->owned + source->size, room);
        if (got < 0) {
            return io_error(source, "read", log);
        }
        source->size += (uint64_t)got;
        if (source->size > source->limits.max_bytes) {
            return too_large(source, log);
        }
        if (got == 0) {
            source->bytes = source->owned;
            return HC_OK;
        }
    }
}

hc_result hc_source_open(hc_source *source, const char *path, const hc_limits *limits, hc_log *log)
{
    const bool  standard = strcmp(path, "-") == 0;
    struct stat status;
    *source = (hc_source){ .name = standard ? "standard input" : path,
                           .fd   = standard ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_CLOEXEC),
                           .limits = resolve(limits) };
    if (source->fd < 0 || fstat(source->fd, &status) != 0) {
        return io_error(source, "open", log);
    }
    if (S_ISDIR(status.st_mode)) {
        return hc_fail(log, HC_ERROR_IO, "%s: is a directory; name a file", source->name);
    }
    if (standard || !S_ISREG(status.st_mode)) {
        return read_pipe(source, log);
    }
    source->path = path;
    source->size = (uint64_t)status.st_size;
    return source->size > source->limits.max_bytes ? too_large(source, log) : HC_OK;
}

hc_source hc_source_memory(const void *bytes, size_t size, const char *name,
                           const hc_limits *limits)
{
    return (hc_source){
        .name = name, .bytes = bytes, .fd = -1, .size = size, .limits = resolve(limits)
    };
}

void hc_source_close(hc_source *source)
{
    if (source->fd >= 0) {
        (void)close(source->fd);
    }
    free(source->owned);
    *source = (hc_source){ .fd = -1 };
}

size_t hc_source_read(const hc_source *source, uint64_t offset, void *buffer, size_t size)
{
    if (offset >= source->size) {
        return 0;
    }
    const size_t wanted = size < source->size - offset ? size : (size_t)(source->size - offset);
    if (source->bytes != NULL) {
        memcpy(buffer, source->bytes + offset, wanted);
        return wanted;
    }
    size_t done = 0;
    while (done < wanted) {
        const ssize_t got =
            pread(source->fd, (uint8_t *)buffer + done, wanted - done, (off_t)(offset + done));
        if (got == 0 || (got < 0 && errno != EINTR)) {
            break;
        }
        done += got > 0 ? (size_t)got : 0;
    }
    return done;
}

hc_result hc_source_need(const hc_source *source, uint64_t offset, void *buffer, size_t size,
                         hc_log *log)
{
    if (hc_source_read(source, offset, buffer, size) == size) {
        return HC_OK;
    }
    return hc_fail(
        log, HC_ERROR_FORMAT,
        "%s: ends early: %llu bytes, where at least %llu are needed; the file is cut off",
        source->name, (unsigned long long)source->size, (unsigned long long)(offset + size));
}
