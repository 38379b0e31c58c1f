/* Rays in: NPY rows from a file or a stream, without seeking. */
#include "npy_header.h"

#include "base/fail.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { COLUMNS = 8, PIECE = 4096 /* rows converted at a time */ };

static const uint64_t rays_max = UINT64_C(1) << 40;

struct hc_ray_file {
    const char *name;
    int         fd;
    uint64_t    count, done;
    bool        wide;    /* float64               */
    bool        foreign; /* the other byte order  */
    double      rows[PIECE * COLUMNS];
};

/* ---- bytes ----------------------------------------------------------------------------------- */

static hc_result ends_early(const hc_ray_file *file, hc_log *log)
{
    if (file->count == 0) {
        return hc_fail(log, HC_ERROR_FORMAT, "%s: ends early, in its header", file->name);
    }
    return hc_fail(log, HC_ERROR_FORMAT,
                   "%s: ends early, after %llu of %llu rays at least; the file is cut off",
                   file->name, (unsigned long long)file->done, (unsigned long long)file->count);
}

/* A signal ends the wait for a stream: the caller's handler may want the program to stop. */
static hc_result read_all(const hc_ray_file *file, void *buffer, size_t size, hc_log *log)
{
    for (size_t done = 0; done < size;) {
        const ssize_t got = read(file->fd, (uint8_t *)buffer + done, size - done);
        if (got < 0 && errno == EINTR) {
            return hc_fail(log, HC_ERROR_CANCELLED, "%s: reading was interrupted by a signal",
                           file->name);
        }
        if (got < 0) {
            return hc_fail(log, HC_ERROR_IO, "%s: cannot read: %s", file->name, strerror(errno));
        }
        if (got == 0) {
            return ends_early(file, log);
        }
        done += (size_t)got;
    }
    return HC_OK;
}

/* ---- header ---------------------------------------------------------------------------------- */

static hc_result read_dictionary(char **text, const hc_ray_file *file, hc_log *log)
{
    uint8_t   prefix[HC_NPY_PREFIX_MAX] = { 0 };
    uint32_t  length                    = 0;
    size_t    start                     = 0;
    hc_result result                    = read_all(file, prefix, HC_NPY_PREFIX, log);
    if (result == HC_OK && !hc_npy_recognise(prefix)) {
        return hc_fail(log, HC_ERROR_FORMAT,
                       "%s: is not an NPY file; save rays with numpy.save, float32 of shape (n, 8)",
                       file->name);
    }
    if (result == HC_OK && prefix[6] >= 2) {
        result = read_all(file, prefix + HC_NPY_PREFIX, HC_NPY_PREFIX_MAX - HC_NPY_PREFIX, log);
    }
    if (result == HC_OK) {
        result = hc_npy_read_prefix(&length, &start, prefix, file->name, log);
    }
    if (result != HC_OK) {
        return result;
    }
    *text = calloc(1, (size_t)length + 1);
    if (*text == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for its header", file->name);
    }
    return read_all(file, *text, length, log);
}

static hc_result check_type(hc_ray_file *file, const hc_npy_description *found, hc_log *log)
{
    file->wide    = strcmp(found->type, "f8") == 0;
    file->foreign = (found->order == '>') != hc_host_is_big_endian() && found->order != '=';
    if (!file->wide && strcmp(found->type, "f4") != 0) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: rays of type \"%s\" are not read; save float32 or float64", file->name,
                       found->type);
    }
    if (found->columns_first) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: is in Fortran order; save numpy.ascontiguousarray(rays)", file->name);
    }
    return HC_OK;
}

static hc_result check_shape(hc_ray_file *file, const hc_npy_description *found,
                             const hc_limits *limits, hc_log *log)
{
    if (found->axes != 2 || found->shape[1] != COLUMNS) {
        return hc_fail(log, HC_ERROR_FORMAT,
                       "%s: has %d axes, the last of %llu; rays have the shape (n, 8): ox oy oz "
                       "tmin dx dy dz tmax",
                       file->name, found->axes,
                       found->axes > 0 ? (unsigned long long)found->shape[found->axes - 1] : 0ULL);
    }
    const uint64_t samples = limits != NULL ? limits->max_samples : 0;
    const uint64_t most =
        samples != 0 && samples / COLUMNS < rays_max ? samples / COLUMNS : rays_max;
    file->count = found->shape[0];
    if (file->count > most) {
        return hc_fail(log, HC_ERROR_LIMIT,
                       "%s: has %llu rays, the limit is %llu; raise max_samples (8 for each ray) "
                       "if you trust it",
                       file->name, (unsigned long long)file->count, (unsigned long long)most);
    }
    return HC_OK;
}

