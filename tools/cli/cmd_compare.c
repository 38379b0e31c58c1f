/* heightcast compare: how far two fields or two maps are apart. */
#include "anyfile.h"
#include "commands.h"
#include "output.h"
#include "picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of one channel, over all levels. Texels that are unlimited in both are equal; in one only, they
 * count as different and stay out of largest, mean and psnr, which they would make infinite. */
typedef struct difference {
    double largest, mean;
    double peak; /* what psnr relates to: 1, or the largest finite ratio of both */
    double psnr; /* [dB], infinite if nothing differs                             */
    size_t differing, unlimited_in_one, where;
} difference;

static difference measure(const hc_cli_anyfile *a, const hc_cli_anyfile *b, int channel)
{
    const size_t texels  = hc_cli_anyfile_texels(a);
    const bool   ratio   = a->channels[channel].cone >= 0;
    double       sum     = 0.0;
    double       squares = 0.0;
    difference   d       = { .peak = ratio ? 0.0 : 1.0 };
    for (size_t i = 0; i < texels; i++) {
        const double x     = (double)hc_cli_anyfile_value(a, channel, i);
        const double y     = (double)hc_cli_anyfile_value(b, channel, i);
        const double apart = x == y ? 0.0 : fabs(x - y);
        if (!isfinite(apart)) {
            d.unlimited_in_one++;
            continue;
        }
        if (ratio && isfinite(x)) {
            d.peak = fmax(d.peak, fmax(x, y));
        }
        d.differing += apart > 0.0;
        sum += apart;
        squares += apart * apart;
        if (apart > d.largest) {
            d.largest = apart;
            d.where   = i;
        }
    }
    const double finite = (double)(texels - d.unlimited_in_one);
    d.differing += d.unlimited_in_one;
    d.mean = finite > 0.0 ? sum / finite : 0.0;
    d.psnr = squares > 0.0 ? 10.0 * log10(d.peak * d.peak * finite / squares) : (double)INFINITY;
    return d;
}

static void show_channel(hc_cli *cli, cJSON *list, const char *name, const difference *d, int width)
{
    cJSON *channel = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(channel, "channel", name);
    (void)cJSON_AddNumberToObject(channel, "largest", d->largest);
    (void)cJSON_AddNumberToObject(channel, "mean", d->mean);
    (void)cJSON_AddNumberToObject(channel, "psnr", d->psnr);
    (void)cJSON_AddNumberToObject(channel, "peak", d->peak);
    (void)cJSON_AddNumberToObject(channel, "differing", (double)d->differing);
    (void)cJSON_AddNumberToObject(channel, "unlimited_in_one", (double)d->unlimited_in_one);
    (void)cJSON_AddNumberToObject(channel, "largest_x", (double)(d->where % (size_t)width));
    (void)cJSON_AddNumberToObject(channel, "largest_y", (double)(d->where / (size_t)width));
    (void)cJSON_AddItemToArray(list, channel);
    hc_cli_say(cli, "%-12s %12.6g %12.6g %9.2f %11zu %10zu\n", name, d->largest, d->mean, d->psnr,
               d->differing, d->unlimited_in_one);
}

/* Level 0 of each channel as a panel. */
static hc_result save_picture(hc_cli *cli, const hc_cli_anyfile *a, const hc_cli_anyfile *b,
                              const difference *differences)
{
    const size_t texels = (size_t)a->width * (size_t)a->height;
    float       *values = malloc(texels * (size_t)a->channel_count * sizeof *values);
    hc_cli_panel panels[HC_CLI_CHANNELS_MAX];
    if (values == NULL) {
        (void)strcpy(cli->log.text, "out of memory");
        return HC_ERROR_MEMORY;
    }
    for (int channel = 0; channel < a->channel_count; channel++) {
        float *panel = values + texels * (size_t)channel;
        for (size_t i = 0; i < texels; i++) {
            const float x = hc_cli_anyfile_value(a, channel, i);
            const float y = hc_cli_anyfile_value(b, channel, i);
            panel[i]      = x == y ? 0.0F : fabsf(x - y);
        }
        panels[channel] =
            (hc_cli_panel){ panel, a->channels[channel].name, differences[channel].largest };
    }
    const hc_result result =
        hc_cli_save_panels(cli, cli->settings.diff, panels, a->channel_count, a->width, a->height);
    free(values);
    return result;
}

