/* A progress bar for a terminal: elapsed and remaining time, as wide as the window. */
#include "bar.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { LINE_MAX_COLUMNS = 120, BAR_MAX_COLUMNS = 40, BAR_MIN_COLUMNS = 5 };

/* Short work needs no bar, and a terminal no more than ten pictures a second. */
static const double QUIET_SECONDS  = 0.2;
static const double REDRAW_SECONDS = 0.1;

double hc_cli_now(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void hc_cli_bar_init(hc_cli_bar *bar)
{
    const char *terminal = getenv("TERM");
    bar->enabled =
        isatty(STDERR_FILENO) == 1 && (terminal == NULL || strcmp(terminal, "dumb") != 0);
}

void hc_cli_bar_start(hc_cli_bar *bar, const char *label)
{
    hc_cli_bar_clear(bar);
    bar->label   = label;
    bar->started = hc_cli_now();
    bar->drawn   = bar->started + QUIET_SECONDS - REDRAW_SECONDS;
}

/* Columns that a line may fill; asked each time, windows change. The last one stays free: some
 * terminals wrap there. */
static int columns_now(void)
{
    struct winsize window;
    int            columns = 80;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0) {
        columns = window.ws_col;
    }
    return columns - 1 < LINE_MAX_COLUMNS ? columns - 1 : LINE_MAX_COLUMNS;
}

static void format_time(char *text, size_t size, double seconds)
{
    const long whole = seconds < 359999.0 ? (long)(seconds + 0.5) : 359999;
    if (whole >= 3600) {
        (void)snprintf(text, size, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
    } else {
        (void)snprintf(text, size, "%ld:%02ld", whole / 60, whole % 60);
    }
}

static void draw_cells(char *text, int cells, double fraction)
{
    const int full = (int)(fraction * cells);
    for (int i = 0; i < cells; i++) {
        text[i] = i < full ? '#' : '.';
    }
    text[cells] = '\0';
}

/* What there is room for: label and percentage always, then the times, then the bar itself. */
static void compose(const hc_cli_bar *bar, char *line, size_t size, double fraction, int columns)
{
    char         elapsed[32];
    char         remaining[32];
    char         times[80] = "";
    char         cells[BAR_MAX_COLUMNS + 1];
    const double seconds = hc_cli_now() - bar->started;
    format_time(elapsed, sizeof elapsed, seconds);
    if (fraction > 0.01) {
        format_time(remaining, sizeof remaining, seconds / fraction * (1.0 - fraction));
        (void)snprintf(times, sizeof times, "%s, %s left", elapsed, remaining);
    } else {
        (void)snprintf(times, sizeof times, "%s", elapsed);
    }
    const int head  = (int)strlen(bar->label) + 6;
    const int rest  = columns - head - (int)strlen(times) - 4;
    const int wide  = rest < BAR_MAX_COLUMNS ? rest : BAR_MAX_COLUMNS;
    const int whole = (int)(fraction * 100.0);
    if (wide >= BAR_MIN_COLUMNS) {
        draw_cells(cells, wide, fraction);
        (void)snprintf(line, size, "%s %3d %% [%s] %s", bar->label, whole, cells, times);
    } else {
        (void)snprintf(line, size, "%s %3d %% %s", bar->label, whole, rest >= 0 ? times : "");
    }
}

void hc_cli_bar_draw(hc_cli_bar *bar, double fraction)
{
    char         line[2 * LINE_MAX_COLUMNS];
    const double now = hc_cli_now();
    if (!bar->enabled || now - bar->drawn < REDRAW_SECONDS) {
        return;
    }
    const int columns = columns_now();
    compose(bar, line, sizeof line, fraction, columns);
    (void)fprintf(stderr, "\r\033[K%.*s", columns, line);
    (void)fflush(stderr);
    bar->drawn = now;
    bar->shown = true;
}

void hc_cli_bar_clear(hc_cli_bar *bar)
{
    if (bar->shown) {
        (void)fputs("\r\033[K", stderr);
        (void)fflush(stderr);
        bar->shown = false;
    }
}
