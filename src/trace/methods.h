/* What the library knows about each method; index: hc_trace_method. */
#ifndef HC_TRACE_METHODS_H
#define HC_TRACE_METHODS_H

#include "tracer.h"

typedef struct hc_trace_method_facts {
    const char    *name;
    hc_trace_needs needs;
    hc_march      *march; /* NULL: fast */
    bool           knows_steps;
    int            steps; /* default; 0: the method does not count them */
    bool           bounds;
} hc_trace_method_facts;

extern const hc_trace_method_facts hc_trace_methods[];

#endif
