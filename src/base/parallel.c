/* A pool of workers for the length of one loop: an atomic counter hands out the items. */
#define _GNU_SOURCE
#include "parallel.h"

#include "fail.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

enum { REPORTS_MAX = 200 };

typedef struct loop {
    hc_parallel_body body;
    void            *context;
    int              count;
    atomic_int       next;
    atomic_bool      stop;
} loop;

typedef struct worker {
    loop     *shared;
    int       index;
    pthread_t thread;
} worker;

int hc_threads_resolve(int wanted)
{
    if (wanted <= 0) {
        cpu_set_t allowed;
        wanted = sched_getaffinity(0, sizeof allowed, &allowed) == 0
                     ? CPU_COUNT(&allowed)
                     : (int)sysconf(_SC_NPROCESSORS_ONLN);
    }
    return wanted < 1 ? 1 : wanted > HC_THREADS_MAX ? HC_THREADS_MAX : wanted;
}

/* The next item to do, or -1. */
static int take(loop *shared)
{
    if (atomic_load_explicit(&shared->stop, memory_order_relaxed)) {
        return -1;
    }
    const int item = atomic_fetch_add_explicit(&shared->next, 1, memory_order_relaxed);
    return item < shared->count ? item : -1;
}

static void *work(void *argument)
{
    const worker *self = argument;
    for (int item = take(self->shared); item >= 0; item = take(self->shared)) {
        self->shared->body(self->shared->context, item, self->index);
    }
    return NULL;
}

/* The calling thread works too, and reports between its items. */
static void work_and_report(loop *shared, hc_progress progress)
{
    int reported = 0;
    for (int item = take(shared); item >= 0; item = take(shared)) {
        shared->body(shared->context, item, 0);
        const int step = (int)((long long)item * REPORTS_MAX / shared->count);
        if (progress.report != NULL && step > reported) {
            reported = step;
            if (!progress.report(progress.user, (double)item / shared->count)) {
                atomic_store(&shared->stop, true);
            }
        }
    }
}

hc_result hc_parallel_for(int count, int threads, hc_parallel_body body, void *context,
                          hc_progress progress, hc_log *log)
{
    loop   shared = { .body = body, .context = context, .count = count };
    worker helpers[HC_THREADS_MAX];
    int    started = 0;
    if (threads > count) {
        threads = count;
    }
    while (started < threads - 1) {
        helpers[started] = (worker){ .shared = &shared, .index = started + 1 };
        if (pthread_create(&helpers[started].thread, NULL, work, &helpers[started]) != 0) {
            break;
        }
        started++;
    }
    work_and_report(&shared, progress);
    for (int i = 0; i < started; i++) {
        (void)pthread_join(helpers[i].thread, NULL);
    }
    if (atomic_load(&shared.stop)) {
        return hc_fail(log, HC_ERROR_CANCELLED, "stopped on request");
    }
    return HC_OK;
}
