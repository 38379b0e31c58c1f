#define _DEFAULT_SOURCE /* madvise */
#include "memory.h"

#include <stdlib.h>

#if defined(__linux__)
#include <sys/mman.h>
#endif

enum { LINE = 64, PAGE = 1 << 21 };

static size_t unit_of(size_t bytes)
{
    return bytes >= (size_t)PAGE ? PAGE : LINE;
}

size_t hc_memory_taken(size_t bytes)
{
    const size_t unit = unit_of(bytes);
    return (bytes + unit - 1) / unit * unit;
}

void *hc_take_memory(size_t bytes)
{
    void *taken = aligned_alloc(unit_of(bytes), hc_memory_taken(bytes));
#if defined(__linux__)
    if (taken != NULL && unit_of(bytes) == PAGE) {
        (void)madvise(taken, hc_memory_taken(bytes), MADV_HUGEPAGE);
    }
#endif
    return taken;
}
