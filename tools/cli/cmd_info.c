/* heightcast info: what a file is, and what its numbers are like. */
#include "anyfile.h"
#include "commands.h"

#include <math.h>
#include <stdio.h>

/* Of one channel, over all levels. */
typedef struct statistics {
    double least, mean, largest; /* of the finite values */
    size_t finite, unlimited, zero;
} statistics;

static statistics measure(const hc_cli_anyfile *file, int channel)
{
    const size_t texels = hc_cli_anyfile_texels(file);
    statistics   s      = { .least = INFINITY, .largest = -INFINITY };
    for (size_t i = 0; i < texels; i++) {
        const double value = (double)hc_cli_anyfile_value(file, channel, i);
        if (!isfinite(value)) {
            s.unlimited++;
            continue;
        }
        s.finite++;
        s.zero += value == 0.0;
        s.mean += value;
        s.least   = fmin(s.least, value);
        s.largest = fmax(s.largest, value);
    }
    s.mean = s.finite > 0 ? s.mean / (double)s.finite : NAN;
    return s;
}

static void show_statistics(hc_cli *cli, const hc_cli_anyfile *file)
{
    cJSON *list = cJSON_AddArrayToObject(cli->json, "statistics");
    hc_cli_say(cli, "%-16s %12s %12s %12s %10s %10s\n", "channel", "least", "mean", "largest",
               "zero", "unlimited");
    for (int i = 0; i < file->channel_count; i++) {
        const statistics s       = measure(file, i);
        cJSON           *channel = cJSON_CreateObject();
        (void)cJSON_AddStringToObject(channel, "channel", file->channels[i].name);
        (void)cJSON_AddNumberToObject(channel, "least", s.finite > 0 ? s.least : NAN);
        (void)cJSON_AddNumberToObject(channel, "mean", s.mean);
        (void)cJSON_AddNumberToObject(channel, "largest", s.finite > 0 ? s.largest : NAN);
        (void)cJSON_AddNumberToObject(channel, "zero", (double)s.zero);
        (void)cJSON_AddNumberToObject(channel, "unlimited", (double)s.unlimited);
        (void)cJSON_AddItemToArray(list, channel);
        hc_cli_say(cli, "%-16s %12.6g %12.6g %12.6g %10zu %10zu\n", file->channels[i].name,
                   s.finite > 0 ? s.least : (double)NAN, s.mean,
                   s.finite > 0 ? s.largest : (double)NAN, s.zero, s.unlimited);
    }
}

static const char *type_name(hc_sample_type type)
{
    static const char *const names[] = { "u8", "u16", "i16", "u32", "i32", "f32", "f64" };
    const unsigned           index   = (unsigned)type;
    return index < sizeof names / sizeof *names ? names[index] : "unknown";
}

/* What the header says. */
static void show_header(hc_cli *cli, const hc_file_info *info)
{
    hc_cli_text(cli, "format", info->format);
    if (info->has_map) {
        hc_cli_show_map(cli, &info->map);
        hc_cli_show_elevation(cli, &info->map.elevation);
        return;
    }
    hc_cli_show_size(cli, info->width, info->height);
    hc_cli_number(cli, "channels", info->channels, NULL);
    hc_cli_number(cli, "bits", info->bits, NULL);
    hc_cli_text(cli, "type", type_name(info->type));
    hc_cli_flag(cli, "srgb", info->srgb);
}

static void show_field(hc_cli *cli, const hc_field *field)
{
    hc_cli_text(cli, "wrap", hc_wrap_name(field->wrap));
    hc_cli_text(cli, "registration", hc_registration_name(field->registration));
    hc_cli_show_elevation(cli, &field->elevation);
}

/* A file with holes is still worth describing: say so, and look at the rest. */
static hc_result load_past_holes(hc_cli_anyfile *file, hc_cli *cli, const char *path)
{
    hc_normalise_options *normalise = &cli->settings.load.normalise;
    hc_result             result    = hc_cli_anyfile_load(file, cli, path);
    if (result == HC_ERROR_FIELD && normalise->holes == HC_HOLES_ERROR) {
        char reason[HC_LOG_TEXT_SIZE];
        (void)snprintf(reason, sizeof reason, "%s", cli->log.text);
        hc_cli_anyfile_free(file);
        normalise->holes = HC_HOLES_LOWEST;
        result           = hc_cli_anyfile_load(file, cli, path);
        if (result == HC_OK) {
            hc_cli_warn(cli, "%s", reason);
        }
    }
    return result;
}

int hc_cli_run_info(hc_cli *cli)
{
    hc_cli_anyfile file;
    const char    *path = cli->settings.paths[0];
    hc_cli_phase(cli, "load");
    const hc_result result = load_past_holes(&file, cli, path);
    hc_cli_phase(cli, NULL);
    int code = HC_CLI_DONE;
    if (result != HC_OK) {
        code = hc_cli_fail_result(cli, result);
    } else {
        hc_cli_text(cli, "input", path);
        if (file.info.format[0] != '\0') {
            show_header(cli, &file.info);
        } else {
            hc_cli_show_size(cli, file.width, file.height);
        }
        if (!file.is_map) {
            show_field(cli, &file.field);
        }
        show_statistics(cli, &file);
    }
    hc_cli_anyfile_free(&file);
    return code;
}
