/* heightcast show: the channels of a field or a map as a picture, in the terminal or in a file. */
#include "anyfile.h"
#include "commands.h"
#include "output.h"
#include "picture.h"
#include "terminal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values looked at to find the scale of a channel. */
enum { SAMPLES_MAX = 65536 };

static int by_value(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Ratios have no natural top, and a few very wide cones would leave the rest dark: the scale ends
 * where 95 % of the finite values lie below. */
static double top_of_most(const float *values, size_t count, float *samples)
{
    const size_t stride = count / SAMPLES_MAX + 1;
    size_t       finite = 0;
    for (size_t i = 0; i < count; i += stride) {
        if (isfinite(values[i])) {
            samples[finite++] = values[i];
        }
    }
    qsort(samples, finite, sizeof *samples, by_value);
    return finite > 0 ? (double)samples[(finite - 1) * 95 / 100] : 0.0;
}

/* The 2006 map holds the roots of its ratios, and is shown as its paper shows it. */
static bool is_root(const hc_cli_anyfile *file, int channel)
{
    return file->is_map && file->map.info.layout == HC_LAYOUT_DUMMER
           && file->channels[channel].cone >= 0;
}

/* Level 0 of a channel. Gradients are drawn by their steepness, whichever way they fall. */
static void copy_channel(float *values, const hc_cli_anyfile *file, int channel)
{
    const size_t texels = (size_t)file->width * (size_t)file->height;
    const bool   root   = is_root(file, channel);
    for (size_t i = 0; i < texels; i++) {
        const float value = fabsf(hc_cli_anyfile_value(file, channel, i));
        values[i]         = root ? sqrtf(value) : value;
    }
}

/* Ratios and float gradients need a scale of their own, all others are fractions of 1. */
static bool is_fraction(const hc_cli_anyfile *file, int channel)
{
    const bool gradient = file->is_map && file->map.info.layout == HC_LAYOUT_GRADIENT;
    return is_root(file, channel)
           || (file->channels[channel].cone < 0 && !(gradient && file->map.info.bits == 32));
}

/* One scale for all ratios, so that quadrants can be compared. */
static void fill_panels(hc_cli_panel *panels, float *values, float *samples,
                        const hc_cli_anyfile *file)
{
    const size_t texels = (size_t)file->width * (size_t)file->height;
    double       top    = 0.0;
    for (int i = 0; i < file->channel_count; i++) {
        float *channel = values + texels * (size_t)i;
        copy_channel(channel, file, i);
        panels[i] = (hc_cli_panel){ .values = channel,
                                    .title  = is_root(file, i) ? "root" : file->channels[i].name,
                                    .top    = 1.0 };
        if (!is_fraction(file, i)) {
            panels[i].top = top_of_most(channel, texels, samples);
            top           = fmax(top, panels[i].top);
        }
    }
    for (int i = 0; i < file->channel_count; i++) {
        if (!is_fraction(file, i)) {
            panels[i].top = top;
        }
    }
}

static int put_panels(hc_cli *cli, const hc_cli_panel *panels, const hc_cli_anyfile *file)
{
    const int count  = file->channel_count;
    hc_result result = HC_OK;
    if (cli->settings.out != NULL) {
        hc_cli_phase(cli, "save");
        result =
            hc_cli_save_panels(cli, cli->settings.out, panels, count, file->width, file->height);
    } else {
        result = hc_cli_print_panels(cli, panels, count, file->width, file->height);
    }
    hc_cli_phase(cli, NULL);
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

static void show_scales(hc_cli *cli, const hc_cli_panel *panels, const hc_cli_anyfile *file)
{
    hc_cli_text(cli, "input", cli->settings.paths[0]);
    if (cli->settings.out != NULL) {
        hc_cli_text(cli, "output", cli->settings.out);
    }
    hc_cli_show_size(cli, file->width, file->height);
    cJSON *list = cJSON_AddArrayToObject(cli->json, "channels");
    for (int i = 0; i < file->channel_count; i++) {
        cJSON *channel = cJSON_CreateObject();
        (void)cJSON_AddStringToObject(channel, "channel", panels[i].title);
        (void)cJSON_AddNumberToObject(channel, "top", panels[i].top);
        (void)cJSON_AddItemToArray(list, channel);
        hc_cli_say(cli, "%-16s 0 to %.3g\n", panels[i].title, panels[i].top);
    }
}

static int show(hc_cli *cli, const hc_cli_anyfile *file)
{
    const size_t texels  = (size_t)file->width * (size_t)file->height;
    float       *values  = malloc(texels * (size_t)file->channel_count * sizeof *values);
    float       *samples = malloc(SAMPLES_MAX * sizeof *samples);
    hc_cli_panel panels[HC_CLI_CHANNELS_MAX];
    int          code = HC_CLI_MEMORY;
    if (values == NULL || samples == NULL) {
        (void)hc_cli_fail_memory(cli);
    } else {
        hc_cli_phase(cli, "draw");
        fill_panels(panels, values, samples, file);
        code = put_panels(cli, panels, file);
    }
    if (code == HC_CLI_DONE) {
        show_scales(cli, panels, file);
    }
    free(samples);
    free(values);
    return code;
}

static int check_arguments(hc_cli *cli)
{
    if (cli->settings.out != NULL) {
        return hc_cli_check_picture(cli, "out", cli->settings.out);
    }
    if (cli->settings.json || !hc_cli_terminal_draws()) {
        return hc_cli_fail(
            cli, HC_CLI_USAGE, "standard output is %s; --out FILE.png writes the picture",
            cli->settings.json ? "for --json" : "no terminal that this build draws in");
    }
    return HC_CLI_DONE;
}

int hc_cli_run_show(hc_cli *cli)
{
    hc_cli_anyfile file = { 0 };
    int            code = check_arguments(cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    hc_cli_phase(cli, "load");
    const hc_result result = hc_cli_anyfile_load(&file, cli, cli->settings.paths[0]);
    code                   = result == HC_OK ? show(cli, &file) : hc_cli_fail_result(cli, result);
    hc_cli_anyfile_free(&file);
    return code;
}
