/* False-colour pictures with a scale and numbers on it. */
#ifndef HC_CLI_PICTURE_H
#define HC_CLI_PICTURE_H

#include "cli.h"

/* Pictures are held in memory: larger ones are refused. */
#define HC_CLI_PIXELS_MAX (UINT64_C(1) << 28)

/* 8-bit RGB pixels, row-major. */
typedef struct hc_cli_canvas {
    uint8_t *rgb;
    int      width, height;
} hc_cli_canvas;

/* Light letters with their upper left corner at (x, y), and how wide they are. */
void hc_cli_draw_text(hc_cli_canvas *c, int x, int y, const char *text);
int  hc_cli_text_width(const char *text);

/* One channel. Values >= 0; INFINITY gets a colour of its own. */
typedef struct hc_cli_panel {
    const float *values; /* width * height, row-major          */
    const char  *title;  /* letters, digits and . + - _        */
    double       top;    /* value of the scale's bright end    */
} hc_cli_panel;

/* Draw the panels, two side by side, each with title, scale and labels, and write them as PNG.
 * Small fields are enlarged; of large ones each pixel shows the largest value under it, so that
 * single texels stay visible. */
hc_result hc_cli_save_panels(hc_cli *cli, const char *path, const hc_cli_panel *panels, int count,
                             int width, int height);

/* The same in the terminal, without labels. Only where hc_cli_terminal_draws. */
hc_result hc_cli_print_panels(hc_cli *cli, const hc_cli_panel *panels, int count, int width,
                              int height);

#endif
