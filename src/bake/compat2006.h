/* The 2006 preprocessor's map, byte for byte. */
#ifndef HC_BAKE_COMPAT2006_H
#define HC_BAKE_COMPAT2006_H

#include <heightcast/bake.h>

#include <stdint.h>

/* Fill G, B and A of an RGBA8 image whose R holds the heights. width, height >= 2. */
hc_result hc_compat2006(uint8_t *rgba, int width, int height, hc_wrap wrap, int threads,
                        hc_progress progress, hc_log *log);

#endif
