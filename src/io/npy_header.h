/* What NPY images and NPY rows of rays share: the header. */
#ifndef HC_IO_NPY_HEADER_H
#define HC_IO_NPY_HEADER_H

#include "io_internal.h"

enum {
    HC_NPY_PREFIX     = 10, /* bytes before the dictionary: magic, version, length        */
    HC_NPY_PREFIX_MAX = 12, /* of versions 2 and 3                                        */
    HC_NPY_HEADER_MAX = 1 << 16,
    HC_NPY_AXES_MAX   = 8,
    HC_NPY_TEXT_MAX   = HC_TEXT_SIZE + 512 /* room that hc_npy_format_header is enough with */
};

/* What the dictionary says. */
typedef struct hc_npy_description {
    char     order; /* '<', '>', '|', '=' */
    char     type[4];
    bool     columns_first;
    int      axes;
    uint64_t shape[HC_NPY_AXES_MAX];
    bool     has_type, has_order, has_shape;
} hc_npy_description;

/* `head` has at least 6 bytes. */
bool hc_npy_recognise(const uint8_t *head);
/* Length of the dictionary and its offset; `prefix` has HC_NPY_PREFIX_MAX bytes. */
hc_result hc_npy_read_prefix(uint32_t *length, size_t *start, const uint8_t *prefix,
                             const char *name, hc_log *log);
/* Read the zero-terminated dictionary. Returns where it stopped making sense, or NULL if all is
 * well; then *rest is what follows. */
const char *hc_npy_parse(hc_npy_description *found, const char *text, const char **rest);
const char *hc_npy_skip_blanks(const char *text);
hc_result   hc_npy_bad_header(const char *name, const char *near_text, hc_log *log);

/* Write prefix and dictionary into `header` of HC_NPY_TEXT_MAX bytes; returns how many they are.
 * shape: "3, 4"; comment: at most HC_TEXT_SIZE bytes, "" for none. */
size_t hc_npy_format_header(uint8_t *header, size_t size, const char *type, const char *shape,
                            const char *comment);

#endif
