/* bake.comp: max-mip pyramids and exact or quick cone maps on the GPU. Compute shaders of GLSL
 * 4.30, several in one text: put your #version line in front of it and
 *     #define HC_BAKE HC_PYRAMID    one level of a pyramid from the level below it
 *                     HC_BOUNDS     the highest or lowest corner of each bilinear cell
 *                     HC_GRADIENT   slopes along one axis
 *                     HC_BRUTE      the steepest of all samples, some rows of them at a time
 *                     HC_EXACT      the same by pruned search of a max pyramid
 *                     HC_UPDATE     the same again where changed heights may matter
 *                     HC_QUICK      the blocks around a texel on every level (2022, 1 and 2)
 *                     HC_FALLING    the samples that limit relaxed cones of one quadrant (2024)
 *                     HC_GEMS       relaxed cones by ray sampling (2007), likewise
 *                     HC_RATIOS     ratios of what the searches found
 *                     HC_CELLS      of each bilinear cell the least ratios of its corners
 *                     HC_ROUNDING   what this driver makes of quotients and roots
 *     #define HC_L2 1               round cones; 0: diamonds
 *     #define HC_SIDED 1            samples of the quadrant u_sides only; 0: all
 *
 * Searches leave in u_best the largest steepness: rise * weight, the weight one over the distance
 * in texture units; 0: nothing is higher. The ratio of the cone is one over that: include/
 * heightcast/bake.h has the canonical formula, and include/heightcast/gpu.h what this gives of it.
 *
 * A dispatch does the texels u_first .. u_end - 1, so that large fields can be split into pieces
 * that no driver takes for a hang. */

#define HC_PYRAMID 1
#define HC_BRUTE 2
#define HC_EXACT 3
#define HC_QUICK 4
#define HC_FALLING 5
#define HC_ROUNDING 6
#define HC_GEMS 7
#define HC_BOUNDS 8
#define HC_GRADIENT 9
#define HC_UPDATE 10
#define HC_RATIOS 11
#define HC_CELLS 12
#ifndef HC_L2
#define HC_L2 1
#endif
#ifndef HC_SIDED
#define HC_SIDED 0
#endif

layout(local_size_x = 8, local_size_y = 8) in;

uniform ivec2 u_first, u_end; /* texels of this dispatch */
uniform ivec2 u_size;         /* of the field */
uniform bvec2 u_wraps;

/* R: the samples; and a pyramid of maxima, on all mips: each level has the sides of the one below
 * halved and rounded down, and its last column (row) has what is left over. */
uniform sampler2D u_heights, u_highest;
uniform int       u_levels;

uniform vec2  u_step;  /* texture units between samples */
uniform ivec2 u_sides; /* of the quadrant: 1 or -1 along u and v */
uniform bool  u_go_on; /* u_best already holds what other dispatches found */

layout(r32f, binding = 0) uniform image2D u_best;

ivec2 texel_of_this(void)
{
    return u_first + ivec2(gl_GlobalInvocationID.xy);
}

/* ---- the canonical formula ------------------------------------------------------------------- */

/* Distances that nothing has: blocks that are not there. */
#define NEVER 1e30

/* Share of one axis in the distance: squared for round cones. */
float reach_of(int samples, float step_)
{
    precise float x = float(samples) * step_;
#if HC_L2
    precise float square = x * x;
    return square;
#else
    return x;
#endif
}

float weight_of(float reach)
{
#if HC_L2
    precise float root   = sqrt(reach);
    precise float weight = 1.0 / root;
#else
    precise float weight = 1.0 / reach;
#endif
    return weight;
}

float power_of(float rise)
{
    return HC_L2 == 1 ? rise * abs(rise) : rise;
}

struct steepest {
    float value; /* 0: nothing is higher */
    float edge;  /* its power, less what rounding may have added */
};

steepest steepest_of(float value)
{
    return steepest(value, value >= 9.094947e-13 ? power_of(value) * (1.0 - 3.8146973e-6) : 0.0);
}

