/* The blocks of the fast caster as a texture, for shaders. */
#include "fast_data.h"
#include "tracer.h"

/* With the one more at the end. */
static int count_blocks(const hc_fast_axis *axis, int level)
{
    return hc_fast_block_count(axis, level) + 1;
}

/* Where a level begins, along the axis that they stand one after another on. */
static int begin_level(int room, int level)
{
    return room - (room >> (HC_FAST_RATIO_BITS * level));
}

/* The least room that holds each level before the next one begins. */
static int make_room(const hc_fast_axis *axis, int levels)
{
    int room = 0;
    for (int k = 0; k + 1 < levels; k++) {
        const int needed = ((4 * count_blocks(axis, k) + 2) / 3) << (HC_FAST_RATIO_BITS * k);
        room             = needed > room ? needed : room;
    }
    return room;
}

static void copy_level(uint32_t *texels, const hc_block_map *map, const hc_fast *fast, int k)
{
    const int left  = begin_level(map->room[0], k);
    const int above = begin_level(map->room[1], k);
    const int wide  = count_blocks(&fast->x, k);
    const int high  = count_blocks(&fast->y, k);
    for (int y = 0; y < high; y++) {
        uint32_t *to = texels + 2 * ((size_t)(above + y) * (size_t)map->width + (size_t)left);
        for (int x = 0; x < wide; x++, to += 2) {
            const hc_fast_block *block =
                fast->blocks + fast->start[k] + hc_fast_block_at(fast, k, x, y);
            to[0] = 0;
            to[1] = 0;
            for (int q = 0; q < 4; q++, block += fast->plane) {
                to[0] = *block > to[0] ? *block : to[0];
                to[1] |= (*block & HC_FAST_CODE) << (8 * q);
            }
        }
    }
}

static hc_block_map shape_of(const hc_fast *fast)
{
    const int           along = fast->x.cells >= fast->y.cells ? 0 : 1;
    const hc_fast_axis *axis  = along == 0 ? &fast->x : &fast->y;
    const int           last  = fast->levels - 1;
    hc_block_map        map   = { .width  = count_blocks(&fast->x, 0),
                                  .height = count_blocks(&fast->y, 0),
                                  .cells  = { fast->x.cells, fast->y.cells },
                                  .first  = { -fast->x.first, -fast->y.first },
                                  .levels = fast->levels,
                                  .sparse = fast->sparse,
                                  .blur   = fast->blur };
    map.room[along]           = make_room(axis, fast->levels);
    const int  end            = begin_level(map.room[along], last) + count_blocks(axis, last);
    int *const side           = along == 0 ? &map.width : &map.height;
    *side                     = end > *side ? end : *side;
    return map;
}

bool hc_tracer_block_map(const hc_tracer *tracer, hc_block_map *map, uint32_t *texels)
{
    const hc_fast *fast = tracer->fast;
    if (fast == NULL) {
        return false;
    }
    *map = shape_of(fast);
    for (int k = 0; k < fast->levels && texels != NULL; k++) {
        copy_level(texels, map, fast, k);
    }
    return true;
}
