/* heightcast's metadata as text: one line of "key=value" words, read and written by one table.
 *
 * The words are separated by single blanks; inside values, bytes outside printable ASCII and '%'
 * and '=' are written as %XX. Keys that are not known are skipped, so that later versions may add
 * some. */
#define _GNU_SOURCE /* locale_t */
#include "io_internal.h"

#include "base/fail.h"

#include <float.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SIGNATURE HC_TEXT_KEY "=1 content="
#define SIGNATURE_MAP SIGNATURE "map"
#define SIGNATURE_FIELD SIGNATURE "field"

enum { NAMES_MAX = 16, WORD_SIZE = 128 };

typedef enum value_type { INTEGER, BOOLEAN, SINGLE, REAL, TEXT, CHOICE } value_type;

/* One key: where its value stands in an hc_map_info, and how it is written. */
typedef struct key {
    const char *name;
    value_type  type;
    bool   of_map; /* else of the elevation, and left out where it is zero, which means unknown */
    size_t offset;
    size_t size;                /* TEXT: of the array      */
    const char *(*choice)(int); /* CHOICE: name of a value */
} key;

static const char *kind_name(int value)
{
    return hc_map_kind_name((hc_map_kind)value);
}

static const char *layout_name(int value)
{
    return hc_layout_name((hc_layout)value);
}

static const char *cones_name(int value)
{
    return hc_cones_name((hc_cones)value);
}

static const char *wrap_name(int value)
{
    return hc_wrap_name((hc_wrap)value);
}

static const char *registration_name(int value)
{
    return hc_registration_name((hc_registration)value);
}

_Static_assert(sizeof(hc_map_kind) == sizeof(int) && sizeof(hc_layout) == sizeof(int)
                   && sizeof(hc_cones) == sizeof(int) && sizeof(hc_wrap) == sizeof(int)
                   && sizeof(hc_registration) == sizeof(int),
               "choices are copied as int");

#define AT(member) offsetof(hc_map_info, member)
static const key keys[] = {
    { "kind", CHOICE, true, AT(kind), 0, kind_name },
    { "layout", CHOICE, true, AT(layout), 0, layout_name },
    { "cones", CHOICE, true, AT(cones), 0, cones_name },
    { "bits", INTEGER, true, AT(bits), 0, NULL },
    { "width", INTEGER, true, AT(width), 0, NULL },
    { "height", INTEGER, true, AT(height), 0, NULL },
    { "channels", INTEGER, true, AT(channels), 0, NULL },
    { "levels", INTEGER, true, AT(levels), 0, NULL },
    { "wrap", CHOICE, true, AT(wrap), 0, wrap_name },
    { "registration", CHOICE, true, AT(registration), 0, registration_name },
    { "max_ratio", SINGLE, true, AT(max_ratio), 0, NULL },
    { "compat2006", BOOLEAN, true, AT(compat2006), 0, NULL },
    { "method", TEXT, true, AT(method), sizeof((hc_map_info *)0)->method, NULL },
    { "low", REAL, false, AT(elevation.low), 0, NULL },
    { "high", REAL, false, AT(elevation.high), 0, NULL },
    { "spacing_x", REAL, false, AT(elevation.spacing_x), 0, NULL },
    { "spacing_y", REAL, false, AT(elevation.spacing_y), 0, NULL },
    { "placed", BOOLEAN, false, AT(elevation.placed), 0, NULL },
    { "origin_x", REAL, false, AT(elevation.origin_x), 0, NULL },
    { "origin_y", REAL, false, AT(elevation.origin_y), 0, NULL },
    { "has_nodata", BOOLEAN, false, AT(elevation.has_nodata), 0, NULL },
    { "nodata", REAL, false, AT(elevation.nodata), 0, NULL },
    { "source_bits", INTEGER, false, AT(elevation.source_bits), 0, NULL },
    { "unit", TEXT, false, AT(elevation.unit), sizeof((hc_elevation *)0)->unit, NULL },
};
#undef AT
enum { KEYS = sizeof keys / sizeof *keys };

/* ---- numbers: a program's locale must not decide what a file says ---------------------------- */

double hc_parse_number(const char *text, char **end)
{
    const locale_t plain    = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t previous = plain != (locale_t)0 ? uselocale(plain) : (locale_t)0;
    const double   value    = strtod(text, end);
    if (plain != (locale_t)0) {
        (void)uselocale(previous);
        freelocale(plain);
    }
    return value;
}

