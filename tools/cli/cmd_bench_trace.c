/* heightcast bench trace: casters on the same rays, as a table, JSON and CSV. */
#include "bench_run.h"

#include "bench/trace_bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINE_MAX_BYTES = 512 };

static const hc_bench_trace_row *row_at(const hc_cli_run *r, int i)
{
    return (const hc_bench_trace_row *)r->rows + i;
}

static cJSON *to_json(const hc_bench_trace_row *row)
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
    return object;
}

static void row_done(void *user, const hc_bench_trace_row *row)
{
    hc_cli_run  *r       = user;
    const double samples = (double)row->side * (double)row->side;
    char         line[LINE_MAX_BYTES];
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s,%s,%d,%zu,%d,%.6g,%.6g,%.4g,%.6g,%.0f\n",
                   row->field, row->side, row->rays, row->caster, row->mode, row->threads,
                   row->count, row->runs, row->seconds, row->rays_per_second, row->hits,
                   row->build_seconds, row->bytes);
    if (!hc_cli_run_add(r, row, sizeof *row, to_json(row), line)) {
        return;
    }
    hc_cli_say(r->cli, "%-10s %5d %-7s %-16s %-8s %7d %10.2f %6.3f %10.1f %8.1f\n", row->field,
               row->side, row->rays, row->caster, row->mode, row->threads,
               1e-6 * row->rays_per_second, row->hits, 1e9 * row->build_seconds / samples,
               row->bytes / samples);
    hc_cli_run_flush(r);
}

static bool same_rays(const hc_bench_trace_row *a, const hc_bench_trace_row *b)
{
    return a->side == b->side && a->field == b->field && strcmp(a->rays, b->rays) == 0;
}

/* The fastest of others on the rays of `like`; single rays are compared with single rays. NULL:
 * there is none. */
static const hc_bench_trace_row *best_other(const hc_cli_run *r, const hc_bench_trace_row *like)
{
    const hc_bench_trace_row *best   = NULL;
    const bool                single = strcmp(like->mode, "single") == 0;
    for (int i = 0; i < r->count; i++) {
        const hc_bench_trace_row *row = row_at(r, i);
        if (same_rays(row, like) && row->threads == like->threads
            && strcmp(row->caster, "fast") != 0 && (!single || strcmp(row->mode, "single") == 0)
            && (best == NULL || row->rays_per_second > best->rays_per_second)) {
            best = row;
        }
    }
    return best;
}

static const hc_bench_trace_row *other_threads(const hc_cli_run *r, const hc_bench_trace_row *like)
{
    for (int i = 0; i < r->count; i++) {
        const hc_bench_trace_row *row = row_at(r, i);
        if (same_rays(row, like) && row->threads > 1 && strcmp(row->caster, "fast") == 0
            && strcmp(row->mode, like->mode) == 0) {
            return row;
        }
    }
    return NULL;
}

static void add_figure(hc_cli_run *r, cJSON *list, const hc_bench_trace_row *row)
{
    const hc_bench_trace_row *other  = best_other(r, row);
    const hc_bench_trace_row *more   = other_threads(r, row);
    cJSON                    *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "rays", row->rays);
    (void)cJSON_AddStringToObject(object, "mode", row->mode);
    hc_cli_say(r->cli, "%-10s %5d %-7s %-8s", row->field, row->side, row->rays, row->mode);
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
static void add_figures(hc_cli_run *r)
{
    cJSON *list = cJSON_AddArrayToObject(r->cli->json, "figures");
    hc_cli_say(r->cli, "\n%-10s %5s %-7s %-8s %10s %10s  %s\n", "field", "side", "rays", "mode",
               "threads", "over best", "other caster (make bench-peers)");
    for (int i = 0; i < r->count; i++) {
        if (strcmp(row_at(r, i)->caster, "fast") == 0 && row_at(r, i)->threads == 1) {
            add_figure(r, list, row_at(r, i));
        }
    }
}

static hc_result measure(hc_cli_run *r)
{
    const hc_bench_trace_options options = { .plan     = hc_cli_run_plan(r),
                                             .rays     = (size_t)r->cli->settings.rays.count,
                                             .row_done = row_done,
                                             .user     = r };
    return hc_bench_trace(&options, &r->cli->log);
}

static void head(hc_cli_run *r)
{
    hc_cli_say(r->cli, "\n%-10s %5s %-7s %-16s %-8s %7s %10s %6s %10s %8s\n", "field", "side",
               "rays", "caster", "mode", "threads", "Mrays/s", "hits", "build ns", "bytes");
}

int hc_cli_run_bench_trace(hc_cli *cli)
{
    static const hc_cli_run_kind kind = {
        .name    = "trace",
        .fields  = "fbm",
        .sides   = "1024",
        .methods = hc_bench_caster,
        .columns = "field,side,rays,caster,mode,threads,count,runs,seconds,rays_per_second,hits,"
                   "build_seconds,bytes\n",
        .head    = head,
        .measure = measure,
        .figures = add_figures
    };
    return hc_cli_bench_run(cli, &kind);
}
