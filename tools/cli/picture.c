#include "picture.h"

#include "font.h"
#include "terminal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE_MIN     = 256,  /* fields are enlarged by whole factors up to about this, */
    SIDE_MAX     = 1024, /* and reduced by whole factors down to at most this      */
    PANEL_MIN    = 176,  /* room for the labels                                    */
    MARGIN       = 8,
    BAR_HEIGHT   = 12,
    GLYPH_SCALE  = 2,
    TEXT_ADVANCE = (HC_CLI_GLYPH_WIDTH + 1) * GLYPH_SCALE,
    TEXT_HEIGHT  = HC_CLI_GLYPH_HEIGHT * GLYPH_SCALE,
    ABOVE        = TEXT_HEIGHT + MARGIN,                  /* the title          */
    BELOW        = MARGIN + BAR_HEIGHT + 4 + TEXT_HEIGHT, /* the scale          */
    ACROSS       = 2                                      /* panels side by side */
};

typedef struct colour {
    uint8_t r, g, b;
} colour;

static const colour BACKGROUND = { 24, 24, 24 };
static const colour INK        = { 230, 230, 230 };
static const colour UNLIMITED  = { 0, 255, 255 };

/* How a field is brought to the size it is drawn at. */
typedef struct fit {
    int width, height; /* of the field */
    int enlarge, reduce;
    int drawn_width, drawn_height;
    int panel_width;
} fit;

static fit fit_field(int width, int height)
{
    const int side = width > height ? width : height;
    fit       f    = { .width = width, .height = height, .enlarge = 1, .reduce = 1 };
    if (side > SIDE_MAX) {
        f.reduce = (side + SIDE_MAX - 1) / SIDE_MAX;
    } else if (side < SIDE_MIN) {
        f.enlarge = SIDE_MIN / side;
    }
    f.drawn_width  = (width + f.reduce - 1) / f.reduce * f.enlarge;
    f.drawn_height = (height + f.reduce - 1) / f.reduce * f.enlarge;
    f.panel_width  = f.drawn_width > PANEL_MIN ? f.drawn_width : PANEL_MIN;
    return f;
}

/* Dark to bright, so that the order of values survives a print in grey. */
static colour ramp(double value)
{
    static const uint8_t stops[5][3] = {
        { 20, 20, 48 }, { 70, 40, 140 }, { 190, 50, 110 }, { 245, 140, 50 }, { 255, 245, 190 }
    };
    const double at   = fmin(fmax(value, 0.0), 1.0) * 4.0;
    const int    stop = at < 4.0 ? (int)at : 3;
    const double part = at - stop;
    uint8_t      mixed[3];
    for (int i = 0; i < 3; i++) {
        mixed[i] = (uint8_t)(stops[stop][i] * (1.0 - part) + stops[stop + 1][i] * part + 0.5);
    }
    return (colour){ mixed[0], mixed[1], mixed[2] };
}

static void put(hc_cli_canvas *c, int x, int y, colour ink)
{
    if (x >= 0 && x < c->width && y >= 0 && y < c->height) {
        uint8_t *pixel = c->rgb + ((size_t)y * (size_t)c->width + (size_t)x) * 3;
        pixel[0]       = ink.r;
        pixel[1]       = ink.g;
        pixel[2]       = ink.b;
    }
}

int hc_cli_text_width(const char *text)
{
    return (int)strlen(text) * TEXT_ADVANCE - GLYPH_SCALE;
}

void hc_cli_draw_text(hc_cli_canvas *c, int x, int y, const char *text)
{
    for (; *text != '\0'; text++, x += TEXT_ADVANCE) {
        for (int row = 0; row < TEXT_HEIGHT; row++) {
            for (int column = 0; column < HC_CLI_GLYPH_WIDTH * GLYPH_SCALE; column++) {
                if (hc_cli_glyph_at(*text, column / GLYPH_SCALE, row / GLYPH_SCALE)) {
                    put(c, x + column, y + row, INK);
                }
            }
        }
    }
}

/* The largest value of the block of texels that one pixel of a reduced panel stands for. */
static float largest_under(const hc_cli_panel *panel, const fit *f, int x, int y)
{
    const int x0      = x / f->enlarge * f->reduce;
    const int y0      = y / f->enlarge * f->reduce;
    float     largest = 0.0F;
    for (int j = y0; j < y0 + f->reduce && j < f->height; j++) {
        for (int i = x0; i < x0 + f->reduce && i < f->width; i++) {
            largest = fmaxf(largest, panel->values[(size_t)j * (size_t)f->width + (size_t)i]);
        }
    }
    return largest;
}

