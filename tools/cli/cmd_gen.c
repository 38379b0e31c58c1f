/* heightcast gen: a named synthetic field into a file. */
#include "commands.h"
#include "figures.h"
#include "options.h"
#include "output.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *name_word(int index)
{
    return hc_synth_name(index);
}

/* The list is what was asked for, so it goes to standard output. */
static int list_names(hc_cli *cli)
{
    cli->on_stdout = true;
    hc_cli_group(cli, "fields");
    for (int i = 0; i < hc_synth_count(); i++) {
        hc_cli_text(cli, hc_synth_name(i), hc_synth_description(i));
    }
    return HC_CLI_DONE;
}

static int check_name(hc_cli *cli, const char *name)
{
    char names[512];
    for (int i = 0; i < hc_synth_count(); i++) {
        if (strcmp(hc_synth_name(i), name) == 0) {
            return HC_CLI_DONE;
        }
    }
    const char *nearest = hc_cli_nearest(name, name_word);
    hc_cli_join_words(names, sizeof names, name_word, ", ");
    if (nearest != NULL) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "no field named '%s'; did you mean '%s'?", name,
                           nearest);
    }
    return hc_cli_fail(cli, HC_CLI_USAGE, "no field named '%s'; known are %s", name, names);
}

static int check_container(hc_cli *cli, const char *path, int bits)
{
    const hc_container *container = hc_container_of(path);
    const int           allowed   = container == NULL ? 0 : container->field_bits;
    char                endings[128];
    hc_cli_list_endings(endings, sizeof endings, HC_CLI_FIELD, bits == 0 ? 8 | 16 | 32 : bits);
    if (allowed == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "output %s: the ending must be one of %s", path,
                           endings);
    }
    if (bits != 0 && (allowed & bits) == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "%s holds no %d bits; use %s, or other --bits",
                           container->name, bits, endings);
    }
    return hc_cli_check_output(cli, path);
}

static int check_arguments(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    if (settings->path_count < 2) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "needs NAME OUT; got %d of 2 (--list shows the names)",
                           settings->path_count);
    }
    if (settings->size.width == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "needs --size WIDTHxHEIGHT");
    }
    const int code = check_name(cli, settings->paths[0]);
    return code == HC_CLI_DONE ? check_container(cli, settings->paths[1], settings->map.bits)
                               : code;
}

static int make_and_save(hc_cli *cli, float *heights)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_field         field    = { .heights = heights,
                                        .width   = settings->size.width,
                                        .height  = settings->size.height };
    hc_save_options        save     = settings->save;
    save.bits                       = settings->map.bits;
    hc_cli_phase(cli, "make");
    hc_result result =
        hc_synth(heights, field.width, field.height, settings->paths[0], settings->seed, &cli->log);
    if (result == HC_OK) {
        hc_cli_phase(cli, "save");
        result = hc_save_field(&field, settings->paths[1], &save, &cli->log);
    }
    hc_cli_phase(cli, NULL);
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

/* As digits: a JSON number made from a double would lose the last ones of a large seed. */
static void show_seed(hc_cli *cli)
{
    char text[32];
    (void)snprintf(text, sizeof text, "%" PRIu64, cli->settings.seed);
    (void)cJSON_AddRawToObject(cli->json, "seed", text);
    hc_cli_say(cli, "%-16s %s\n", "seed", text);
}

int hc_cli_run_gen(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    if (settings->list) {
        return list_names(cli);
    }
    int code = check_arguments(cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    const size_t samples = (size_t)settings->size.width * (size_t)settings->size.height;
    float       *heights = malloc(samples * sizeof *heights);
    if (heights == NULL) {
        return hc_cli_fail(cli, HC_CLI_MEMORY,
                           "no memory for %d x %d samples; choose a smaller --size",
                           settings->size.width, settings->size.height);
    }
    code = make_and_save(cli, heights);
    free(heights);
    if (code == HC_CLI_DONE) {
        hc_cli_text(cli, "field", settings->paths[0]);
        show_seed(cli);
        hc_cli_show_size(cli, settings->size.width, settings->size.height);
        hc_cli_text(cli, "output", settings->paths[1]);
        hc_cli_number(cli, "output_bytes", hc_cli_file_bytes(settings->paths[1]), NULL);
    }
    return code;
}
