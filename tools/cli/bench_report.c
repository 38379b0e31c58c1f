#include "bench_report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CSV_LINE_MAX = 1024 };

static double ns_per_texel(const hc_bench_row *row)
{
    return 1e9 * row->seconds / ((double)row->side * (double)row->side);
}

/* ---- CSV ---- */

void hc_cli_csv_add(hc_cli_csv *csv, const char *line)
{
    const size_t length = strlen(line);
    char        *grown  = realloc(csv->text, csv->size + length + 1);
    if (grown == NULL) {
        csv->failed = true;
        return;
    }
    memcpy(grown + csv->size, line, length + 1);
    csv->text = grown;
    csv->size += length;
}

/* Room grows by doubling from 64 rows, so the count alone says when it is used up. */
void *hc_cli_add_row(void *rows, int count, const void *row, size_t size)
{
    const bool full = count == 0 || (count >= 64 && (count & (count - 1)) == 0);
    if (full) {
        rows = realloc(rows, (size_t)(count == 0 ? 64 : 2 * count) * size);
    }
    if (rows != NULL) {
        memcpy((char *)rows + (size_t)count * size, row, size);
    }
    return rows;
}

/* Figures that are not known stay empty. */
static const char *number_or_nothing(char *text, size_t size, int digits, double value)
{
    text[0] = '\0';
    if (isfinite(value)) {
        (void)snprintf(text, size, "%.*g", digits, value);
    }
    return text;
}

static void add_csv_number(hc_cli_bench *bench, double value)
{
    char text[32], cell[40];
    (void)snprintf(cell, sizeof cell, ",%s", number_or_nothing(text, sizeof text, 9, value));
    hc_cli_csv_add(&bench->csv, cell);
}

static void add_csv_row(hc_cli_bench *bench, const hc_bench_row *row)
{
    const hc_bench_machine *machine   = &bench->machine;
    const double            numbers[] = {
                   row->threads,    row->runs,          row->seconds,           row->fastest,
                   row->slowest,    row->expected,      row->processor_seconds, ns_per_texel(row),
                   row->peak_bytes, row->memory_factor, row->mean_kept,         row->mean_ratio,
                   row->wider,      row->wider_share
    };
    char line[CSV_LINE_MAX];
    (void)snprintf(line, sizeof line, "%s,%d,%s,%s", row->field, row->side, row->method,
                   row->cones == NULL ? "" : row->cones);
    hc_cli_csv_add(&bench->csv, line);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        add_csv_number(bench, numbers[i]);
    }
    (void)snprintf(line, sizeof line, ",\"%s\",\"%s\",\"%s\",%s,%s\n", machine->cpu,
                   machine->system, machine->compiler, machine->commit, hc_version());
    hc_cli_csv_add(&bench->csv, line);
}

/* ---- the head ---- */

void hc_cli_show_machine(hc_cli *cli, const hc_bench_machine *machine)
{
    hc_cli_group(cli, "machine");
    hc_cli_text(cli, "cpu", machine->cpu);
    hc_cli_number(cli, "cores", machine->cores, NULL);
    hc_cli_number(cli, "memory_bytes", machine->memory_bytes, NULL);
    hc_cli_text(cli, "system", machine->system);
    hc_cli_number(cli, "load", machine->load, NULL);
    hc_cli_text(cli, "compiler", machine->compiler);
    hc_cli_text(cli, "commit", machine->commit);
    hc_cli_text(cli, "isa", hc_isa_name(hc_isa_resolve(cli->settings.map.cone.isa)));
    hc_cli_group(cli, NULL);
}

