/* Files <-> fields and maps (library heightcast-io). Safe on untrusted bytes: sizes are checked
 * against limits before memory is taken; a damaged file gives HC_ERROR_FORMAT, never undefined
 * behaviour. docs/formats.md describes each container and its metadata. */
#ifndef HEIGHTCAST_IO_H
#define HEIGHTCAST_IO_H

#include <heightcast/maps.h>
#include <heightcast/mesh.h>
#include <heightcast/ray.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Limits on what is read. Zero: the default in brackets. */
typedef struct hc_limits {
    uint64_t max_samples; /* samples of one file, channels counted [2^30] */
    uint64_t max_bytes;   /* size of one file                      [2^33] */
} hc_limits;

typedef struct hc_load_options {
    hc_normalise_options normalise;
    hc_wrap              wrap;
    hc_registration      registration;
    hc_limits            limits;
    /* RAW files (any name, when raw_width > 0): headerless samples, row-major */
    int            raw_width, raw_height;
    hc_sample_type raw_type;
    bool           raw_big_endian;
} hc_load_options;

/* Load a height field. The format is found by content, not by name; "-" reads standard input (not
 * GDAL formats).
 * PNG 1 to 16 bit, TIFF 8/16/32 bit integer and 32/64 bit float with GeoTIFF scale, tie point and
 * nodata, EXR half/float/uint, PGM/PPM 8/16, PFM, NPY (u1, u2, i2, u4, i4, f4, f8; (height, width)
 * or (height, width, channels)), RAW; what GDAL reads if it was built in.
 *
 * field    [out] field->heights is allocated; free with hc_free_field. Left zeroed on error.
 * options  NULL or zero: defaults
 *
 * Files with heightcast's own metadata say what their samples mean: with HC_RANGE_AUTO and
 * HC_CHANNEL_AUTO the heights come back as they were saved, also out of a map's height channel, and
 * elevation->low, high are the original ones.
 * Warns, naming the file: sRGB-tagged input; heights that use little of their range. Errors as in
 * result.h. */
HC_API hc_result hc_load_field(hc_field *field, const char *path, const hc_load_options *options,
                               hc_log *log);
HC_API void      hc_free_field(hc_field *field);

/* True if this build reads other formats through GDAL. */
HC_API bool hc_io_has_gdal(void);

typedef struct hc_save_options {
    bool overwrite; /* otherwise an existing file gives HC_ERROR_EXISTS            */
    int  bits;      /* fields only; maps have theirs                               */
    int  level;     /* pyramids: write this level alone, counted from 1; 0: all of
                       them, which containers without levels refuse                */
} hc_save_options;

/* Write heights as a field file, the original range and metadata with them: format by the name's
 * ending (.png .tif .tiff .exr .pgm .pfm .npy .raw), bits 8, 16 or 32 (float). 0: the most the
 * format has. PNG, PGM: 8, 16; EXR, PFM: 32; TIFF: 8, 16, 32; NPY, RAW: 8, 16, 32. "-" as path is
 * refused.
 * Written to a temporary name beside `path` and renamed: complete or not there. */
HC_API hc_result hc_save_field(const hc_field *field, const char *path,
                               const hc_save_options *options, hc_log *log);

/* Write a map, its info in the container's own metadata: PNG (8, 16 bit), TIFF (8, 16, 32; one
 * directory per level), EXR (32), NPY (8, 16, 32; the info is a comment behind the header's
 * dictionary), KTX2 and DDS (8, 16, 32; levels). Same rules as hc_save_field. A level written alone
 * is a map of that level's size with one level; its spacing and origin are the level's.
 * HC_ERROR_UNSUPPORTED names the containers that can hold the map. */
HC_API hc_result hc_save_map(const hc_map *map, const char *path, const hc_save_options *options,
                             hc_log *log);

/* Read a map back. map->texels is allocated; free with hc_free_map. Left zeroed on error.
 * HC_ERROR_FORMAT for files without heightcast's metadata. */
HC_API hc_result hc_load_map(hc_map *map, const char *path, const hc_limits *limits, hc_log *log);
HC_API void      hc_free_map(hc_map *map);

/* ---- pictures -------------------------------------------------------------------------------- */

/* Write 8-bit RGB pixels (width * height * 3) as PNG; same rules as hc_save_field. */
HC_API hc_result hc_save_picture(const uint8_t *rgb, int width, int height, const char *path,
                                 const hc_save_options *options, hc_log *log);

/* Write floats as they are, channels interleaved (1: Y; 3: R, G, B), as EXR or, one channel, PFM or
 * NPY: pictures in linear light, depths with their infinities. Same rules as hc_save_field. */
HC_API hc_result hc_save_floats(const float *values, int width, int height, int channels,
                                const char *path, const hc_save_options *options, hc_log *log);

/* ---- rays and hits --------------------------------------------------------------------------- */

/* Rows of numbers in and out, piece by piece, so that any number of them passes in little memory:
 * NPY arrays, C order, files or streams ("-": standard input, standard output; nothing seeks). Each
 * object serves one thread at a time. */

