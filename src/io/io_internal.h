/* What the format files share: bytes in, bytes out, the decoded image between them, and the
 * metadata text.
 *
 * Every reader is safe on untrusted bytes: it learns the sizes, has them checked by
 * hc_image_prepare, and only then takes memory. Readers and writers name the file in each
 * message. */
#ifndef HC_IO_INTERNAL_H
#define HC_IO_INTERNAL_H

#include "maps/levels.h"

#include <heightcast/io.h>

#include <stddef.h>
#include <stdint.h>

/* ---- bytes in -------------------------------------------------------------------------------- */

/* A file to read, as random access: a regular file by its descriptor, everything else read into
 * memory first. */
typedef struct hc_source {
    const char    *name;  /* for messages                                     */
    const char    *path;  /* of a regular file; NULL where there is none      */
    const uint8_t *bytes; /* the whole file in memory, or NULL: read it by fd */
    uint8_t       *owned; /* to free at the end                               */
    int            fd;    /* -1 if not open                                   */
    uint64_t       size;
    hc_limits      limits; /* defaults resolved */
} hc_source;

/* Open `path`, "-" being standard input. Close with hc_source_close, also after an error. */
hc_result hc_source_open(hc_source *source, const char *path, const hc_limits *limits, hc_log *log);
/* A source over bytes that stay the caller's; limits may be NULL. */
hc_source hc_source_memory(const void *bytes, size_t size, const char *name,
                           const hc_limits *limits);
void      hc_source_close(hc_source *source);
/* Copy up to `size` bytes from `offset`; returns how many there were. */
size_t hc_source_read(const hc_source *source, uint64_t offset, void *buffer, size_t size);
/* The same, all or HC_ERROR_FORMAT: "ends early". */
hc_result hc_source_need(const hc_source *source, uint64_t offset, void *buffer, size_t size,
                         hc_log *log);

/* ---- bytes out ------------------------------------------------------------------------------- */

/* A file being written under a temporary name beside its path. Write errors stick until
 * hc_output_close reports them. */
typedef struct hc_output {
    const char *path;
    char       *temporary;
    int         fd;
    bool        overwrite;
    uint64_t    size;  /* bytes so far: where hc_output_append goes on */
    int         error; /* errno of the first failed write; 0: none     */
} hc_output;

/* Refuses "-", existing outputs unless `overwrite`, and outputs that are not regular files. */
hc_result hc_output_open(hc_output *output, const char *path, bool overwrite, hc_log *log);
bool      hc_output_append(hc_output *output, const void *bytes, size_t size);
bool      hc_output_write_at(hc_output *output, uint64_t offset, const void *bytes, size_t size);
size_t    hc_output_read_at(const hc_output *output, uint64_t offset, void *buffer, size_t size);
/* Make the file durable and give it its name if `result` is HC_OK and every write succeeded; remove
 * it otherwise. Returns the first error, `result` or its own. Call exactly once after a successful
 * open. */
hc_result hc_output_close(hc_output *output, hc_result result, hc_log *log);

/* ---- images ---------------------------------------------------------------------------------- */

enum { HC_TEXT_SIZE = 1024 }; /* of the metadata text, with the final 0 */

/* What a file holds, decoded: interleaved channels, row-major, levels one after another, native
 * endian. */
typedef struct hc_image {
    void          *data; /* NULL if only the header was wanted */
    hc_sample_type type;
    int            width, height, channels; /* channels 1 .. 4                              */
    int            levels;                  /* 1, or of a mip chain: sides halve            */
    int            bits;                    /* per sample in the file                       */
    double         type_max;                /* code that means 1; 0: the type's largest     */
    bool           srgb;                    /* tagged as sRGB                               */
    hc_elevation   elevation;               /* spacing, place, nodata by the file's own tags */
    char           driver[16];              /* set by readers of many formats: which one    */
    char           text[HC_TEXT_SIZE];      /* heightcast's metadata; "" if there is none   */
} hc_image;

/* Samples of all levels, channels counted; the sizes must have passed hc_image_prepare. */
size_t hc_image_samples(const hc_image *image);
size_t hc_image_bytes(const hc_image *image);
/* Bytes of one level, and its first one. */
size_t   hc_level_bytes(const hc_image *image, int level);
uint8_t *hc_level_texels(const hc_image *image, int level);
/* Check sizes, channels, levels and limits, then take the memory for `data` unless only the header
 * is wanted. width, height and channels are what the file says, unchecked; they are written to the
 * image. */
