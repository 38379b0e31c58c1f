/* The fast caster. hc_fast_create checks nothing: hc_tracer_create has. */
#ifndef HC_TRACE_FAST_H
#define HC_TRACE_FAST_H

#include <heightcast/trace.h>

typedef struct hc_fast hc_fast;

/* `tracer` is the one that it becomes part of; its axes are known. */
hc_result hc_fast_create(hc_fast **fast, const hc_tracer *tracer, const hc_field *field,
                         const hc_trace_options *options, hc_log *log);
void      hc_fast_destroy(hc_fast *fast);
/* 0: too large, which hc_fast_create says, too. */
size_t hc_fast_bytes(const hc_field *field, const hc_trace_options *options);
void   hc_fast_tolerance(const hc_fast *fast, double *rise, double *reach);
void   hc_fast_nearest(const hc_fast *fast, hc_hit *hits, const hc_ray *rays, size_t count);
void   hc_fast_any(const hc_fast *fast, uint8_t *any, const hc_ray *rays, size_t count);

#endif
