#include "meaning.h"

#include "options.h"
#include "picture.h"
#include "words.h"

#include <math.h>

enum { SIDE_MAX = 65536 };

int hc_cli_check_pairs(hc_cli *cli, const char *const (*pairs)[2], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (hc_cli_given(&cli->settings, pairs[i][0])
            && hc_cli_given(&cli->settings, pairs[i][1])) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--%s and --%s exclude each other", pairs[i][0],
                               pairs[i][1]);
        }
    }
    return HC_CLI_DONE;
}

hc_backend hc_cli_drawn_by(const hc_cli_settings *settings)
{
    return settings->backend == HC_CLI_GL ? HC_BACKEND_GL : HC_BACKEND_CPU;
}

static int check_size(hc_cli *cli)
{
    const hc_cli_size size = cli->settings.size;
    if (size.width > SIDE_MAX || size.height > SIDE_MAX) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--size %dx%d: sides are at most %d", size.width,
                           size.height, SIDE_MAX);
    }
    if ((uint64_t)size.width * (uint64_t)size.height > HC_CLI_PIXELS_MAX) {
        return hc_cli_fail(cli, HC_CLI_MEMORY, "--size %dx%d: at most %llu pixels are drawn",
                           size.width, size.height, (unsigned long long)HC_CLI_PIXELS_MAX);
    }
    return HC_CLI_DONE;
}

int hc_cli_check_drawing(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_cones         cones    = settings->map.cone.cones;
    const double          *light    = settings->render.light;
    const int              code     = check_size(cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    if (hc_cli_given(settings, "light")
        && fabs(light[0]) + fabs(light[1]) + fabs(light[2]) == 0.0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--light 0,0,0 is no direction");
    }
    if (settings->render.refine != HC_CLI_BINARY && settings->rays.refinements > 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--refinements does nothing with --refine %s",
                           hc_cli_refine_words((int)settings->render.refine));
    }
    if (hc_cli_given(settings, "cones") && cones != HC_CONES_L1 && cones != HC_CONES_QUAD) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--cones %s: safe takes l1 or quad",
                           hc_cones_name(cones));
    }
    return HC_CLI_DONE;
}
