/* A libtiff handle over a source or an output. */
#include "tiff_handle.h"

#include <stdio.h>
#include <string.h>

static int keep_complaint(TIFF *handle, void *user, const char *module, const char *format,
                          va_list arguments)
{
    (void)handle;
    (void)module;
    hc_tiff *tiff = user;
    if (tiff->complaint[0] == '\0') {
        (void)vsnprintf(tiff->complaint, sizeof tiff->complaint, format, arguments);
    }
    return 1;
}

/* Warnings are mostly about private tags, which heightcast's own files have too. */
static int drop_warning(TIFF *handle, void *user, const char *module, const char *format,
                        va_list arguments)
{
    (void)handle;
    (void)user;
    (void)module;
    (void)format;
    (void)arguments;
    return 1;
}

static tmsize_t read_bytes(thandle_t user, void *buffer, tmsize_t size)
{
    hc_tiff     *tiff = user;
    const size_t got  = tiff->source != NULL
                            ? hc_source_read(tiff->source, tiff->position, buffer, (size_t)size)
                            : hc_output_read_at(tiff->output, tiff->position, buffer, (size_t)size);
    tiff->position += got;
    if (got < (size_t)size && tiff->complaint[0] == '\0') {
        (void)snprintf(tiff->complaint, sizeof tiff->complaint, "the file is cut off");
    }
    return (tmsize_t)got;
}

static tmsize_t write_bytes(thandle_t user, void *buffer, tmsize_t size)
{
    hc_tiff *tiff = user;
    if (tiff->output == NULL
        || !hc_output_write_at(tiff->output, tiff->position, buffer, (size_t)size)) {
        return -1;
    }
    tiff->position += (uint64_t)size;
    return size;
}

static toff_t file_size(thandle_t user)
{
    const hc_tiff *tiff = user;
    return tiff->source != NULL ? tiff->source->size : tiff->output->size;
}

static toff_t seek(thandle_t user, toff_t offset, int whence)
{
    hc_tiff *tiff = user;
    switch (whence) {
    case SEEK_CUR: tiff->position += offset; break;
    case SEEK_END: tiff->position = file_size(user) + offset; break;
    default: tiff->position = offset; break;
    }
    return tiff->position;
}

static int close_nothing(thandle_t user)
{
    (void)user;
    return 0;
}

bool hc_tiff_open(hc_tiff *tiff, const hc_source *source, hc_output *output, bool big)
{
    *tiff                    = (hc_tiff){ .source = source, .output = output };
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();
    if (options == NULL) {
        (void)snprintf(tiff->complaint, sizeof tiff->complaint, "no memory");
        return false;
    }
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_complaint, tiff);
    TIFFOpenOptionsSetWarningHandlerExtR(options, drop_warning, tiff);
    if (source != NULL) {
        /* no single sample is wider than 8 bytes, and no structure needs more than all samples
         * together */
        TIFFOpenOptionsSetMaxSingleMemAlloc(options,
                                            (tmsize_t)(source->limits.max_samples * 8 + (1 << 20)));
    }
    /* m: no mapping of memory; l: the same bytes on every machine */
    const char *mode = source != NULL ? "rm" : big ? "wl8" : "wl";
    const char *name = source != NULL ? source->name : output->path;
    tiff->handle = TIFFClientOpenExt(name, mode, tiff, read_bytes, write_bytes, seek, close_nothing,
                                     file_size, NULL, NULL, options);
    TIFFOpenOptionsFree(options);
    return tiff->handle != NULL;
}

void hc_tiff_close(hc_tiff *tiff)
{
    if (tiff->handle != NULL) {
        TIFFClose(tiff->handle);
    }
}