static int compare(hc_cli *cli, const hc_cli_anyfile *a, const hc_cli_anyfile *b)
{
    difference differences[HC_CLI_CHANNELS_MAX];
    bool       equal = true;
    hc_cli_phase(cli, "compare");
    for (int i = 0; i < a->channel_count; i++) {
        differences[i] = measure(a, b, i);
        equal          = equal && differences[i].differing == 0;
    }
    if (cli->settings.diff != NULL) {
        hc_cli_phase(cli, "save");
        const hc_result result = save_picture(cli, a, b, differences);
        if (result != HC_OK) {
            return hc_cli_fail_result(cli, result);
        }
    }
    hc_cli_phase(cli, NULL);
    hc_cli_show_size(cli, a->width, a->height);
    cJSON *list = cJSON_AddArrayToObject(cli->json, "channels");
    hc_cli_say(cli, "%-12s %12s %12s %9s %11s %10s\n", "channel", "largest", "mean", "psnr dB",
               "differing", "unlimited");
    for (int i = 0; i < a->channel_count; i++) {
        show_channel(cli, list, a->channels[i].name, &differences[i], a->width);
    }
    hc_cli_flag(cli, "equal", equal);
    return HC_CLI_DONE;
}

static int check_pair(hc_cli *cli, const hc_cli_anyfile *a, const hc_cli_anyfile *b)
{
    const char *const *paths = cli->settings.paths;
    if (a->is_map != b->is_map) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s is a baked map and %s is a height map",
                           paths[a->is_map ? 0 : 1], paths[a->is_map ? 1 : 0]);
    }
    if (a->width != b->width || a->height != b->height) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE, "the sizes differ: %s is %d x %d, %s is %d x %d",
                           paths[0], a->width, a->height, paths[1], b->width, b->height);
    }
    const hc_map_info *x = &a->map.info;
    const hc_map_info *y = &b->map.info;
    if (a->is_map && (x->layout != y->layout || x->kind != y->kind || x->levels != y->levels)) {
        return hc_cli_fail(
            cli, HC_CLI_BAD_FILE,
            "the maps differ in kind: %s is a %s map, layout %s, %d levels, %s is a %s "
            "map, layout %s, %d levels",
            paths[0], hc_map_kind_name(x->kind), hc_layout_name(x->layout), x->levels, paths[1],
            hc_map_kind_name(y->kind), hc_layout_name(y->layout), y->levels);
    }
    return HC_CLI_DONE;
}

static int check_arguments(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    if (strcmp(settings->paths[0], "-") == 0 && strcmp(settings->paths[1], "-") == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "only one of the two can be standard input");
    }
    if (settings->diff == NULL) {
        return HC_CLI_DONE;
    }
    return hc_cli_check_picture(cli, "diff", settings->diff);
}

int hc_cli_run_compare(hc_cli *cli)
{
    hc_cli_anyfile a    = { 0 };
    hc_cli_anyfile b    = { 0 };
    int            code = check_arguments(cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    hc_cli_phase(cli, "load");
    hc_result result = hc_cli_anyfile_load(&a, cli, cli->settings.paths[0]);
    if (result == HC_OK) {
        result = hc_cli_anyfile_load(&b, cli, cli->settings.paths[1]);
    }
    code = result == HC_OK ? check_pair(cli, &a, &b) : hc_cli_fail_result(cli, result);
    code = code == HC_CLI_DONE ? compare(cli, &a, &b) : code;
    hc_cli_anyfile_free(&a);
    hc_cli_anyfile_free(&b);
    return code;
}
