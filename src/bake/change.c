#include "change.h"

#include "base/fail.h"

#include <math.h>

hc_result hc_check_change(const float *heights, int width, int height, hc_rect changed, hc_log *log)
{
    const hc_rect r = changed;
    if (r.x < 0 || r.y < 0 || r.width < 0 || r.height < 0 || r.width > width || r.height > height
        || r.x > width - r.width || r.y > height - r.height) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "changed rectangle %d,%d %dx%d is not inside %d x %d", r.x, r.y, r.width,
                       r.height, width, height);
    }
    for (int y = r.y; y < r.y + r.height; y++) {
        for (int x = r.x; x < r.x + r.width; x++) {
            const float h = heights[(size_t)y * (size_t)width + (size_t)x];
            if (!(h >= 0.0F && h <= 1.0F)) {
                return hc_fail(log, HC_ERROR_FIELD,
                               "heights[%d, %d] is %g; heights must lie in 0..1", x, y, (double)h);
            }
        }
    }
    return HC_OK;
}

/* Highest old or new height of the samples of `rect` that differ; -1 if none does. */
static float changed_top(const float *heights, int width, hc_rect rect, hc_height_before *before,
                         const void *owner)
{
    float top = -1.0F;
    for (int y = rect.y; y < rect.y + rect.height; y++) {
        for (int x = rect.x; x < rect.x + rect.width; x++) {
            const float was = before(owner, x, y);
            const float is  = heights[(size_t)y * (size_t)width + (size_t)x];
            if (was != is) {
                top = fmaxf(top, fmaxf(was, is));
            }
        }
    }
    return top;
}

/* Small pieces, each with its own top: one tower does not make the whole rectangle high. */
int hc_find_changes(hc_change changes[HC_CHANGES_MAX], const float *heights, int width,
                    hc_rect changed, hc_height_before *before, const void *owner)
{
    const hc_rect r      = changed;
    const int     across = (r.width + HC_CHANGE_PIECES - 1) / HC_CHANGE_PIECES;
    const int     down   = (r.height + HC_CHANGE_PIECES - 1) / HC_CHANGE_PIECES;
    int           count  = 0;
    for (int y = r.y; y < r.y + r.height; y += down) {
        for (int x = r.x; x < r.x + r.width; x += across) {
            hc_rect piece   = { x, y, across, down };
            piece.width     = r.x + r.width - x < across ? r.x + r.width - x : across;
            piece.height    = r.y + r.height - y < down ? r.y + r.height - y : down;
            const float top = changed_top(heights, width, piece, before, owner);
            if (top >= 0.0F) {
                changes[count++] = (hc_change){ .rect = piece, .top = top };
            }
        }
    }
    return count;
}
