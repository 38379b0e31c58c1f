/* heightcast bench: the measurements of bench/ as a table, JSON and CSV. */
#include "bench_report.h"
#include "bench_run.h"
#include "commands.h"
#include "lists.h"
#include "options.h"
#include "output.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int hc_cli_check_item(hc_cli *cli, const char *name, const char *item, hc_cli_words *words)
{
    char known[512];
    int  found = 0;
    while (words(found) != NULL && strcmp(words(found), item) != 0) {
        found++;
    }
    if (words(found) != NULL) {
        return HC_CLI_DONE;
    }
    const char *near = hc_cli_nearest(item, words);
    hc_cli_join_words(known, sizeof known, words, ", ");
    return hc_cli_fail(cli, HC_CLI_USAGE, "--%s %s: allowed are %s%s%s%s", name, item, known,
                       near == NULL ? "" : "; did you mean '", near == NULL ? "" : near,
                       near == NULL ? "" : "'?");
}

int hc_cli_read_list(hc_cli *cli, hc_cli_list *list, const char *name, const char *text,
                     hc_cli_words *words)
{
    int code = HC_CLI_DONE;
    if (!hc_cli_split(list, text)) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--%s %s: allowed are %s", name, text,
                           hc_cli_option_named(name)->allowed);
    }
    for (int i = 0; words != NULL && i < list->count && code == HC_CLI_DONE; i++) {
        code = hc_cli_check_item(cli, name, list->items[i], words);
    }
    return code;
}

int hc_cli_read_sides(hc_cli *cli, hc_cli_list *sides, int numbers[HC_CLI_LIST_MAX],
                      const char *otherwise)
{
    const char *text = cli->settings.sizes == NULL ? otherwise : cli->settings.sizes;
    const int   code = hc_cli_read_list(cli, sides, "sizes", text, NULL);
    for (int i = 0; code == HC_CLI_DONE && i < sides->count; i++) {
        const char *item   = sides->items[i];
        const bool  digits = item[strspn(item, "0123456789")] == '\0' && strlen(item) < 8;
        numbers[i]         = digits ? atoi(item) : 0;
        if (numbers[i] < 1 || numbers[i] > HC_SIDE_MAX) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--sizes %s: allowed are %s", item,
                               hc_cli_option_named("sizes")->allowed);
        }
    }
    return code;
}

/* Without a word, for bake. */
static bool asks_for(const hc_cli *cli, const char *what)
{
    return strcmp(cli->settings.path_count == 1 ? cli->settings.paths[0] : "bake", what) == 0;
}

static int check_arguments(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    if (!asks_for(cli, "bake") && !asks_for(cli, "trace") && !asks_for(cli, "steps")
        && !asks_for(cli, "render") && !asks_for(cli, "terrain")) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "nothing to measure is called '%s'; bake, trace, steps, render and "
                           "terrain are",
                           settings->paths[0]);
    }
    const bool draws = asks_for(cli, "render") || asks_for(cli, "terrain");
    if (!draws && hc_cli_given(settings, "size")) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--size is for bench render and bench terrain; leave it out");
    }
    if (!asks_for(cli, "trace") && !asks_for(cli, "steps") && hc_cli_given(settings, "rays")) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--rays is for bench trace and bench steps; leave it out");
    }
    if (!draws && !asks_for(cli, "bake") && hc_cli_given(settings, "backend")) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--backend is for bench bake, render and terrain; leave it out");
    }
    if (hc_cli_given(settings, "limit") && !asks_for(cli, "terrain")
        && !(asks_for(cli, "bake") && settings->backend == HC_CLI_GL)) {
        return hc_cli_fail(
            cli, HC_CLI_USAGE,
            "--limit is for bench bake --backend gl and bench terrain; leave it out");
    }
    if (settings->either) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--backend auto could be either; bench measures cpu or gl");
    }
    const bool json_file = settings->report != NULL && strcmp(settings->report, "-") != 0;
    int        code      = json_file ? hc_cli_check_output(cli, settings->report) : HC_CLI_DONE;
    if (code == HC_CLI_DONE && settings->csv != NULL) {
        code = hc_cli_check_output(cli, settings->csv);
    }
    return code != HC_CLI_DONE || !json_file
               ? code
               : hc_cli_check_apart(cli, "json", settings->report, "csv", settings->csv);
}

static int measure(hc_cli *cli, const hc_cli_grounds *in, hc_cli_bench *bench, hc_gpu *gpu)
{
    const hc_bench_options options = { .plan     = hc_cli_plan(cli, in),
                                       .gpu      = gpu,
                                       .limit    = (double)cli->settings.limit,
                                       .progress = hc_cli_progress(cli),
                                       .row_done = hc_cli_bench_row,
                                       .user     = bench };
    hc_cli_phase(cli, "bake");
    const hc_result result =
        gpu != NULL ? hc_bench_gpu(&options, &cli->log) : hc_bench_bake(&options, &cli->log);
    hc_cli_phase(cli, NULL);
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

int hc_cli_write_reports(hc_cli *cli, const char *csv)
{
    const hc_cli_settings *settings = &cli->settings;
    int                    code     = HC_CLI_DONE;
    if (settings->csv != NULL) {
        code = hc_cli_write_text(cli, settings->csv, csv);
    }
    if (code == HC_CLI_DONE && settings->report != NULL && !settings->json) {
        char *text = hc_cli_json_text(cli);
        code =
            text == NULL ? hc_cli_fail_memory(cli) : hc_cli_write_text(cli, settings->report, text);
        cJSON_free(text);
    }
    return code;
}

static int bench_bake(hc_cli *cli, const hc_cli_grounds *in)
{
    hc_gpu   *gpu    = NULL;
    hc_result result = HC_OK;
    if (cli->settings.backend == HC_CLI_GL) {
        result = hc_gpu_create(&gpu, &cli->log);
    }
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    hc_cli_bench bench = { .cli = cli, .gpu = gpu };
    int          code  = hc_cli_bench_begin(&bench);
    code               = code == HC_CLI_DONE ? measure(cli, in, &bench, gpu) : code;
    if (code == HC_CLI_DONE) {
        hc_cli_bench_figures(&bench);
        code = hc_cli_write_reports(cli, bench.csv.text);
    }
    hc_cli_bench_end(&bench);
    hc_gpu_destroy(gpu);
    return code;
}

static int run_bench_bake(hc_cli *cli)
{
    const bool     gl   = cli->settings.backend == HC_CLI_GL;
    hc_cli_grounds in   = { .sides = { .count = 0 } };
    int            code = hc_cli_read_grounds(cli, &in, "fbm", "512,4096",
                                   gl ? hc_bench_gpu_method : hc_bench_method);
    code                = code == HC_CLI_DONE ? bench_bake(cli, &in) : code;
    hc_cli_free_grounds(&in);
    return code;
}

int hc_cli_run_bench(hc_cli *cli)
{
    cli->settings.json = cli->settings.report != NULL && strcmp(cli->settings.report, "-") == 0;
    const int code     = check_arguments(cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    return asks_for(cli, "bake")     ? run_bench_bake(cli)
           : asks_for(cli, "trace")  ? hc_cli_run_bench_trace(cli)
           : asks_for(cli, "steps")  ? hc_cli_run_bench_steps(cli)
           : asks_for(cli, "render") ? hc_cli_run_bench_render(cli)
                                     : hc_cli_run_bench_terrain(cli);
}