/* False only if no rise up to `rise` > 0 at no less than `reach` is steeper than `best`. */
bool may_be_steeper(float rise, float reach, steepest best)
{
    return reach < NEVER && power_of(rise) >= best.edge * reach;
}

void look_at(inout steepest best, float rise, float reach)
{
    if (rise > 0.0 && may_be_steeper(rise, reach, best)) {
        precise float value = rise * weight_of(reach);
        if (value > best.value) {
            best = steepest_of(value);
        }
    }
}

/* Samples between `from` and the nearest of low .. high that counts; -1: none does. side: 1, -1 for
 * those that way, 0 for all, at their nearest images along an axis that wraps. */
int apart(int from, int low, int high, int size, bool wraps, int side)
{
    if (side > 0) {
        return high >= from ? max(low - from, 0) : wraps ? low + size - from : -1;
    }
    if (side < 0) {
        return low <= from ? max(from - high, 0) : wraps ? from + size - high : -1;
    }
    int straight = max(max(low - from, from - high), 0);
    return wraps ? min(straight, min(low + size - from, from + size - high)) : straight;
}

ivec2 apart_from(ivec2 from, ivec2 low, ivec2 high)
{
    ivec2 sides = HC_SIDED == 1 ? u_sides : ivec2(0);
    return ivec2(apart(from.x, low.x, high.x, u_size.x, u_wraps.x, sides.x),
                 apart(from.y, low.y, high.y, u_size.y, u_wraps.y, sides.y));
}

float reach_to(ivec2 away)
{
    precise float sum = reach_of(away.x, u_step.x) + reach_of(away.y, u_step.y);
    return away.x < 0 || away.y < 0 ? NEVER : sum;
}

/* ---- blocks ---------------------------------------------------------------------------------- */

ivec2 side_of(int level)
{
    return max(u_size >> level, ivec2(1));
}

ivec2 block_above(ivec2 sample_, int level)
{
    return min(sample_ >> level, side_of(level) - 1);
}

/* First and last sample of a block. */
ivec2 first_of(ivec2 block, int level)
{
    return block << level;
}

ivec2 last_of(ivec2 block, int level)
{
    bvec2 ends = equal(block, side_of(level) - 1);
    ivec2 next = (block + 1) << level;
    return ivec2(ends.x ? u_size.x : next.x, ends.y ? u_size.y : next.y) - 1;
}

/* Last of the blocks of the level below; the first is 2 * block. */
ivec2 last_child(ivec2 block, int level)
{
    bvec2 ends  = equal(block, side_of(level) - 1);
    ivec2 below = side_of(level - 1) - 1;
    return ivec2(ends.x ? below.x : 2 * block.x + 1, ends.y ? below.y : 2 * block.y + 1);
}

/* ---- pyramids -------------------------------------------------------------------------------- */

uniform bool u_minimum;

float extreme_of(float a, float b)
{
    return u_minimum ? min(a, b) : max(a, b);
}

#if HC_BAKE == HC_PYRAMID

uniform int u_level;
layout(r32f, binding = 1) uniform readonly image2D u_below;

void run(ivec2 block)
{
    ivec2 first = 2 * block;
    ivec2 last  = last_child(block, u_level);
    float found = imageLoad(u_below, first).r;
    for (int y = first.y; y <= last.y; y++) {
        for (int x = first.x; x <= last.x; x++) {
            found = extreme_of(found, imageLoad(u_below, ivec2(x, y)).r);
        }
    }
    imageStore(u_best, block, vec4(found));
}

#endif

/* ---- cells and slopes ------------------------------------------------------------------------ */

/* The sample beside one, wrapped or at the border. */
ivec2 beside_of(ivec2 here, ivec2 by)
{
    ivec2 next   = here + by;
    ivec2 folded = (next + u_size) % u_size;
    ivec2 kept   = clamp(next, ivec2(0), u_size - 1);
    return ivec2(u_wraps.x ? folded.x : kept.x, u_wraps.y ? folded.y : kept.y);
}

#if HC_BAKE == HC_BOUNDS

