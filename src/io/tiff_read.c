/* TIFF in: strips and tiles, integers and floats, the elevation tags of GeoTIFF and GDAL.
 * After: the TIFF 6.0 specification; OGC GeoTIFF 1.1 for the tags of the place. */
#include "tiff_handle.h"

#include "base/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RASTER_TYPE_KEY = 1025, RASTER_PIXEL_IS_POINT = 2 };

/* What one directory says about its samples. */
typedef struct shape {
    uint32_t width, height;
    uint16_t channels, bits, format, planar, photometric, compression;
    bool     tiled;
} shape;

static hc_result damaged(const hc_tiff *tiff, const char *what, hc_log *log)
{
    return hc_fail(log, HC_ERROR_FORMAT, "%s: damaged TIFF: %s; write it again", tiff->source->name,
                   tiff->complaint[0] != '\0' ? tiff->complaint : what);
}

static hc_result unsupported(const hc_tiff *tiff, const char *what, int value, const char *remedy,
                             hc_log *log)
{
    return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: TIFF with %s %d is not read; %s",
                   tiff->source->name, what, value, remedy);
}

/* ---- tags ------------------------------------------------------------------------------------ */

/* The values of a tag of the given type, however it is registered: as an unknown tag, or by another
 * library in the same program (GDAL registers these for every handle). NULL if absent or of another
 * type. */
static const void *tag_values(TIFF *handle, uint32_t tag, TIFFDataType type, uint32_t *count)
{
    const TIFFField *field  = TIFFFindField(handle, tag, TIFF_ANY);
    void            *values = NULL;
    uint16_t         narrow = 0;
    *count                  = 0;
    if (field == NULL || TIFFFieldDataType(field) != type) {
        return NULL;
    }
    if (!TIFFFieldPassCount(field)) {
        if (type != TIFF_ASCII || TIFFGetField(handle, tag, &values) != 1 || values == NULL) {
            return NULL;
        }
        *count = (uint32_t)strlen(values);
    } else if (TIFFFieldReadCount(field) == TIFF_VARIABLE2) {
        if (TIFFGetField(handle, tag, count, &values) != 1) {
            return NULL;
        }
    } else {
        if (TIFFGetField(handle, tag, &narrow, &values) != 1) {
            return NULL;
        }
        *count = narrow;
    }
    return values;
}

/* With PixelIsArea, GeoTIFF's default, raster place (0, 0) is the corner of the first pixel, half a
 * sample away. */
static double sample_place(TIFF *handle)
{
    uint32_t        count;
    const uint16_t *entries = tag_values(handle, HC_TIFF_GEO_KEYS, TIFF_SHORT, &count);
    for (uint32_t i = 4; entries != NULL && i + 3 < count; i += 4) {
        if (entries[i] == RASTER_TYPE_KEY && entries[i + 1] == 0) {
            return entries[i + 3] == RASTER_PIXEL_IS_POINT ? 0.0 : 0.5;
        }
    }
    return 0.5;
}

static void read_place(hc_elevation *elevation, TIFF *handle)
{
    uint32_t      scales;
    uint32_t      ties;
    const double *scale = tag_values(handle, HC_TIFF_PIXEL_SCALE, TIFF_DOUBLE, &scales);
    if (scale == NULL || scales < 2 || !(fabs(scale[0]) > 0.0) || !(fabs(scale[1]) > 0.0)
        || !isfinite(scale[0]) || !isfinite(scale[1])) {
        return;
    }
    elevation->spacing_x = fabs(scale[0]);
    elevation->spacing_y = fabs(scale[1]);
    const double *tie    = tag_values(handle, HC_TIFF_TIE_POINT, TIFF_DOUBLE, &ties);
    if (tie == NULL || ties < 6) {
        return;
    }
    const double first = sample_place(handle);
    const double x     = tie[3] + (first - tie[0]) * scale[0];
    const double y     = tie[4] - (first - tie[1]) * scale[1];
    if (isfinite(x) && isfinite(y)) {
        elevation->placed   = true;
        elevation->origin_x = x;
        elevation->origin_y = y;
    }
}

static void read_nodata(hc_elevation *elevation, TIFF *handle)
{
    uint32_t    count;
    const char *text = tag_values(handle, HC_TIFF_GDAL_NODATA, TIFF_ASCII, &count);
    char        copy[64];
    if (text == NULL || count >= sizeof copy) {
        return;
    }
    memcpy(copy, text, count);
    copy[count]        = '\0';
    char        *end   = copy;
    const double value = hc_parse_number(copy, &end);
    if (end != copy) {
        elevation->has_nodata = true;
        elevation->nodata     = value;
    }
}

