#include "foreign.h"

void hc_cli_keep_to_one_line(char *text)
{
    for (; *text != '\0'; text++) {
        if ((unsigned char)*text < ' ' || *text == 0x7F) {
            *text = '?';
        }
    }
}

/* Bytes of the character that begins here; 0: none does. The second byte's range leaves out what
 * has a shorter form, halves of pairs, and what is above U+10FFFF. */
static int character_length(const unsigned char *text)
{
    const unsigned char lead   = text[0];
    const int           length = lead < 0x80   ? 1
                                 : lead < 0xC2 ? 0
                                 : lead < 0xE0 ? 2
                                 : lead < 0xF0 ? 3
                                 : lead < 0xF5 ? 4
                                               : 0;
    const unsigned char low    = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned char high   = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    for (int i = 1; i < length; i++) {
        if (text[i] < (i == 1 ? low : 0x80) || text[i] > (i == 1 ? high : 0xBF)) {
            return 0;
        }
    }
    return length;
}

void hc_cli_keep_to_utf8(char *text)
{
    while (*text != '\0') {
        const int length = character_length((const unsigned char *)text);
        if (length == 0) {
            *text = '?';
        }
        text += length == 0 ? 1 : length;
    }
}