void run(ivec2 here)
{
    ivec2 next  = beside_of(here, ivec2(1));
    float upper = extreme_of(texelFetch(u_heights, here, 0).r,
                             texelFetch(u_heights, ivec2(next.x, here.y), 0).r);
    float lower = extreme_of(texelFetch(u_heights, ivec2(here.x, next.y), 0).r,
                             texelFetch(u_heights, next, 0).r);
    imageStore(u_best, here, vec4(extreme_of(upper, lower)));
}

#endif

#if HC_BAKE == HC_GRADIENT

uniform double u_per_step; /* samples per texture unit */

/* Central difference, one-sided at a border that does not wrap, along u_sides. Doubles, so that the
 * difference of two floats is exact and only the result is rounded. */
void run(ivec2 here)
{
    ivec2  low   = beside_of(here, -u_sides);
    ivec2  high  = beside_of(here, u_sides);
    bool   wraps = u_sides.x != 0 ? u_wraps.x : u_wraps.y;
    ivec2  apart_ = wraps ? 2 * u_sides : high - low;
    int    steps = apart_.x + apart_.y;
    precise double rise  = double(texelFetch(u_heights, high, 0).r)
                          - double(texelFetch(u_heights, low, 0).r);
    precise double slope = rise * (steps == 2 ? 0.5 * u_per_step : u_per_step);
    imageStore(u_best, here, vec4(steps > 0 ? float(slope) : 0.0));
}

#endif

/* ---- all samples ----------------------------------------------------------------------------- */

#if HC_BAKE == HC_BRUTE

uniform ivec2 u_rows; /* first row that is looked at, and the one after the last */

/* The columns that count are from.x .. from.y - 1, or their images `shift` beyond. */
float look_along(ivec2 from, int shift, ivec2 here, int y, float reach_v, float height, float found)
{
    for (int x = from.x; x < from.y; x++) {
        float         rise  = texelFetch(u_heights, ivec2(x, y), 0).r - height;
        precise float reach = reach_of(abs(x + shift - here.x), u_step.x) + reach_v;
        precise float value = rise * weight_of(reach);
        found               = rise > 0.0 && value > found ? value : found;
    }
    return found;
}

/* Which columns count where they are: those before .x do so a period further right, those from .y
 * on a period further left. */
ivec2 nearest_images(int here, int size, bool wraps, int side)
{
    if (!wraps) {
        return ivec2(0, size);
    }
    int half_ = size / 2;
    return side > 0   ? ivec2(here, size)
           : side < 0 ? ivec2(0, here + 1)
                      : ivec2(max(here - half_, 0), min(here + half_ + 1, size));
}

void run(ivec2 here)
{
    float height = texelFetch(u_heights, here, 0).r;
    float found  = u_go_on ? imageLoad(u_best, here).r : 0.0;
    ivec2 sides  = HC_SIDED == 1 ? u_sides : ivec2(0);
    ivec2 own    = nearest_images(here.x, u_size.x, u_wraps.x, sides.x);
    ivec2 seen   = u_wraps.x ? ivec2(0, u_size.x)
                             : ivec2(sides.x > 0 ? here.x : 0, sides.x < 0 ? here.x + 1 : u_size.x);
    ivec2 middle = ivec2(max(own.x, seen.x), min(own.y, seen.y));
    for (int y = u_rows.x; y < u_rows.y; y++) {
        int   away    = apart(here.y, y, y, u_size.y, u_wraps.y, sides.y);
        float reach_v = reach_of(away, u_step.y);
        if (away >= 0) {
            found = look_along(ivec2(seen.x, own.x), u_size.x, here, y, reach_v, height, found);
            found = look_along(middle, 0, here, y, reach_v, height, found);
            found = look_along(ivec2(own.y, seen.y), -u_size.x, here, y, reach_v, height, found);
        }
    }
    imageStore(u_best, here, vec4(found));
}

#endif

/* ---- pruned search --------------------------------------------------------------------------- */

#if HC_BAKE == HC_GEMS

uniform int u_gems_steps;

