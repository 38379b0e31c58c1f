/* Bytes out: complete under the wanted name, or not there at all. */
#include "io_internal.h"

#include "base/fail.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NAME_TRIES = 100 };

static hc_result exists(const char *path, hc_log *log)
{
    return hc_fail(log, HC_ERROR_EXISTS, "%s: exists already; choose another name or set overwrite",
                   path);
}

/* Renaming onto a device or a folder would do harm, so only what is absent or a regular file may be
 * the target. */
static hc_result check_target(const char *path, bool overwrite, hc_log *log)
{
    struct stat status;
    if (strcmp(path, "-") == 0) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "-: files are not written to standard output; name a file");
    }
    if (stat(path, &status) != 0) {
        return HC_OK;
    }
    if (!S_ISREG(status.st_mode)) {
        return hc_fail(log, HC_ERROR_IO, "%s: is not a regular file; name another output", path);
    }
    return overwrite ? HC_OK : exists(path, log);
}

hc_result hc_output_open(hc_output *output, const char *path, bool overwrite, hc_log *log)
{
    const hc_result allowed = check_target(path, overwrite, log);
    if (allowed != HC_OK) {
        return allowed;
    }
    /* a name of its own, since one made of the wanted name could be too long where that is not */
    const char  *slash  = strrchr(path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - path) + 1 : 0;
    const size_t room   = folder + 64;
    *output =
        (hc_output){ .path = path, .temporary = malloc(room), .fd = -1, .overwrite = overwrite };
    if (output->temporary == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for its name", path);
    }
    errno = EEXIST;
    for (int i = 0; i < NAME_TRIES && output->fd < 0 && errno == EEXIST; i++) {
        (void)snprintf(output->temporary, room, "%.*sheightcast-%ld-%d.tmp", (int)folder, path,
                       (long)getpid(), i);
        output->fd = open(output->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (output->fd < 0) {
        const int error = errno;
        free(output->temporary);
        return hc_fail(log, HC_ERROR_IO, "%s: cannot create a file in its folder: %s", path,
                       strerror(error));
    }
    return HC_OK;
}

bool hc_output_write_at(hc_output *output, uint64_t offset, const void *bytes, size_t size)
{
    const uint8_t *rest = bytes;
    uint64_t       at   = offset;
    size_t         left = size;
    while (left > 0 && output->error == 0) {
        const ssize_t done = pwrite(output->fd, rest, left, (off_t)at);
        if (done > 0) {
            rest += done;
            at += (uint64_t)done;
            left -= (size_t)done;
        } else if (done == 0 || errno != EINTR) {
            output->error = done == 0 ? ENOSPC : errno;
        }
    }
    output->size = at > output->size ? at : output->size;
    return output->error == 0;
}

bool hc_output_append(hc_output *output, const void *bytes, size_t size)
{
    return hc_output_write_at(output, output->size, bytes, size);
}

size_t hc_output_read_at(const hc_output *output, uint64_t offset, void *buffer, size_t size)
{
    const ssize_t got = pread(output->fd, buffer, size, (off_t)offset);
    return got > 0 ? (size_t)got : 0;
}

/* link refuses an existing name, rename does not; file systems without hard links leave a short
 * race. */
static hc_result give_name(const hc_output *output, hc_log *log)
{
    if (!output->overwrite) {
        if (link(output->temporary, output->path) == 0) {
            (void)unlink(output->temporary);
            return HC_OK;
        }
        if (errno == EEXIST || access(output->path, F_OK) == 0) {
            return exists(output->path, log);
        }
    }
    if (rename(output->temporary, output->path) != 0) {
        return hc_fail(log, HC_ERROR_IO, "%s: cannot rename the finished file to it: %s",
                       output->path, strerror(errno));
    }
    return HC_OK;
}

hc_result hc_output_close(hc_output *output, hc_result result, hc_log *log)
{
    if (result == HC_OK && output->error == 0 && fsync(output->fd) != 0) {
        output->error = errno;
    }
    if (close(output->fd) != 0 && output->error == 0) {
        output->error = errno;
    }
    /* A failed write explains the encoder's complaint better than the complaint itself. */
    if (output->error != 0) {
        result = hc_fail(log, HC_ERROR_IO, "%s: cannot write it: %s; nothing was left behind",
                         output->path, strerror(output->error));
    }
    if (result == HC_OK) {
        result = give_name(output, log);
    }
    if (result != HC_OK) {
        (void)unlink(output->temporary);
    }
    free(output->temporary);
    return result;
}
