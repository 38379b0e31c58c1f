/* From the text of a value to its place in the settings. */
#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *target_of(const hc_cli_option *option, hc_cli_settings *settings)
{
    return (char *)settings + option->target;
}

/* A finite number at the start of `text` that ends before `end` (a character, '\0' for all of it).
 * Sets *rest to what follows that character. */
static bool number_until(const char *text, char end, double *value, const char **rest)
{
    char *stop = NULL;
    errno      = 0;
    *value     = strtod(text, &stop);
    if (stop == text || *stop != end || errno == ERANGE || !isfinite(*value)) {
        return false;
    }
    *rest = end == '\0' ? stop : stop + 1;
    return true;
}

/* Digits only: strtol alone would take spaces, signs and an empty text. */
static bool whole_until(const char *text, char end, int low, int high, int *value,
                        const char **rest)
{
    const size_t digits = strspn(text, "0123456789");
    if (digits == 0 || digits > 9 || text[digits] != end) {
        return false;
    }
    *value = (int)strtol(text, NULL, 10);
    *rest  = end == '\0' ? text + digits : text + digits + 1;
    return *value >= low && *value <= high;
}

bool hc_cli_read_int(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    return whole_until(text, '\0', (int)option->low, (int)option->high, target_of(option, settings),
                       &text);
}

bool hc_cli_read_u64(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    const size_t digits = strspn(text, "0123456789");
    uint64_t    *value  = target_of(option, settings);
    if (digits == 0 || text[digits] != '\0') {
        return false;
    }
    errno  = 0;
    *value = strtoull(text, NULL, 10);
    return errno == 0 && *value >= (uint64_t)option->low;
}

bool hc_cli_read_float(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    double value = 0.0;
    if (!number_until(text, '\0', &value, &text) || value <= option->low || value > option->high) {
        return false;
    }
    *(float *)target_of(option, settings) = (float)value;
    return (float)value > 0.0F;
}

static int word_index(const hc_cli_option *option, const char *text)
{
    for (int i = 0; option->words(i) != NULL; i++) {
        if (strcmp(option->words(i), text) == 0) {
            return i;
        }
    }
    return -1;
}

bool hc_cli_read_word(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    const int index = word_index(option, text);
    if (index >= 0) {
        /* The targets are enums, which have the size of an int here and not always its sign. */
        memcpy(target_of(option, settings), &index, sizeof index);
    }
    return index >= 0;
}

bool hc_cli_read_number_word(const hc_cli_option *option, const char *text,
                             hc_cli_settings *settings)
{
    return word_index(option, text) >= 0
           && whole_until(text, '\0', 0, 1 << 20, target_of(option, settings), &text);
}

bool hc_cli_read_size(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    hc_cli_size *size = target_of(option, settings);
    if (whole_until(text, '\0', 1, HC_SIDE_MAX, &size->width, &text)) {
        size->height = size->width;
        return true;
    }
    return whole_until(text, 'x', 1, HC_SIDE_MAX, &size->width, &text)
           && whole_until(text, '\0', 1, HC_SIDE_MAX, &size->height, &text);
}

bool hc_cli_read_range(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    hc_normalise_options *normalise = target_of(option, settings);
    const int             index     = word_index(option, text);
    if (index >= 0) {
        normalise->range = (hc_range)index;
        return true;
    }
    normalise->range = HC_RANGE_GIVEN;
    return number_until(text, ':', &normalise->low, &text)
           && number_until(text, '\0', &normalise->high, &text)
           && normalise->low != normalise->high;
}

bool hc_cli_read_point(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    double *point = target_of(option, settings);
    return number_until(text, ',', &point[0], &text) && number_until(text, ',', &point[1], &text)
           && number_until(text, '\0', &point[2], &text);
}

bool hc_cli_read_spacing(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    double *spacing = target_of(option, settings);
    if (number_until(text, '\0', &spacing[0], &text)) {
        spacing[1] = spacing[0];
        return spacing[0] > 0.0;
    }
    return number_until(text, ',', &spacing[0], &text)
           && number_until(text, '\0', &spacing[1], &text) && spacing[0] > 0.0 && spacing[1] > 0.0;
}