static void draw_values(hc_cli_canvas *c, const hc_cli_panel *panel, const fit *f, int left,
                        int top)
{
    for (int y = 0; y < f->drawn_height; y++) {
        for (int x = 0; x < f->drawn_width; x++) {
            const double value = (double)largest_under(panel, f, x, y);
            put(c, left + x, top + y,
                isinf(value) ? UNLIMITED : ramp(panel->top > 0.0 ? value / panel->top : 0.0));
        }
    }
}

/* The scale: a bar from 0 to the top value, numbers below its ends and its middle. */
static void draw_scale(hc_cli_canvas *c, const hc_cli_panel *panel, int left, int top, int width)
{
    char middle[32];
    char end[32];
    for (int x = 0; x < width; x++) {
        const colour ink = ramp(width > 1 ? (double)x / (width - 1) : 0.0);
        for (int y = 0; y < BAR_HEIGHT; y++) {
            put(c, left + x, top + y, ink);
        }
    }
    (void)snprintf(middle, sizeof middle, "%.2g", panel->top / 2.0);
    (void)snprintf(end, sizeof end, "%.3g", panel->top);
    const int line = top + BAR_HEIGHT + 4;
    hc_cli_draw_text(c, left, line, "0");
    if (panel->top > 0.0) {
        hc_cli_draw_text(c, left + (width - hc_cli_text_width(middle)) / 2, line, middle);
        hc_cli_draw_text(c, left + width - hc_cli_text_width(end), line, end);
    }
}

static void draw_panel(hc_cli_canvas *c, const hc_cli_panel *panel, const fit *f, int left, int top)
{
    hc_cli_draw_text(c, left, top, panel->title);
    draw_values(c, panel, f, left, top + ABOVE);
    draw_scale(c, panel, left, top + ABOVE + f->drawn_height + MARGIN, f->panel_width);
}

static void clear(hc_cli_canvas *c)
{
    for (int y = 0; y < c->height; y++) {
        for (int x = 0; x < c->width; x++) {
            put(c, x, y, BACKGROUND);
        }
    }
}

/* Panels row by row, two side by side; without `labels` neither titles nor scales. */
static hc_result draw_panels(hc_cli_canvas *c, hc_cli *cli, const hc_cli_panel *panels, int count,
                             int width, int height, bool labels)
{
    const fit f       = fit_field(width, height);
    const int columns = count < ACROSS ? count : ACROSS;
    const int rows    = (count + ACROSS - 1) / ACROSS;
    const int step_x  = (labels ? f.panel_width : f.drawn_width) + MARGIN;
    const int step_y  = f.drawn_height + MARGIN + (labels ? ABOVE + BELOW : 0);
    *c = (hc_cli_canvas){ .width = MARGIN + columns * step_x, .height = MARGIN + rows * step_y };
    c->rgb = malloc((size_t)c->width * (size_t)c->height * 3);
    if (c->rgb == NULL) {
        (void)snprintf(cli->log.text, sizeof cli->log.text, "out of memory");
        return HC_ERROR_MEMORY;
    }
    clear(c);
    for (int i = 0; i < count; i++) {
        const int left = MARGIN + i % ACROSS * step_x;
        const int top  = MARGIN + i / ACROSS * step_y;
        if (labels) {
            draw_panel(c, &panels[i], &f, left, top);
        } else {
            draw_values(c, &panels[i], &f, left, top);
        }
    }
    return HC_OK;
}

hc_result hc_cli_save_panels(hc_cli *cli, const char *path, const hc_cli_panel *panels, int count,
                             int width, int height)
{
    hc_cli_canvas c;
    hc_result     result = draw_panels(&c, cli, panels, count, width, height, true);
    if (result == HC_OK) {
        result = hc_save_picture(c.rgb, c.width, c.height, path, &cli->settings.save, &cli->log);
        free(c.rgb);
    }
    return result;
}

hc_result hc_cli_print_panels(hc_cli *cli, const hc_cli_panel *panels, int count, int width,
                              int height)
{
    hc_cli_canvas   c;
    const hc_result result = draw_panels(&c, cli, panels, count, width, height, false);
    if (result == HC_OK) {
        hc_cli_terminal_draw(c.rgb, c.width, c.height);
        free(c.rgb);
    }
    return result;
}
