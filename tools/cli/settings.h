/* What the command line said: the one struct that all options of all commands write into. */
#ifndef HC_CLI_SETTINGS_H
#define HC_CLI_SETTINGS_H

#include <heightcast/bake.h>
#include <heightcast/io.h>

#define HC_CLI_PATHS_MAX 2

typedef enum hc_cli_backend { HC_CLI_CPU = 0, HC_CLI_GL } hc_cli_backend;

typedef struct hc_cli_size {
    int width, height; /* 0: not given */
} hc_cli_size;

/* All zero: the defaults, as the library's own option structs have them. */
typedef struct hc_cli_settings {
    const char     *paths[HC_CLI_PATHS_MAX]; /* what is not an option, in order */
    int             path_count;
    hc_load_options load;
    hc_map_options  map;
    hc_save_options save;
    int             compat; /* 2006, or 0 */
    hc_cli_backend  backend;
    int             threads;
    hc_cli_size     size;
    uint64_t        seed;
    bool            list, all;
    int             texels;
    const char     *diff, *heights, *out;
    const char     *sizes, *fields, *methods; /* bench: comma-separated */
    int             repeat;
    const char     *report; /* bench: file for --json, "-" is standard output */
    const char     *csv;
    bool            json, quiet, verbose, help, version;
    uint64_t        given; /* one bit for each row of the option table */
} hc_cli_settings;

#endif
