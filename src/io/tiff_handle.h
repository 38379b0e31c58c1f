/* A libtiff handle over a source or an output, and what went wrong with it. */
#ifndef HC_IO_TIFF_HANDLE_H
#define HC_IO_TIFF_HANDLE_H

#include "io_internal.h"

#include <tiffio.h>

enum {
    HC_TIFF_PIXEL_SCALE = 33550, /* GeoTIFF: sample spacing x, y, z                     */
    HC_TIFF_TIE_POINT   = 33922, /* GeoTIFF: raster place (3 numbers), its place (3)    */
    HC_TIFF_GEO_KEYS    = 34735, /* GeoTIFF: key directory                              */
    HC_TIFF_GDAL_XML    = 42112, /* GDAL: metadata, such as scale and offset            */
    HC_TIFF_GDAL_NODATA = 42113  /* GDAL: the value that means "no sample", as text     */
};

typedef struct hc_tiff {
    TIFF            *handle;
    const hc_source *source; /* one of the two is NULL */
    hc_output       *output;
    uint64_t         position;
    char             complaint[256]; /* the first error, or that the file ends early; "" if none */
} hc_tiff;

/* Open for reading (source) or writing (output); `tiff` must stay where it is until hc_tiff_close.
 * False on failure, with the complaint set. Errors and warnings of libtiff stay in this handle:
 * nothing is printed, nothing is global. */
bool hc_tiff_open(hc_tiff *tiff, const hc_source *source, hc_output *output, bool big);
void hc_tiff_close(hc_tiff *tiff);

#endif
