#include "bench_run.h"

#include "interrupt.h"

#include <stdio.h>
#include <stdlib.h>

static bool stopped(void)
{
    return hc_cli_caught_signal() != 0;
}

hc_bench_plan hc_cli_plan(const hc_cli *cli, const hc_cli_grounds *in)
{
    const hc_cli_settings *settings = &cli->settings;
    return (hc_bench_plan){ .fields       = in->grounds,
                            .field_count  = in->fields.count,
                            .sides        = in->numbers,
                            .side_count   = in->sides.count,
                            .methods      = in->methods.items,
                            .method_count = in->methods.count,
                            .seed         = settings->seed,
                            .repeat       = settings->repeat,
                            .threads      = settings->threads,
                            .isa          = settings->map.cone.isa,
                            .stop         = stopped };
}

hc_bench_plan hc_cli_run_plan(const hc_cli_run *run)
{
    return hc_cli_plan(run->cli, &run->in);
}

bool hc_cli_run_add(hc_cli_run *run, const void *row, size_t size, cJSON *object, const char *csv)
{
    void *rows = hc_cli_add_row(run->rows, run->count, row, size);
    (void)cJSON_AddItemToArray(run->list, object);
    hc_cli_csv_add(&run->csv, csv);
    if (rows == NULL) {
        run->failed = true;
        return false;
    }
    run->rows = rows;
    run->count++;
    return true;
}

void hc_cli_run_flush(const hc_cli_run *run)
{
    if (run->cli->on_stdout) {
        (void)fflush(stdout);
    }
}

static int measure(hc_cli_run *run, const hc_cli_run_kind *kind)
{
    hc_bench_machine_read(&run->machine);
    hc_cli_text(run->cli, "bench", kind->name);
    hc_cli_show_machine(run->cli, &run->machine);
    run->list = cJSON_AddArrayToObject(run->cli->json, "rows");
    hc_cli_csv_add(&run->csv, kind->columns);
    kind->head(run);
    const hc_result result = kind->measure(run);
    if (result != HC_OK) {
        return hc_cli_fail_result(run->cli, result);
    }
    return run->failed || run->csv.failed ? hc_cli_fail_memory(run->cli) : HC_CLI_DONE;
}

int hc_cli_bench_run(hc_cli *cli, const hc_cli_run_kind *kind)
{
    hc_cli_run run  = { .cli = cli };
    int        code = hc_cli_read_grounds(cli, &run.in, kind->fields, kind->sides, kind->methods);
    if (code == HC_CLI_DONE) {
        code = measure(&run, kind);
    }
    if (code == HC_CLI_DONE) {
        kind->figures(&run);
        code = hc_cli_write_reports(cli, run.csv.text);
    }
    hc_cli_free_grounds(&run.in);
    free(run.rows);
    free(run.csv.text);
    return code;
}
