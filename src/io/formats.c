/* The list of formats, and how a file's is found. */
#include "io_internal.h"

#include "base/fail.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool starts(const uint8_t *head, size_t size, const char *magic, size_t length)
{
    return size >= length && memcmp(head, magic, length) == 0;
}

static bool is_png(const uint8_t *head, size_t size)
{
    return starts(head, size, "\x89PNG\r\n\x1A\n", 8);
}

static bool is_tiff(const uint8_t *head, size_t size)
{
    return starts(head, size, "II\x2A\0", 4) || starts(head, size, "MM\0\x2A", 4)
           || starts(head, size, "II\x2B\0", 4) || starts(head, size, "MM\0\x2B", 4);
}

static bool is_exr(const uint8_t *head, size_t size)
{
    return starts(head, size, "\x76\x2F\x31\x01", 4);
}

static bool has_letters(const uint8_t *head, size_t size, const char *kinds)
{
    return size >= 3 && head[0] == 'P' && head[1] != '\0' && strchr(kinds, head[1]) != NULL
           && (head[2] == ' ' || (head[2] >= '\t' && head[2] <= '\r') || head[2] == '#');
}

static bool is_pnm(const uint8_t *head, size_t size)
{
    return has_letters(head, size, "1234567");
}

static bool is_pfm(const uint8_t *head, size_t size)
{
    return has_letters(head, size, "fF");
}

static bool is_npy(const uint8_t *head, size_t size)
{
    return starts(head, size, "\x93NUMPY", 6);
}

static bool is_ktx2(const uint8_t *head, size_t size)
{
    return starts(head, size, "\xABKTX 20\xBB\r\n\x1A\n", 12);
}

static bool is_dds(const uint8_t *head, size_t size)
{
    return starts(head, size, "DDS ", 4);
}

static const hc_format formats[] = {
    { { "PNG", { ".png" }, 8 | 16, 8 | 16, false }, is_png, hc_read_png, hc_write_png },
    { { "TIFF", { ".tif", ".tiff" }, 8 | 16 | 32, 8 | 16 | 32, true },
      is_tiff,
      hc_read_tiff,
      hc_write_tiff },
    { { "EXR", { ".exr" }, 32, 32, false }, is_exr, hc_read_exr, hc_write_exr },
    { { "PNM", { ".pgm" }, 8 | 16, 0, false }, is_pnm, hc_read_pnm, hc_write_pgm },
    { { "PFM", { ".pfm" }, 32, 0, false }, is_pfm, hc_read_pfm, hc_write_pfm },
    { { "NPY", { ".npy" }, 8 | 16 | 32, 8 | 16 | 32, false }, is_npy, hc_read_npy, hc_write_npy },
    { { "RAW", { ".raw" }, 8 | 16 | 32, 0, false }, NULL, NULL, hc_write_raw },
    { { "KTX2", { ".ktx2" }, 0, 8 | 16 | 32, true }, is_ktx2, hc_read_ktx2, hc_write_ktx2 },
    { { "DDS", { ".dds" }, 0, 8 | 16 | 32, true }, is_dds, hc_read_dds, hc_write_dds },
};

enum { FORMATS = (int)(sizeof formats / sizeof *formats) };

const hc_container *hc_container_at(int index)
{
    return index >= 0 && index < FORMATS ? &formats[index].container : NULL;
}

const hc_format *hc_format_by_content(const uint8_t *head, size_t size)
{
    for (int i = 0; i < FORMATS; i++) {
        if (formats[i].recognise != NULL && formats[i].recognise(head, size)) {
            return &formats[i];
        }
    }
    return NULL;
}

const hc_format *hc_format_by_ending(const char *path)
{
    const size_t length = strlen(path);
    for (int i = 0; i < FORMATS; i++) {
        const char *const *endings = formats[i].container.endings;
        for (int k = 0; k < 2 && endings[k] != NULL; k++) {
            const size_t ending = strlen(endings[k]);
            if (length > ending && strcasecmp(path + length - ending, endings[k]) == 0) {
                return &formats[i];
            }
        }
    }
    return NULL;
}

const hc_container *hc_container_of(const char *path)
{
    const hc_format *format = hc_format_by_ending(path);
    return format != NULL ? &format->container : NULL;
}

hc_result hc_read_image(hc_image *image, char format[16], const hc_source *source, bool header_only,
                        hc_log *log)
{
    uint8_t          head[HC_HEAD_SIZE];
    const size_t     size  = hc_source_read(source, 0, head, sizeof head);
    const hc_format *found = hc_format_by_content(head, size);
    hc_result        result;
    *image = (hc_image){ .levels = 1 };
    if (size == 0) {
        return hc_fail(log, HC_ERROR_FORMAT, "%s: is empty; write it again", source->name);
    }
    if (found != NULL) {
        result = found->read(image, source, header_only, log);
    } else if (source->path != NULL) {
        result = hc_read_gdal(image, source, header_only, log);
    } else {
        result = hc_fail(log, HC_ERROR_FORMAT,
                         "%s: is of no known format; write PNG, TIFF, EXR, PGM, PFM or NPY",
                         source->name);
    }
    if (result != HC_OK) {
        hc_image_free(image);
        return result;
    }
    if (format != NULL) {
        (void)snprintf(format, sizeof image->driver, "%s",
                       found != NULL ? found->container.name : image->driver);
    }
    return HC_OK;
}