void hc_print_number(char *buffer, size_t size, double value)
{
    const locale_t plain    = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t previous = plain != (locale_t)0 ? uselocale(plain) : (locale_t)0;
    /* The shortest of the digits that give the value back: 0.1 rather than 0.10000000000000001. */
    for (int digits = 6; digits <= 17; digits++) {
        (void)snprintf(buffer, size, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value) {
            break;
        }
    }
    if (plain != (locale_t)0) {
        (void)uselocale(previous);
        freelocale(plain);
    }
}

/* ---- writing --------------------------------------------------------------------------------- */

static void escape(char *word, size_t size, const char *text, size_t text_size)
{
    size_t used = 0;
    for (size_t i = 0; i < text_size && text[i] != '\0' && used + 4 <= size; i++) {
        const unsigned char byte = (unsigned char)text[i];
        if (byte > ' ' && byte < 0x7F && byte != '%' && byte != '=') {
            word[used++] = text[i];
        } else {
            used += (size_t)snprintf(word + used, size - used, "%%%02X", byte);
        }
    }
    word[used] = '\0';
}

/* The word for one value; false if it is zero, that is, unknown. */
static bool print_value(char word[WORD_SIZE], const key *entry, const hc_map_info *info)
{
    const char *place = (const char *)info + entry->offset;
    int         integer;
    bool        boolean;
    float       single;
    double      real;
    switch (entry->type) {
    case INTEGER:
    case CHOICE:
        memcpy(&integer, place, sizeof integer);
        if (entry->type == CHOICE) {
            escape(word, WORD_SIZE, entry->choice(integer), WORD_SIZE);
        } else {
            (void)snprintf(word, WORD_SIZE, "%d", integer);
        }
        return integer != 0;
    case BOOLEAN:
        memcpy(&boolean, place, sizeof boolean);
        (void)snprintf(word, WORD_SIZE, "%d", boolean);
        return boolean;
    case SINGLE:
        memcpy(&single, place, sizeof single);
        hc_print_number(word, WORD_SIZE, (double)single);
        return single != 0.0F;
    case REAL:
        memcpy(&real, place, sizeof real);
        hc_print_number(word, WORD_SIZE, real);
        return real != 0.0;
    case TEXT: escape(word, WORD_SIZE, place, entry->size); return *place != '\0';
    }
    return false;
}

static void print_keys(char text[HC_TEXT_SIZE], const char *signature, const hc_map_info *info,
                       bool map)
{
    size_t used = (size_t)snprintf(text, HC_TEXT_SIZE, "%s", signature);
    for (int i = 0; i < KEYS; i++) {
        char word[WORD_SIZE];
        if (keys[i].of_map && !map) {
            continue;
        }
        if (print_value(word, &keys[i], info) || keys[i].of_map) {
            used +=
                (size_t)snprintf(text + used, HC_TEXT_SIZE - used, " %s=%s", keys[i].name, word);
        }
    }
}

void hc_text_from_map(char text[HC_TEXT_SIZE], const hc_map_info *info)
{
    print_keys(text, SIGNATURE_MAP, info, true);
}

void hc_text_from_field(char text[HC_TEXT_SIZE], const hc_elevation *elevation)
{
    print_keys(text, SIGNATURE_FIELD, &(hc_map_info){ .elevation = *elevation }, false);
}

/* ---- reading --------------------------------------------------------------------------------- */

static int hex_digit(char character)
{
    static const char digits[] = "0123456789ABCDEF";
    const char       *found    = character != '\0' ? strchr(digits, character) : NULL;
    return found != NULL ? (int)(found - digits) : -1;
}

static bool unescape(char *text, size_t size, const char *word)
{
    size_t used = 0;
    while (*word != '\0' && used + 1 < size) {
        if (*word == '%') {
            const int high = hex_digit(word[1]);
            const int low  = high >= 0 ? hex_digit(word[2]) : -1;
            if (low < 0 || high * 16 + low == 0) {
                return false;
            }
            text[used++] = (char)(high * 16 + low);
            word += 3;
        } else {
            text[used++] = *word++;
        }
    }
    memset(text + used, 0, size - used);
    return *word == '\0';
}

static bool parse_integer(int *value, const char *word)
{
    char      *end;
    const long number = strtol(word, &end, 10);
    *value            = (int)number;
    return *word != '\0' && *end == '\0' && number >= 0 && number <= INT_MAX;
}

static bool parse_choice(int *value, const char *word, const char *(*choice)(int))
{
    for (int i = 0; i < NAMES_MAX && strcmp(choice(i), "unknown") != 0; i++) {
        if (strcmp(choice(i), word) == 0) {
            *value = i;
            return true;
        }
    }
    return false;
}

