/* A progress bar for a terminal. */
#ifndef HC_CLI_BAR_H
#define HC_CLI_BAR_H

#include <stdbool.h>

/* Zero: a bar that never shows. */
typedef struct hc_cli_bar {
    bool        enabled;
    bool        shown;
    const char *label;
    double      started, drawn; /* monotonic seconds */
} hc_cli_bar;

double hc_cli_now(void); /* monotonic seconds */

/* Enable it if standard error is a terminal that can move its cursor. */
void hc_cli_bar_init(hc_cli_bar *bar);
void hc_cli_bar_start(hc_cli_bar *bar, const char *label);
void hc_cli_bar_draw(hc_cli_bar *bar, double fraction);
void hc_cli_bar_clear(hc_cli_bar *bar);

#endif
