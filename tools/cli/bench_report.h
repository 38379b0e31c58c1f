/* Measurements as they come in: a line of the table, a JSON object, a line of CSV; figures at the
 * end. */
#ifndef HC_CLI_BENCH_REPORT_H
#define HC_CLI_BENCH_REPORT_H

#include "cli.h"

#include "bench/bake_bench.h"
#include "bench/machine.h"

/* Lines of CSV so far. Zero: none. Free `text`. */
typedef struct hc_cli_csv {
    char  *text;
    size_t size;
    bool   failed; /* memory ran out: lines are missing */
} hc_cli_csv;

void hc_cli_csv_add(hc_cli_csv *csv, const char *line);

/* Append a row of `size` bytes to rows[count], which is NULL or came from here: the rows, perhaps
 * moved, or NULL if memory ran out; the old ones are then still there. */
void *hc_cli_add_row(void *rows, int count, const void *row, size_t size);

typedef struct hc_cli_bench {
    hc_cli          *cli;
    const hc_gpu    *gpu; /* NULL: the CPU is measured */
    hc_bench_machine machine;
    hc_bench_row    *rows; /* their field names are those of the command line */
    int              count;
    cJSON           *list; /* member "rows" of cli->json                      */
    hc_cli_csv       csv;
    bool             failed; /* memory ran out: rows are missing              */
} hc_cli_bench;

/* The head of every report. */
void hc_cli_show_machine(hc_cli *cli, const hc_bench_machine *machine);

/* Read the machine, print the head. Returns the exit code. */
int hc_cli_bench_begin(hc_cli_bench *bench);
/* hc_bench_options.row_done; `user` is the bench. */
void hc_cli_bench_row(void *user, const hc_bench_row *row);
/* Ratios between rows: against ring and quick-improved, threads, growth. */
void hc_cli_bench_figures(hc_cli_bench *bench);
void hc_cli_bench_end(hc_cli_bench *bench);

#endif