/* Two neighbouring samples along one axis: low, high; and the weight of the second. */
int tap_at(float place, int size, bool wraps, out int high, out float weight)
{
    float         whole = float(size);
    precise float turns = whole * floor(place / whole);
    precise float kept  = wraps ? place - turns : clamp(place, 0.0, whole - 1.0);
    if (wraps && !(kept >= 0.0 && kept < whole)) {
        kept = 0.0; /* rounding can leave the period */
    }
    int low = int(kept);
    high    = low + 1 < size ? low + 1 : wraps ? 0 : low;
    weight  = kept - float(low);
    return low;
}

float between(float a, float b, float weight)
{
    precise float part = (b - a) * weight;
    precise float sum  = a + part;
    return sum;
}

float surface(vec2 place)
{
    ivec2 high;
    vec2  weight;
    int   x     = tap_at(place.x, u_size.x, u_wraps.x, high.x, weight.x);
    int   y     = tap_at(place.y, u_size.y, u_wraps.y, high.y, weight.y);
    float upper = between(texelFetch(u_heights, ivec2(x, y), 0).r,
                          texelFetch(u_heights, ivec2(high.x, y), 0).r, weight.x);
    float lower = between(texelFetch(u_heights, ivec2(x, high.y), 0).r,
                          texelFetch(u_heights, high, 0).r, weight.x);
    return between(upper, lower, weight.y);
}

/* From `here` to the nearest image of `there`; of two as near, the one to the right or below. */
ivec2 to_image(ivec2 here, ivec2 there)
{
    ivec2 straight = there - here;
    ivec2 forward  = u_size / 2;
    ivec2 turns    = ivec2(lessThan(straight, forward - u_size + 1))
                  - ivec2(greaterThan(straight, forward));
    return straight + turns * ivec2(u_wraps) * u_size;
}

/* A ray from above `here` enters the surface at `there` and goes on down: where it comes out again
 * the cone ends. */
void judge(inout steepest best, ivec2 here, ivec2 there, float apex, float rise, float reach)
{
    ivec2 way   = to_image(here, there);
    float entry = texelFetch(u_heights, there, 0).r;
    if (entry >= 1.0) {
        look_at(best, rise, reach);
        return;
    }
    float         steps   = float(u_gems_steps);
    precise float falls   = (1.0 - entry) * steps;
    precise float stretch = entry / falls;
    for (int i = 1; i <= u_gems_steps; i++) {
        precise float share  = float(i) / steps;
        precise float fallen = entry * share;
        precise float height = entry - fallen;
        precise float longer = float(i) * stretch;
        precise float times  = 1.0 + longer;
        precise float square = times * times;
        precise float beyond = reach * square;
        precise float over   = height - apex;
        if (height <= apex || !may_be_steeper(over, beyond, best)) {
            return;
        }
        precise vec2 gone  = vec2(way) * times;
        precise vec2 place = vec2(here) + gone;
        if (surface(place) < height) {
            look_at(best, over, beyond);
            return;
        }
    }
}

#endif

#if HC_BAKE == HC_EXACT || HC_BAKE == HC_UPDATE || HC_BAKE == HC_GEMS

#if HC_BAKE != HC_GEMS
#define judge(best, here, there, apex, rise, reach) look_at(best, rise, reach)
#endif

/* The blocks below one parent, in the order in which they are looked at: from the side of the block
 * of their level that holds the texel. */
struct family {
    ivec2 first, last; /* in this order: first may be beyond last */
    ivec2 step_;
};

family family_of(ivec2 parent, int level, ivec2 own)
{
    ivec2 low  = 2 * parent;
    ivec2 high = last_child(parent, level + 1);
    bvec2 turn = greaterThan(own, low);
    return family(ivec2(turn.x ? high.x : low.x, turn.y ? high.y : low.y),
                  ivec2(turn.x ? low.x : high.x, turn.y ? low.y : high.y),
                  ivec2(turn.x ? -1 : 1, turn.y ? -1 : 1));
}

/* False: `block` is the last one, and stays. */
bool next_of(family f, inout ivec2 block)
{
    bool turn = block.x == f.last.x;
    if (turn && block.y == f.last.y) {
        return false;
    }
    block = turn ? ivec2(f.first.x, block.y + f.step_.y) : ivec2(block.x + f.step_.x, block.y);
    return true;
}

