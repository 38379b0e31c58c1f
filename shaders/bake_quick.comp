/* bake_quick.comp: three blocks an axis on every level (2022). Behind bake.comp. */

/* A pyramid of maxima, on all mips: each level has the sides of the one below halved and rounded
 * down, and its last column (row) has what is left over. */
uniform sampler2D u_highest;
uniform int       u_levels;

uniform bool u_improved, u_centre;

/* Where the blocks of one level lie on one axis: reaches to all of a block, and to the part of it
 * that no finer level has visited. */
struct beside {
    float whole[3], rest[3];
    int   block[3];
};

/* Intervals of samples: first, last; empty if first > last. */
ivec2 common_part(ivec2 a, ivec2 b)
{
    return ivec2(max(a.x, b.x), min(a.y, b.y));
}

/* There is only one: `visited` reaches beyond the middle of `span` or its end. */
ivec2 beyond(ivec2 span, ivec2 visited)
{
    return span.x < visited.x ? common_part(span, ivec2(span.x, visited.x - 1))
                              : common_part(span, ivec2(visited.y + 1, span.y));
}

int level_side(int size, int level)
{
    return max(size >> level, 1);
}

bool exists(int block, int count, bool wraps)
{
    return wraps || (block >= 0 && block < count);
}

/* Blocks -1 and `count` are the images across a border that wraps. */
ivec2 image_samples(int block, int level, int size)
{
    int  count = level_side(size, level);
    int  own   = (block + count) % count;
    int  shift = block < 0 ? -size : block >= count ? size : 0;
    bool ends  = own == count - 1;
    return ivec2(own << level, (ends ? size : (own + 1) << level) - 1) + shift;
}

ivec2 visited_after(int level, int place, int size, bool wraps)
{
    int count = level_side(size, level);
    int block = min(place >> level, count - 1);
    int first = exists(block - 1, count, wraps) ? block - 1 : block;
    int last  = exists(block + 1, count, wraps) ? block + 1 : block;
    return ivec2(image_samples(first, level, size).x, image_samples(last, level, size).y);
}

/* Half steps, for the middles of even intervals. */
float reach_to_span(ivec2 span, int place, float step_)
{
    int halves = u_centre ? abs(span.x + span.y - 2 * place)
                          : 2 * (span.x > place ? span.x - place : max(place - span.y, 0));
    return span.x > span.y ? NEVER : reach_of(halves, 0.5 * step_);
}

/* One block, `offset` from the one that holds the texel. */
void measure(inout beside made, int slot, int offset, int level, int place, int size, bool wraps,
             float step_, int side)
{
    int count        = level_side(size, level);
    int block        = min(place >> level, count - 1);
    made.block[slot] = block;
    made.whole[slot] = NEVER;
    made.rest[slot]  = NEVER;
    if (!exists(block + offset, count, wraps)) {
        return;
    }
    ivec2 seen    = ivec2(side > 0 ? place : -2 * size, side < 0 ? place : 3 * size);
    ivec2 whole   = common_part(image_samples(block + offset, level, size), seen);
    ivec2 visited = level > 0 ? visited_after(level - 1, place, size, wraps) : ivec2(place);
    ivec2 rest    = beyond(whole, visited);
    made.block[slot] = (block + offset + count) % count;
    made.rest[slot]  = reach_to_span(rest, place, step_);
    made.whole[slot] = reach_to_span(whole, place, step_);
    if (!u_improved && offset != 0) {
        made.rest[slot] = made.whole[slot];
    } else if (u_improved && u_centre && rest.x <= rest.y) {
        made.whole[slot] = made.rest[slot];
    }
}

beside measure_all(int level, int place, int size, bool wraps, float step_, int side)
{
    beside made;
    int    first = side > 0 ? 0 : -1;
    for (int slot = 0; slot < 3 - HC_SIDED; slot++) {
        measure(made, slot, first + slot, level, place, size, wraps, step_, side);
    }
    return made;
}

void run(ivec2 here)
{
    float    height = texelFetch(u_heights, here, 0).r;
    float    top    = texelFetch(u_highest, ivec2(0), u_levels - 1).r;
    ivec2    sides  = HC_SIDED == 1 ? u_sides : ivec2(0);
    steepest best   = steepest(0.0, 0.0);
    for (int level = 0; level < u_levels && top > height; level++) {
        beside u = measure_all(level, here.x, u_size.x, u_wraps.x, u_step.x, sides.x);
        beside v = measure_all(level, here.y, u_size.y, u_wraps.y, u_step.y, sides.y);
        for (int i = 0; i < (3 - HC_SIDED) * (3 - HC_SIDED); i++) {
            int           x     = i % (3 - HC_SIDED);
            int           y     = i / (3 - HC_SIDED);
            precise float by_u  = u.rest[x] + v.whole[y];
            precise float by_v  = u.whole[x] + v.rest[y];
            float         reach = min(by_u, by_v);
            ivec2         block = ivec2(u.block[x], v.block[y]);
            look_at(best, texelFetch(u_highest, block, level).r - height, reach);
        }
    }
    imageStore(u_best, here, vec4(best.value));
}
