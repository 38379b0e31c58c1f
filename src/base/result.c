/* Names of results, and the two ways to write into a log. */
#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

const char *hc_version(void)
{
    return HC_VERSION_STRING;
}

const char *hc_result_name(hc_result result)
{
    static const char *const names[] = {
        "HC_OK",           "HC_ERROR_ARGUMENT",    "HC_ERROR_IO",    "HC_ERROR_EXISTS",
        "HC_ERROR_FORMAT", "HC_ERROR_UNSUPPORTED", "HC_ERROR_FIELD", "HC_ERROR_MEMORY",
        "HC_ERROR_LIMIT",  "HC_ERROR_CANCELLED",
    };
    const unsigned index = (unsigned)result;
    return index < sizeof names / sizeof *names ? names[index] : "unknown";
}

hc_result hc_fail(hc_log *log, hc_result result, const char *format, ...)
{
    if (log != NULL) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(log->text, sizeof log->text, format, arguments);
        va_end(arguments);
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
        log->warn(log->user, line);
    }
}
