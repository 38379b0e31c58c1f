#include "albedo.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static float linear_of(float code)
{
    return code <= 0.04045F ? code / 12.92F : powf((code + 0.055F) / 1.055F, 2.4F);
}

int hc_cli_load_channel(hc_field *plane, hc_cli *cli, const char *path, hc_channel channel)
{
    hc_log          log    = { .text = "" }; /* without its warning of sRGB, which is right here */
    hc_load_options load   = { .normalise = { .channel = channel, .range = HC_RANGE_TYPE },
                               .limits    = cli->settings.load.limits };
    hc_result       result = hc_load_field(plane, path, &load, &log);
    if (result != HC_OK) {
        load.normalise.channel = HC_CHANNEL_AUTO;
        result                 = hc_load_field(plane, path, &load, &log);
    }
    if (result != HC_OK) {
        cli->log = (hc_log){ .warn = cli->log.warn, .user = cli->log.user };
        memcpy(cli->log.text, log.text, sizeof log.text);
        return hc_cli_fail_result(cli, result);
    }
    return HC_CLI_DONE;
}

/* One channel after the other, as heights are read. */
int hc_cli_load_colours(hc_cli *cli, const char *path, float **rgb, int *width, int *height)
{
    for (int channel = 0; channel < 3; channel++) {
        hc_field  plane;
        const int code =
            hc_cli_load_channel(&plane, cli, path, (hc_channel)(HC_CHANNEL_R + channel));
        if (code != HC_CLI_DONE) {
            return code;
        }
        const size_t count = (size_t)plane.width * (size_t)plane.height;
        if (*rgb == NULL) {
            *rgb = malloc(count * 3 * sizeof **rgb);
        }
        *width  = plane.width;
        *height = plane.height;
        for (size_t i = 0; *rgb != NULL && i < count; i++) {
            (*rgb)[3 * i + (size_t)channel] = linear_of(plane.heights[i]);
        }
        hc_free_field(&plane);
    }
    return *rgb != NULL ? HC_CLI_DONE : hc_cli_fail_memory(cli);
}
