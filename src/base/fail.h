/* How code below the public API reports: one line that names the culprit, its value and the
 * remedy. */
#ifndef HC_BASE_FAIL_H
#define HC_BASE_FAIL_H

#include <heightcast/result.h>

/* Put the formatted line into log->text (if log is not NULL) and return `result`. */
__attribute__((format(printf, 3, 4))) hc_result hc_fail(hc_log *log, hc_result result,
                                                        const char *format, ...);

/* Pass a formatted warning to log->warn, if both are there. */
__attribute__((format(printf, 2, 3))) void hc_warn(const hc_log *log, const char *format, ...);

#endif
