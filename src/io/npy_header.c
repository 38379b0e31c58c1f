/* The dictionary in front of NPY arrays, in and out.
 * After: the format description in NumPy's documentation (versions 1, 2 and 3). */
#include "npy_header.h"

#include "base/fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

static const uint8_t magic[6] = { 0x93, 'N', 'U', 'M', 'P', 'Y' };

const char *hc_npy_skip_blanks(const char *text)
{
    return text + strspn(text, " \t\r\n");
}

/* Past `wanted` and the blanks around it; NULL if something else is there. */
static const char *expect(const char *text, char wanted)
{
    text = hc_npy_skip_blanks(text);
    return *text == wanted ? hc_npy_skip_blanks(text + 1) : NULL;
}

/* A quoted word of at most size - 1 bytes; NULL if it is none. */
static const char *take_word(char *word, size_t size, const char *text)
{
    const char   quote  = *text;
    const char  *end    = quote == '\'' || quote == '"' ? strchr(text + 1, quote) : NULL;
    const size_t length = end != NULL ? (size_t)(end - text - 1) : size;
    if (length >= size) {
        return NULL;
    }
    memcpy(word, text + 1, length);
    word[length] = '\0';
    return end + 1;
}

static const char *take_shape(hc_npy_description *found, const char *text)
{
    text = expect(text, '(');
    while (text != NULL && *text != ')') {
        char                    *end;
        const unsigned long long side = strtoull(text, &end, 10);
        if (*text < '0' || *text > '9' || found->axes == HC_NPY_AXES_MAX) {
            return NULL;
        }
        found->shape[found->axes++] = side;
        text                        = hc_npy_skip_blanks(end);
        if (*text == ',') {
            text = hc_npy_skip_blanks(text + 1);
        } else if (*text != ')') {
            return NULL;
        }
    }
    found->has_shape = text != NULL;
    return text != NULL ? text + 1 : NULL;
}

static const char *take_flag(hc_npy_description *found, const char *text)
{
    found->columns_first = strncmp(text, "True", 4) == 0;
    found->has_order     = found->columns_first || strncmp(text, "False", 5) == 0;
    return found->has_order ? text + (found->columns_first ? 4 : 5) : NULL;
}

static const char *take_type(hc_npy_description *found, const char *text)
{
    char        word[8];
    const char *rest = take_word(word, sizeof word, text);
    if (rest == NULL || strlen(word) != 3) {
        return NULL;
    }
    found->order = word[0];
    memcpy(found->type, word + 1, 3);
    found->has_type = strchr("<>|=", word[0]) != NULL;
    return found->has_type ? rest : NULL;
}

const char *hc_npy_parse(hc_npy_description *found, const char *text, const char **rest)
{
    const char *place = expect(text, '{');
    if (place == NULL) {
        return text;
    }
    while (*place != '}') {
        char        key[24];
        const char *here  = place;
        const char *value = take_word(key, sizeof key, place);
        value             = value != NULL ? expect(value, ':') : NULL;
        if (value == NULL) {
            return here;
        }
        if (strcmp(key, "descr") == 0) {
            place = take_type(found, value);
        } else if (strcmp(key, "fortran_order") == 0) {
            place = take_flag(found, value);
        } else if (strcmp(key, "shape") == 0 && !found->has_shape) {
            place = take_shape(found, value);
        } else {
            return here;
        }
        if (place == NULL) {
            return value;
        }
        place = hc_npy_skip_blanks(place);
        if (*place == ',') {
            place = hc_npy_skip_blanks(place + 1);
        } else if (*place != '}') {
            return place;
        }
    }
    *rest = hc_npy_skip_blanks(place + 1);
    return found->has_type && found->has_order && found->has_shape ? NULL : text;
}

hc_result hc_npy_read_prefix(uint32_t *length, size_t *start, const uint8_t *prefix,
                             const char *name, hc_log *log)
{
    const bool wide = prefix[6] >= 2;
    *length         = wide ? hc_get_le32(prefix + 8) : hc_get_le16(prefix + 8);
    *start          = wide ? HC_NPY_PREFIX_MAX : HC_NPY_PREFIX;
    if (prefix[6] < 1 || prefix[6] > 3 || *length > HC_NPY_HEADER_MAX) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: NPY of version %d with a header of %u bytes is not read; save a plain "
                       "array as version 1",
                       name, prefix[6], *length);
    }
    return HC_OK;
}

bool hc_npy_recognise(const uint8_t *head)
{
    return memcmp(head, magic, sizeof magic) == 0;
}

hc_result hc_npy_bad_header(const char *name, const char *near_text, hc_log *log)
{
    return hc_fail(log, HC_ERROR_FORMAT,
                   "%s: NPY header makes no sense near \"%.24s\"; save the array again", name,
                   near_text);
}

size_t hc_npy_format_header(uint8_t *header, size_t size, const char *type, const char *shape,
                            const char *comment)
{
    const int length = snprintf((char *)header + HC_NPY_PREFIX, size - HC_NPY_PREFIX,
                                "{'descr': '%s', 'fortran_order': False, 'shape': (%s), }%s%s",
                                type, shape, comment[0] != '\0' ? "  # " : "", comment);
    /* blanks and a newline fill the header up, so that the samples are aligned */
    const size_t used  = HC_NPY_PREFIX + (size_t)length;
    const size_t total = (used + 1 + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    memset(header + used, ' ', total - used);
    header[total - 1] = '\n';
    memcpy(header, magic, sizeof magic);
    header[6] = 1;
    header[7] = 0;
    hc_put_le16(header + 8, (uint16_t)(total - HC_NPY_PREFIX));
    return total;
}