/* From the block that was looked at to the next one: beside it, or else its parent. Along the
 * blocks that hold `here` the search climbs: those are not looked at, but their siblings from the
 * first. False: there is none beside it. */
bool advance(inout ivec2 block, inout int level, ivec2 here)
{
    ivec2  own    = block_above(here, level);
    ivec2  parent = min(block >> 1, side_of(level + 1) - 1);
    family f      = family_of(parent, level, own);
    ivec2  next   = block == own ? f.first : block;
    bool   more   = block == own || next_of(f, next);
    if (more && next == own) {
        more = next_of(f, next);
    }
    block = more ? next : parent;
    level += more ? 0 : 1;
    return more;
}

void search(ivec2 here, float height, steepest best)
{
    float    top    = texelFetch(u_highest, ivec2(0), u_levels - 1).r;
    ivec2    block  = here;
    int      level  = top > height ? 0 : u_levels;
    bool     fresh  = false; /* `block` was not looked at yet */
    while (fresh || level < u_levels - 1) {
        if (!fresh && !advance(block, level, here)) {
            continue;
        }
        float rise  = texelFetch(u_highest, block, level).r - height;
        float reach = reach_to(apart_from(here, first_of(block, level), last_of(block, level)));
        bool  may_be = rise > 0.0 && may_be_steeper(rise, reach, best);
        fresh        = may_be && level > 0;
        if (may_be && level == 0) {
            judge(best, here, block, height, rise, reach);
        }
        if (fresh) {
            level--;
            block = family_of(block, level, block_above(here, level)).first;
        }
    }
    imageStore(u_best, here, vec4(best.value));
}

#endif

#if HC_BAKE == HC_EXACT || HC_BAKE == HC_GEMS

void run(ivec2 here)
{
    float height = texelFetch(u_heights, here, 0).r;
    search(here, height, steepest_of(u_go_on ? imageLoad(u_best, here).r : 0.0));
}

#endif

/* ---- a changed rectangle --------------------------------------------------------------------- */

#if HC_BAKE == HC_UPDATE

/* First and last sample of the rectangle, and of pieces of it in which any sample differs; with
 * them the highest height, old or new, of those that do. */
uniform ivec4 u_changed, u_pieces[64];
uniform float u_top, u_tops[64];
uniform int   u_piece_count;

layout(binding = 0, offset = 0) uniform atomic_uint u_searched;

/* A change matters if it is steeper than what was found, or was itself what was found. */
bool matters(ivec2 here, float height, ivec4 rect, float top, steepest best)
{
    float rise = top - height;
    return rise > 0.0 && may_be_steeper(rise, reach_to(apart_from(here, rect.xy, rect.zw)), best);
}

bool is_touched(ivec2 here, float height)
{
    if (all(greaterThanEqual(here, u_changed.xy)) && all(lessThanEqual(here, u_changed.zw))) {
        return true;
    }
    /* Less than was found, by more than drivers that do not round are off. */
    steepest best    = steepest_of(imageLoad(u_best, here).r * (1.0 - 7.6293945e-6));
    bool     touched = false;
    if (matters(here, height, u_changed, u_top, best)) {
        for (int i = 0; i < u_piece_count && !touched; i++) {
            touched = matters(here, height, u_pieces[i], u_tops[i], best);
        }
    }
    return touched;
}

void run(ivec2 here)
{
    float height = texelFetch(u_heights, here, 0).r;
    if (is_touched(here, height)) {
        atomicCounterIncrement(u_searched);
        search(here, height, steepest_of(0.0));
    }
}

#endif

/* ---- quick: three blocks an axis on every level ---------------------------------------------- */

#if HC_BAKE == HC_QUICK

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

#endif

/* ---- what limits relaxed cones --------------------------------------------------------------- */

#if HC_BAKE == HC_FALLING

/* A sample counts if the surface falls outwards from it along one of the four edges of its cell on
 * that side; others are below every height. */
