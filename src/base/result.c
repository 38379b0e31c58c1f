/* Names of results, and the version. */
#include <heightcast/result.h>

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
