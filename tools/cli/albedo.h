/* Colour images, to lay over fields. */
#ifndef HC_CLI_ALBEDO_H
#define HC_CLI_ALBEDO_H

#include "cli.h"

/* Load --albedo, in linear light. *rgb is NULL before, and freed by the caller whatever comes of
 * it. Returns the exit code. */
int hc_cli_load_albedo(hc_cli *cli, float **rgb, int *width, int *height);

#endif
