/* TIFF out: deflate with prediction, one directory per level, GeoTIFF tags where the place is
 * known. */
#include "tiff_handle.h"

#include "base/fail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STRIP_BYTES = 1 << 18, ZIP_LEVEL = 4, SHORTS = 8 };

static const TIFFFieldInfo elevation_tags[] = {
    { HC_TIFF_PIXEL_SCALE, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1,
      (char *)"ModelPixelScale" },
    { HC_TIFF_TIE_POINT, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1,
      (char *)"ModelTiepoint" },
    { HC_TIFF_GEO_KEYS, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_SHORT, FIELD_CUSTOM, 1, 1,
      (char *)"GeoKeyDirectory" },
    { HC_TIFF_GDAL_XML, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_ASCII, FIELD_CUSTOM, 1, 0,
      (char *)"GDALMetadata" },
    { HC_TIFF_GDAL_NODATA, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_ASCII, FIELD_CUSTOM, 1, 0,
      (char *)"GDALNoDataValue" },
};

/* Scale and offset by which GIS programs turn stored heights back into the original unit. */
static void set_scale_and_offset(TIFF *handle, const hc_elevation *elevation, double one)
{
    char offset[32];
    char scale[32];
    char xml[256];
    hc_print_number(offset, sizeof offset, elevation->low);
    hc_print_number(scale, sizeof scale, (elevation->high - elevation->low) / one);
    (void)snprintf(xml, sizeof xml,
                   "<GDALMetadata>\n"
                   "  <Item name=\"OFFSET\" sample=\"0\" role=\"offset\">%s</Item>\n"
                   "  <Item name=\"SCALE\" sample=\"0\" role=\"scale\">%s</Item>\n"
                   "</GDALMetadata>\n",
                   offset, scale);
    (void)TIFFSetField(handle, HC_TIFF_GDAL_XML, xml);
}

/* The nodata tag names a stored value. It is written only where it cannot be one, since no hole is
 * left in a field. */
static void set_nodata(TIFF *handle, const hc_elevation *elevation, double one)
{
    char text[32];
    if (elevation->has_nodata && !(elevation->nodata >= 0.0 && elevation->nodata <= one)) {
        hc_print_number(text, sizeof text, elevation->nodata);
        (void)TIFFSetField(handle, HC_TIFF_GDAL_NODATA, text);
    }
}

/* Where the samples lie, and for files of heights alone what they mean. */
static void set_elevation(TIFF *handle, const hc_image *image)
{
    static const uint16_t point_keys[SHORTS] = { 1, 1, 0, 1, 1025, 0, 1, 2 }; /* PixelIsPoint */
    const hc_elevation   *elevation          = &image->elevation;
    const double          one = image->bits == 8 ? 255.0 : image->bits == 16 ? 65535.0 : 1.0;
    if (elevation->spacing_x > 0.0 && elevation->spacing_y > 0.0) {
        const double scale[3] = { elevation->spacing_x, elevation->spacing_y, 0.0 };
        (void)TIFFSetField(handle, HC_TIFF_PIXEL_SCALE, 3, scale);
    }
    if (elevation->placed) {
        const double tie[6] = { 0.0, 0.0, 0.0, elevation->origin_x, elevation->origin_y, 0.0 };
        (void)TIFFSetField(handle, HC_TIFF_TIE_POINT, 6, tie);
        (void)TIFFSetField(handle, HC_TIFF_GEO_KEYS, SHORTS, point_keys);
    }
    if (image->channels == 1) {
        if (elevation->low < elevation->high || elevation->low > elevation->high) {
            set_scale_and_offset(handle, elevation, one);
        }
        set_nodata(handle, elevation, one);
    }
}

