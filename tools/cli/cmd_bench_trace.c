/* heightcast bench trace: casters on the same rays, as a table, JSON and CSV. */
#include "bench_report.h"
#include "bench_trace.h"
#include "interrupt.h"

#include "bench/trace_bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 512 };

typedef struct report {
    hc_cli             *cli;
    hc_bench_machine    machine;
    hc_bench_trace_row *rows; /* one scene and size after another */
    int                 count;
    cJSON              *list;
    hc_cli_csv          csv;
    bool                failed;
} report;

static void add_json(report *r, const hc_bench_trace_row *row)
{
    cJSON *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "rays", row->rays);
    (void)cJSON_AddStringToObject(object, "caster", row->caster);
    (void)cJSON_AddStringToObject(object, "mode", row->mode);
    (void)cJSON_AddNumberToObject(object, "threads", row->threads);
    (void)cJSON_AddNumberToObject(object, "count", (double)row->count);
    (void)cJSON_AddNumberToObject(object, "runs", row->runs);
    (void)cJSON_AddNumberToObject(object, "seconds", row->seconds);
    (void)cJSON_AddNumberToObject(object, "rays_per_second", row->rays_per_second);
    (void)cJSON_AddNumberToObject(object, "hits", row->hits);
    (void)cJSON_AddNumberToObject(object, "build_seconds", row->build_seconds);
    (void)cJSON_AddNumberToObject(object, "bytes", row->bytes);
    (void)cJSON_AddItemToArray(r->list, object);
}

static void row_done(void *user, const hc_bench_trace_row *row)
{
    report             *r       = user;
    const double        samples = (double)row->side * (double)row->side;
    char                line[LINE_MAX_BYTES];
    hc_bench_trace_row *rows = hc_cli_add_row(r->rows, r->count, row, sizeof *row);
    if (rows == NULL) {
        r->failed = true;
        return;
    }
    r->rows = rows;
    r->count++;
    add_json(r, row);
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s,%s,%d,%zu,%d,%.6g,%.6g,%.4g,%.6g,%.0f\n",
                   row->field, row->side, row->rays, row->caster, row->mode, row->threads,
                   row->count, row->runs, row->seconds, row->rays_per_second, row->hits,
                   row->build_seconds, row->bytes);
    hc_cli_csv_add(&r->csv, line);
    hc_cli_say(r->cli, "%-10s %5d %-7s %-16s %-8s %7d %10.2f %6.3f %10.1f %8.1f\n", row->field,
               row->side, row->rays, row->caster, row->mode, row->threads,
               1e-6 * row->rays_per_second, row->hits, 1e9 * row->build_seconds / samples,
               row->bytes / samples);
    if (r->cli->on_stdout) {
        (void)fflush(stdout); /* a long run shows what it has */
    }
}

/* The fastest of others on the rays of `like`; NULL: there is none. */
static const hc_bench_trace_row *best_other(const report *r, const hc_bench_trace_row *like)
{
    const hc_bench_trace_row *best = NULL;
    for (int i = 0; i < r->count; i++) {
        const hc_bench_trace_row *row = &r->rows[i];
        if (row->side == like->side && row->field == like->field && row->threads == like->threads
            && strcmp(row->rays, like->rays) == 0 && strcmp(row->caster, "fast") != 0
            && (best == NULL || row->rays_per_second > best->rays_per_second)) {
            best = row;
        }
    }
    return best;
}

static const hc_bench_trace_row *other_threads(const report *r, const hc_bench_trace_row *like)
{
    for (int i = 0; i < r->count; i++) {
        const hc_bench_trace_row *row = &r->rows[i];
        if (row->side == like->side && row->field == like->field && row->threads > 1
            && strcmp(row->rays, like->rays) == 0 && strcmp(row->caster, "fast") == 0) {
            return row;
        }
    }
    return NULL;
}

