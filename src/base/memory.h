/* Memory for large arrays that are read all over the place. */
#ifndef HC_BASE_MEMORY_H
#define HC_BASE_MEMORY_H

#include <stddef.h>

/* At least `bytes`, aligned to cache lines, in large pages where the system has them: the kernel
 * gives them faster, and each small page would cost a look-up. Free with free. NULL: no memory. */
void *hc_take_memory(size_t bytes);

/* What that takes. */
size_t hc_memory_taken(size_t bytes);

#endif
