/* The two ways to write into a log. */
#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

/* Names and bytes of files get into messages: none of them may start a line or steer a terminal. */
static void keep_to_one_line(char *text)
{
    for (; *text != '\0'; text++) {
        if ((unsigned char)*text < ' ' || *text == 0x7F) {
            *text = '?';
        }
    }
}

hc_result hc_fail(hc_log *log, hc_result result, const char *format, ...)
{
    if (log != NULL) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(log->text, sizeof log->text, format, arguments);
        va_end(arguments);
        keep_to_one_line(log->text);
    }
    return result;
}

void hc_warn(const hc_log *log, const char *format, ...)
{
    if (log != NULL && log->warn != NULL) {
        char    line[HC_LOG_TEXT_SIZE];
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(line, sizeof line, format, arguments);
        va_end(arguments);
        keep_to_one_line(line);
        log->warn(log->user, line);
    }
}
