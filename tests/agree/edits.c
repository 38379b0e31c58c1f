#include "edits.h"

#include "support.h"

#include <math.h>

const char *agree_edit_name(agree_edit how)
{
    static const char *const names[] = { "raise", "lower", "mix", "clear", "touch nothing" };
    return names[how];
}

agree_edit agree_some_edit(uint64_t *random)
{
    return (agree_edit)agree_range(random, 0, AGREE_TOUCH_NOTHING);
}

static float edited(float height, agree_edit how, uint64_t *random)
{
    const float by = (float)agree_uniform(random) * 0.5F;
    switch (how) {
    case AGREE_RAISE: return fminf(1.0F, height + by);
    case AGREE_LOWER: return fmaxf(0.0F, height - by);
    case AGREE_MIX: return agree_range(random, 0, 1) == 0 ? height : (float)agree_uniform(random);
    case AGREE_CLEAR: return 0.0F;
    default: return height;
    }
}

void agree_apply(float *heights, int width, hc_rect rect, agree_edit how, uint64_t *random)
{
    for (int y = rect.y; y < rect.y + rect.height; y++) {
        for (int x = rect.x; x < rect.x + rect.width; x++) {
            heights[y * width + x] = edited(heights[y * width + x], how, random);
        }
    }
}

hc_rect agree_some_rect(const hc_field *field, int turn, uint64_t *random)
{
    hc_rect rect = { .x = agree_range(random, 0, field->width - 1),
                     .y = agree_range(random, 0, field->height - 1) };
    rect.width   = agree_range(random, 1, field->width - rect.x);
    rect.height  = agree_range(random, 1, field->height - rect.y);
    switch (turn % 6) {
    case 0: rect.width = rect.height = 1; break;
    case 1: return (hc_rect){ field->width - 1, field->height - 1, 1, 1 };
    case 2: return (hc_rect){ 0, rect.y, field->width, rect.height };
    case 3: return (hc_rect){ 0, 0, field->width, field->height };
    case 4: return (hc_rect){ 0, 0, (rect.width + 1) / 2, 1 };
    default: break;
    }
    return rect;
}