static void add_figure(report *r, cJSON *list, const hc_bench_trace_row *row)
{
    const hc_bench_trace_row *other  = best_other(r, row);
    const hc_bench_trace_row *more   = other_threads(r, row);
    cJSON                    *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "rays", row->rays);
    hc_cli_say(r->cli, "%-10s %5d %-7s", row->field, row->side, row->rays);
    if (more != NULL) {
        const double gain = more->rays_per_second / row->rays_per_second;
        (void)cJSON_AddNumberToObject(object, "threads_speedup", gain);
        hc_cli_say(r->cli, " %10.2f", gain);
    } else {
        hc_cli_say(r->cli, " %10s", "");
    }
    if (other != NULL) {
        const double ratio    = row->rays_per_second / other->rays_per_second;
        char         name[64] = "";
        (void)snprintf(name, sizeof name, "%s %s", other->caster, other->mode);
        (void)cJSON_AddStringToObject(object, "best_other", name);
        (void)cJSON_AddNumberToObject(object, "ratio", ratio);
        hc_cli_say(r->cli, " %10.2f  %s", ratio, name);
    }
    hc_cli_say(r->cli, "\n");
    (void)cJSON_AddItemToArray(list, object);
}

/* What `fast` reaches with several threads over one, and over the best of the others. */
static void add_figures(report *r)
{
    cJSON *list = cJSON_AddArrayToObject(r->cli->json, "figures");
    hc_cli_say(r->cli, "\n%-10s %5s %-7s %10s %10s  %s\n", "field", "side", "rays", "threads",
               "over best", "other caster (make bench-peers)");
    for (int i = 0; i < r->count; i++) {
        if (strcmp(r->rows[i].caster, "fast") == 0 && r->rows[i].threads == 1) {
            add_figure(r, list, &r->rows[i]);
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
    const hc_bench_trace_options options  = { .fields       = in->grounds,
                                              .field_count  = in->fields.count,
                                              .sides        = in->numbers,
                                              .side_count   = in->sides.count,
                                              .casters      = in->methods.items,
                                              .caster_count = in->methods.count,
                                              .seed         = settings->seed,
                                              .rays         = (size_t)settings->rays.count,
                                              .repeat       = settings->repeat,
                                              .threads      = settings->threads,
                                              .isa          = settings->map.cone.isa,
                                              .stop         = stop_asked,
                                              .row_done     = row_done,
                                              .user         = r };
    const hc_result              result   = hc_bench_trace(&options, &cli->log);
    if (result == HC_OK && (r->failed || r->csv.failed)) {
        return hc_cli_fail_memory(cli);
    }
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

static void begin(report *r)
{
    hc_bench_machine_read(&r->machine);
    hc_cli_text(r->cli, "bench", "trace");
    hc_cli_show_machine(r->cli, &r->machine);
    r->list = cJSON_AddArrayToObject(r->cli->json, "rows");
    hc_cli_csv_add(&r->csv,
                   "field,side,rays,caster,mode,threads,count,runs,seconds,rays_per_second,hits,"
                   "build_seconds,bytes\n");
    hc_cli_say(r->cli, "\n%-10s %5s %-7s %-16s %-8s %7s %10s %6s %10s %8s\n", "field", "side",
               "rays", "caster", "mode", "threads", "Mrays/s", "hits", "build ns", "bytes");
}

int hc_cli_run_bench_trace(hc_cli *cli)
{
    hc_cli_grounds in   = { 0 };
    report         r    = { .cli = cli };
    int            code = hc_cli_read_grounds(cli, &in, "fbm", "1024", hc_bench_caster);
    if (code == HC_CLI_DONE) {
        begin(&r);
        code = measure(cli, &in, &r);
    }
    if (code == HC_CLI_DONE) {
        add_figures(&r);
        code = hc_cli_write_reports(cli, r.csv.text);
    }
    hc_cli_free_grounds(&in);
    free(r.rows);
    free(r.csv.text);
    return code;
}
