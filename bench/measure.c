#include "measure.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { RUNS_MAX = 1000, POLL_MILLISECONDS = 200 };

/* What the child sends ahead of the output. */
typedef struct message {
    hc_result     result;
    hc_bench_time time;
    char          text[HC_LOG_TEXT_SIZE];
} message;

static double read_clock(clockid_t clock)
{
    struct timespec time;
    (void)clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* A figure of /proc/self/status such as "VmHWM:" [bytes]; 0 where there is none. */
static double status_bytes(const char *name)
{
    char   line[256];
    double kilobytes = 0.0;
    FILE  *file      = fopen("/proc/self/status", "r");
    if (file == NULL) {
        return 0.0;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, name, strlen(name)) == 0) {
            kilobytes = strtod(line + strlen(name), NULL);
        }
    }
    (void)fclose(file);
    return kilobytes * 1024.0;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_of(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, by_value);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

static void run_all(message *m, void *output, hc_bench_work *work, void *context,
                    const hc_bench_limits *limits, hc_log *log)
{
    static double seconds[RUNS_MAX];
    static double processor[RUNS_MAX];
    const double  start = read_clock(CLOCK_MONOTONIC);
    int           runs  = 0;
    do {
        const double begin     = read_clock(CLOCK_MONOTONIC);
        const double processed = read_clock(CLOCK_PROCESS_CPUTIME_ID);
        m->result              = work(context, output, log);
        processor[runs]        = read_clock(CLOCK_PROCESS_CPUTIME_ID) - processed;
        seconds[runs++]        = read_clock(CLOCK_MONOTONIC) - begin;
    } while (m->result == HC_OK && runs < limits->repeat && runs < RUNS_MAX
             && read_clock(CLOCK_MONOTONIC) - start < limits->seconds);
    m->time.runs      = runs;
    m->time.median    = median_of(seconds, runs);
    m->time.fastest   = seconds[0];
    m->time.slowest   = seconds[runs - 1];
    m->time.processor = median_of(processor, runs);
}

static bool write_all(int pipe_end, const void *data, size_t size)
{
    const char *next = data;
    while (size > 0) {
        const ssize_t wrote = write(pipe_end, next, size);
        if (wrote < 0 && errno != EINTR) {
            return false;
        }
        next += wrote > 0 ? wrote : 0;
        size -= wrote > 0 ? (size_t)wrote : 0;
    }
    return true;
}

static void *nothing(void *unused)
{
    return unused;
}

/* A process's first thread makes the loader touch pages of every library the program has: they are
 * no memory of the work. */
static void start_first_thread(void)
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, nothing, NULL) == 0) {
        (void)pthread_join(thread, NULL);
    }
}

/* The output is touched before the clock starts: the work is measured, not the kernel's giving of
 * pages. */
static void be_child(int pipe_end, void *output, hc_bench_work *work, void *context,
                     const hc_bench_limits *limits)
{
    static message m;
    static hc_log  log;
    start_first_thread();
    const double resident = status_bytes("VmRSS:");
    memset(output, 0, limits->output_bytes);
    run_all(&m, output, work, context, limits, &log);
    const double peak = status_bytes("VmHWM:");
    m.time.peak_bytes = peak > 0.0 ? peak - resident + (double)limits->input_bytes : 0.0;
    memcpy(m.text, log.text, sizeof m.text);
    const bool sent = write_all(pipe_end, &m, sizeof m)
                      && (m.result != HC_OK || write_all(pipe_end, output, limits->output_bytes));
    _exit(sent ? 0 : 1);
}

static hc_result fail(hc_log *log, hc_result result, const char *text)
{
    if (log != NULL) {
        (void)snprintf(log->text, sizeof log->text, "%s", text);
    }
    return result;
}

static bool stopped(const hc_bench_limits *limits)
{
    return limits->stop != NULL && limits->stop();
}

/* False at the end of the data, or when asked to stop. */
static bool read_all(int pipe_end, void *data, size_t size, const hc_bench_limits *limits)
{
    char *next = data;
    while (size > 0) {
        struct pollfd wanted = { .fd = pipe_end, .events = POLLIN };
        const int     ready  = poll(&wanted, 1, POLL_MILLISECONDS);
        if (stopped(limits)) {
            return false;
        }
        const ssize_t got = ready > 0 ? read(pipe_end, next, size) : -1;
        if (got == 0 || (got < 0 && ready > 0 && errno != EINTR)) {
            return false;
        }
        next += got > 0 ? got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

/* The child is gone, or is to go. */
static hc_result lost(const hc_bench_limits *limits, hc_log *log)
{
    return stopped(limits)
               ? fail(log, HC_ERROR_CANCELLED, "stopped on request")
               : fail(log, HC_ERROR_MEMORY, "the measuring process died; out of memory?");
}

static hc_result receive(hc_bench_time *time, void *output, int pipe_end,
                         const hc_bench_limits *limits, hc_log *log)
{
    static message m;
    if (!read_all(pipe_end, &m, sizeof m, limits)) {
        return lost(limits, log);
    }
    if (m.result != HC_OK) {
        return fail(log, m.result, m.text);
    }
    *time = m.time;
    return read_all(pipe_end, output, limits->output_bytes, limits) ? HC_OK : lost(limits, log);
}

hc_result hc_bench_measure(hc_bench_time *time, void *output, hc_bench_work *work, void *context,
                           const hc_bench_limits *limits, hc_log *log)
{
    int ends[2];
    if (pipe(ends) != 0) {
        return fail(log, HC_ERROR_IO, "cannot make a pipe");
    }
    (void)fflush(NULL); /* or the child would print what is still buffered once more */
    const pid_t child = fork();
    if (child == 0) {
        (void)close(ends[0]);
        be_child(ends[1], output, work, context, limits);
    }
    (void)close(ends[1]);
    hc_result result = fail(log, HC_ERROR_MEMORY, "cannot start a process");
    if (child > 0) {
        result = receive(time, output, ends[0], limits, log);
        if (result != HC_OK) {
            (void)kill(child, SIGKILL);
        }
        while (waitpid(child, NULL, 0) < 0 && errno == EINTR) {
        }
    }
    (void)close(ends[0]);
    return result;
}
