#include "drawing.h"

#include "output.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int hc_cli_check_ending(hc_cli *cli, const char *option, const char *path, const char *endings)
{
    const hc_container *container = hc_container_of(path);
    if (container == NULL || strstr(endings, container->endings[0]) == NULL) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--%s %s: the ending must be one of %s", option, path,
                           endings);
    }
    return hc_cli_check_output(cli, path);
}

bool hc_cli_take_picture(hc_picture *picture, bool depths)
{
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    picture->rgb       = malloc(count * 3 * sizeof *picture->rgb);
    picture->depth     = depths ? malloc(count * sizeof *picture->depth) : NULL;
    return picture->rgb != NULL && (picture->depth != NULL || !depths);
}

static hc_result save_png(hc_cli *cli, const hc_picture *picture, const char *out,
                          hc_cli_over *over)
{
    hc_cli_canvas c = { .width = picture->width, .height = picture->height };
    c.rgb           = malloc((size_t)c.width * (size_t)c.height * 3);
    if (c.rgb == NULL) {
        (void)snprintf(cli->log.text, sizeof cli->log.text, "out of memory");
        return HC_ERROR_MEMORY;
    }
    hc_picture_bytes(c.rgb, picture);
    over(&c, cli, picture);
    const hc_result result =
        hc_save_picture(c.rgb, c.width, c.height, out, &cli->settings.save, &cli->log);
    free(c.rgb);
    return result;
}

hc_result hc_cli_save_drawing(hc_cli *cli, const hc_picture *picture, const char *out,
                              const char *depths, hc_cli_over *over)
{
    const hc_save_options *save   = &cli->settings.save;
    hc_result              result = HC_OK;
    if (strcmp(hc_container_of(out)->name, "PNG") == 0) {
        result = save_png(cli, picture, out, over);
    } else {
        result =
            hc_save_floats(picture->rgb, picture->width, picture->height, 3, out, save, &cli->log);
    }
    if (result == HC_OK && depths != NULL) {
        result = hc_save_floats(picture->depth, picture->width, picture->height, 1, depths, save,
                                &cli->log);
    }
    return result;
}
