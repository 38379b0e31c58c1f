/* What every command gets: its settings, and the ways to say something: errors, phases, figures. */
#ifndef HC_CLI_H
#define HC_CLI_H

#include "bar.h"
#include "settings.h"

#include <cjson/cJSON.h>

enum {
    HC_CLI_DONE          = 0,
    HC_CLI_USAGE         = 1,
    HC_CLI_INPUT_OUTPUT  = 2,
    HC_CLI_BAD_FILE      = 3,
    HC_CLI_MEMORY        = 4,
    HC_CLI_VERIFY_FAILED = 5
    /* 128 + the signal after Ctrl-C and its like */
};

typedef struct hc_cli {
    const char     *command;
    hc_cli_settings settings;
    hc_log          log;
    bool            on_stdout; /* where figures for people go      */
    cJSON          *json;      /* what --json prints at the end    */
    cJSON          *seconds;   /* member of `json`                 */
    cJSON          *group;     /* where figures go now             */
    bool            detail;    /* the next figures are for -v only */
    const char     *phase;     /* name of the running one, or NULL */
    double          phase_start, total_start;
    hc_cli_bar      bar;
} hc_cli;

/* Fill in a zeroed cli whose `command` and `settings` are set. */
void hc_cli_begin(hc_cli *cli);
/* The JSON object so far, to be freed with cJSON_free; NULL: no memory. */
char *hc_cli_json_text(const hc_cli *cli);
/* End the running phase, print the JSON object if asked for, free. Returns the exit code: `code`,
 * or HC_CLI_INPUT_OUTPUT if standard output could not take everything. */
int hc_cli_finish(hc_cli *cli, int code);

/* ---- errors: one line on standard error, "error" in the JSON object; they return the exit code */
__attribute__((format(printf, 3, 4))) int hc_cli_fail(hc_cli *cli, int code, const char *format,
                                                      ...);
/* For a result of the library, whose words are in cli->log. */
int hc_cli_fail_result(hc_cli *cli, hc_result result);
int hc_cli_fail_memory(hc_cli *cli);
/* True if the CPU may do what OpenGL could not: with --backend gl where there is no OpenGL for it,
 * with auto after any failure of graphics. Then it has been warned of, and the backend is the CPU.
 * `does`: "bakes", "draws". */
bool hc_cli_falls_back(hc_cli *cli, hc_result result, const char *does);

/* "warning: ..." on standard error, unless -q; "warnings" in the JSON object. */
__attribute__((format(printf, 2, 3))) void hc_cli_warn(hc_cli *cli, const char *format, ...);

/* ---- phases: members of "seconds", words beside the progress bar ---- */
void        hc_cli_phase(hc_cli *cli, const char *name);          /* NULL ends the last */
hc_progress hc_cli_progress(hc_cli *cli);                         /* bar, and stop on signals  */
double      hc_cli_seconds(const hc_cli *cli, const char *phase); /* of a phase that has ended */

/* ---- figures: each has a name in the JSON object and a line for people ---- */
/* The next figures become members of the object `name`; NULL: of the whole. */
void hc_cli_group(hc_cli *cli, const char *name);
/* The next figures are shown to people with -v only. */
void hc_cli_details(hc_cli *cli, bool on);
void hc_cli_text(hc_cli *cli, const char *name, const char *value);
void hc_cli_number(hc_cli *cli, const char *name, double value, const char *unit);
void hc_cli_flag(hc_cli *cli, const char *name, bool value);
/* A line for people alone: headings, tables, figures already in the object. */
__attribute__((format(printf, 2, 3))) void hc_cli_say(hc_cli *cli, const char *format, ...);

#endif
