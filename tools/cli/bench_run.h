/* `bench trace`, `steps`, `render` and `terrain`: what they measure differs, but not how it is
 * asked for and reported. */
#ifndef HC_CLI_BENCH_RUN_H
#define HC_CLI_BENCH_RUN_H

#include "bench_report.h"
#include "grounds.h"

typedef struct hc_cli_run {
    hc_cli          *cli;
    hc_cli_grounds   in;
    hc_bench_machine machine;
    void            *rows; /* one type of row a command, in the order of measuring */
    int              count;
    cJSON           *list; /* member "rows" of cli->json        */
    hc_cli_csv       csv;
    bool             failed; /* memory ran out: rows are missing */
} hc_cli_run;

typedef struct hc_cli_run_kind {
    const char   *name;
    const char   *fields, *sides; /* where --field and --sizes are not given */
    hc_cli_words *methods;        /* NULL: --methods is not checked          */
    const char   *columns;        /* first line of the CSV                   */
    void (*head)(hc_cli_run *run);
    hc_result (*measure)(hc_cli_run *run);
    void (*figures)(hc_cli_run *run);
} hc_cli_run_kind;

/* Returns the exit code. */
int hc_cli_bench_run(hc_cli *cli, const hc_cli_run_kind *kind);

/* What the command line says of the fields, the methods and the runs. */
hc_bench_plan hc_cli_plan(const hc_cli *cli, const hc_cli_grounds *in);
hc_bench_plan hc_cli_run_plan(const hc_cli_run *run);

/* Keep a row; its object and its line of CSV are added to the reports. False: memory ran out. */
bool hc_cli_run_add(hc_cli_run *run, const void *row, size_t size, cJSON *object, const char *csv);
/* Show what there is of a long run. */
void hc_cli_run_flush(const hc_cli_run *run);

int hc_cli_run_bench_trace(hc_cli *cli);
int hc_cli_run_bench_steps(hc_cli *cli);
int hc_cli_run_bench_render(hc_cli *cli);
int hc_cli_run_bench_terrain(hc_cli *cli);

#endif