hc_result hc_image_prepare(hc_image *image, const hc_source *source, uint64_t width,
                           uint64_t height, uint64_t channels, bool header_only, hc_log *log);
/* HC_ERROR_FORMAT if the file is too small for what its header promises: fewer than needed / ratio
 * bytes. */
hc_result hc_check_promise(const hc_source *source, double needed, double ratio, hc_log *log);
void      hc_image_free(hc_image *image);
/* True if an ICC profile's description names sRGB. */
bool hc_profile_is_srgb(const void *profile, size_t size);

/* ---- byte order ------------------------------------------------------------------------------ */

bool hc_host_is_big_endian(void);
/* Reverse the bytes of `count` values of `size` bytes each (1, 2, 4 or 8). */
void     hc_swap_bytes(void *values, size_t count, size_t size);
uint16_t hc_get_le16(const uint8_t *bytes);
uint32_t hc_get_le32(const uint8_t *bytes);
uint64_t hc_get_le64(const uint8_t *bytes);
void     hc_put_le16(uint8_t *bytes, uint16_t value);
void     hc_put_le32(uint8_t *bytes, uint32_t value);
void     hc_put_le64(uint8_t *bytes, uint64_t value);
/* Append samples in little-endian order on every machine. */
bool hc_append_samples(hc_output *output, const void *samples, size_t count, size_t size);
/* Read samples straight into memory, from the given byte order to the machine's. */
hc_result hc_read_samples(const hc_source *source, uint64_t offset, void *samples, size_t count,
                          size_t size, bool big_endian, hc_log *log);

/* ---- metadata text --------------------------------------------------------------------------- */

/* One line of "key=value" words that every container carries (docs/formats.md).
 * Locale-independent. */
#define HC_TEXT_KEY "heightcast" /* under which containers keep it */

void      hc_text_from_map(char text[HC_TEXT_SIZE], const hc_map_info *info);
void      hc_text_from_field(char text[HC_TEXT_SIZE], const hc_elevation *elevation);
bool      hc_text_is_map(const char *text);
hc_result hc_text_to_map(hc_map_info *info, const char *text, const char *name, hc_log *log);
hc_result hc_text_to_field(hc_elevation *elevation, const char *text, const char *name,
                           hc_log *log);
/* Take over `length` bytes as an image's text if they look like heightcast's; otherwise leave
 * it. */
void hc_image_take_text(hc_image *image, const char *bytes, size_t length);
/* strtod and printf %.17g as in the C locale. */
double hc_parse_number(const char *text, char **end);
void   hc_print_number(char *buffer, size_t size, double value);

/* ---- formats --------------------------------------------------------------------------------- */

typedef hc_result hc_reader(hc_image *image, const hc_source *source, bool header_only,
                            hc_log *log);
typedef hc_result hc_writer(hc_output *output, const hc_image *image, hc_log *log);

typedef struct hc_format {
    hc_container container;
    bool (*recognise)(const uint8_t *head, size_t size); /* NULL: never by content         */
    hc_reader *read;                                     /* NULL: not without further options */
    hc_writer *write;
} hc_format;

enum { HC_HEAD_SIZE = 16 }; /* bytes that are enough to tell every format */

const hc_format *hc_format_by_content(const uint8_t *head, size_t size);
const hc_format *hc_format_by_ending(const char *path);
/* Decode a source whatever its format, GDAL's included. `format` [out] may be NULL. */
hc_result hc_read_image(hc_image *image, char format[16], const hc_source *source, bool header_only,
                        hc_log *log);

hc_reader hc_read_png, hc_read_tiff, hc_read_exr, hc_read_pnm, hc_read_pfm, hc_read_npy,
    hc_read_ktx2, hc_read_dds, hc_read_gdal;
hc_writer hc_write_png, hc_write_tiff, hc_write_exr, hc_write_pgm, hc_write_pfm, hc_write_npy,
    hc_write_raw, hc_write_ktx2, hc_write_dds;
hc_result hc_read_raw(hc_image *image, const hc_source *source, const hc_load_options *options,
                      hc_log *log);

/* ---- loading from sources: the public functions less the opening ----------------------------- */

hc_result hc_load_field_source(hc_field *field, const hc_source *source,
                               const hc_load_options *options, hc_log *log);
hc_result hc_load_map_source(hc_map *map, const hc_source *source, hc_log *log);
hc_result hc_read_source_info(hc_file_info *info, const hc_source *source, hc_log *log);
hc_result hc_load_mesh_source(hc_mesh **mesh, const hc_source *source, hc_log *log);

#endif
