/* The commands: one file each, one row each in the table of program.c. */
#ifndef HC_CLI_COMMANDS_H
#define HC_CLI_COMMANDS_H

#include "cli.h"

typedef struct hc_cli_command {
    const char *name;
    unsigned    bit;
    int (*run)(hc_cli *cli); /* returns the exit code                       */
    const char *arguments;   /* as the usage line shows them                */
    int         paths_min, paths_max;
    const char *summary;   /* one line                                      */
    const char *notes;     /* more for --help, newline-separated paragraphs */
    bool        on_stdout; /* the figures are what was asked for            */
} hc_cli_command;

/* Ends with a row whose name is NULL. */
extern const hc_cli_command hc_cli_commands[];

int hc_cli_run_bake(hc_cli *cli);
int hc_cli_run_gen(hc_cli *cli);
int hc_cli_run_info(hc_cli *cli);
int hc_cli_run_show(hc_cli *cli);
int hc_cli_run_compare(hc_cli *cli);
int hc_cli_run_verify(hc_cli *cli);
int hc_cli_run_trace(hc_cli *cli);
int hc_cli_run_render(hc_cli *cli);
int hc_cli_run_terrain(hc_cli *cli);
int hc_cli_run_bench(hc_cli *cli);

/* The whole program; returns the exit code. */
int hc_cli_main(int argc, char **argv);

/* The help of the program, and of one command. */
void hc_cli_help(void);
void hc_cli_help_command(const hc_cli_command *command);

#endif