void run(ivec2 here)
{
    ivec2 out_  = beside_of(here, u_sides);
    float at    = texelFetch(u_heights, here, 0).r;
    float at_u  = texelFetch(u_heights, ivec2(out_.x, here.y), 0).r;
    float at_v  = texelFetch(u_heights, ivec2(here.x, out_.y), 0).r;
    float at_uv = texelFetch(u_heights, out_, 0).r;
    bool  falls = at > at_u || at > at_v || at_u > at_uv || at_v > at_uv;
    imageStore(u_best, here, vec4(falls ? at : -1.0));
}

#endif

/* ---- ratios ---------------------------------------------------------------------------------- */

#if HC_BAKE == HC_RATIOS || HC_BAKE == HC_CELLS
layout(binding = 1) uniform writeonly image2D u_out;
#endif

#if HC_BAKE == HC_RATIOS

uniform sampler2D u_found[5];
uniform int       u_searches; /* 1, 4 quadrants, or 5 elongated diamonds */
uniform float     u_outwards; /* what searches found, times this */
uniform float     u_max_ratio; /* 0: no limit */

/* Beyond 2^60 there is no limit at all. */
float ratio_of(float slope)
{
    precise float ratio = 1.0 / slope;
    precise float kept  = ratio * 0.99999904632568359375;
    float         whole = slope == 0.0 || ratio > 1.152921504606846976e18
                              ? uintBitsToFloat(0x7f800000u) : kept;
    return u_max_ratio > 0.0 ? min(whole, u_max_ratio) : whole;
}

float found_at(int which, ivec2 here)
{
    /* Arrays of samplers take constant indices only. */
    float found = which == 0   ? texelFetch(u_found[0], here, 0).r
                  : which == 1 ? texelFetch(u_found[1], here, 0).r
                  : which == 2 ? texelFetch(u_found[2], here, 0).r
                  : which == 3 ? texelFetch(u_found[3], here, 0).r
                               : texelFetch(u_found[4], here, 0).r;
    precise float outer = found * u_outwards;
    return outer;
}

/* Of the elongation whose slopes have the least sum, the first such; and the plain diamond's. */
vec4 elongated(ivec2 here)
{
    vec2  slopes = vec2(0.0);
    vec2  a      = vec2(0.25, 4.0);
    for (int i = 0; i < 5; i++) {
        float         found = found_at(i, here);
        precise vec2  next  = found * a;
        precise float sum   = next.x + next.y;
        precise float least = slopes.x + slopes.y;
        slopes              = i == 0 || sum < least ? next : slopes;
        a *= vec2(2.0, 0.5);
    }
    return vec4(ratio_of(slopes.x), ratio_of(slopes.y), ratio_of(found_at(2, here)), 0.0);
}

void run(ivec2 here)
{
    vec4 ratios = vec4(0.0);
    if (u_searches == 5) {
        ratios = elongated(here);
    } else {
        for (int i = 0; i < u_searches; i++) {
            ratios[i] = ratio_of(found_at(i, here));
        }
    }
    imageStore(u_out, here, ratios);
}

#endif

#if HC_BAKE == HC_CELLS

uniform sampler2D u_ratios;

void run(ivec2 here)
{
    ivec2 next  = beside_of(here, ivec2(1));
    vec4  upper = min(texelFetch(u_ratios, here, 0),
                      texelFetch(u_ratios, ivec2(next.x, here.y), 0));
    vec4  lower = min(texelFetch(u_ratios, ivec2(here.x, next.y), 0),
                      texelFetch(u_ratios, next, 0));
    imageStore(u_out, here, min(upper, lower));
}

#endif

/* ---- arithmetic ------------------------------------------------------------------------------ */

#if HC_BAKE == HC_ROUNDING

void run(ivec2 here)
{
    imageStore(u_best, here, vec4(weight_of(texelFetch(u_heights, here, 0).r)));
}

#endif

void main(void)
{
    ivec2 here = texel_of_this();
    if (here.x < u_end.x && here.y < u_end.y) {
        run(here);
    }
}
