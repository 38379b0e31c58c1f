/* heightcast bench render: frames of relief by every kind of map and method, as a table, JSON and
 * CSV. */
#include "bench_run.h"
#include "meaning.h"
#include "words.h"

#include "bench/render_bench.h"

#include <stdio.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256 };

static const hc_bench_render_row *row_at(const hc_cli_run *r, int i)
{
    return (const hc_bench_render_row *)r->rows + i;
}

/* Below that a method counts as true: safe is held against the fewest steps that are. */
static const double WRONG_MOST = 0.001;

static cJSON *to_json(const hc_bench_render_row *row)
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
    return object;
}

static void row_done(void *user, const hc_bench_render_row *row)
{
    hc_cli_run *r = user;
    char        line[LINE_MAX_BYTES];
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s,%d,%s,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n",
                   row->field, row->side, row->map, row->method, row->steps, row->refine, row->runs,
                   row->milliseconds, row->mean_steps, row->mean_fetches, row->lost, row->made_up,
                   row->unconverged);
    if (!hc_cli_run_add(r, row, sizeof *row, to_json(row), line)) {
        return;
    }
    hc_cli_say(r->cli, "%-8s %5d %-14s %-10s %5d %-6s %9.2f %7.2f %7.1f %8.3f %8.3f %8.3f\n",
               row->field, row->side, row->map, row->method, row->steps, row->refine,
               row->milliseconds, row->mean_steps, row->mean_fetches, 100.0 * row->lost,
               100.0 * row->made_up, 100.0 * row->unconverged);
    hc_cli_run_flush(r);
}

/* ---- safe against loop and maxmip ---- */

static double wrong(const hc_bench_render_row *row)
{
    return row->lost + row->made_up;
}

/* On the field of `like`: the first row of the method that is true enough, else the truest; NULL:
 * it has none. */
static const hc_bench_render_row *truest(const hc_cli_run *r, const hc_bench_render_row *like,
                                         const char *method)
{
    const hc_bench_render_row *best = NULL;
    for (int i = 0; i < r->count; i++) {
        const hc_bench_render_row *row = row_at(r, i);
        if (row->side == like->side && row->field == like->field && strcmp(row->method, method) == 0
            && (best == NULL || (wrong(best) >= WRONG_MOST && wrong(row) < wrong(best)))) {
            best = row;
        }
    }
    return best;
}

static void add_ratio(hc_cli_run *r, cJSON *object, const hc_bench_render_row *safe,
                      const char *method, const char *name)
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

static void add_figures(hc_cli_run *r)
{
    cJSON *list = cJSON_AddArrayToObject(r->cli->json, "figures");
    for (int i = 0; i < r->count; i++) {
        const hc_bench_render_row *row = row_at(r, i);
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

static hc_result measure(hc_cli_run *r)
{
    const hc_cli_settings        *settings = &r->cli->settings;
    const hc_bench_render_options options  = { .plan     = hc_cli_run_plan(r),
                                               .width    = settings->size.width,
                                               .height   = settings->size.height,
                                               .backend  = hc_cli_drawn_by(settings),
                                               .row_done = row_done,
                                               .user     = r };
    return hc_bench_render(&options, &r->cli->log);
}

static void head(hc_cli_run *r)
{
    const hc_cli_settings *settings = &r->cli->settings;
    hc_cli_text(r->cli, "backend", hc_cli_backend_words((int)settings->backend));
    hc_cli_say(r->cli, "\n%-8s %5s %-14s %-10s %5s %-6s %9s %7s %7s %8s %8s %8s\n", "field", "side",
               "map", "method", "steps", "refine", "ms/frame", "steps", "fetches", "lost %",
               "made up", "unconv.");
}

int hc_cli_run_bench_render(hc_cli *cli)
{
    static const hc_cli_run_kind kind = {
        .name    = "render",
        .fields  = "cobbles",
        .sides   = "512",
        .methods = NULL,
        .columns = "field,side,map,method,steps,refine,runs,milliseconds,mean_steps,"
                   "mean_fetches,lost,made_up,unconverged\n",
        .head    = head,
        .measure = measure,
        .figures = add_figures
    };
    if (cli->settings.methods != NULL) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "bench render measures all methods; leave out --methods");
    }
    return hc_cli_bench_run(cli, &kind);
}
