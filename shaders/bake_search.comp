/* bake_search.comp: the steepest of all samples, by brute force or by pruned search. Behind
 * bake.comp. */

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

/* ---- rays below the surface ------------------------------------------------------------------ */

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

/* ---- pruned search --------------------------------------------------------------------------- */

#if HC_BAKE == HC_EXACT || HC_BAKE == HC_UPDATE || HC_BAKE == HC_GEMS

uniform sampler2D u_families;
uniform int       u_top_level; /* of the one family that has all samples */
uniform int       u_looks;     /* at families, in one dispatch, for one texel */

/* Searches that need more wait here for the next dispatch, which has u_resume set, finds u_waiting
 * of them and does them as texels of rows of 1024. */
struct search_left {
    uint texel, block, levels, low, high;
};
layout(std430, binding = 0) buffer waiting_room { search_left waiting[]; };
layout(binding = 0, offset = 0) uniform atomic_uint u_searched;
layout(binding = 0, offset = 4) uniform atomic_uint u_unfinished;
uniform bool u_resume;
uniform int  u_waiting;

/* Where a search is: the family to be looked at next, and what remains to be looked at below
 * families on the way there, four children a level from level 2 up. Families that hold the texel
 * itself are climbed from level 1 on, each without the child that does. */
struct walk {
    ivec2 block;
    int   level, climbed;
    uint  low, high; /* of `left`: levels 2 to 9, and above */
};

uint left_at(walk w, int level)
{
    return (level < 10 ? w.low >> (4 * level - 8) : w.high >> (4 * level - 40)) & 15u;
}

void flip_left(inout walk w, int level, uint children)
{
    w.low ^= level < 10 ? children << (4 * level - 8) : 0u;
    w.high ^= level < 10 ? 0u : children << (4 * level - 40);
}

/* Along one axis, samples between `from` and each child of the block. */
ivec2 apart_from_children(int from, int block, int level, int size, bool wraps, int side)
{
    int first = block << level;
    int half_ = first + (1 << (level - 1));
    int end   = first + (1 << level);
    return ivec2(apart(from, first, min(half_, size) - 1, size, wraps, side),
                 apart(from, half_, min(end, size) - 1, size, wraps, side));
}

vec4 reaches_to_children(ivec2 from, ivec2 block, int level)
{
    ivec2 sides = HC_SIDED == 1 ? u_sides : ivec2(0);
    ivec2 u     = apart_from_children(from.x, block.x, level, u_size.x, u_wraps.x, sides.x);
    ivec2 v     = apart_from_children(from.y, block.y, level, u_size.y, u_wraps.y, sides.y);
    vec2  at_u  = vec2(reach_of(u.x, u_step.x), reach_of(u.y, u_step.x));
    vec2  at_v  = vec2(reach_of(v.x, u_step.y), reach_of(v.y, u_step.y));
    precise vec4 sums = at_u.xyxy + at_v.xxyy;
#if HC_SIDED
    return mix(sums, vec4(NEVER), bvec4(min(u.xyxy, v.xxyy) >> 31));
#else
    return sums;
#endif
}

/* The children, one bit each, that may be steeper. */
uint worth_a_look(vec4 rises, vec4 reaches, steepest best)
{
    uint found = 0u;
    for (int i = 0; i < 4; i++) {
        found |= rises[i] > 0.0 && may_be_steeper(rises[i], reaches[i], best) ? 1u << i : 0u;
    }
    return found;
}

/* Samples, not blocks. */
void look_at_all(inout steepest best, inout int looks, uint which, vec4 rises, vec4 reaches,
                 ivec2 here, ivec2 first, float height)
{
    for (int i = 0; i < 4; i++) {
        if ((which >> i & 1u) != 0u) {
#if HC_BAKE == HC_GEMS
            judge(best, here, first + ivec2(i & 1, i >> 1), height, rises[i], reaches[i]);
            looks -= u_gems_steps;
#else
            look_at(best, rises[i], reaches[i]);
#endif
        }
    }
}

void look_at_family(inout walk w, inout steepest best, inout int looks, ivec2 here, float height)
{
    vec4 rises   = texelFetch(u_families, place_of(w.block, w.level), 0) - height;
    vec4 reaches = reaches_to_children(here, w.block, w.level);
    uint which   = worth_a_look(rises, reaches, best);
    if (w.level == 1) {
        look_at_all(best, looks, which, rises, reaches, here, 2 * w.block, height);
    } else {
        ivec2 own = (here >> (w.level - 1)) & 1;
        which &= w.level == w.climbed ? ~(1u << (own.x + 2 * own.y)) : 15u;
        flip_left(w, w.level, which);
    }
}

