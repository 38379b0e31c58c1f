/* A font for labels: capitals, digits and a few signs, 3 x 5 pixels each. */
#ifndef HC_CLI_FONT_H
#define HC_CLI_FONT_H

#include <stdbool.h>

enum { HC_CLI_GLYPH_WIDTH = 3, HC_CLI_GLYPH_HEIGHT = 5 };

/* True if the glyph of `letter` is inked at (x, y); small letters look like capitals, unknown ones
 * are blank. */
bool hc_cli_glyph_at(char letter, int x, int y);

#endif
