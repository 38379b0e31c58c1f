/* What the measurements are asked for, and where their reports go. */
#ifndef HC_CLI_GROUNDS_H
#define HC_CLI_GROUNDS_H

#include "cli.h"
#include "lists.h"
#include "options.h"

#include "bench/plan.h"

/* An item of the value of --NAME. */
int hc_cli_check_item(hc_cli *cli, const char *name, const char *item, hc_cli_words *words);
/* Split the value of --NAME and check each item against `words` (NULL: none). */
int hc_cli_read_list(hc_cli *cli, hc_cli_list *list, const char *name, const char *text,
                     hc_cli_words *words);
/* --sizes, or `otherwise`, as numbers. */
int hc_cli_read_sides(hc_cli *cli, hc_cli_list *sides, int numbers[HC_CLI_LIST_MAX],
                      const char *otherwise);
/* cli->json and the text of the CSV, where they are asked for. */
int hc_cli_write_reports(hc_cli *cli, const char *csv);

/* What the options --sizes, --field and --methods name. Zero: nothing. */
typedef struct hc_cli_grounds {
    hc_cli_list     sides, fields, methods;
    int             numbers[HC_CLI_LIST_MAX];
    hc_bench_ground grounds[HC_CLI_LIST_MAX];
    hc_field        tiles[HC_CLI_LIST_MAX];
} hc_cli_grounds;

/* Fields are names of made ones, or files: what has a dot. Their heights fill 0 to 1, as those of
 * made ones do. hc_cli_free_grounds must follow, whatever the exit code is. */
int hc_cli_read_grounds(hc_cli *cli, hc_cli_grounds *grounds, const char *fields, const char *sides,
                        hc_cli_words *methods);
void hc_cli_free_grounds(hc_cli_grounds *grounds);

#endif
