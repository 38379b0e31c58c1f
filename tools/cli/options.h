/* Options: one table, one parser, one help text for all commands. */
#ifndef HC_CLI_OPTIONS_H
#define HC_CLI_OPTIONS_H

#include "settings.h"

#include <stddef.h>

/* Which commands an option belongs to: one bit for each. */
enum {
    HC_CLI_BAKE    = 1,
    HC_CLI_GEN     = 2,
    HC_CLI_INFO    = 4,
    HC_CLI_COMPARE = 8,
    HC_CLI_VERIFY  = 16,
    HC_CLI_BENCH   = 32,
    HC_CLI_SHOW    = 64,
    HC_CLI_TRACE   = 128,
    HC_CLI_RENDER  = 256,
    HC_CLI_TERRAIN = 512,
    HC_CLI_ALL     = 1023
};

typedef enum hc_cli_section {
    HC_CLI_SECTION_INPUT = 0,
    HC_CLI_SECTION_MAP,
    HC_CLI_SECTION_WORK, /* what only this command does */
    HC_CLI_SECTION_COMMON,
    HC_CLI_SECTIONS
} hc_cli_section;

typedef struct hc_cli_option hc_cli_option;

/* Read the value `text` into settings at option->target; false if it is not allowed. */
typedef bool hc_cli_reader(const hc_cli_option *option, const char *text,
                           hc_cli_settings *settings);

/* The allowed words of an option by index, NULL beyond the last. */
typedef const char *hc_cli_words(int index);

struct hc_cli_option {
    const char    *name;
    char           letter; /* 0: none */
    unsigned       commands;
    hc_cli_section section;
    hc_cli_reader *read;      /* NULL: a switch, `target` is a bool                           */
    size_t         target;    /* offset in hc_cli_settings                                    */
    hc_cli_words  *words;     /* for hc_cli_read_word and hc_cli_read_number_word             */
    double         low, high; /* for numbers                                               */
    const char    *metavar;   /* shown in the help; NULL: the words joined by |, or none    */
    const char    *allowed;   /* shown when a value is refused; NULL: the words            */
    const char    *help;
    bool           optional; /* the value may be left out, which means "-"                */
};

/* The table; ends with a row whose name is NULL. */
extern const hc_cli_option hc_cli_options[];

/* Row of the option `name`, which must exist. */
const hc_cli_option *hc_cli_option_named(const char *name);
/* True if the command line had the option `name`. */
bool hc_cli_given(const hc_cli_settings *settings, const char *name);

/* Readers: an int or uint64_t in low .. high, a float above low and up to high, a word as its
 * index, a word that is itself the number, "WIDTHxHEIGHT" or one side, range, RAW description, text
 * as it is, three numbers "X,Y,Z", one or two positive distances "X,Y", rising numbers "LOW:HIGH",
 * one or two tile counts "U,V", a double from 0 to 1, one more of hc_cli_detail_list. */
hc_cli_reader hc_cli_read_int, hc_cli_read_u64, hc_cli_read_float, hc_cli_read_word,
    hc_cli_read_number_word, hc_cli_read_size, hc_cli_read_range, hc_cli_read_raw, hc_cli_read_text,
    hc_cli_read_point, hc_cli_read_spacing, hc_cli_read_rise, hc_cli_read_tiles, hc_cli_read_share,
    hc_cli_read_detail;

/* Words of an option as "a, b, c" (separator ", ") or "a|b|c". */
void hc_cli_join_words(char *text, size_t size, hc_cli_words *words, const char *separator);

/* Parse argv[1 ..] for the command whose bit is `command`. On false, `error` holds one line: the
 * flag, the value, what is allowed, and a near name if there is one. */
bool hc_cli_parse(hc_cli_settings *settings, unsigned command, int argc, char **argv, char *error,
                  size_t error_size);

/* The name in `words` nearest to `text`, or NULL if none is near. */
const char *hc_cli_nearest(const char *text, hc_cli_words *words);

#endif
