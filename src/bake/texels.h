/* Writing decoded numbers into the texels of a map, in its bits and layout. */
#ifndef HC_BAKE_TEXELS_H
#define HC_BAKE_TEXELS_H

#include <heightcast/bake.h>

/* Everything here works on rows of level 0, or says otherwise; rows can be written at once by
 * different threads. */

/* Heights, already those that codes stand for, and limited ratios: layouts rg, aniso, quad (heights
 * unused), height (ratios unused) and the height and ratio of dummer. */
void hc_put_cone_row(const hc_map *map, int y, const float *heights, const float *ratios);

/* Slopes of layout dummer, from the height codes that all rows already hold. */
void hc_put_dummer_slopes(const hc_map *map, int y);

/* Slopes of layout gradient in codes, from the field's heights. */
void hc_put_slope_row(const hc_map *map, int y, const hc_field *field);

/* One channel of a level of a pyramid, rounded up for maxima and down for minima. */
void hc_put_extremes(const hc_map *map, int level, int channel, const float *values,
                     hc_extreme extreme);

#endif
