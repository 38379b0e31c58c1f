/* `bench trace`, and what it shares with `bench bake`. */
#ifndef HC_CLI_BENCH_TRACE_H
#define HC_CLI_BENCH_TRACE_H

#include "cli.h"
#include "lists.h"
#include "options.h"

/* Split the value of --NAME and check each item against `words` (NULL: none). */
int hc_cli_read_list(hc_cli *cli, hc_cli_list *list, const char *name, const char *text,
                     hc_cli_words *words);
/* --sizes, or `otherwise`, as numbers. */
int hc_cli_read_sides(hc_cli *cli, hc_cli_list *sides, int numbers[HC_CLI_LIST_MAX],
                      const char *otherwise);
/* cli->json and the text of the CSV, where they are asked for. */
int hc_cli_write_reports(hc_cli *cli, const char *csv);

int hc_cli_run_bench_trace(hc_cli *cli);

#endif
