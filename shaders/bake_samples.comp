/* bake_samples.comp: what depends on a sample and its neighbours alone. Behind bake.comp. */

ivec2 side_of(int level)
{
    return max(u_size >> level, ivec2(1));
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

/* ---- families -------------------------------------------------------------------------------- */

#if HC_BAKE == HC_FAMILIES

uniform int  u_level;
uniform bool u_falling; /* of samples that limit relaxed cones of the quadrant u_sides alone */

layout(rgba32f, binding = 1) uniform image2D u_families_out;

/* The surface falls outwards from the sample along one of the four edges of its cell on that
 * side. */
bool falls(ivec2 here, float at)
{
    ivec2 out_  = beside_of(here, u_sides);
    float at_u  = texelFetch(u_heights, ivec2(out_.x, here.y), 0).r;
    float at_v  = texelFetch(u_heights, ivec2(here.x, out_.y), 0).r;
    float at_uv = texelFetch(u_heights, out_, 0).r;
    return at > at_u || at > at_v || at_u > at_uv || at_v > at_uv;
}

float sample_at(ivec2 here)
{
    if (any(greaterThanEqual(here, u_size))) {
        return -1.0;
    }
    float at = texelFetch(u_heights, here, 0).r;
    return u_falling && !falls(here, at) ? -1.0 : at;
}

/* The highest sample of a block of the level below. */
float highest_of(ivec2 block)
{
    ivec2 sides = (u_size + (1 << (u_level - 1)) - 1) >> (u_level - 1);
    if (any(greaterThanEqual(block, sides))) {
        return -1.0;
    }
    vec4 below = imageLoad(u_families_out, place_of(block, u_level - 1));
    return max(max(below.r, below.g), max(below.b, below.a));
}

float child_of(ivec2 block)
{
    return u_level == 1 ? sample_at(block) : highest_of(block);
}

void run(ivec2 block)
{
    ivec2 first = 2 * block;
    vec4  four  = vec4(child_of(first), child_of(first + ivec2(1, 0)),
                       child_of(first + ivec2(0, 1)), child_of(first + ivec2(1, 1)));
    imageStore(u_families_out, place_of(block, u_level), four);
}

#endif

/* ---- cells and slopes ------------------------------------------------------------------------ */

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