int hc_cli_bench_begin(hc_cli_bench *bench)
{
    hc_cli *cli = bench->cli;
    hc_bench_machine_read(&bench->machine);
    hc_cli_text(cli, "bench", "bake");
    if (bench->gpu != NULL) {
        hc_cli_text(cli, "gpu", hc_gpu_name(bench->gpu));
        hc_cli_text(cli, "driver", hc_gpu_driver(bench->gpu));
        hc_cli_text(cli, "gpu_rounds", hc_gpu_rounds(bench->gpu) ? "yes" : "no");
        hc_cli_text(cli, "timer", hc_gpu_timer(bench->gpu));
    }
    hc_cli_show_machine(cli, &bench->machine);
    bench->list = cJSON_AddArrayToObject(cli->json, "rows");
    hc_cli_csv_add(
        &bench->csv,
        "field,side,method,cones,threads,runs,seconds,fastest,slowest,"
        "expected_seconds,processor_seconds,ns_per_texel,peak_bytes,memory_factor,mean_kept,"
        "mean_ratio,wider,wider_share,cpu,system,compiler,commit,version\n");
    hc_cli_say(cli, "\n%-10s %5s %-18s %-5s %7s %4s %10s %9s %6s %7s %7s %8s %6s\n", "field",
               "side", "method", "cones", "threads", "runs", "seconds", "ns/texel", "memory",
               "kept", "ratio", "wider", "%");
    return bench->failed || bench->csv.failed ? hc_cli_fail_memory(cli) : HC_CLI_DONE;
}

/* ---- rows ---- */

static void add_json_row(hc_cli_bench *bench, const hc_bench_row *row)
{
    cJSON *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "method", row->method);
    if (row->cones != NULL) {
        (void)cJSON_AddStringToObject(object, "cones", row->cones);
    }
    (void)cJSON_AddNumberToObject(object, "threads", row->threads);
    (void)cJSON_AddNumberToObject(object, "runs", row->runs);
    (void)cJSON_AddNumberToObject(object, "seconds", row->seconds);
    (void)cJSON_AddNumberToObject(object, "fastest", row->fastest);
    (void)cJSON_AddNumberToObject(object, "slowest", row->slowest);
    (void)cJSON_AddNumberToObject(object, "expected_seconds", row->expected);
    (void)cJSON_AddNumberToObject(object, "processor_seconds", row->processor_seconds);
    (void)cJSON_AddNumberToObject(object, "ns_per_texel", ns_per_texel(row));
    (void)cJSON_AddNumberToObject(object, "peak_bytes", row->peak_bytes);
    (void)cJSON_AddNumberToObject(object, "memory_factor", row->memory_factor);
    (void)cJSON_AddNumberToObject(object, "mean_kept", row->mean_kept);
    (void)cJSON_AddNumberToObject(object, "mean_ratio", row->mean_ratio);
    (void)cJSON_AddNumberToObject(object, "wider", row->wider);
    (void)cJSON_AddNumberToObject(object, "wider_share", row->wider_share);
    (void)cJSON_AddItemToArray(bench->list, object);
}

static void say_row(hc_cli_bench *bench, const hc_bench_row *row)
{
    char kept[32], ratio[32], wider[32], share[32];
    (void)number_or_nothing(kept, sizeof kept, 4, row->mean_kept);
    (void)number_or_nothing(ratio, sizeof ratio, 4, row->mean_ratio);
    (void)number_or_nothing(wider, sizeof wider, 9, row->wider);
    (void)number_or_nothing(share, sizeof share, 3, 100.0 * row->wider_share);
    hc_cli_say(bench->cli, "%-10s %5d %-18s %-5s %7d %4d ", row->field, row->side, row->method,
               row->cones == NULL ? "" : row->cones, row->threads, row->runs);
    if (row->runs == 0 && isinf(row->expected)) {
        hc_cli_say(bench->cli, "stopped before anything was done\n");
    } else if (row->runs == 0) {
        hc_cli_say(bench->cli, "stopped: would take about %.0f s\n", row->expected);
    } else {
        hc_cli_say(bench->cli, "%10.4g %9.2f %6.2f %7s %7s %8s %6s\n", row->seconds,
                   ns_per_texel(row), row->memory_factor, kept, ratio, wider, share);
    }
    if (bench->cli->on_stdout) {
        (void)fflush(stdout); /* a long run shows what it has */
    }
}

