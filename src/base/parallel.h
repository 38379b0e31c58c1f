/* Items to threads; what is computed does not depend on how many there are. */
#ifndef HC_BASE_PARALLEL_H
#define HC_BASE_PARALLEL_H

#include <heightcast/result.h>

#define HC_THREADS_MAX 1024

/* Threads that `wanted` comes to: 0 means one per core that this process may use;
 * 1 .. HC_THREADS_MAX. */
int hc_threads_resolve(int wanted);

/* Work on one item. `worker` is 0 .. threads - 1 and names the thread, for scratch memory of its
 * own. */
typedef void (*hc_parallel_body)(void *context, int item, int worker);

/* Run `body` once for each item 0 .. count - 1 on up to `threads` threads, the calling one among
 * them; items are handed out in rising order. Progress is reported from the calling thread. Returns
 * HC_OK, or HC_ERROR_CANCELLED when progress->report said stop (items in flight are finished, the
 * rest never start). Needs no more threads than it can get: when one cannot be started, the others
 * do its work. */
hc_result hc_parallel_for(int count, int threads, hc_parallel_body body, void *context,
                          hc_progress progress, hc_log *log);

#endif