/* Nothing beyond the block that was climbed last can be steeper. */
bool is_enough(walk w, steepest best, ivec2 here, float rise)
{
    ivec2 first = (here >> w.climbed) << w.climbed;
    ivec2 end   = min(first + (1 << w.climbed), u_size);
    ivec2 least = min(here - first + 1, end - here);
    float reach = min(reach_of(least.x, u_step.x), reach_of(least.y, u_step.y));
    return !may_be_steeper(rise, reach, best);
}

/* To the child that is left on the lowest level, the one nearest to `here`. False: none is. */
bool descend(inout walk w, ivec2 here)
{
    if ((w.low | w.high) == 0u) {
        return false;
    }
    int   level  = 2 + (w.low != 0u ? findLSB(w.low) : 32 + findLSB(w.high)) / 4;
    ivec2 parent = w.block >> (level - w.level);
    uint  left   = left_at(w, level);
    bvec2 turns  = greaterThan(here >> (level - 1), 2 * parent);
    uint  near   = (turns.x ? 1u : 0u) + (turns.y ? 2u : 0u);
    uint  child  = near;
    for (uint i = 1u; i < 4u && (left >> child & 1u) == 0u; i++) {
        child = near ^ i;
    }
    flip_left(w, level, 1u << child);
    w.level = level - 1;
    w.block = 2 * parent + ivec2(child & 1u, child >> 1);
    return true;
}

bool climb(inout walk w, steepest best, ivec2 here, float rise)
{
    if (w.climbed == u_top_level || is_enough(w, best, here, rise)) {
        return false;
    }
    w.climbed++;
    w.level = w.climbed;
    w.block = here >> w.level;
    return true;
}

void wait_for_next(walk w, ivec2 here, uint place)
{
    waiting[place] = search_left(uint(here.x) | uint(here.y) << 16,
                                 uint(w.block.x) | uint(w.block.y) << 16,
                                 uint(w.level) | uint(w.climbed) << 8, w.low, w.high);
}

/* False: u_looks were not enough. */
bool search(inout walk w, ivec2 here, float height, steepest best)
{
    vec4  all   = texelFetch(u_families, place_of(ivec2(0), u_top_level), 0);
    float rise  = max(max(all.r, all.g), max(all.b, all.a)) - height;
    bool  more  = rise > 0.0;
    int   looks = u_looks;
    while (more && looks > 0) {
        look_at_family(w, best, looks, here, height);
        more = descend(w, here) || climb(w, best, here, rise);
        looks--;
    }
    imageStore(u_best, here, vec4(best.value));
    return !more;
}

void search_anew(ivec2 here, float height, steepest best)
{
    walk w = walk(here >> 1, 1, 1, 0u, 0u);
    if (!search(w, here, height, best)) {
        wait_for_next(w, here, atomicCounterIncrement(u_unfinished));
    }
}

/* level 0: it is done. */
void search_on(int place)
{
    if (place >= u_waiting || waiting[place].levels == 0u) {
        return;
    }
    search_left left = waiting[place];
    ivec2 here = ivec2(left.texel & 0xffffu, left.texel >> 16);
    walk  w    = walk(ivec2(left.block & 0xffffu, left.block >> 16), int(left.levels & 0xffu),
                      int(left.levels >> 8), left.low, left.high);
    float height = texelFetch(u_heights, here, 0).r;
    bool  done   = search(w, here, height, steepest_of(imageLoad(u_best, here).r));
    wait_for_next(w, here, uint(place));
    if (done) {
        waiting[place].levels = 0u;
    } else {
        atomicCounterIncrement(u_unfinished);
    }
}

#endif

#if HC_BAKE == HC_EXACT || HC_BAKE == HC_GEMS

void run(ivec2 here)
{
    if (u_resume) {
        search_on(here.x + 1024 * here.y);
    } else {
        search_anew(here, texelFetch(u_heights, here, 0).r,
                    steepest_of(u_go_on ? imageLoad(u_best, here).r : 0.0));
    }
}

#endif

/* ---- a changed rectangle --------------------------------------------------------------------- */

#if HC_BAKE == HC_UPDATE

/* First and last sample of the rectangle, and of pieces of it in which any sample differs; with
 * them the highest height, old or new, of those that do. */
uniform ivec4 u_changed, u_pieces[64];
uniform float u_top, u_tops[64];
uniform int   u_piece_count;

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
    if (u_resume) {
        search_on(here.x + 1024 * here.y);
        return;
    }
    float height = texelFetch(u_heights, here, 0).r;
    if (is_touched(here, height)) {
        atomicCounterIncrement(u_searched);
        search_anew(here, height, steepest_of(0.0));
    }
}

#endif
