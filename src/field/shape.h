/* What every function of this part asks of sizes. */
#ifndef HC_FIELD_SHAPE_H
#define HC_FIELD_SHAPE_H

#include "base/fail.h"

#include <heightcast/field.h>

/* HC_ERROR_ARGUMENT unless the sides are 1 .. HC_SIDE_MAX and width * height elements of
 * `element_bytes` bytes can be one object in memory. `what` names the culprit. */
hc_result hc_check_shape(const char *what, int width, int height, size_t element_bytes,
                         hc_log *log);

/* hc_field_check on several threads, if that pays. */
hc_result hc_field_check_on(const hc_field *field, int threads, hc_log *log);

#endif