static void set_shape(TIFF *handle, const hc_image *image, int width, int height, uint32_t rows)
{
    const bool            real    = image->type == HC_F32;
    const bool            colours = image->channels >= 3;
    const int             extra   = image->channels - (colours ? 3 : 1);
    static const uint16_t kinds[] = { EXTRASAMPLE_UNSPECIFIED, EXTRASAMPLE_UNSPECIFIED,
                                      EXTRASAMPLE_UNSPECIFIED };
    (void)TIFFSetField(handle, TIFFTAG_IMAGEWIDTH, (uint32_t)width);
    (void)TIFFSetField(handle, TIFFTAG_IMAGELENGTH, (uint32_t)height);
    (void)TIFFSetField(handle, TIFFTAG_SAMPLESPERPIXEL, image->channels);
    (void)TIFFSetField(handle, TIFFTAG_BITSPERSAMPLE, image->bits);
    (void)TIFFSetField(handle, TIFFTAG_SAMPLEFORMAT,
                       real ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    (void)TIFFSetField(handle, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    (void)TIFFSetField(handle, TIFFTAG_PHOTOMETRIC,
                       colours ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    if (extra > 0) {
        (void)TIFFSetField(handle, TIFFTAG_EXTRASAMPLES, extra, kinds);
    }
    (void)TIFFSetField(handle, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    (void)TIFFSetField(handle, TIFFTAG_PREDICTOR,
                       real ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
    (void)TIFFSetField(handle, TIFFTAG_ZIPQUALITY, ZIP_LEVEL);
    (void)TIFFSetField(handle, TIFFTAG_ROWSPERSTRIP, rows);
}

/* libtiff may change the bytes it is given, so each strip is a copy. */
static bool write_strips(TIFF *handle, const uint8_t *rows, size_t row_size, int height,
                         uint32_t rows_per_strip)
{
    uint8_t *strip = malloc(row_size * rows_per_strip);
    bool     good  = strip != NULL;
    uint32_t index = 0;
    for (uint32_t y = 0; good && y < (uint32_t)height; y += rows_per_strip, index++) {
        const uint32_t left  = (uint32_t)height - y;
        const size_t   bytes = row_size * (left < rows_per_strip ? left : rows_per_strip);
        memcpy(strip, rows + y * row_size, bytes);
        good = TIFFWriteEncodedStrip(handle, index, strip, (tmsize_t)bytes) == (tmsize_t)bytes;
    }
    free(strip);
    return good;
}

static bool write_level(TIFF *handle, const hc_image *image, int level)
{
    const int      width    = hc_level_side(image->width, level);
    const int      height   = hc_level_side(image->height, level);
    const size_t   row_size = (size_t)width * (size_t)image->channels * hc_sample_size(image->type);
    const uint32_t fitting  = (uint32_t)(STRIP_BYTES / row_size);
    const uint32_t at_least = fitting > 0 ? fitting : 1;
    const uint32_t per_strip = at_least < (uint32_t)height ? at_least : (uint32_t)height;
    set_shape(handle, image, width, height, per_strip);
    if (level > 0) {
        (void)TIFFSetField(handle, TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE);
    } else {
        if (image->text[0] != '\0') {
            (void)TIFFSetField(handle, TIFFTAG_IMAGEDESCRIPTION, image->text);
        }
        set_elevation(handle, image);
    }
    return write_strips(handle, hc_level_texels(image, level), row_size, height, per_strip)
           && TIFFWriteDirectory(handle) == 1;
}

hc_result hc_write_tiff(hc_output *output, const hc_image *image, hc_log *log)
{
    hc_tiff tiff;
    /* classic TIFF has 32-bit offsets; deflate may add a little to incompressible samples */
    const bool big  = hc_image_bytes(image) > UINT64_C(4000000000);
    bool       good = hc_tiff_open(&tiff, NULL, output, big);
    if (good) {
        (void)TIFFMergeFieldInfo(tiff.handle, elevation_tags,
                                 sizeof elevation_tags / sizeof *elevation_tags);
    }
    for (int level = 0; good && level < image->levels; level++) {
        good = write_level(tiff.handle, image, level);
    }
    hc_tiff_close(&tiff);
    if (!good) {
        return hc_fail(log, HC_ERROR_IO, "%s: cannot encode the TIFF: %s", output->path,
                       tiff.complaint[0] != '\0' ? tiff.complaint : "no memory");
    }
    return HC_OK;
}
