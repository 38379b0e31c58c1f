/* The CPU draws what every other backend is compared with. */
#ifndef HC_RENDER_CPU_H
#define HC_RENDER_CPU_H

#include "shade.h"

/* Fill zeroed pixels. */
hc_result hc_cpu_draw(hc_pixel *pixels, const hc_stage *stage, hc_log *log);

#endif
