/* Pictures in a terminal, through libchafa where this build has it. */
#ifndef HC_CLI_TERMINAL_H
#define HC_CLI_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

/* True if standard output is a terminal and this build can draw in it. */
bool hc_cli_terminal_draws(void);

/* Draw 8-bit RGB pixels as large as the terminal allows, with sixels or letters, whatever
 * the terminal says it can. Only where hc_cli_terminal_draws. */
void hc_cli_terminal_draw(const uint8_t *rgb, int width, int height);

#endif
