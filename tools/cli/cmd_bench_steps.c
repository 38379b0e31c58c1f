/* heightcast bench steps: steps of rays on fields of growing size, as a table, JSON and CSV. */
#include "bench_run.h"

#include "bench/steps_bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256 };

static const hc_bench_steps_row *row_at(const hc_cli_run *r, int i)
{
    return (const hc_bench_steps_row *)r->rows + i;
}

static void row_done(void *user, const hc_bench_steps_row *row)
{
    hc_cli_run *r = user;
    char        line[LINE_MAX_BYTES];
    cJSON      *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "rays", row->rays);
    (void)cJSON_AddStringToObject(object, "method", row->method);
    (void)cJSON_AddNumberToObject(object, "count", (double)row->count);
    (void)cJSON_AddNumberToObject(object, "hits", row->hits);
    (void)cJSON_AddNumberToObject(object, "mean_steps", row->mean);
    (void)cJSON_AddNumberToObject(object, "steps_99", row->most99);
    (void)cJSON_AddNumberToObject(object, "worst_steps", row->worst);
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s,%zu,%.4g,%.6g,%.0f,%.0f\n", row->field,
                   row->side, row->rays, row->method, row->count, row->hits, row->mean, row->most99,
                   row->worst);
    if (!hc_cli_run_add(r, row, sizeof *row, object, line)) {
        return;
    }
    hc_cli_say(r->cli, "%-10s %5d %-7s %-8s %6.3f %10.2f %8.0f %8.0f\n", row->field, row->side,
               row->rays, row->method, row->hits, row->mean, row->most99, row->worst);
    hc_cli_run_flush(r);
}

/* The row of the same rays and method on the field of another side. */
static const hc_bench_steps_row *at_side(const hc_cli_run *r, const hc_bench_steps_row *like,
                                         int side)
{
    for (int i = 0; i < r->count; i++) {
        const hc_bench_steps_row *row = row_at(r, i);
        if (row->side == side && row->field == like->field && strcmp(row->rays, like->rays) == 0
            && strcmp(row->method, like->method) == 0) {
            return row;
        }
    }
    return NULL;
}

static void add_figure(hc_cli_run *r, cJSON *list, const hc_bench_steps_row *from,
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
static void add_figures(hc_cli_run *r)
{
    const hc_cli_grounds *in    = &r->in;
    cJSON                *list  = cJSON_AddArrayToObject(r->cli->json, "figures");
    const int             first = in->numbers[(in->sides.count - 1) / 2];
    const int             last  = in->numbers[in->sides.count - 1];
    const double          log_n = pow(log(last) / log(first), 1.0 / log2((double)last / first));
    if (first < 2 || last <= first) {
        return;
    }
    hc_cli_say(r->cli, "\nTimes as many steps for twice the side, from %d to %d (as log n: %.2f)\n",
               first, last, log_n);
    for (int i = 0; i < r->count; i++) {
        const hc_bench_steps_row *from = at_side(r, row_at(r, i), first);
        if (row_at(r, i)->side == last && from != NULL && from->most99 > 0.0) {
            add_figure(r, list, from, row_at(r, i));
        }
    }
}

static hc_result measure(hc_cli_run *r)
{
    const hc_bench_steps_options options = { .plan     = hc_cli_run_plan(r),
                                             .rays     = (size_t)r->cli->settings.rays.count,
                                             .row_done = row_done,
                                             .user     = r };
    return hc_bench_steps(&options, &r->cli->log);
}

static void head(hc_cli_run *r)
{
    hc_cli_say(r->cli, "\n%-10s %5s %-7s %-8s %6s %10s %8s %8s\n", "field", "side", "rays",
               "method", "hits", "mean steps", "99 %", "worst");
}

int hc_cli_run_bench_steps(hc_cli *cli)
{
    static const hc_cli_run_kind kind = {
        .name    = "steps",
        .fields  = "fbm",
        .sides   = "64,128,256,512,1024",
        .methods = hc_bench_steps_method,
        .columns = "field,side,rays,method,count,hits,mean_steps,steps_99,worst_steps\n",
        .head    = head,
        .measure = measure,
        .figures = add_figures
    };
    return hc_cli_bench_run(cli, &kind);
}