static void read_tags(hc_image *image, TIFF *handle)
{
    uint32_t    size;
    void       *profile;
    const char *description;
    read_place(&image->elevation, handle);
    read_nodata(&image->elevation, handle);
    image->srgb = TIFFGetField(handle, TIFFTAG_ICCPROFILE, &size, &profile) == 1
                  && hc_profile_is_srgb(profile, size);
    if (TIFFGetField(handle, TIFFTAG_IMAGEDESCRIPTION, &description) == 1 && description != NULL) {
        hc_image_take_text(image, description, strlen(description));
    }
}

/* ---- shape ----------------------------------------------------------------------------------- */

static shape read_shape(TIFF *handle)
{
    shape found = { .photometric = PHOTOMETRIC_MINISBLACK };
    (void)TIFFGetField(handle, TIFFTAG_IMAGEWIDTH, &found.width);
    (void)TIFFGetField(handle, TIFFTAG_IMAGELENGTH, &found.height);
    (void)TIFFGetFieldDefaulted(handle, TIFFTAG_SAMPLESPERPIXEL, &found.channels);
    (void)TIFFGetFieldDefaulted(handle, TIFFTAG_BITSPERSAMPLE, &found.bits);
    (void)TIFFGetFieldDefaulted(handle, TIFFTAG_SAMPLEFORMAT, &found.format);
    (void)TIFFGetFieldDefaulted(handle, TIFFTAG_PLANARCONFIG, &found.planar);
    (void)TIFFGetFieldDefaulted(handle, TIFFTAG_COMPRESSION, &found.compression);
    (void)TIFFGetField(handle, TIFFTAG_PHOTOMETRIC, &found.photometric);
    found.tiled = TIFFIsTiled(handle) != 0;
    return found;
}

/* Type of the decoded samples; signed bytes have none of their own and become 16 bits. */
static bool find_type(hc_sample_type *type, const shape *found)
{
    static const struct {
        uint16_t       format, bits;
        hc_sample_type type;
    } known[] = {
        { SAMPLEFORMAT_UINT, 8, HC_U8 },     { SAMPLEFORMAT_UINT, 16, HC_U16 },
        { SAMPLEFORMAT_UINT, 32, HC_U32 },   { SAMPLEFORMAT_VOID, 8, HC_U8 },
        { SAMPLEFORMAT_VOID, 16, HC_U16 },   { SAMPLEFORMAT_VOID, 32, HC_U32 },
        { SAMPLEFORMAT_INT, 8, HC_I16 },     { SAMPLEFORMAT_INT, 16, HC_I16 },
        { SAMPLEFORMAT_INT, 32, HC_I32 },    { SAMPLEFORMAT_IEEEFP, 32, HC_F32 },
        { SAMPLEFORMAT_IEEEFP, 64, HC_F64 },
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (known[i].format == found->format && known[i].bits == found->bits) {
            *type = known[i].type;
            return true;
        }
    }
    return false;
}

static hc_result check_shape(const hc_tiff *tiff, const shape *found, hc_sample_type *type,
                             hc_log *log)
{
    if (found->photometric > PHOTOMETRIC_RGB) {
        return unsupported(tiff, "photometric interpretation", found->photometric,
                           "write it as grey or RGB", log);
    }
    if (!TIFFIsCODECConfigured(found->compression)) {
        return unsupported(tiff, "compression", found->compression,
                           "write it with deflate compression", log);
    }
    if (!find_type(type, found)) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: TIFF with %d-bit samples of format %d is not read; write 8, 16 or 32 "
                       "bit integers or 32 or 64 bit floats",
                       tiff->source->name, found->bits, found->format);
    }
    return HC_OK;
}

/* What a file of this size can unpack to at most; zstd, LZMA and lossy codecs have no useful
 * bound. */
static double packing_ratio(uint16_t compression)
{
    switch (compression) {
    case COMPRESSION_NONE: return 1.0;
    case COMPRESSION_PACKBITS: return 64.0;
    case COMPRESSION_ADOBE_DEFLATE:
    case COMPRESSION_DEFLATE: return 1032.0;
    case COMPRESSION_LZW: return 4096.0;
    default: return HUGE_VAL;
    }
}

/* ---- samples --------------------------------------------------------------------------------- */

/* One level's place in the image, and how its blocks (strips or tiles) cover it. */
typedef struct level {
    const shape   *found;
    uint8_t       *first;
    size_t         value_size;  /* decoded                            */
    size_t         stored_size; /* in the file                        */
    uint32_t       block_width, block_height;
    uint32_t       across, down; /* blocks */
    int            planes;       /* 1, or one per channel             */
    hc_sample_type type;
} level;

