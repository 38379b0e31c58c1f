/* What changed in a rectangle of heights, for bakers that stay. */
#ifndef HC_BAKE_CHANGE_H
#define HC_BAKE_CHANGE_H

#include <heightcast/bake.h>

/* A changed rectangle is looked at in at most so many pieces. */
enum { HC_CHANGE_PIECES = 8, HC_CHANGES_MAX = HC_CHANGE_PIECES * HC_CHANGE_PIECES };

/* Samples that changed: where, and their highest height, old or new. */
typedef struct hc_change {
    hc_rect rect;
    float   top;
} hc_change;

/* HC_ERROR_ARGUMENT unless `changed` is inside the field, HC_ERROR_FIELD unless its heights are in
 * 0..1. */
hc_result hc_check_change(const float *heights, int width, int height, hc_rect changed,
                          hc_log *log);

/* A sample as it was before. */
typedef float hc_height_before(const void *owner, int x, int y);

/* The pieces of `changed` in which any sample differs; how many. */
int hc_find_changes(hc_change changes[HC_CHANGES_MAX], const float *heights, int width,
                    hc_rect changed, hc_height_before *before, const void *owner);

#endif
