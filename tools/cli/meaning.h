/* Options that make no sense together: what the commands that draw have in common. */
#ifndef HC_CLI_MEANING_H
#define HC_CLI_MEANING_H

#include "cli.h"

#include <stddef.h>

/* Of two options that say the same thing in two ways, at most one is given. Returns the exit code. */
int hc_cli_check_pairs(hc_cli *cli, const char *const (*pairs)[2], size_t count);

/* The picture's size, refinements, cones. Returns the exit code. */
int hc_cli_check_drawing(hc_cli *cli);

#endif