static void copy_values(uint8_t *to, const uint8_t *from, size_t count, const level *into)
{
    if (into->stored_size == into->value_size) {
        memcpy(to, from, count * into->value_size);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const int16_t wide = (int16_t)(int8_t)from[i];
        memcpy(to + i * sizeof wide, &wide, sizeof wide);
    }
}

/* Put a decoded block in its place: cut at the image's border, plane by plane if need be. */
static void place_block(const level *into, const uint8_t *block, uint32_t x0, uint32_t y0,
                        int plane)
{
    const size_t   channels = into->found->channels;
    const size_t   stored   = into->planes > 1 ? 1 : channels; /* values per pixel in the block */
    const size_t   run      = stored == channels ? into->block_width : 1; /* pixels side by side */
    const uint32_t right    = into->found->width - x0;
    const uint32_t columns  = into->block_width < right ? into->block_width : right;
    for (uint32_t y = 0; y < into->block_height && y0 + y < into->found->height; y++) {
        for (uint32_t x = 0; x < columns; x += (uint32_t)run) {
            const size_t   pixels = run < columns ? run : columns;
            const size_t   pixel  = (size_t)(y0 + y) * into->found->width + x0 + x;
            const uint8_t *from =
                block + ((size_t)y * into->block_width + x) * stored * into->stored_size;
            copy_values(into->first + (pixel * channels + (size_t)plane) * into->value_size, from,
                        pixels * stored, into);
        }
    }
}

static bool read_block(TIFF *handle, const level *into, uint32_t index, uint8_t *block, size_t size)
{
    const tmsize_t got = into->found->tiled
                             ? TIFFReadEncodedTile(handle, index, block, (tmsize_t)size)
                             : TIFFReadEncodedStrip(handle, index, block, (tmsize_t)size);
    return got == (tmsize_t)size;
}

/* Blocks that need sorting out: tiles, planes, or signed bytes. */
static hc_result read_through_buffer(hc_tiff *tiff, const level *into, size_t block_size,
                                     hc_log *log)
{
    uint8_t *block = calloc(1, block_size); /* zeroed: see hc_image_prepare */
    if (block == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for a block of %zu bytes",
                       tiff->source->name, block_size);
    }
    hc_result result = HC_OK;
    uint32_t  index  = 0;
    for (int plane = 0; plane < into->planes; plane++) {
        for (uint32_t row = 0; row < into->down && result == HC_OK; row++) {
            for (uint32_t column = 0; column < into->across && result == HC_OK; column++, index++) {
                const uint32_t y0 = row * into->block_height;
                const uint32_t rows =
                    into->found->tiled || into->found->height - y0 > into->block_height
                        ? into->block_height
                        : into->found->height - y0;
                const size_t size = block_size / into->block_height * rows;
                if (read_block(tiff->handle, into, index, block, size)) {
                    place_block(into, block, column * into->block_width, y0, plane);
                } else {
                    result = damaged(tiff, "a block is cut off", log);
                }
            }
        }
    }
    free(block);
    return result;
}

/* Strips of interleaved samples are the rows themselves. */
static hc_result read_in_place(hc_tiff *tiff, const level *into, size_t row_size, hc_log *log)
{
    for (uint32_t row = 0; row < into->down; row++) {
        const uint32_t y0   = row * into->block_height;
        const uint32_t left = into->found->height - y0;
        const uint32_t rows = left < into->block_height ? left : into->block_height;
        if (!read_block(tiff->handle, into, row, into->first + y0 * row_size, rows * row_size)) {
            return damaged(tiff, "a strip is cut off", log);
        }
    }
    return HC_OK;
}

/* White is high: codes of files whose lowest code is white are turned round. */
static void turn_round(uint8_t *values, size_t count, hc_sample_type type)
{
    const size_t bytes = count * hc_sample_size(type);
    for (size_t i = 0; i < bytes; i++) {
        values[i] = (uint8_t)~values[i];
    }
}

