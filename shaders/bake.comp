/* bake.comp: max-mip pyramids and exact or quick cone maps on the GPU. Compute shaders of GLSL
 * 4.30, several in a text: put your #version line and
 *     #define HC_BAKE HC_PYRAMID    one level of a pyramid from the level below it
 *                     HC_BOUNDS     the highest or lowest corner of each bilinear cell
 *                     HC_GRADIENT   slopes along one axis
 *                     HC_BRUTE      the steepest of all samples, some rows of them at a time
 *                     HC_FAMILIES   one level of the pyramid that pruned searches walk
 *                     HC_EXACT      the steepest of all samples by pruned search
 *                     HC_UPDATE     the same again where changed heights may matter
 *                     HC_QUICK      the blocks around a texel on every level (2022, 1 and 2)
 *                     HC_GEMS       relaxed cones by ray sampling (2007), by pruned search
 *                     HC_RATIOS     ratios of what the searches found
 *                     HC_CELLS      of each bilinear cell the least ratios of its corners
 *                     HC_ROUNDING   what this driver makes of quotients and roots
 *     #define HC_L2 1               round cones; 0: diamonds
 *     #define HC_SIDED 1            samples of the quadrant u_sides only; 0: all
 * in front of this text, and behind it
 *     bake_search.comp              HC_BRUTE, HC_EXACT, HC_UPDATE, HC_GEMS
 *     bake_quick.comp               HC_QUICK
 *     bake_samples.comp             all others
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
#define HC_FAMILIES 5
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

uniform sampler2D u_heights; /* R: the samples */

uniform vec2  u_step;  /* texture units between samples */
uniform ivec2 u_sides; /* of the quadrant: 1 or -1 along u and v */
uniform bool  u_go_on; /* u_best already holds what other dispatches found */

layout(r32f, binding = 0) uniform image2D u_best;

/* What is done for one texel. */
void run(ivec2 here);

void main(void)
{
    ivec2 here = u_first + ivec2(gl_GlobalInvocationID.xy);
    if (here.x < u_end.x && here.y < u_end.y) {
        run(here);
    }
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

/* ---- samples and blocks ---------------------------------------------------------------------- */

/* The sample beside one, wrapped or at the border. */
ivec2 beside_of(ivec2 here, ivec2 by)
{
    ivec2 next   = here + by;
    ivec2 folded = (next + u_size) % u_size;
    ivec2 kept   = clamp(next, ivec2(0), u_size - 1);
    return ivec2(u_wraps.x ? folded.x : kept.x, u_wraps.y ? folded.y : kept.y);
}

/* Families: the pyramid that pruned searches walk. A block of level l has 2^l samples a side, less
 * at the right and lower border; a family is the four highest samples of the blocks of level l - 1
 * that a block of level l consists of, as RGBA, -1 for those that are not there. Level 1 stands at
 * the left of the texture, all others one below the other to its right. */
ivec2 place_of(ivec2 block, int level)
{
    ivec2 half_ = (u_size + 1) >> 1;
    int   above = half_.y - (half_.y >> max(level - 2, 0)) + level - 2;
    return level == 1 ? block : ivec2(half_.x, above) + block;
}
