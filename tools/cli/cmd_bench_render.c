/* heightcast bench render: frames of relief by every kind of map and method, as a table, JSON and
 * CSV. */
#include "bench_report.h"
#include "bench_trace.h"
#include "interrupt.h"
#include "words.h"

#include "bench/render_bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256 };

/* Below that a method counts as true: safe is held against the fewest steps that are. */
static const double WRONG_MOST = 0.001;

typedef struct report {
    hc_cli              *cli;
    hc_bench_machine     machine;
    hc_bench_render_row *rows;
    int                  count;
    cJSON               *list;
    hc_cli_csv           csv;
    bool                 failed;
} report;

static void add_json(report *r, const hc_bench_render_row *row)
{
    cJSON *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "map", row->map);
    (void)cJSON_AddStringToObject(object, "method", row->method);
    (void)cJSON_AddNumberToObject(object, "steps", row->steps);
    (void)cJSON_AddStringToObject(object, "refine", row->refine);
    (void)cJSON_AddNumberToObject(object, "runs", row->runs);
    (void)cJSON_AddNumberToObject(object, "milliseconds", row->milliseconds);
    (void)cJSON_AddNumberToObject(object, "mean_steps", row->mean_steps);
    (void)cJSON_AddNumberToObject(object, "mean_fetches", row->mean_fetches);
    (void)cJSON_AddNumberToObject(object, "lost", row->lost);
    (void)cJSON_AddNumberToObject(object, "made_up", row->made_up);
    (void)cJSON_AddNumberToObject(object, "unconverged", row->unconverged);
    (void)cJSON_AddItemToArray(r->list, object);
}

static void row_done(void *user, const hc_bench_render_row *row)
{
    report              *r = user;
    char                 line[LINE_MAX_BYTES];
    hc_bench_render_row *rows = hc_cli_add_row(r->rows, r->count, row, sizeof *row);
    if (rows == NULL) {
        r->failed = true;
        return;
    }
    r->rows = rows;
    r->count++;
    add_json(r, row);
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s,%d,%s,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n",
                   row->field, row->side, row->map, row->method, row->steps, row->refine, row->runs,
                   row->milliseconds, row->mean_steps, row->mean_fetches, row->lost, row->made_up,
                   row->unconverged);
    hc_cli_csv_add(&r->csv, line);
    hc_cli_say(r->cli, "%-8s %5d %-14s %-10s %5d %-6s %9.2f %7.2f %7.1f %8.3f %8.3f %8.3f\n",
               row->field, row->side, row->map, row->method, row->steps, row->refine,
               row->milliseconds, row->mean_steps, row->mean_fetches, 100.0 * row->lost,
               100.0 * row->made_up, 100.0 * row->unconverged);
    if (r->cli->on_stdout) {
        (void)fflush(stdout); /* a long run shows what it has */
    }
}

/* ---- safe against loop and maxmip ---- */

static double wrong(const hc_bench_render_row *row)
{
    return row->lost + row->made_up;
}

/* On the field of `like`: the first row of the method that is true enough, else the truest; NULL:
 * it has none. */
static const hc_bench_render_row *truest(const report *r, const hc_bench_render_row *like,
                                         const char *method)
{
    const hc_bench_render_row *best = NULL;
    for (int i = 0; i < r->count; i++) {
        const hc_bench_render_row *row = &r->rows[i];
        if (row->side == like->side && row->field == like->field && strcmp(row->method, method) == 0
            && (best == NULL || (wrong(best) >= WRONG_MOST && wrong(row) < wrong(best)))) {
            best = row;
        }
    }
    return best;
}

