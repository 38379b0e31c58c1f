#include "terminal.h"

#include <unistd.h>

#ifdef HC_HAVE_CHAFA

#include <chafa.h>

#include <stdio.h>
#include <sys/ioctl.h>

typedef struct cells {
    int columns, rows;
    int width, height; /* of one cell [pixels] */
} cells;

/* What the terminal says, or what was usual in 1978. Two rows stay free for the prompt. */
static cells terminal_cells(void)
{
    struct winsize size = { 0 };
    cells          c    = { .columns = 80, .rows = 24, .width = 8, .height = 16 };
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 2) {
        c.columns = size.ws_col;
        c.rows    = size.ws_row;
        if (size.ws_xpixel > 0 && size.ws_ypixel > 0) {
            c.width  = size.ws_xpixel / size.ws_col;
            c.height = size.ws_ypixel / size.ws_row;
        }
    }
    c.rows -= 2;
    return c;
}

static ChafaCanvasConfig *configure(ChafaTermInfo *term, ChafaSymbolMap *symbols, int width,
                                    int height)
{
    const cells c       = terminal_cells();
    gint        columns = c.columns;
    gint        rows    = c.rows;
    const bool  sixels  = chafa_term_info_have_seq(term, CHAFA_TERM_SEQ_BEGIN_SIXELS);
    const bool  colours = chafa_term_info_have_seq(term, CHAFA_TERM_SEQ_SET_COLOR_FGBG_DIRECT);
    ChafaCanvasConfig *config = chafa_canvas_config_new();
    chafa_symbol_map_add_by_tags(symbols, CHAFA_SYMBOL_TAG_BLOCK | CHAFA_SYMBOL_TAG_BORDER
                                              | CHAFA_SYMBOL_TAG_SPACE);
    chafa_calc_canvas_geometry(width, height, &columns, &rows, (gfloat)c.width / (gfloat)c.height,
                               FALSE, FALSE);
    chafa_canvas_config_set_geometry(config, columns, rows);
    chafa_canvas_config_set_cell_geometry(config, c.width, c.height);
    chafa_canvas_config_set_symbol_map(config, symbols);
    chafa_canvas_config_set_pixel_mode(config,
                                       sixels ? CHAFA_PIXEL_MODE_SIXELS : CHAFA_PIXEL_MODE_SYMBOLS);
    chafa_canvas_config_set_canvas_mode(config, colours ? CHAFA_CANVAS_MODE_TRUECOLOR
                                                        : CHAFA_CANVAS_MODE_INDEXED_256);
    return config;
}

bool hc_cli_terminal_draws(void)
{
    return isatty(STDOUT_FILENO) == 1;
}

void hc_cli_terminal_draw(const uint8_t *rgb, int width, int height)
{
    gchar            **environment = g_get_environ();
    ChafaTermInfo     *term        = chafa_term_db_detect(chafa_term_db_get_default(), environment);
    ChafaSymbolMap    *symbols     = chafa_symbol_map_new();
    ChafaCanvasConfig *config      = configure(term, symbols, width, height);
    ChafaCanvas       *canvas      = chafa_canvas_new(config);
    chafa_canvas_draw_all_pixels(canvas, CHAFA_PIXEL_RGB8, rgb, width, height, width * 3);
    GString *text = chafa_canvas_print(canvas, term);
    (void)fwrite(text->str, 1, text->len, stdout);
    (void)fputc('\n', stdout);
    (void)g_string_free(text, TRUE);
    chafa_canvas_unref(canvas);
    chafa_canvas_config_unref(config);
    chafa_symbol_map_unref(symbols);
    chafa_term_info_unref(term);
    g_strfreev(environment);
}

#else

bool hc_cli_terminal_draws(void)
{
    return false;
}

void hc_cli_terminal_draw(const uint8_t *rgb, int width, int height)
{
    (void)rgb;
    (void)width;
    (void)height;
}

#endif