/* Rays: float32 or float64, shape (n, 8), rows as in hc_ray; float64 is rounded to nearest. Both
 * byte orders. */
typedef struct hc_ray_file hc_ray_file;

/* Open a ray file and read its header. Close with hc_ray_file_close, which accepts NULL.
 *
 * file    [out] NULL on error
 * limits  NULL or zero: 2^40 rays; max_samples counts 8 for each ray. Nothing is held in memory, so
 *         max_bytes does not matter
 *
 * A regular file that is too short for its rays is refused here, a stream where it ends. What
 * follows the last ray is left alone. */
HC_API hc_result hc_ray_file_open(hc_ray_file **file, const char *path, const hc_limits *limits,
                                  hc_log *log);
HC_API uint64_t  hc_ray_file_count(const hc_ray_file *file); /* rays in all */
/* Read the next rays, `room` at most; *count is how many, 0 only after the last or with no room.
 * HC_ERROR_CANCELLED: a signal came while a stream had nothing to read. After an error nothing more
 * can be read. */
HC_API hc_result hc_ray_file_read(hc_ray_file *file, hc_ray *rays, size_t room, size_t *count,
                                  hc_log *log);
HC_API void      hc_ray_file_close(hc_ray_file *file);

/* A row of a hit file: float32 (n, 8). A miss has t = INFINITY, and 0 for all else but the
 * steps. */
typedef struct hc_hit_row {
    float t, u, v, height; /* as in hc_hit                                  */
    float normal[3];       /* of the patch, in the rays' space              */
    float steps;           /* exact up to 2^24                              */
} hc_hit_row;

/* rays  float32 (n, 8), rows of hc_ray
 * hits  float32 (n, 8), rows of hc_hit_row
 * any   uint8 (n,): 1 for a ray that hits, 0 for one that does not */
typedef enum hc_rows { HC_ROWS_RAYS = 0, HC_ROWS_HITS, HC_ROWS_ANY } hc_rows;

typedef struct hc_row_file hc_row_file;

/* Begin a file of `count` rows, which the header says at once. Same rules as hc_save_field, but "-"
 * is standard output. Every created file must go through hc_row_file_close.
 * file [out] NULL on error. */
HC_API hc_result hc_row_file_create(hc_row_file **file, const char *path, hc_rows rows,
                                    uint64_t count, const hc_save_options *options, hc_log *log);
/* Append rows: hc_ray, hc_hit_row or uint8_t. After an error the file can only be closed. */
HC_API hc_result hc_row_file_append(hc_row_file *file, const void *rows, size_t count, hc_log *log);
/* Give the file its name if `result` is HC_OK, all rows are there and all were written; else remove
 * it. Returns the first error: `result` or its own. Accepts NULL. */
HC_API hc_result hc_row_file_close(hc_row_file *file, hc_result result, hc_log *log);

/* ---- what can be written --------------------------------------------------------------------- */

/* A file format that the functions above write, chosen by the ending of a file's name. */
typedef struct hc_container {
    const char *name;       /* "PNG"                                                */
    const char *endings[2]; /* ".tif", ".tiff"; the second may be NULL              */
    int         field_bits; /* depths it writes fields with: OR of 8, 16, 32; 0: none */
    int         map_bits;   /* likewise for maps                                    */
    bool        levels;     /* holds all levels of a pyramid                        */
} hc_container;

/* By index, NULL beyond the last. Static. */
HC_API const hc_container *hc_container_at(int index);
/* By the ending of `path`, of which the case does not matter; NULL if none has it. Static. */
HC_API const hc_container *hc_container_of(const char *path);

/* ---- what a file is -------------------------------------------------------------------------- */

typedef struct hc_file_info {
    char           format[16]; /* "PNG", "TIFF", "EXR", "PNM", "PFM", "NPY", "KTX2", "DDS",
                                  "GDAL: name"                                               */
    int            width, height, channels;
    hc_sample_type type;    /* of the samples as decoded; half floats: HC_F32 with bits 16 */
    int            bits;    /* per sample in the file                                      */
    bool           srgb;    /* tagged as sRGB                                              */
    bool           has_map; /* heightcast's own metadata is there: `map` is filled         */
    hc_map_info    map;
    hc_elevation   elevation; /* what the file says: spacing, origin, nodata                 */
} hc_file_info;

/* Read what the header says, decoding no more than the container needs. */
HC_API hc_result hc_read_file_info(hc_file_info *info, const char *path, const hc_limits *limits,
                                   hc_log *log);

/* ---- meshes ---------------------------------------------------------------------------------- */

/* Load a Wavefront OBJ: its vertices and faces, of polygons fans; all else is passed over. Destroy
 * with hc_mesh_destroy; *mesh is NULL after an error, which names the line. */
HC_API hc_result hc_load_mesh(hc_mesh **mesh, const char *path, const hc_limits *limits,
                              hc_log *log);

#ifdef __cplusplus
}
#endif

#endif
