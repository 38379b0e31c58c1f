/* Time and peak memory of a piece of work, taken in a process of its own. */
#ifndef HC_BENCH_MEASURE_H
#define HC_BENCH_MEASURE_H

#include <heightcast/result.h>

#include <stddef.h>

/* Fill `output`; called `repeat` times with the same arguments. */
typedef hc_result hc_bench_work(void *context, void *output, hc_log *log);

typedef struct hc_bench_limits {
    int    repeat;      /* runs wanted, of which the median counts          */
    double seconds;     /* no further run is started after so long          */
    size_t input_bytes; /* what the work reads, already in memory           */
    size_t output_bytes;
    bool (*stop)(void); /* asked a few times a second: true ends the child; may be NULL */
} hc_bench_limits;

typedef struct hc_bench_time {
    int    runs;
    double median, fastest, slowest; /* [s]                                         */
    double processor;                /* median of all threads' processor time [s]   */
    double peak_bytes;               /* input + output + work memory; 0: not known  */
} hc_bench_time;

/* Run `work` in a child process and bring back its output.
 * output  [out] limits->output_bytes; not yet touched, so that its pages count as the child's
 * Errors: what the work returned; HC_ERROR_IO or HC_ERROR_MEMORY if there is no child to be had or
 * it died; HC_ERROR_CANCELLED. */
hc_result hc_bench_measure(hc_bench_time *time, void *output, hc_bench_work *work, void *context,
                           const hc_bench_limits *limits, hc_log *log);

#endif
