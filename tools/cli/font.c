#include "font.h"

#include <ctype.h>
#include <stdint.h>

/* Five octal digits: five rows from the top, three pixels each. */
static const uint16_t digits[10]   = { 075557, 026227, 071747, 071717, 055711,
                                       074717, 074757, 071111, 075757, 075717 };
static const uint16_t capitals[26] = { 025755, 065656, 034443, 065556, 074647, 074644, 034553,
                                       055755, 072227, 011152, 055655, 044447, 057755, 065555,
                                       025552, 065644, 025563, 065655, 034216, 072222, 055557,
                                       055552, 055775, 055255, 055222, 071247 };

static unsigned rows_of(char letter)
{
    const int upper = toupper((unsigned char)letter);
    if (upper >= '0' && upper <= '9') {
        return digits[upper - '0'];
    }
    if (upper >= 'A' && upper <= 'Z') {
        return capitals[upper - 'A'];
    }
    switch (upper) {
    case '.': return 000002;
    case '-': return 000700;
    case '+': return 002720;
    case '_': return 000007;
    default: return 0;
    }
}

bool hc_cli_glyph_at(char letter, int x, int y)
{
    const int row = (HC_CLI_GLYPH_HEIGHT - 1 - y) * 3;
    return (rows_of(letter) >> (row + HC_CLI_GLYPH_WIDTH - 1 - x) & 1U) != 0;
}
