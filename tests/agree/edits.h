/* Changes of heights in rectangles, for bakers that stay. */
#ifndef AGREE_EDITS_H
#define AGREE_EDITS_H

#include <heightcast/bake.h>

typedef enum agree_edit {
    AGREE_RAISE,
    AGREE_LOWER,
    AGREE_MIX,
    AGREE_CLEAR,
    AGREE_TOUCH_NOTHING
} agree_edit;

const char *agree_edit_name(agree_edit how);
agree_edit  agree_some_edit(uint64_t *random);

void agree_apply(float *heights, int width, hc_rect rect, agree_edit how, uint64_t *random);

/* Single samples, rectangles anywhere, at the far corner, across one axis, everything: in turn. */
hc_rect agree_some_rect(const hc_field *field, int turn, uint64_t *random);

#endif
