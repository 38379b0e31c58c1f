/* Everything else: files that GDAL reads, in builds that have it. */
#include "io_internal.h"

#include "base/fail.h"

#ifdef HC_HAVE_GDAL

#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COMPLAINT_SIZE = 256 };

/* Drivers that read other files or the network when a file tells them to: what a file holds must
 * come from the file. */
static const char *const left_out[] = {
    "VRT",           "Derived",    "WMS",       "WMTS",        "WCS",    "HTTP",           "DAAS",
    "PLMOSAIC",      "NGW",        "EEDA",      "EEDAI",       "OGCAPI", "STACTA",         "STACIT",
    "PostGISRaster", "RASTERLITE", "SENTINEL2", "OpenFileGDB", "TIL",    "KMLSUPEROVERLAY"
};

static char         **drivers; /* names that GDALOpenEx may try; made once, kept for good */
static pthread_once_t drivers_once = PTHREAD_ONCE_INIT;

static void list_drivers(void)
{
    GDALAllRegister();
    for (int i = 0; i < GDALGetDriverCount(); i++) {
        const char *name = GDALGetDriverShortName(GDALGetDriver(i));
        bool        out  = false;
        for (size_t k = 0; k < sizeof left_out / sizeof *left_out; k++) {
            out = out || strcmp(name, left_out[k]) == 0;
        }
        drivers = out ? drivers : CSLAddString(drivers, name);
    }
}

static void CPL_STDCALL keep_complaint(CPLErr kind, CPLErrorNum number, const char *message)
{
    (void)number;
    char *complaint = CPLGetErrorHandlerUserData();
    if (kind >= CE_Failure && complaint[0] == '\0') {
        (void)snprintf(complaint, COMPLAINT_SIZE, "%.*s", (int)strcspn(message, "\n"), message);
    }
}

/* Types that GDAL has and hc_sample_type has not are read as double. */
static hc_sample_type sample_type(GDALDataType type, GDALDataType *wanted)
{
    *wanted = type;
    switch (type) {
    case GDT_Byte: return HC_U8;
    case GDT_UInt16: return HC_U16;
    case GDT_Int16: return HC_I16;
    case GDT_UInt32: return HC_U32;
    case GDT_Int32: return HC_I32;
    case GDT_Float32: return HC_F32;
    default: *wanted = GDT_Float64; return HC_F64;
    }
}

static void read_elevation(hc_elevation *elevation, GDALDatasetH set, GDALRasterBandH band)
{
    double t[6];
    int    has_nodata = 0;
    if (GDALGetGeoTransform(set, t) == CE_None) {
        elevation->spacing_x = sqrt(t[1] * t[1] + t[4] * t[4]);
        elevation->spacing_y = sqrt(t[2] * t[2] + t[5] * t[5]);
        elevation->placed    = true;
        elevation->origin_x =
            t[0] + 0.5 * (t[1] + t[2]); /* GDAL places corners, we place samples */
        elevation->origin_y = t[3] + 0.5 * (t[4] + t[5]);
    }
    elevation->nodata     = GDALGetRasterNoDataValue(band, &has_nodata);
    elevation->has_nodata = has_nodata != 0;
    const char *unit      = GDALGetRasterUnitType(band);
    if (unit != NULL && strlen(unit) < sizeof elevation->unit) {
        (void)snprintf(elevation->unit, sizeof elevation->unit, "%s", unit);
    }
}

static hc_result read_set(GDALDatasetH set, hc_image *image, const hc_source *source,
                          const char *complaint, bool header_only, hc_log *log)
{
    const int bands = GDALGetRasterCount(set);
    if (bands < 1) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: has no raster bands; name one of its parts",
                       source->name);
    }
    GDALRasterBandH    first  = GDALGetRasterBand(set, 1);
    const GDALDataType stored = GDALGetRasterDataType(first);
    GDALDataType       wanted;
    if (GDALDataTypeIsComplex(stored)) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: has complex samples; write real ones",
                       source->name);
    }
    image->type   = sample_type(stored, &wanted);
    image->bits   = GDALGetDataTypeSizeBits(stored);
    image->levels = 1;
    (void)snprintf(image->driver, sizeof image->driver, "GDAL: %.9s",
                   GDALGetDriverShortName(GDALGetDatasetDriver(set)));
    read_elevation(&image->elevation, set, first);
    const hc_result result =
        hc_image_prepare(image, source, (uint64_t)GDALGetRasterXSize(set),
                         (uint64_t)GDALGetRasterYSize(set), (uint64_t)bands, header_only, log);
    if (result != HC_OK || header_only) {
        return result;
    }
    const int      size  = (int)hc_sample_size(image->type);
    const GSpacing pixel = (GSpacing)size * bands;
    const CPLErr   error = GDALDatasetRasterIOEx(
          set, GF_Read, 0, 0, image->width, image->height, image->data, image->width, image->height,
          wanted, bands, NULL, pixel, pixel * image->width, size, NULL);
    return error == CE_None
               ? HC_OK
               : hc_fail(log, HC_ERROR_FORMAT, "%s: GDAL cannot read it: %s; repair it",
                         source->name, complaint);
}

hc_result hc_read_gdal(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    char complaint[COMPLAINT_SIZE] = "";
    (void)pthread_once(&drivers_once, list_drivers);
    /* handlers are per thread; nothing is printed */
    CPLPushErrorHandlerEx(keep_complaint, complaint);
    GDALDatasetH set = GDALOpenEx(source->path, GDAL_OF_RASTER | GDAL_OF_READONLY,
                                  (const char *const *)drivers, NULL, NULL);
    hc_result    result;
    if (set != NULL) {
        result = read_set(set, image, source, complaint, header_only, log);
        GDALClose(set);
    } else {
        result = hc_fail(log, HC_ERROR_FORMAT,
                         "%s: is of no known format%s%s; write PNG, TIFF, EXR, PGM, PFM or NPY",
                         source->name, complaint[0] != '\0' ? ": " : "", complaint);
    }
    CPLPopErrorHandler();
    return result;
}

bool hc_io_has_gdal(void)
{
    return true;
}

#else

hc_result hc_read_gdal(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    (void)image;
    (void)header_only;
    return hc_fail(log, HC_ERROR_FORMAT,
                   "%s: is of no known format, and this build has no GDAL; write PNG, TIFF, EXR, "
                   "PGM, PFM or NPY",
                   source->name);
}

bool hc_io_has_gdal(void)
{
    return false;
}

#endif
