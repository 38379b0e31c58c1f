/* Options that make no sense together: what the commands that draw have in common. */
#ifndef HC_CLI_MEANING_H
#define HC_CLI_MEANING_H

#include "cli.h"

#include <heightcast/render.h>

#include <stddef.h>

/* Of two options that say the same thing in two ways, at most one is given. Returns the exit
 * code. */
int hc_cli_check_pairs(hc_cli *cli, const char *const (*pairs)[2], size_t count);

/* What draws. --backend auto has become gl by then, from which hc_cli_falls_back may lead. */
hc_backend hc_cli_drawn_by(const hc_cli_settings *settings);

/* The picture's size, refinements, cones, the light. Returns the exit code. */
int hc_cli_check_drawing(hc_cli *cli);

#endif