/* Only a nodata value may be NaN or infinite. */
static bool parse_real(double *value, const char *word, const char *name)
{
    char *end;
    *value = hc_parse_number(word, &end);
    return *word != '\0' && *end == '\0' && (isfinite(*value) || strcmp(name, "nodata") == 0);
}

static bool parse_value(hc_map_info *info, const key *entry, const char *word)
{
    char  *place   = (char *)info + entry->offset;
    int    integer = 0;
    bool   boolean;
    float  single;
    double real;
    bool   good;
    switch (entry->type) {
    case INTEGER:
    case CHOICE:
        good = entry->type == CHOICE ? parse_choice(&integer, word, entry->choice)
                                     : parse_integer(&integer, word);
        memcpy(place, &integer, sizeof integer);
        return good;
    case BOOLEAN:
        good    = parse_integer(&integer, word) && integer <= 1;
        boolean = integer == 1;
        memcpy(place, &boolean, sizeof boolean);
        return good;
    case SINGLE:
        good   = parse_real(&real, word, entry->name) && real >= 0.0 && real <= (double)FLT_MAX;
        single = good ? (float)real : 0.0F;
        memcpy(place, &single, sizeof single);
        return good;
    case REAL:
        good = parse_real(&real, word, entry->name);
        memcpy(place, &real, sizeof real);
        return good;
    case TEXT: return unescape(place, entry->size, word);
    }
    return false;
}

static hc_result bad_word(const char *name, const char *word, hc_log *log)
{
    return hc_fail(
        log, HC_ERROR_FORMAT,
        "%s: its heightcast metadata says \"%.100s\", which makes no sense; bake it again", name,
        word);
}

/* Parse all words; every map key must be there if `map`. */
static hc_result parse_keys(hc_map_info *info, const char *text, bool map, const char *name,
                            hc_log *log)
{
    bool seen[KEYS] = { false };
    *info           = (hc_map_info){ 0 };
    char  copy[HC_TEXT_SIZE];
    char *rest = copy;
    (void)snprintf(copy, sizeof copy, "%s", text);
    for (char *word = strtok_r(copy, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        char *equals = strchr(word, '=');
        if (equals == NULL) {
            return bad_word(name, word, log);
        }
        *equals = '\0';
        int i   = 0;
        while (i < KEYS && strcmp(keys[i].name, word) != 0) {
            i++;
        }
        if (i < KEYS && (seen[i] || !parse_value(info, &keys[i], equals + 1))) {
            *equals = '=';
            return bad_word(name, word, log);
        }
        if (i < KEYS) {
            seen[i] = true;
        }
    }
    for (int i = 0; i < KEYS; i++) {
        if (map && keys[i].of_map && !seen[i]) {
            return hc_fail(log, HC_ERROR_FORMAT,
                           "%s: its heightcast metadata lacks the key \"%s\"; bake it again", name,
                           keys[i].name);
        }
    }
    return HC_OK;
}

bool hc_text_is_map(const char *text)
{
    return strncmp(text, SIGNATURE_MAP " ", sizeof SIGNATURE_MAP) == 0;
}

hc_result hc_text_to_map(hc_map_info *info, const char *text, const char *name, hc_log *log)
{
    if (!hc_text_is_map(text)) {
        return hc_fail(log, HC_ERROR_FORMAT,
                       "%s: has no metadata of a heightcast map; bake the map anew, or load the "
                       "file as a field",
                       name);
    }
    const hc_result parsed = parse_keys(info, text, true, name, log);
    if (parsed != HC_OK) {
        return parsed;
    }
    hc_log inner = { 0 };
    if (hc_map_info_check(info, &inner) != HC_OK) {
        return hc_fail(log, HC_ERROR_FORMAT, "%s: its heightcast metadata is wrong: %s", name,
                       inner.text);
    }
    return HC_OK;
}

hc_result hc_text_to_field(hc_elevation *elevation, const char *text, const char *name, hc_log *log)
{
    hc_map_info     info;
    const hc_result parsed = parse_keys(&info, text, false, name, log);
    *elevation             = info.elevation;
    return parsed;
}

void hc_image_take_text(hc_image *image, const char *bytes, size_t length)
{
    while (length > 0 && (bytes[length - 1] == '\0' || bytes[length - 1] == '\n')) {
        length--;
    }
    const bool ours =
        length >= sizeof SIGNATURE - 1 && memcmp(bytes, SIGNATURE, sizeof SIGNATURE - 1) == 0;
    if (ours && length < HC_TEXT_SIZE && memchr(bytes, '\0', length) == NULL) {
        memcpy(image->text, bytes, length);
        image->text[length] = '\0';
    }
}
