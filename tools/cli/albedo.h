/* Colour images, to lay over fields. */
#ifndef HC_CLI_ALBEDO_H
#define HC_CLI_ALBEDO_H

#include "cli.h"

#include <heightcast/io.h>

/* Load one of its channels, codes as 0 .. 1; grey images have but one. Freed with hc_free_field.
 * Returns the exit code. */
int hc_cli_load_channel(hc_field *plane, hc_cli *cli, const char *path, hc_channel channel);

/* Load an image in linear light. *rgb is NULL before, and freed by the caller whatever comes of
 * it. Returns the exit code. */
int hc_cli_load_colours(hc_cli *cli, const char *path, float **rgb, int *width, int *height);

#endif