static hc_result read_level(hc_tiff *tiff, const hc_image *image, const shape *found,
                            uint8_t *first, hc_log *log)
{
    level into = { .found        = found,
                   .first        = first,
                   .value_size   = hc_sample_size(image->type),
                   .stored_size  = found->bits / 8U,
                   .block_width  = found->width,
                   .block_height = found->height,
                   .planes       = found->planar == PLANARCONFIG_SEPARATE ? found->channels : 1,
                   .type         = image->type };
    if (found->tiled) {
        (void)TIFFGetField(tiff->handle, TIFFTAG_TILEWIDTH, &into.block_width);
        (void)TIFFGetField(tiff->handle, TIFFTAG_TILELENGTH, &into.block_height);
    } else {
        (void)TIFFGetFieldDefaulted(tiff->handle, TIFFTAG_ROWSPERSTRIP, &into.block_height);
        into.block_height = into.block_height > found->height ? found->height : into.block_height;
    }
    if (into.block_width == 0 || into.block_height == 0) {
        return damaged(tiff, "its blocks have no size", log);
    }
    const size_t stored  = into.planes > 1 ? 1 : found->channels;
    const double samples = (double)into.block_width * into.block_height * (double)stored;
    if (samples > (double)tiff->source->limits.max_samples) {
        return hc_fail(log, HC_ERROR_LIMIT,
                       "%s: has tiles of %u x %u samples, the limit is %llu samples; raise "
                       "max_samples if you trust it",
                       tiff->source->name, into.block_width, into.block_height,
                       (unsigned long long)tiff->source->limits.max_samples);
    }
    into.across = (found->width - 1) / into.block_width + 1;
    into.down   = (found->height - 1) / into.block_height + 1;

    const size_t row_size = (size_t)into.block_width * stored * into.stored_size;
    const bool as_it_is = !found->tiled && into.planes == 1 && into.stored_size == into.value_size;
    hc_result  result   = as_it_is
                              ? read_in_place(tiff, &into, row_size, log)
                              : read_through_buffer(tiff, &into, row_size * into.block_height, log);
    if (result == HC_OK && found->photometric == PHOTOMETRIC_MINISWHITE
        && (image->type == HC_U8 || image->type == HC_U16 || image->type == HC_U32)) {
        turn_round(first, (size_t)found->width * found->height * found->channels, image->type);
    }
    return result;
}

/* ---- file ------------------------------------------------------------------------------------ */

static bool same_kind(const shape *a, const shape *b)
{
    return a->channels == b->channels && a->bits == b->bits && a->format == b->format;
}

/* A pyramid has one directory per level; in other files what follows the first directory is
 * something else. */
static int count_levels(const hc_image *image, const hc_source *source)
{
    hc_map_info info;
    return hc_text_is_map(image->text)
                   && hc_text_to_map(&info, image->text, source->name, NULL) == HC_OK
               ? info.levels
               : 1;
}

static hc_result read_levels(hc_tiff *tiff, hc_image *image, shape found, hc_log *log)
{
    for (int k = 0; k < image->levels; k++) {
        const int width  = hc_level_side(image->width, k);
        const int height = hc_level_side(image->height, k);
        if (k > 0) {
            hc_sample_type type;
            if (TIFFReadDirectory(tiff->handle) != 1) {
                return damaged(tiff, "levels of the pyramid are missing", log);
            }
            const shape next = read_shape(tiff->handle);
            if (!same_kind(&found, &next) || next.width != (uint32_t)width
                || next.height != (uint32_t)height) {
                return damaged(tiff, "a level of the pyramid has a wrong size or type", log);
            }
            const hc_result checked = check_shape(tiff, &next, &type, log);
            if (checked != HC_OK) {
                return checked;
            }
            found = next;
        }
        const hc_result result = read_level(tiff, image, &found, hc_level_texels(image, k), log);
        if (result != HC_OK) {
            return result;
        }
    }
    return HC_OK;
}

static hc_result read_open(hc_tiff *tiff, hc_image *image, bool header_only, hc_log *log)
{
    const shape found  = read_shape(tiff->handle);
    hc_result   result = check_shape(tiff, &found, &image->type, log);
    if (result != HC_OK) {
        return result;
    }
    const double packed = (double)found.width * found.height * found.channels * (found.bits / 8);
    result = hc_check_promise(tiff->source, packed, packing_ratio(found.compression), log);
    if (result != HC_OK) {
        return result;
    }
    read_tags(image, tiff->handle);
    image->bits   = found.bits;
    image->levels = count_levels(image, tiff->source);
    result        = hc_image_prepare(image, tiff->source, found.width, found.height, found.channels,
                                     header_only, log);
    return result != HC_OK || header_only ? result : read_levels(tiff, image, found, log);
}

hc_result hc_read_tiff(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    hc_tiff tiff;
    /* libtiff goes on without tags that it cannot read, but one of them may name nodata */
    const bool      opened = hc_tiff_open(&tiff, source, NULL, false) && tiff.complaint[0] == '\0';
    const hc_result result = opened ? read_open(&tiff, image, header_only, log)
                                    : damaged(&tiff, "no image directory", log);
    hc_tiff_close(&tiff);
    return result;
}
