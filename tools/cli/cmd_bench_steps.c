/* heightcast bench steps: steps of rays on fields of growing size, as a table, JSON and CSV. */
#include "bench_report.h"
#include "bench_trace.h"
#include "interrupt.h"

#include "bench/steps_bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256 };

typedef struct report {
    hc_cli             *cli;
    hc_bench_machine    machine;
    hc_bench_steps_row *rows;
    int                 count;
    cJSON              *list;
    hc_cli_csv          csv;
    bool                failed;
} report;

static void row_done(void *user, const hc_bench_steps_row *row)
{
    report             *r = user;
    char                line[LINE_MAX_BYTES];
    hc_bench_steps_row *rows = hc_cli_add_row(r->rows, r->count, row, sizeof *row);
    if (rows == NULL) {
        r->failed = true;
        return;
    }
    r->rows = rows;
    r->count++;
    cJSON *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "rays", row->rays);
    (void)cJSON_AddStringToObject(object, "method", row->method);
    (void)cJSON_AddNumberToObject(object, "count", (double)row->count);
    (void)cJSON_AddNumberToObject(object, "hits", row->hits);
    (void)cJSON_AddNumberToObject(object, "mean_steps", row->mean);
    (void)cJSON_AddNumberToObject(object, "steps_99", row->most99);
    (void)cJSON_AddNumberToObject(object, "worst_steps", row->worst);
    (void)cJSON_AddItemToArray(r->list, object);
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s,%zu,%.4g,%.6g,%.0f,%.0f\n", row->field,
                   row->side, row->rays, row->method, row->count, row->hits, row->mean, row->most99,
                   row->worst);
    hc_cli_csv_add(&r->csv, line);
    hc_cli_say(r->cli, "%-10s %5d %-7s %-8s %6.3f %10.2f %8.0f %8.0f\n", row->field, row->side,
               row->rays, row->method, row->hits, row->mean, row->most99, row->worst);
    if (r->cli->on_stdout) {
        (void)fflush(stdout); /* a long run shows what it has */
    }
}

/* The row of the same rays and method on the field of another side. */
static const hc_bench_steps_row *at_side(const report *r, const hc_bench_steps_row *like, int side)
{
    for (int i = 0; i < r->count; i++) {
        const hc_bench_steps_row *row = &r->rows[i];
        if (row->side == side && row->field == like->field && strcmp(row->rays, like->rays) == 0
            && strcmp(row->method, like->method) == 0) {
            return row;
        }
    }
    return NULL;
}

static void add_figure(report *r, cJSON *list, const hc_bench_steps_row *from,
                       const hc_bench_steps_row *to)
{
    const double doublings = log2((double)to->side / from->side);
    const double mean      = pow(to->mean / from->mean, 1.0 / doublings);
    const double most99    = pow(to->most99 / from->most99, 1.0 / doublings);
    const double worst     = pow(to->worst / from->worst, 1.0 / doublings);
    cJSON       *object    = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", to->field);
    (void)cJSON_AddStringToObject(object, "rays", to->rays);
    (void)cJSON_AddStringToObject(object, "method", to->method);
    (void)cJSON_AddNumberToObject(object, "from_side", from->side);
    (void)cJSON_AddNumberToObject(object, "to_side", to->side);
    (void)cJSON_AddNumberToObject(object, "growth_mean", mean);
    (void)cJSON_AddNumberToObject(object, "growth_99", most99);
    (void)cJSON_AddNumberToObject(object, "growth_worst", worst);
    (void)cJSON_AddItemToArray(list, object);
    hc_cli_say(r->cli, "%-10s %-7s %-8s %10.2f %8.2f %8.2f\n", to->field, to->rays, to->method,
               mean, most99, worst);
}

/* Growth of the steps when the side doubles, from the middle one of the sides to the last. Steps
 * that grow as its logarithm do by log(last) / log(middle) over all these doublings. */
static void add_figures(report *r, const hc_cli_grounds *in)
{
    cJSON       *list  = cJSON_AddArrayToObject(r->cli->json, "figures");
    const int    first = in->numbers[(in->sides.count - 1) / 2];
    const int    last  = in->numbers[in->sides.count - 1];
    const double log_n = pow(log(last) / log(first), 1.0 / log2((double)last / first));
    if (first < 2 || last <= first) {
        return;
    }
    hc_cli_say(r->cli, "\nTimes as many steps for twice the side, from %d to %d (as log n: %.2f)\n",
               first, last, log_n);
    for (int i = 0; i < r->count; i++) {
        const hc_bench_steps_row *from = at_side(r, &r->rows[i], first);
        if (r->rows[i].side == last && from != NULL && from->most99 > 0.0) {
            add_figure(r, list, from, &r->rows[i]);
        }
    }
}

static bool stop_asked(void)
{
    return hc_cli_caught_signal() != 0;
}

static int measure(hc_cli *cli, const hc_cli_grounds *in, report *r)
{
    const hc_cli_settings       *settings = &cli->settings;
    const hc_bench_steps_options options  = { .fields       = in->grounds,
                                              .field_count  = in->fields.count,
                                              .sides        = in->numbers,
                                              .side_count   = in->sides.count,
                                              .methods      = in->methods.items,
                                              .method_count = in->methods.count,
                                              .seed         = settings->seed,
                                              .rays         = (size_t)settings->rays.count,
                                              .threads      = settings->threads,
                                              .isa          = settings->map.cone.isa,
                                              .stop         = stop_asked,
                                              .row_done     = row_done,
                                              .user         = r };
    const hc_result              result   = hc_bench_steps(&options, &cli->log);
    if (result == HC_OK && (r->failed || r->csv.failed)) {
        return hc_cli_fail_memory(cli);
    }
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

static void begin(report *r)
{
    hc_bench_machine_read(&r->machine);
    hc_cli_text(r->cli, "bench", "steps");
    hc_cli_show_machine(r->cli, &r->machine);
    r->list = cJSON_AddArrayToObject(r->cli->json, "rows");
    hc_cli_csv_add(&r->csv, "field,side,rays,method,count,hits,mean_steps,steps_99,worst_steps\n");
    hc_cli_say(r->cli, "\n%-10s %5s %-7s %-8s %6s %10s %8s %8s\n", "field", "side", "rays",
               "method", "hits", "mean steps", "99 %", "worst");
}

int hc_cli_run_bench_steps(hc_cli *cli)
{
    hc_cli_grounds in = { 0 };
    report         r  = { .cli = cli };
    int code = hc_cli_read_grounds(cli, &in, "fbm", "64,128,256,512,1024", hc_bench_steps_method);
    if (code == HC_CLI_DONE) {
        begin(&r);
        code = measure(cli, &in, &r);
    }
    if (code == HC_CLI_DONE) {
        add_figures(&r, &in);
        code = hc_cli_write_reports(cli, r.csv.text);
    }
    hc_cli_free_grounds(&in);
    free(r.rows);
    free(r.csv.text);
    return code;
}
