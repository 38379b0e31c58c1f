/* Pictures in numbers: names, files, sums of figures, and what a signal leaves. */
#ifndef HC_CLI_FRAMES_H
#define HC_CLI_FRAMES_H

#include "drawing.h"

/* Name of a frame's file: that of the command line, with a number if there are many. False if it is
 * too long. */
bool hc_cli_frame_name(char *name, size_t size, const hc_cli *cli, const char *path, int frame);

/* HC_CLI_DONE if --out and --depth-out are given as they must be, and all their files may be
 * written. */
int hc_cli_check_frames(hc_cli *cli);

/* Write frame 0 .. --frames - 1, or the one picture. */
hc_result hc_cli_save_frame(hc_cli *cli, const hc_picture *picture, int frame, hc_cli_over *over);

/* Say why there are no more after `frame` of them. Returns the exit code. */
int hc_cli_stop_frames(hc_cli *cli, hc_result result, int frame);

/* Of one picture, or summed over many: means times the rays that
 * came to anything, mean_error as it is. */
typedef struct hc_cli_totals {
    int               frames;
    hc_render_figures sum;
} hc_cli_totals;

void hc_cli_add_figures(hc_cli_totals *totals, const hc_render_figures *figures);

#endif