static void add_ratio(report *r, cJSON *object, const hc_bench_render_row *safe, const char *method,
                      const char *name)
{
    const hc_bench_render_row *other = truest(r, safe, method);
    if (other != NULL) {
        const double ratio = safe->milliseconds / other->milliseconds;
        cJSON       *part  = cJSON_AddObjectToObject(object, name);
        (void)cJSON_AddNumberToObject(part, "ratio", ratio);
        (void)cJSON_AddNumberToObject(part, "steps", other->steps);
        (void)cJSON_AddNumberToObject(part, "wrong", wrong(other));
        hc_cli_say(r->cli, "  %.2f of the time of %s", ratio, method);
        if (other->steps > 0) {
            hc_cli_say(r->cli, " with %d steps", other->steps);
        }
        hc_cli_say(r->cli, ", which is wrong in %.3f %%\n", 100.0 * wrong(other));
    }
}

static void add_figures(report *r)
{
    cJSON *list = cJSON_AddArrayToObject(r->cli->json, "figures");
    for (int i = 0; i < r->count; i++) {
        const hc_bench_render_row *row = &r->rows[i];
        if (strcmp(row->map, "quadrant") == 0) {
            cJSON *object = cJSON_CreateObject();
            (void)cJSON_AddStringToObject(object, "field", row->field);
            (void)cJSON_AddNumberToObject(object, "side", row->side);
            hc_cli_say(r->cli,
                       "\n%s %d: safe with quadrants, wrong in %.3f %% of the rays, takes\n",
                       row->field, row->side, 100.0 * wrong(row));
            add_ratio(r, object, row, "cone-loop", "over_loop");
            add_ratio(r, object, row, "maxmip", "over_maxmip");
            (void)cJSON_AddItemToArray(list, object);
        }
    }
}

/* ---- the work ---- */

static bool stop_asked(void)
{
    return hc_cli_caught_signal() != 0;
}

static int measure(hc_cli *cli, const hc_cli_grounds *in, report *r)
{
    const hc_cli_settings        *settings = &cli->settings;
    const hc_bench_render_options options  = { .fields      = in->grounds,
                                               .field_count = in->fields.count,
                                               .sides       = in->numbers,
                                               .side_count  = in->sides.count,
                                               .width       = settings->size.width,
                                               .height      = settings->size.height,
                                               .backend     = settings->backend == HC_CLI_GL
                                                                  ? HC_BACKEND_GL
                                                                  : HC_BACKEND_CPU,
                                               .seed        = settings->seed,
                                               .repeat      = settings->repeat,
                                               .threads     = settings->threads,
                                               .stop        = stop_asked,
                                               .row_done    = row_done,
                                               .user        = r };
    const hc_result               result   = hc_bench_render(&options, &cli->log);
    if (result == HC_OK && (r->failed || r->csv.failed)) {
        return hc_cli_fail_memory(cli);
    }
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

static void begin(report *r)
{
    const hc_cli_settings *settings = &r->cli->settings;
    hc_bench_machine_read(&r->machine);
    hc_cli_text(r->cli, "bench", "render");
    hc_cli_text(r->cli, "backend", hc_cli_backend_words((int)settings->backend));
    hc_cli_show_machine(r->cli, &r->machine);
    r->list = cJSON_AddArrayToObject(r->cli->json, "rows");
    hc_cli_csv_add(&r->csv, "field,side,map,method,steps,refine,runs,milliseconds,mean_steps,"
                            "mean_fetches,lost,made_up,unconverged\n");
    hc_cli_say(r->cli, "\n%-8s %5s %-14s %-10s %5s %-6s %9s %7s %7s %8s %8s %8s\n", "field", "side",
               "map", "method", "steps", "refine", "ms/frame", "steps", "fetches", "lost %",
               "made up", "unconv.");
}

int hc_cli_run_bench_render(hc_cli *cli)
{
    hc_cli_grounds in   = { 0 };
    report         r    = { .cli = cli };
    int            code = HC_CLI_DONE;
    if (cli->settings.methods != NULL) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "bench render measures all methods; leave out --methods");
    }
    code = hc_cli_read_grounds(cli, &in, "cobbles", "512", NULL);
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