bool hc_cli_read_rise(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    double *ends = target_of(option, settings);
    return number_until(text, ':', &ends[0], &text) && number_until(text, '\0', &ends[1], &text)
           && ends[0] < ends[1];
}

bool hc_cli_read_tiles(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    int      *tiles = target_of(option, settings);
    const int most  = (int)option->high;
    if (whole_until(text, '\0', 1, most, &tiles[0], &text)) {
        tiles[1] = tiles[0];
        return true;
    }
    return whole_until(text, ',', 1, most, &tiles[0], &text)
           && whole_until(text, '\0', 1, most, &tiles[1], &text);
}

bool hc_cli_read_share(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    double *share = target_of(option, settings);
    return number_until(text, '\0', share, &text) && *share >= 0.0 && *share <= 1.0;
}

/* The name of a file, up to a comma. */
static bool name_until_comma(char name[HC_CLI_PATH_LENGTH], const char **text)
{
    const size_t length = strcspn(*text, ",");
    if (length == 0 || length >= HC_CLI_PATH_LENGTH) {
        return false;
    }
    memcpy(name, *text, length);
    name[length] = '\0';
    *text += length + ((*text)[length] == ',' ? 1 : 0);
    return true;
}

/* A number above 0 at the start, up to a comma or the end. */
static bool length_until_comma(double *value, const char **text)
{
    const char end = strchr(*text, ',') != NULL ? ',' : '\0';
    return number_until(*text, end, value, text) && *value > 0.0;
}

/* What is no number behind the map is its colour. */
bool hc_cli_read_detail(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    hc_cli_detail_list *details = target_of(option, settings);
    if (details->count == HC_DETAILS_MAX) {
        return false;
    }
    hc_cli_detail *detail  = &details->maps[details->count++];
    double        *sizes[] = { &detail->tile, &detail->depth };
    double         number;
    const char    *rest = text;
    if (!name_until_comma(detail->map, &rest)) {
        return false;
    }
    text = rest;
    if (*text != '\0' && !length_until_comma(&number, &rest)) {
        rest = text;
        if (!name_until_comma(detail->colour, &rest)) {
            return false;
        }
        text = rest;
    }
    for (int i = 0; i < 2 && *text != '\0'; i++) {
        if (!length_until_comma(sizes[i], &text)) {
            return false;
        }
    }
    return *text == '\0';
}

/* "u16be" and the like: the type, and the byte order behind it. */
static bool read_sample_type(const char *text, hc_load_options *load)
{
    static const char *const names[] = { "u8", "u16", "i16", "u32", "i32", "f32", "f64" };
    for (int type = 0; type < (int)(sizeof names / sizeof *names); type++) {
        const size_t length = strlen(names[type]);
        const char  *order  = text + length;
        if (strncmp(text, names[type], length) == 0
            && (*order == '\0' || strcmp(order, "be") == 0 || strcmp(order, "le") == 0)) {
            load->raw_type       = (hc_sample_type)type;
            load->raw_big_endian = strcmp(order, "be") == 0;
            return true;
        }
    }
    return false;
}

bool hc_cli_read_raw(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    hc_load_options *load = target_of(option, settings);
    return whole_until(text, 'x', 1, HC_SIDE_MAX, &load->raw_width, &text)
           && whole_until(text, ':', 1, HC_SIDE_MAX, &load->raw_height, &text)
           && read_sample_type(text, load);
}

bool hc_cli_read_text(const hc_cli_option *option, const char *text, hc_cli_settings *settings)
{
    *(const char **)target_of(option, settings) = text;
    return *text != '\0';
}

void hc_cli_join_words(char *text, size_t size, hc_cli_words *words, const char *separator)
{
    size_t used = 0;
    text[0]     = '\0';
    for (int i = 0; words(i) != NULL && used < size; i++) {
        const int wrote =
            snprintf(text + used, size - used, "%s%s", i == 0 ? "" : separator, words(i));
        used += wrote > 0 ? (size_t)wrote : 0;
    }
}