void hc_cli_bench_row(void *user, const hc_bench_row *row)
{
    hc_cli_bench *bench = user;
    /* The bar was drawn by the process that measured; this one must clear it. */
    bench->cli->bar.shown = bench->cli->bar.enabled;
    hc_bench_row *rows    = hc_cli_add_row(bench->rows, bench->count, row, sizeof *row);
    if (rows == NULL) {
        bench->failed = true;
        return;
    }
    bench->rows = rows;
    bench->count++;
    add_json_row(bench, row);
    add_csv_row(bench, row);
    say_row(bench, row);
}

/* ---- figures ---- */

enum { SEVERAL = -1 };

/* Round cones. NULL if that was not measured. */
static const hc_bench_row *find(const hc_cli_bench *bench, const hc_bench_row *like,
                                const char *method, int threads)
{
    for (int i = 0; i < bench->count; i++) {
        const hc_bench_row *row  = &bench->rows[i];
        const bool          here = row->side == like->side && row->field == like->field;
        if (here && row->runs > 0 && strcmp(row->method, method) == 0 && row->cones != NULL
            && strcmp(row->cones, hc_cones_name(HC_CONES_L2)) == 0
            && (threads == SEVERAL ? row->threads > 1 : row->threads == threads)) {
            return row;
        }
    }
    return NULL;
}

static bool is_exact_l2(const hc_bench_row *row)
{
    return row->runs > 0 && strcmp(row->method, "exact") == 0 && row->threads <= 1
           && strcmp(row->cones, hc_cones_name(HC_CONES_L2)) == 0;
}

static void add_ratio(hc_cli_bench *bench, cJSON *figure, const char *name, const char *words,
                      const hc_bench_row *over, const hc_bench_row *under)
{
    if (over != NULL && under != NULL) {
        const double ratio = over->seconds / under->seconds;
        (void)cJSON_AddNumberToObject(figure, name, ratio);
        hc_cli_say(bench->cli, "%-10s %5d %s %.2f\n", under->field, under->side, words, ratio);
    }
}

static void add_growth(hc_cli_bench *bench, cJSON *figure, const hc_bench_row *small,
                       const hc_bench_row *large)
{
    const double side   = (double)large->side / small->side;
    const double growth = large->seconds / small->seconds;
    (void)cJSON_AddNumberToObject(figure, "growth_from_side", small->side);
    (void)cJSON_AddNumberToObject(figure, "growth_texels", side * side);
    (void)cJSON_AddNumberToObject(figure, "growth_seconds", growth);
    hc_cli_say(bench->cli,
               "%-10s %5d exact, time against side %d: %.2f for %.4g times the texels\n",
               large->field, large->side, small->side, growth, side * side);
}

void hc_cli_bench_figures(hc_cli_bench *bench)
{
    cJSON              *list  = cJSON_AddArrayToObject(bench->cli->json, "figures");
    const hc_bench_row *first = NULL;
    hc_cli_say(bench->cli, "\n");
    for (int i = 0; i < bench->count; i++) {
        const hc_bench_row *exact = &bench->rows[i];
        if (exact->cones == NULL || !is_exact_l2(exact)) {
            continue;
        }
        cJSON *figure = cJSON_CreateObject();
        (void)cJSON_AddStringToObject(figure, "field", exact->field);
        (void)cJSON_AddNumberToObject(figure, "side", exact->side);
        add_ratio(bench, figure, "ring_over_exact",
                  "exact, times as fast as ring:", find(bench, exact, "ring", exact->threads),
                  exact);
        add_ratio(bench, figure, "quick_improved_over_exact",
                  "exact, times as fast as quick-improved:",
                  find(bench, exact, "quick-improved", exact->threads), exact);
        add_ratio(bench, figure, "brute_over_exact",
                  "exact, times as fast as brute:", find(bench, exact, "brute", exact->threads),
                  exact);
        add_ratio(bench, figure, "threads_speedup", "exact, one thread over several:", exact,
                  find(bench, exact, "exact", SEVERAL));
        if (first != NULL && first->field == exact->field && first->side < exact->side) {
            add_growth(bench, figure, first, exact);
        } else {
            first = exact;
        }
        (void)cJSON_AddItemToArray(list, figure);
    }
}

void hc_cli_bench_end(hc_cli_bench *bench)
{
    free(bench->rows);
    free(bench->csv.text);
}
