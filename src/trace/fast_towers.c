/* The towers of sparse ground: a floor that few corners are higher than, and these, each with those
 * next to it. docs/algorithms.md has what their boxes bound. */
#include "fast_data.h"

#include <string.h>

/* Towers are at most one corner in RARE, and their entries in bins one in ROOM: most stand in one
 * bin. Where a bin has more than CROWD, as along a wall, blocks tell more than towers. */
enum { RARE = 64, ROOM = 48, CROWD = 64, CLASSES = 1024 };

typedef struct tower {
    int   left, right, above, below;
    float top;
} tower;

size_t hc_fast_plan_towers(hc_fast *fast)
{
    hc_fast_towers *t     = &fast->towers;
    const size_t    cells = (size_t)fast->x.cells * (size_t)fast->y.cells;
    t->bins_x             = fast->x.cells / HC_FAST_BIN + 3;
    t->bins_y             = fast->y.cells / HC_FAST_BIN + 3;
    t->most               = (uint32_t)(cells / ROOM) + 16; /* sixteen are read at a time */
    return (size_t)t->bins_x * (size_t)t->bins_y + 1 + 4 * (size_t)t->most;
}

void hc_fast_place_towers(hc_fast *fast, uint32_t *room)
{
    hc_fast_towers *t = &fast->towers;
    t->bins           = room;
    t->x              = (float *)(room + (size_t)t->bins_x * (size_t)t->bins_y + 1);
    t->y              = t->x + t->most;
    t->size           = t->y + t->most;
    t->rise           = t->size + t->most;
}

/* The highest of all corners but the towers, which are whole classes of heights. */
static float choose_floor(const hc_fast *fast)
{
    size_t      counts[CLASSES] = { 0 };
    float       tops[CLASSES]   = { 0.0F };
    size_t      left            = (size_t)(fast->x.cells + 1) * (size_t)(fast->y.cells + 1) / RARE;
    int         k               = CLASSES - 1;
    const float top             = fast->highest > 0.0 ? (float)fast->highest : 1.0F;
    const float scale           = (float)(CLASSES - 1) / top;
    for (int y = 0; y <= fast->y.cells; y++) {
        for (int x = 0; x <= fast->x.cells; x++) {
            const float height = fast->heights[hc_fast_corner(fast, x, y)];
            const int class    = (int)(height * scale);
            counts[class]++;
            tops[class] = height > tops[class] ? height : tops[class];
        }
    }
    for (; k > 0 && counts[k] <= left; k--) {
        left -= counts[k];
    }
    return tops[k];
}

/* That of a corner, with those around it that are higher than the floor. */
static tower tower_at(const hc_fast *fast, int x, int y, float ground)
{
    const int left  = x > 0 ? x - 1 : 0;
    const int above = y > 0 ? y - 1 : 0;
    tower     t     = { x, x, y, y, 0.0F };
    for (int j = above; j <= y + 1 && j <= fast->y.cells; j++) {
        for (int i = left; i <= x + 1 && i <= fast->x.cells; i++) {
            const float height = fast->heights[hc_fast_corner(fast, i, j)];
            if (height > ground) {
                t.left  = i < t.left ? i : t.left;
                t.right = i > t.right ? i : t.right;
                t.above = j < t.above ? j : t.above;
                t.below = j > t.below ? j : t.below;
                t.top   = height > t.top ? height : t.top;
            }
        }
    }
    return t;
}

static void put_tower(hc_fast_towers *all, uint32_t k, const tower *t, float ground)
{
    const int wide = t->right - t->left;
    const int high = t->below - t->above;
    all->x[k]      = (float)(t->left + t->right);
    all->y[k]      = (float)(t->above + t->below);
    all->size[k]   = (float)(wide > high ? wide : high);
    all->rise[k]   = t->top - ground;
}

static int bin_of(float corner)
{
    return (int)(corner / (float)HC_FAST_BIN + 1.0F);
}

/* List one in the bins that it reaches into, or count it there: with a quarter of a cell around it
 * and what rounding may misplace rays by. */
static void list_tower(hc_fast *fast, const tower *t, float ground, bool count)
{
    hc_fast_towers *all    = &fast->towers;
    const float     around = 1.25F + 8.0F * fast->blur;
    const int       right  = bin_of((float)t->right + around);
    const int       below  = bin_of((float)t->below + around);
    for (int y = bin_of((float)t->above - around); y <= below && y < all->bins_y; y++) {
        for (int x = bin_of((float)t->left - around); x <= right && x < all->bins_x; x++) {
            uint32_t *bin = &all->bins[(size_t)y * (size_t)all->bins_x + (size_t)x];
            if (count) {
                ++*bin;
            } else {
                put_tower(all, --*bin, t, ground);
            }
        }
    }
}

static void list_all(hc_fast *fast, float ground, bool count)
{
    for (int y = 0; y <= fast->y.cells; y++) {
        for (int x = 0; x <= fast->x.cells; x++) {
            if (fast->heights[hc_fast_corner(fast, x, y)] > ground) {
                const tower t = tower_at(fast, x, y, ground);
                list_tower(fast, &t, ground, count);
            }
        }
    }
}

void hc_fast_list_towers(hc_fast *fast)
{
    hc_fast_towers *all    = &fast->towers;
    const size_t    bins   = (size_t)all->bins_x * (size_t)all->bins_y;
    const float     ground = choose_floor(fast);
    uint32_t        sum    = 0;
    uint32_t        most   = 0;
    memset(all->bins, 0, (bins + 1) * sizeof *all->bins);
    list_all(fast, ground, true);
    for (size_t i = 0; i <= bins; i++) {
        most = all->bins[i] > most ? all->bins[i] : most;
        sum += all->bins[i];
        all->bins[i] = sum; /* its end: entries are put in from there down to where it begins */
    }
    if (most <= CROWD && sum + 16 <= all->most) {
        memset(all->x, 0, 4 * (size_t)all->most * sizeof(float));
        list_all(fast, ground, false);
        all->floor        = ground + fast->least;
        all->listed       = true;
        fast->first_level = 0; /* rays come down to the floor, or stop at a tower */
    }
}