/* Files tell before the work begins, streams only when they end. */
static hc_result check_length(const hc_ray_file *file, hc_log *log)
{
    struct stat    status;
    const off_t    here   = lseek(file->fd, 0, SEEK_CUR);
    const uint64_t needed = file->count * COLUMNS * (file->wide ? sizeof(double) : sizeof(float));
    if (fstat(file->fd, &status) != 0 || !S_ISREG(status.st_mode) || here < 0) {
        return HC_OK;
    }
    const uint64_t there = status.st_size > here ? (uint64_t)(status.st_size - here) : 0;
    if (there < needed) {
        return hc_fail(log, HC_ERROR_FORMAT,
                       "%s: ends early: %llu bytes of rays, where %llu are needed; the file is cut "
                       "off",
                       file->name, (unsigned long long)there, (unsigned long long)needed);
    }
    return HC_OK;
}

static hc_result read_header(hc_ray_file *file, const hc_limits *limits, hc_log *log)
{
    char              *text   = NULL;
    const char        *rest   = NULL;
    hc_npy_description found  = { .order = '|' };
    hc_result          result = read_dictionary(&text, file, log);
    if (result == HC_OK) {
        const char *bad = hc_npy_parse(&found, text, &rest);
        result          = bad != NULL ? hc_npy_bad_header(file->name, bad, log) : HC_OK;
    }
    free(text);
    if (result == HC_OK) {
        result = check_type(file, &found, log);
    }
    if (result == HC_OK) {
        result = check_shape(file, &found, limits, log);
    }
    return result == HC_OK ? check_length(file, log) : result;
}

/* ---- rows ------------------------------------------------------------------------------------ */

static hc_result read_wide(hc_ray_file *file, hc_ray *rays, size_t count, hc_log *log)
{
    float *to = (float *)rays;
    for (size_t done = 0; done < count;) {
        const size_t    part   = count - done < PIECE ? count - done : PIECE;
        const hc_result result = read_all(file, file->rows, part * COLUMNS * sizeof(double), log);
        if (result != HC_OK) {
            return result;
        }
        if (file->foreign) {
            hc_swap_bytes(file->rows, part * COLUMNS, sizeof(double));
        }
        for (size_t i = 0; i < part * COLUMNS; i++) {
            *to++ = (float)file->rows[i];
        }
        done += part;
    }
    return HC_OK;
}

static hc_result read_narrow(hc_ray_file *file, hc_ray *rays, size_t count, hc_log *log)
{
    const hc_result result = read_all(file, rays, count * sizeof *rays, log);
    if (result == HC_OK && file->foreign) {
        hc_swap_bytes(rays, count * COLUMNS, sizeof(float));
    }
    return result;
}

hc_result hc_ray_file_open(hc_ray_file **file, const char *path, const hc_limits *limits,
                           hc_log *log)
{
    const bool   standard = strcmp(path, "-") == 0;
    hc_ray_file *opened   = malloc(sizeof *opened);
    *file                 = NULL;
    if (opened == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to read it", path);
    }
    opened->name     = standard ? "standard input" : path;
    opened->count    = 0;
    opened->done     = 0;
    opened->fd       = standard ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_CLOEXEC);
    hc_result result = HC_OK;
    if (opened->fd < 0) {
        result = hc_fail(log, HC_ERROR_IO, "%s: cannot open: %s", opened->name, strerror(errno));
    } else {
        result = read_header(opened, limits, log);
    }
    if (result != HC_OK) {
        hc_ray_file_close(opened);
        return result;
    }
    *file = opened;
    return HC_OK;
}

uint64_t hc_ray_file_count(const hc_ray_file *file)
{
    return file->count;
}

hc_result hc_ray_file_read(hc_ray_file *file, hc_ray *rays, size_t room, size_t *count, hc_log *log)
{
    const uint64_t  left = file->count - file->done;
    const size_t    part = left < room ? (size_t)left : room;
    const hc_result result =
        file->wide ? read_wide(file, rays, part, log) : read_narrow(file, rays, part, log);
    *count     = result == HC_OK ? part : 0;
    file->done = result == HC_OK ? file->done + part : file->count;
    return result;
}

void hc_ray_file_close(hc_ray_file *file)
{
    if (file != NULL && file->fd >= 0) {
        (void)close(file->fd);
    }
    free(file);
}
