/* Pictures of the renderer: outputs checked, memory, files. */
#ifndef HC_CLI_DRAWING_H
#define HC_CLI_DRAWING_H

#include "picture.h"

#include <heightcast/render.h>

/* HC_CLI_DONE if --`option` may write a file at `path`, whose ending is in `endings`. */
int hc_cli_check_ending(hc_cli *cli, const char *option, const char *path, const char *endings);

/* Memory for rgb, and for depths if they are wanted; false: there is none. Free both. */
bool hc_cli_take_picture(hc_picture *picture, bool depths);

/* What stands on top of a PNG: legends. */
typedef void hc_cli_over(hc_cli_canvas *canvas, const hc_cli *cli, const hc_picture *picture);

/* Write `out` (.png, .exr), and `depths` unless that is NULL. */
hc_result hc_cli_save_drawing(hc_cli *cli, const hc_picture *picture, const char *out,
                              const char *depths, hc_cli_over *over);

#endif
