/* Height fields that change from frame to frame: the same bits on every machine. */
#ifndef HC_CLI_MOTION_H
#define HC_CLI_MOTION_H

#include "settings.h"

/* Heights of a frame, 0 .. frames - 1.
 * heights  [in, out] those of the frame before; of frame 0 anything
 * ground   the field as it was loaded
 * scratch  twice as many floats
 * Returns a rectangle outside which nothing changed. */
hc_rect hc_cli_move(float *heights, float *scratch, const hc_field *ground, hc_cli_motion motion,
                    int frame, int frames);

#endif
