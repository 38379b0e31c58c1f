/* heightcast.glsl: rays against height fields in a shader. One text for GLSL 4.30 and GLSL ES 3.00.
 *
 * Take this file. Put in front of it your #version line, for ES
 *     precision highp float; precision highp int; precision highp sampler2D;
 * and what you choose of
 *     #define HC_METHOD HC_SAFE     the marcher that hc_nearest uses: HC_SAFE (default), HC_MAXMIP,
 *                                   HC_QDM, HC_PARALLAX, HC_LINEAR, HC_RELIEF, HC_OCCLUSION,
 *                                   HC_CONE_FIXED, HC_CONE_LOOP, HC_CONE_EXACT, HC_RELAXED,
 *                                   HC_ROBUST, HC_QUICK, HC_PDM, HC_FAST
 *     #define HC_GATHER             read the corners of a cell with one textureGather (GLSL 4.00,
 *                                   GLSL ES 3.10): then hc_heights and hc_ratios must repeat along
 *                                   the axes that hc_wraps names
 *     #define HC_STEPS              samples are flat tops as wide as they are apart, instead of
 *                                   patches between them: HC_SAFE, HC_MAXMIP and HC_FAST (HC_QDM:
 *                                   always)
 *     #define HC_SPARSE             for HC_FAST, where hc_tracer_block_map says so
 *     #define HC_OPEN_SIDES         rays that come in through a side below the surface do not hit
 *                                   it there, but go on, may come up, and then hit from above
 *     #define HC_DUMMER             hc_heights is the RGBA map of the 2006 paper: heights in R,
 *                                   roots of the ratios in G, slopes in B and A; hc_ratios is not
 *                                   read
 * Methods, and what they find and lose: include/heightcast/trace.h, where they have the same names.
 *
 *     hc_hit hit = hc_nearest(origin, direction, 1e9);
 *     if (hit.t < HC_MISS) { ... hit.place.xy is where to read your colours ... }
 *
 * Space    (u, v, height): one tile is 0 .. 1 along u and v, heights are 0 (low) .. 1 (high).
 *          hc_to_texture brings directions there from a tangent frame.
 * Textures are read with texelFetch and filtered here, with weights in full: the units of common
 *          graphics cards have 8 bits for them, and a ray that needs more walks through walls. Set
 *          their filters to nearest. Nothing takes derivatives, so loops and branches are free to
 *          diverge, and no mip level is chosen behind your back. Mips of your own for distant
 *          ground: heights by their maximum, ratios by their minimum; averages are not safe.
 * Ratios   run over rise in texture space: heightcast bake makes them. What a method needs:
 *          safe: cell ratios of l1 (R) or quad (RGBA, HC_CONE_CHANNELS 4, the default) cones;
 *          relaxed: relaxed ratios; cone-*, robust, quick: those of l2 cones.
 * Safe     safe, maxmip and fast lose no first hit, and make none up, but for rounding: heights
 *          that the ray misses by less than 2^-20, places that it misses by 2^-22 of the field's
 *          side, with fast 2^-21.
 * Speed    fewer steps for distant surfaces: set hc_step_limit (hc_steps_for); or fade the depth
 *          out (hc_fade). */

#define HC_SAFE 1
#define HC_MAXMIP 2
#define HC_QDM 3
#define HC_PARALLAX 4
#define HC_LINEAR 5
#define HC_RELIEF 6
#define HC_OCCLUSION 7
#define HC_CONE_FIXED 8
#define HC_CONE_LOOP 9
#define HC_CONE_EXACT 10
#define HC_RELAXED 11
#define HC_ROBUST 12
#define HC_QUICK 13
#define HC_PDM 14
#define HC_FAST 15
#ifndef HC_METHOD
#define HC_METHOD HC_SAFE
#endif
#if defined(HC_DUMMER) && HC_METHOD == HC_SAFE
#error heightcast.glsl: the 2006 map has no cell ratios for HC_SAFE; choose another HC_METHOD
#endif
#if HC_METHOD == HC_QDM || defined(HC_STEPS)
#define HC_TOPS true
#else
#define HC_TOPS false
#endif
#ifndef HC_CONE_CHANNELS
#define HC_CONE_CHANNELS 4
#endif

/* No hit; also "never" for times along a ray. */
#define HC_MISS 1e30

/* ---- what you set ---------------------------------------------------------------------------- */

uniform sampler2D hc_heights; /* R: samples, row 0 is v = 0 */
#ifndef HC_DUMMER
uniform sampler2D hc_ratios; /* of samples, or of cells */
#endif
#if HC_METHOD == HC_MAXMIP || HC_METHOD == HC_QDM || HC_METHOD == HC_PDM
/* R, all mips: the highest corner of each cell (qdm: the samples), each level the maximum of the
 * one below it; an odd side's last texel takes the one left over, too. */
uniform sampler2D hc_bounds;
uniform int       hc_levels;
#endif
#if HC_METHOD == HC_FAST
/* Blocks of cells: R, the bits of a float, their top; G, four slopes. All levels, level k at
 * hc_block_room - (hc_block_room >> 2 * k). hc_tracer_block_map fills it, and knows the rest. */
uniform highp usampler2D hc_blocks;
uniform ivec2            hc_block_room, hc_block_cells;
uniform ivec2            hc_block_first; /* where sample 0 is, in their cells */
uniform int              hc_block_levels;
uniform float            hc_block_blur; /* rays go so much farther than to walls, in cells */
#endif
/* Samples; cells per tile: as many, with grid registration and no wrap one less; place of sample 0
 * in cells: 0.5, with grid registration 0, for qdm and steps 0.5 less, since cells are texels; axes
 * along which the field repeats. */
uniform ivec2 hc_size;
uniform vec2  hc_steps, hc_zero;
uniform bvec2 hc_wraps;
uniform int   hc_step_count;  /* at most so many steps, in methods that count them */
uniform int   hc_refinements; /* bisections; -1: one secant, -2: none              */

/* Reads of textures so far, and moves from cell to cell or node to node (safe, maxmip, qdm, pdm and
 * fast), if you care. */
int hc_fetch_count    = 0;
int hc_crossing_count = 0;

/* Set it where a ray may do with fewer steps than hc_step_count; 0: it may not. */
int hc_step_limit = 0;

/* ---- results --------------------------------------------------------------------------------- */

/* flags: the ray starts in the solid; it comes in through a side; the steps ran out */
#define HC_INSIDE 1
#define HC_SIDE 2
#define HC_UNCONVERGED 4

struct hc_hit {
    float t;     /* HC_MISS: nothing                                           */
    vec3  place; /* u, v as they come along a wrapped axis, height of the ray  */
    int   flags;
    int   steps;
};

/* ---- the field ------------------------------------------------------------------------------- */

/* A ray in cells: along an axis, cell k lies between k and k + 1, and sample k sits at k. */
struct hc_path {
    vec3  place, along; /* at s = 0, and per s */
    float from, end;    /* s where it enters and leaves the box */
    ivec2 cell;         /* at `from` */
};

struct hc_found {
    float s; /* HC_MISS: nothing */
    int   flags, steps;
};

int hc_most_steps(void)
{
    return hc_step_limit > 0 ? min(hc_step_limit, hc_step_count) : hc_step_count;
}

ivec2 hc_index(ivec2 texel)
{
    ivec2 folded = texel - hc_size * ivec2(floor(vec2(texel) / vec2(hc_size)));
    folded += hc_size * ivec2(lessThan(folded, ivec2(0))); /* where the quotient was rounded */
    folded -= hc_size * ivec2(greaterThanEqual(folded, hc_size));
    ivec2 inside = clamp(texel, ivec2(0), hc_size - 1);
    return ivec2(hc_wraps.x ? folded.x : inside.x, hc_wraps.y ? folded.y : inside.y);
}

float hc_sample(ivec2 texel)
{
    hc_fetch_count += 1;
    return texelFetch(hc_heights, hc_index(texel), 0).r;
}

/* Code 0 would stop a marcher for ever, and 8-bit maps hold none above 1. */
float hc_ratio(ivec2 texel)
{
    hc_fetch_count += 1;
#ifdef HC_DUMMER
    float root = texelFetch(hc_heights, hc_index(texel), 0).g;
    return root * root;
#else
    return texelFetch(hc_ratios, hc_index(texel), 0).r;
#endif
}

#ifdef HC_GATHER
/* Drivers disagree about what a gather finds over an edge that does not repeat, so it stays inside,
 * and corners beyond the edge are those on it. */
ivec2 hc_gather_at(ivec2 cell)
{
    ivec2 inside = min(max(cell, ivec2(0)), max(hc_size - 2, ivec2(0)));
    return ivec2(hc_wraps.x ? cell.x : inside.x, hc_wraps.y ? cell.y : inside.y);
}

/* hc_corners of a cell, from those that were gathered. */
vec4 hc_gathered(ivec2 cell, vec4 h)
{
    bvec2 last  = greaterThanEqual(cell, hc_size - 1);
    bvec2 first = bvec2(cell.x < 0 || hc_size.x == 1, cell.y < 0 || hc_size.y == 1);
    h           = hc_wraps.x ? h : first.x ? h.xxzz : last.x ? h.yyww : h;
    return hc_wraps.y ? h : first.y ? h.xyxy : last.y ? h.zwzw : h;
}
#endif

/* Of a cell's corners, as hc_corners has them. */
vec4 hc_corner_ratios(ivec2 cell)
{
#if defined(HC_GATHER) && defined(HC_DUMMER)
    hc_fetch_count += 1;
    vec2 at    = (vec2(hc_gather_at(cell)) + 1.0) / vec2(hc_size);
    vec4 roots = hc_gathered(cell, textureGather(hc_heights, at, 1).wzxy);
    return roots * roots;
#elif defined(HC_GATHER)
    hc_fetch_count += 1;
    vec2 at = (vec2(hc_gather_at(cell)) + 1.0) / vec2(hc_size);
    return hc_gathered(cell, textureGather(hc_ratios, at).wzxy);
#else
    return vec4(hc_ratio(cell), hc_ratio(cell + ivec2(1, 0)), hc_ratio(cell + ivec2(0, 1)),
                hc_ratio(cell + ivec2(1, 1)));
#endif
}

vec2 hc_low(void)
{
    return vec2(hc_wraps.x ? -HC_MISS : -hc_zero.x, hc_wraps.y ? -HC_MISS : -hc_zero.y);
}

vec2 hc_high(void)
{
    vec2 high = hc_steps - hc_zero;
    return vec2(hc_wraps.x ? HC_MISS : high.x, hc_wraps.y ? HC_MISS : high.y);
}

vec3 hc_at(hc_path path, float s)
{
    return path.place + s * path.along;
}

/* When the ray comes to a coordinate of an axis. */
float hc_reaches(float place, float along, float coordinate)
{
    return along == 0.0 ? HC_MISS : (coordinate - place) / along;
}

/* ---- patches --------------------------------------------------------------------------------- */

/* height = base + x * slope.x + y * slope.y + x * y * twist, from the cell's corner */
struct hc_patch {
    float base;
    vec2  slope;
    float twist;
};

/* The samples at a cell's corners: upper left, upper right, lower left, lower right. */
vec4 hc_corners(ivec2 cell)
{
#ifdef HC_GATHER
    hc_fetch_count += 1;
    vec2 at = (vec2(hc_gather_at(cell)) + 1.0) / vec2(hc_size);
    return hc_gathered(cell, textureGather(hc_heights, at).wzxy);
#else
    ivec2 a = hc_index(cell);
    ivec2 b = hc_index(cell + 1);
    hc_fetch_count += 4;
    return vec4(texelFetch(hc_heights, a, 0).r, texelFetch(hc_heights, ivec2(b.x, a.y), 0).r,
                texelFetch(hc_heights, ivec2(a.x, b.y), 0).r, texelFetch(hc_heights, b, 0).r);
#endif
}

hc_patch hc_patch_of(ivec2 cell)
{
    if (HC_TOPS) {
        return hc_patch(hc_sample(cell), vec2(0.0), 0.0); /* a flat top */
    }
    vec4 h = hc_corners(cell);
    return hc_patch(h.x, h.yz - h.x, h.w - h.y - h.z + h.x);
}

/* Height of the ray above the patch, r after s: x + r * y + r * r * z. */
vec3 hc_gap_of(hc_patch patch_, hc_path path, ivec2 cell, float s)
{
    vec3  at    = hc_at(path, s);
    vec2  place = at.xy - vec2(cell);
    vec2  along = path.along.xy;
    float under = patch_.base + dot(place, patch_.slope) + place.x * place.y * patch_.twist;
    float turn  = patch_.twist * (place.x * along.y + place.y * along.x);
    return vec3(at.z - under, path.along.z - (dot(patch_.slope, along) + turn),
                -patch_.twist * along.x * along.y);
}

/* Least r in 0 .. length where a gap that starts above 0 is none; HC_MISS: it stays. The roots are
 * by the formulas that add what the others would cancel; a change of sign is a contact, whatever
 * rounding makes of them. */
float hc_contact(vec3 gap, float reach)
{
    bool  below  = gap.x + reach * (gap.y + reach * gap.z) <= 0.0;
    float square = gap.y * gap.y - 4.0 * gap.x * gap.z;
    float root   = HC_MISS;
    if (square >= 0.0 && gap.y < 0.0) {
        root = 2.0 * gap.x / (sqrt(square) - gap.y);
    } else if (square >= 0.0 && gap.z < 0.0) {
        root = (gap.y + sqrt(square)) / (-2.0 * gap.z);
    }
    if (below) {
        return min(root, reach);
    }
    return gap.z > 0.0 && root <= reach ? root : HC_MISS;
}

/* ---- walking from cell to cell --------------------------------------------------------------- */

/* The walls of a block of cells that the ray goes to; never before s. */
vec2 hc_walls(hc_path path, ivec2 low, ivec2 high, float s)
{
    float x = float(path.along.x > 0.0 ? high.x : low.x);
    float y = float(path.along.y > 0.0 ? high.y : low.y);
    return max(vec2(hc_reaches(path.place.x, path.along.x, x),
                    hc_reaches(path.place.y, path.along.y, y)), vec2(s));
}

/* Over the wall, or the corner, that comes first. The index moves by the wall: a position on a
 * wall, rounded, may give back the cell it came from, and the ray would stall. */
ivec2 hc_cross(hc_path path, ivec2 cell, vec2 walls)
{
    float first = min(walls.x, walls.y);
    cell.x += walls.x <= first ? (path.along.x > 0.0 ? 1 : -1) : 0;
    cell.y += walls.y <= first ? (path.along.y > 0.0 ? 1 : -1) : 0;
    return cell;
}

/* The cell at s; never back. */
ivec2 hc_jump(hc_path path, ivec2 cell, float s)
{
    ivec2 there = ivec2(floor(hc_at(path, s).xy));
    ivec2 ahead = max(cell, there);
    ivec2 back  = min(cell, there);
    return ivec2(path.along.x > 0.0 ? ahead.x : path.along.x < 0.0 ? back.x : cell.x,
                 path.along.y > 0.0 ? ahead.y : path.along.y < 0.0 ? back.y : cell.y);
}

/* ---- safe: cones that the surface does not enter, and patches -------------------------------- */

#if HC_METHOD == HC_SAFE

float hc_cell_slope(ivec2 cell, int channel)
{
    hc_fetch_count += 1;
    return 1.0 / max(texelFetch(hc_ratios, hc_index(cell), 0)[channel], 1e-30);
}

/* Tops are wider than their samples: how much nearer they are than the samples, from here on. */
float hc_nearer(hc_path path, ivec2 cell, float s)
{
    vec2 inside = hc_at(path, s).xy - vec2(cell);
    vec2 behind = vec2(path.along.x > 0.0 ? inside.x : 1.0 - inside.x,
                       path.along.y > 0.0 ? inside.y : 1.0 - inside.y);
    vec2 steps  = vec2(notEqual(path.along.xy, vec2(0.0))) / hc_steps;
    return HC_TOPS ? dot(behind, steps) : 0.0;
}

/* docs/algorithms.md, sections 4 and 19.3, has the proof. A cone that leads out of the cell
 * carries the ray, else the patch decides and the ray goes over the wall. */
hc_found hc_march_safe(hc_path path)
{
    float run     = dot(abs(path.along.xy), 1.0 / hc_steps);
    int   channel = (path.along.x < 0.0 ? 1 : 0) + (path.along.y < 0.0 ? 2 : 0);
    float s       = path.from;
    ivec2 cell    = path.cell;
    int   steps   = 0;
    bool  crossed = false;
    if (HC_CONE_CHANNELS == 1) {
        channel = 0;
    }
    for (int most = 0; most < 65536; most++) {
        vec3  gap   = hc_gap_of(hc_patch_of(cell), path, cell, s);
        vec2  walls = hc_walls(path, cell, cell + 1, s);
        float leave = min(min(walls.x, walls.y), path.end);
        steps++;
        if (gap.x <= 0.0) {
            return hc_found(s, HC_TOPS && crossed ? HC_SIDE : 0, steps);
        }
        float slope = hc_cell_slope(cell, channel);
        float rate  = slope * run - path.along.z;
        float room  = gap.x - slope * hc_nearer(path, cell, s);
        float open_ = room < 0.0 ? s : rate > 0.0 ? s + room / rate : HC_MISS;
        if (open_ <= leave) {
            float meet = hc_contact(gap, leave - s);
            if (meet < HC_MISS) {
                return hc_found(s + meet, 0, steps);
            }
        }
        if (max(leave, open_) >= path.end) {
            break;
        }
        hc_crossing_count += 1;
        crossed      = true;
        ivec2 before = cell;
        if (open_ > leave) {
            s    = open_;
            cell = hc_jump(path, cell, s);
        }
        if (cell == before) { /* a step that leads nowhere is one over the wall */
            walls = hc_walls(path, cell, cell + 1, s);
            s     = min(walls.x, walls.y);
            cell  = hc_cross(path, cell, walls);
        }
    }
    return hc_found(HC_MISS, 0, steps);
}

#endif

/* ---- fast: blocks of cells that carry cones, and patches ------------------------------------ */

#if HC_METHOD == HC_FAST

/* A ray in the cells of hc_blocks, in one period of the field. s counts cells gone sideways, and
 * upright rays count as many as their heights come to in units of HC_UPRIGHT. */
struct hc_lane {
    hc_path path;
    vec2    over;     /* s per cell */
    ivec2   ahead;    /* 1: up along the axis */
    vec2    seam;     /* s at which the period ends */
    int     quadrant; /* bits to shift a block's slopes */
};

#define HC_UPRIGHT 1048576.0
#define HC_STANDS 1e18 /* `over` where a ray does not go along an axis */

/* s from a place to walls of blocks of 2^shift cells. */
vec2 hc_lane_walls(hc_lane lane, vec2 place, ivec2 walls, int shift)
{
    return (vec2(walls << shift) - place) * lane.over;
}

hc_lane hc_lane_along(vec3 along)
{
    hc_lane lane;
    vec2    stands  = vec2(along.x < 0.0 ? -HC_STANDS : HC_STANDS,
                           along.y < 0.0 ? -HC_STANDS : HC_STANDS);
    lane.path.along = along;
    lane.path.from  = 0.0;
    lane.path.cell  = ivec2(0);
    lane.ahead      = ivec2(greaterThanEqual(along.xy, vec2(0.0)));
    lane.quadrant   = 24 - 8 * lane.ahead.x - 16 * lane.ahead.y;
    lane.over       = vec2(abs(along.x) * HC_STANDS > 1.0 ? 1.0 / along.x : stands.x,
                           abs(along.y) * HC_STANDS > 1.0 ? 1.0 / along.y : stands.y);
    return lane;
}

/* In the period that a place is in; on a seam it is the one that the ray goes into. */
void hc_lane_begin(inout hc_lane lane, vec3 place, float rest)
{
    vec2 size  = vec2(hc_block_cells);
    vec2 turns = place.xy / size;
    vec2 first = size * vec2(lane.ahead.x > 0 ? floor(turns.x) : ceil(turns.x) - 1.0,
                             lane.ahead.y > 0 ? floor(turns.y) : ceil(turns.y) - 1.0);
    vec2 in_   = clamp(place.xy - first, vec2(0.0), size);
    vec2 seam  = hc_lane_walls(lane, in_, lane.ahead * hc_block_cells, 0);
    lane.path.place = vec3(hc_wraps.x ? in_.x : place.x, hc_wraps.y ? in_.y : place.y, place.z);
    lane.seam       = vec2(hc_wraps.x ? seam.x : HC_MISS, hc_wraps.y ? seam.y : HC_MISS);
    lane.path.end   = min(rest, min(lane.seam.x, lane.seam.y));
}

/* Where the period ends; on a seam that it comes to, to the bit. */
vec3 hc_lane_end(hc_lane lane)
{
    vec3 place = hc_at(lane.path, lane.path.end);
    vec2 seam  = vec2(lane.ahead * hc_block_cells);
    return vec3(lane.seam.x <= lane.path.end ? seam.x : place.x,
                lane.seam.y <= lane.path.end ? seam.y : place.y, place.z);
}

/* Behind a corner that a ray cuts steps may stand that it does not see; patches cannot. */
bool hc_lane_cuts(vec2 walls)
{
    return HC_TOPS && abs(walls.x - walls.y) < 4.0 * hc_block_blur;
}

/* s from where a ray leaves its block, `over` its top and falling `down` per s, to where what is
 * beyond the block may come up to it. It has come `aside` along the side by which it leaves. */
float hc_lane_beyond(uint code, int shift, float over, float down, float aside)
{
#ifdef HC_STEPS
    return 0.0; /* cones are for patches */
#elif defined(HC_SPARSE)
    float slope = uintBitsToFloat(((code >> 4) << 23) + (116u << 23));
    float way   = float((code & 15u) << shift) - aside - 8.0 * hc_block_blur;
    return max(over / max(slope + down, 1.0 / HC_STANDS),
               min(way, over / max(down, 1.0 / HC_STANDS)));
#else
    float slope = uintBitsToFloat((code << 20) + (97u << 23));
    return over / max(slope + down, 1.0 / HC_STANDS);
#endif
}

/* The level after a step over a block. */
int hc_lane_level(int level, int shift, float walked)
{
    int next = min(level + 1, hc_block_levels - 1);
#ifdef HC_SPARSE
    return clamp((floatBitsToInt(walked) >> 24) - 65, 0, next); /* half the exponent */
#else
    return walked > float(2 << shift) ? next : level;
#endif
}

/* Over blocks, to a cell that the ray may hit. False: it comes to the end. */
bool hc_lane_near(hc_lane lane, inout float s, inout int level, inout int steps)
{
    bool  near = false;
    float fall = min(lane.path.along.z, -1.0 / HC_STANDS);
    while (s < lane.path.end && !near) {
        vec3  at     = hc_at(lane.path, s);
        int   shift  = 2 * level + 1;
        ivec2 which  = ivec2(at.xy) >> shift;
        ivec2 texel  = which + hc_block_room - (hc_block_room >> (2 * level));
        uvec2 block  = texelFetch(hc_blocks, texel, 0).rg;
        vec2  walls  = hc_lane_walls(lane, at.xy, which + lane.ahead, shift);
        float leave  = max(min(walls.x, walls.y), 0.0) + hc_block_blur;
        float top    = uintBitsToFloat(block.r);
        float over   = at.z + leave * lane.path.along.z - top;
        bool  above  = at.z > top;
        bool  sinks  = above && !(over > 0.0);
        bool  clear  = above && over > 0.0 && !hc_lane_cuts(walls);
        uint  code   = (block.g >> lane.quadrant) & 255u;
        vec2  come   = abs(at.xy - vec2((which + 1 - lane.ahead) << shift));
        float aside  = come.x + come.y + leave - float(1 << shift);
        float walked = leave + hc_lane_beyond(code, shift, over, -lane.path.along.z, aside);
        s += clear ? walked : sinks ? (top - at.z) / fall : 0.0;
        near  = !clear && level == 0;
        level = clear ? hc_lane_level(level, shift, walked) : max(level - 1, 0);
        hc_fetch_count += 1;
        hc_crossing_count += clear ? 1 : 0;
        steps++;
    }
    return near && s < lane.path.end;
}

float hc_lane_contact(hc_lane lane, ivec2 cell, float enter, float leave)
{
    vec3  gap   = hc_gap_of(hc_patch_of(cell - hc_block_first), lane.path, cell, enter);
    float reach = min(leave, lane.path.end) - enter;
    if (gap.x <= 0.0) { /* it came down on what rounding has passed by; tops have no slope */
        float back = gap.y < 0.0 && !HC_TOPS ? -gap.x / gap.y : 0.0;
        return max(enter + max(back, -8.0 * hc_block_blur), 0.0);
    }
    return enter + hc_contact(gap, reach);
}

/* The cell at s, as a whole. HC_MISS: no contact, and s is behind the cell. */
float hc_lane_look(hc_lane lane, inout float s, out bool face)
{
    vec2  place  = hc_at(lane.path, s).xy;
    ivec2 cell   = clamp(ivec2(place), ivec2(0), hc_block_cells - 1);
    vec2  before = hc_lane_walls(lane, place, cell + 1 - lane.ahead, 0);
    vec2  behind = max(hc_lane_walls(lane, place, cell + lane.ahead, 0), vec2(0.0)) + s;
    float enter  = clamp(s + max(before.x, before.y), 0.0, s);
    float leave  = min(behind.x, behind.y);
    float meets  = hc_lane_contact(lane, cell, enter, leave);
    if (meets >= HC_MISS && leave < lane.path.end && hc_lane_cuts(behind)) {
        ivec2 side = 2 * lane.ahead - 1;
        enter      = leave;
        leave      = max(behind.x, behind.y);
        cell += behind.x < behind.y ? ivec2(side.x, 0) : ivec2(0, side.y);
        meets = hc_lane_contact(lane, cell, enter, leave);
    }
    face = HC_TOPS && meets <= enter && enter > 0.0;
    s    = leave + hc_block_blur;
    hc_crossing_count += 1;
    return meets;
}

/* Over blocks that the ray stays above, and as far as the cones around them carry it, else to finer
 * blocks, and to the cells. docs/algorithms.md, section 20, has the proof. */
hc_found hc_march_fast(hc_path path)
{
    float run    = max(max(abs(path.along.x) + abs(path.along.y), abs(path.along.z) / HC_UPRIGHT),
                       1e-30);
    vec3  place  = hc_at(path, path.from) + vec3(hc_block_first, 0.0);
    float rest   = (path.end - path.from) * run;
    float gone   = 0.0; /* s in other periods */
    float meets  = HC_MISS;
    int   level  = min(1, hc_block_levels - 1);
    int   steps  = 0;
    bool  face   = false;
    hc_lane lane = hc_lane_along(path.along / run);
    for (int most = 0; most < 1024 && meets >= HC_MISS && gone < rest; most++) {
        hc_lane_begin(lane, place, rest - gone);
        float s = hc_block_blur;
        while (meets >= HC_MISS && hc_lane_near(lane, s, level, steps)) {
            meets = hc_lane_look(lane, s, face);
            steps++;
        }
        gone += meets < HC_MISS ? meets : lane.path.end;
        place = hc_lane_end(lane);
    }
    return hc_found(meets < HC_MISS ? path.from + gone / run : HC_MISS, face ? HC_SIDE : 0, steps);
}

#endif

/* ---- maxmip, qdm and pdm: the pyramid of the bounding map ------------------------------------ */

#if HC_METHOD == HC_MAXMIP || HC_METHOD == HC_QDM || HC_METHOD == HC_PDM

/* The node of a level that a cell is in: its cells low .. high - 1, and its bound. Above single
 * cells the first and the last node of an unwrapped axis have what lies at the border, too. */
float hc_node(ivec2 cell, int level, out ivec2 low, out ivec2 high)
{
    ivec2 side  = max(hc_size >> level, ivec2(1));
    ivec2 index = hc_index(cell);
    ivec2 which = min(index >> level, side - 1);
    bvec2 last  = equal(which, side - 1);
    ivec2 base  = cell - index; /* of the period, where there are some */
    ivec2 next  = (which + 1) << level;
    low  = base + (which << level);
    high = base + ivec2(last.x ? hc_size.x : next.x, last.y ? hc_size.y : next.y);
    if (level == 0) {
        low  = cell;
        high = cell + 1;
    } else {
        if (!hc_wraps.x) {
            low.x  = which.x == 0 ? -2 : which.x << level;
            high.x = last.x ? hc_size.x + 1 : next.x;
        }
        if (!hc_wraps.y) {
            low.y  = which.y == 0 ? -2 : which.y << level;
            high.y = last.y ? hc_size.y + 1 : next.y;
        }
    }
    hc_fetch_count += 1;
    return texelFetch(hc_bounds, which, level).r;
}

#endif

#if HC_METHOD == HC_PDM

float hc_in_patch(float root, float reach)
{
    return root >= 0.0 && root <= reach ? root : HC_MISS;
}

/* Equation (1), and the smaller of its roots that is in the patch. */
float hc_first_root(vec3 gap, float reach)
{
    float square = gap.y * gap.y - 4.0 * gap.z * gap.x;
    if (square < 0.0) {
        return HC_MISS;
    }
    float half_ = -0.5 * (gap.y + (gap.y < 0.0 ? -sqrt(square) : sqrt(square)));
    float one   = half_ != 0.0 ? gap.x / half_ : HC_MISS;
    float two   = gap.z != 0.0 ? half_ / gap.z : HC_MISS;
    return min(hc_in_patch(one, reach), hc_in_patch(two, reach));
}

/* WSCG 2009, 3 to 5, as printed: what it remembers is a place on the ray and a level. The texel is
 * looked up a little ahead of the place, and what lies within that little of a corner is passed
 * by. */
hc_found hc_march_pdm(hc_path path)
{
    float s     = path.from;
    int   level = hc_levels - 1;
    int   steps = 0;
    for (int most = 0; most < 65536; most++) {
        ivec2 low, high;
        ivec2 cell   = ivec2(floor(hc_at(path, s).xy + sign(path.along.xy) / 1024.0));
        float bound  = hc_node(cell, level, low, high);
        vec2  walls  = hc_walls(path, low, high, s);
        float leave  = min(min(walls.x, walls.y), path.end);
        bool  inside = hc_at(path, s).z <= bound;
        steps++;
        if (!inside && path.along.z < 0.0) {
            float meets = hc_reaches(path.place.z, path.along.z, bound);
            inside      = meets < leave;
            s           = inside ? max(meets, s) : s;
        }
        if (inside && level > 0) {
            level--;
            continue;
        }
        if (inside) {
            float root = hc_first_root(hc_gap_of(hc_patch_of(cell), path, cell, s), leave - s);
            if (root < HC_MISS) {
                return hc_found(s + root, 0, steps);
            }
        }
        if (leave >= path.end) {
            break;
        }
        hc_crossing_count += 1;
        s     = leave;
        level = min(level + 1, hc_levels - 1);
    }
    return hc_found(HC_MISS, 0, steps);
}

#endif

#if HC_METHOD == HC_MAXMIP || HC_METHOD == HC_QDM

/* WSCG 2009, 3 to 5: a node whose bound the ray stays above is crossed, and the next one looked
 * for a level higher; else down a level, first to the height of the bound if the ray falls. */
hc_found hc_march_maxmip(hc_path path)
{
    float s       = path.from;
    ivec2 cell    = path.cell;
    int   level   = hc_levels - 1;
    int   steps   = 0;
    bool  crossed = false; /* the ray is on a wall that it has just crossed */
    for (int most = 0; most < 65536; most++) {
        ivec2 low, high;
        float bound = hc_node(cell, level, low, high);
        vec2  walls = hc_walls(path, low, high, s);
        float leave = min(min(walls.x, walls.y), path.end);
        float enter = hc_at(path, s).z;
        bool  above = min(enter, hc_at(path, leave).z) > bound;
        float move  = leave;
        steps++;
        if (!above && level > 0) {
            level--;
            if (!(enter > bound)) {
                continue;
            }
            crossed = false;
            move    = clamp(hc_reaches(path.place.z, path.along.z, bound), s, leave);
        } else {
            if (!above) {
                vec3  gap  = hc_gap_of(hc_patch_of(cell), path, cell, s);
                bool  face = HC_TOPS && crossed && gap.x <= 0.0;
                float meet = gap.x <= 0.0 ? 0.0 : hc_contact(gap, leave - s);
                if (meet < HC_MISS) {
                    return hc_found(s + meet, face ? HC_SIDE : 0, steps);
                }
            }
            if (leave >= path.end) {
                break;
            }
            hc_crossing_count += 1;
            crossed = true;
            level   = min(level + 1, hc_levels - 1);
        }
        s    = move;
        cell = clamp(hc_jump(path, cell, s), low, high - 1);
        if (crossed && walls.x <= s) {
            cell.x = path.along.x > 0.0 ? high.x : low.x - 1;
        }
        if (crossed && walls.y <= s) {
            cell.y = path.along.y > 0.0 ? high.y : low.y - 1;
        }
    }
    return hc_found(HC_MISS, 0, steps);
}

#endif

/* ---- the published marchers: the field as a texture, filtered wherever they look ------------- */

/* They are done where the ray leaves the box, the bottom included. */
float hc_image_end(hc_path path)
{
    float bottom = path.along.z < 0.0 ? hc_reaches(path.place.z, path.along.z, 0.0) : HC_MISS;
    return max(min(path.end, bottom), path.from);
}

/* Height of the ray above the filtered heights. */
float hc_image_gap(hc_path path, float s)
{
    vec3     at     = hc_at(path, s);
    vec2     place  = clamp(at.xy, hc_low(), hc_high());
    vec2     cell   = floor(place);
    vec2     f      = place - cell;
    hc_patch patch_ = hc_patch_of(ivec2(cell));
    return at.z - (patch_.base + dot(f, patch_.slope) + f.x * f.y * patch_.twist);
}

/* Between above (over the surface) and below: where the line between the ends comes down. */
float hc_secant(hc_path path, float above, float below)
{
    float over  = hc_image_gap(path, above);
    float under = hc_image_gap(path, below);
    return over > under ? above + (below - above) * (over / (over - under)) : below;
}

float hc_refine(hc_path path, float above, float below, inout int steps)
{
    if (hc_refinements < 0) {
        steps += hc_refinements == -1 ? 1 : 0;
        return hc_refinements == -1 ? hc_secant(path, above, below) : below;
    }
    for (int i = 0; i < hc_refinements; i++) {
        float middle = above + 0.5 * (below - above);
        bool  over   = hc_image_gap(path, middle) > 0.0;
        above        = over ? middle : above;
        below        = over ? below : middle;
        steps++;
    }
    return below;
}

/* One offset, limited (Welsh 2004). */
hc_found hc_march_parallax(hc_path path)
{
    float length_ = length(vec3(path.along.xy / hc_steps, path.along.z));
    float s       = path.from + hc_image_gap(path, path.from) / length_;
    return hc_found(path.along.z < 0.0 && s <= hc_image_end(path) ? s : HC_MISS, 0, 1);
}

/* The first of hc_most_steps() equal steps that is at or under the surface, and the place before
 * it. */
vec2 hc_first_below(hc_path path, inout int steps)
{
    float last  = path.from;
    float leave = hc_image_end(path);
    int   most  = hc_most_steps();
    for (int i = 1; i <= most; i++) {
        float s = path.from + (leave - path.from) * (float(i) / float(most));
        steps++;
        if (hc_image_gap(path, s) <= 0.0) {
            return vec2(last, s);
        }
        last = s;
    }
    return vec2(last, HC_MISS);
}

/* WSCG 2009, 2. */
hc_found hc_march_linear(hc_path path)
{
    int  steps   = 0;
    vec2 bracket = hc_first_below(path, steps);
    return hc_found(bracket.y, 0, steps);
}

/* Linear, then refined (Policarpo 2005). */
hc_found hc_march_relief(hc_path path)
{
    int   steps   = 0;
    vec2  bracket = hc_first_below(path, steps);
    float s = bracket.y < HC_MISS ? hc_refine(path, bracket.x, bracket.y, steps) : HC_MISS;
    return hc_found(s, 0, steps);
}

/* Linear, then one secant (Tatarchuk 2006). */
hc_found hc_march_occlusion(hc_path path)
{
    int   steps   = 0;
    vec2  bracket = hc_first_below(path, steps);
    float s = bracket.y < HC_MISS ? hc_secant(path, bracket.x, bracket.y) : HC_MISS;
    return hc_found(s, 0, steps);
}

/* ---- cone steps ------------------------------------------------------------------------------ */

/* Cones lead towards the surface for ever. Whoever is within a code of an 8-bit map has arrived. */
#define HC_ARRIVED (1.0 / 255.0)

/* Filtered ratio, as maps hold it: at most 1, and its root is filtered if `root` (2006). */
float hc_image_ratio(vec2 at, bool root)
{
    vec2  place = clamp(at, hc_low(), hc_high());
    ivec2 cell  = ivec2(floor(place));
    vec2  f     = place - vec2(cell);
    vec4  r     = min(hc_corner_ratios(cell), vec4(1.0));
    r         = root ? sqrt(r) : r;
    vec2  row = mix(r.xz, r.yw, f.x);
    float sum = mix(row.x, row.y, f.y);
    return root ? sum * sum : sum;
}

/* Least ratio of the nearest sample and the eight around it. */
float hc_least_around(vec2 at)
{
    ivec2 middle = ivec2(floor(at + 0.5));
    float least  = HC_MISS;
    for (int i = 0; i < 9; i++) {
        least = min(least, hc_ratio(middle + ivec2(i % 3 - 1, i / 3 - 1)));
    }
    return least;
}

/* From a gap the ray leaves the cone after gap / (run / ratio - rise). */
float hc_cone_step(hc_path path, float run, float gap, float ratio)
{
    float grows = run > 0.0 ? run / max(ratio, 1e-30) : 0.0;
    float rate  = grows - path.along.z;
    return rate > 0.0 ? gap / rate : HC_MISS;
}

/* The width of a texel, as a length along the ray. */
float hc_texel_step(hc_path path)
{
    float length_ = length(vec3(path.along.xy / hc_steps, path.along.z));
    return 1.0 / (max(hc_steps.x, hc_steps.y) * length_);
}

/* The step of this method from s, `gap` above the surface. */
float hc_step_of(hc_path path, float run, float s, float gap)
{
    vec3 at = hc_at(path, s);
    if (HC_METHOD == HC_RELAXED || HC_METHOD == HC_QUICK) {
        return hc_cone_step(path, run, gap, hc_image_ratio(at.xy, false));
    }
    if (HC_METHOD == HC_ROBUST) {
        float cone  = hc_cone_step(path, run, gap, hc_least_around(at.xy));
        ivec2 cell  = ivec2(floor(at.xy));
        vec2  walls = hc_walls(path, cell, cell + 1, s);
        float wall  = min(walls.x, walls.y) - s;
        float over  = 1e-5 / length(vec3(path.along.xy / hc_steps, path.along.z));
        return wall < 1e29 ? max(cone, wall + over) : cone;
    }
    float cone = hc_cone_step(path, run, gap, hc_image_ratio(at.xy, true));
    return HC_METHOD == HC_CONE_EXACT ? cone + hc_texel_step(path) : cone;
}

/* Step until below the surface, out of the box, or out of steps; then what the method does
 * there. */
hc_found hc_march_cones(hc_path path)
{
    float run   = length(path.along.xy / hc_steps);
    float leave = hc_image_end(path);
    float s     = path.from;
    float above = s;
    float gap   = hc_image_gap(path, s);
    int   steps = 0;
    int   most  = hc_most_steps();
    for (int i = 0; i < most && gap > 0.0; i++) {
        float next = s + hc_step_of(path, run, s, gap);
        steps++;
        above = s;
        s     = min(next, leave);
        gap   = hc_image_gap(path, s);
        if (gap > 0.0 && next >= leave) {
            return hc_found(HC_MISS, 0, steps);
        }
    }
    if (HC_METHOD == HC_CONE_EXACT) {
        s = max(s - hc_texel_step(path), path.from);
        return hc_found(s, gap <= 0.0 ? 0 : HC_UNCONVERGED, steps);
    }
    if (HC_METHOD != HC_CONE_FIXED && HC_METHOD != HC_CONE_LOOP && gap <= 0.0) {
        s = hc_refine(path, above, s, steps);
    }
    return hc_found(s, gap <= HC_ARRIVED ? 0 : HC_UNCONVERGED, steps);
}

/* 2006: `fixed` is the same march with few steps, which your compiler may unroll. */
#define hc_march_cone_fixed hc_march_cones
#define hc_march_cone_loop hc_march_cones
#define hc_march_cone_exact hc_march_cones
/* GPU Gems 3, 18; 2024; 2022. */
#define hc_march_relaxed hc_march_cones
#define hc_march_robust hc_march_cones
#define hc_march_quick hc_march_cones

#if HC_METHOD == HC_SAFE
#define hc_march hc_march_safe
#elif HC_METHOD == HC_MAXMIP || HC_METHOD == HC_QDM
#define hc_march hc_march_maxmip
#elif HC_METHOD == HC_PDM
#define hc_march hc_march_pdm
#elif HC_METHOD == HC_FAST
#define hc_march hc_march_fast
#elif HC_METHOD == HC_PARALLAX
#define hc_march hc_march_parallax
#elif HC_METHOD == HC_LINEAR
#define hc_march hc_march_linear
#elif HC_METHOD == HC_RELIEF
#define hc_march hc_march_relief
#elif HC_METHOD == HC_OCCLUSION
#define hc_march hc_march_occlusion
#else
#define hc_march hc_march_cones
#endif

/* ---- rays ------------------------------------------------------------------------------------ */

/* The cell at path.from; on a wall it is the one that the ray goes into. */
ivec2 hc_first_cell(hc_path path)
{
    vec2 inside = clamp(hc_at(path, path.from).xy, hc_low(), hc_high());
    return ivec2(path.along.x < 0.0 ? ceil(inside.x) - 1.0 : floor(inside.x),
                 path.along.y < 0.0 ? ceil(inside.y) - 1.0 : floor(inside.y));
}

/* To the box of the field. through: the axis of the side it comes in by, 2 from above, 3 if it
 * starts in the box. False: it passes by. */
bool hc_enter(vec3 origin, vec3 direction, float t_max, out hc_path path, out int through)
{
    vec2  turns = floor(origin.xy);
    vec3  low   = vec3(hc_low(), -HC_MISS);
    vec3  high  = vec3(hc_high(), 1.0);
    origin.xy -= vec2(hc_wraps.x ? turns.x : 0.0, hc_wraps.y ? turns.y : 0.0);
    path.place = vec3(origin.xy * hc_steps - hc_zero, origin.z);
    path.along = vec3(direction.xy * hc_steps, direction.z);
    path.from  = 0.0;
    path.end   = t_max;
    through    = 3;
    for (int i = 0; i < 3; i++) {
        float place = path.place[i];
        float along = path.along[i];
        if (along == 0.0) {
            path.end = place >= low[i] && place <= high[i] ? path.end : -1.0;
        } else {
            float enters = ((along > 0.0 ? low[i] : high[i]) - place) / along;
            float leaves = ((along > 0.0 ? high[i] : low[i]) - place) / along;
            through      = enters > path.from ? i : through;
            path.from    = max(path.from, enters);
            path.end     = min(path.end, leaves);
        }
    }
    path.cell = hc_first_cell(path);
    return path.from <= path.end;
}

#ifdef HC_OPEN_SIDES

/* Rays below the surface are followed down to here. */
#define HC_DEEP (-1.0)

/* For a ray that starts at or under the surface: least r at which it comes down on it again after
 * it came up; HC_MISS if it does not. */
float hc_gap_return(vec3 gap, float reach)
{
    float up    = gap.x < 0.0 ? hc_contact(-gap, reach) : 0.0;
    float slope = gap.y + 2.0 * up * gap.z;
    float back  = slope > 0.0 && gap.z < 0.0 ? up - slope / gap.z : HC_MISS;
    return up <= reach && back <= reach ? back : HC_MISS;
}

/* Cell by cell until the ray comes up. True: from there on it can be marched; else it is lost, or
 * has come down again at once and `found` says where. */
bool hc_come_up(inout hc_path path, inout hc_found found)
{
    if (hc_at(path, path.from).z < HC_DEEP) {
        path.from = path.along.z > 0.0 ? hc_reaches(path.place.z, path.along.z, HC_DEEP) : HC_MISS;
        path.cell = hc_first_cell(path);
    } else if (path.along.z < 0.0) {
        path.end = min(path.end, hc_reaches(path.place.z, path.along.z, HC_DEEP));
    }
    for (int most = 0; most < 65536 && path.from < path.end; most++) {
        vec3  gap   = hc_gap_of(hc_patch_of(path.cell), path, path.cell, path.from);
        vec2  walls = hc_walls(path, path.cell, path.cell + 1, path.from);
        float leave = min(min(walls.x, walls.y), path.end);
        float back  = gap.x > 0.0 ? HC_MISS : hc_gap_return(gap, leave - path.from);
        if (gap.x > 0.0) {
            return true;
        }
        found.steps++;
        if (back < HC_MISS || leave >= path.end) {
            found.s = back < HC_MISS ? path.from + back : HC_MISS;
            return false;
        }
        hc_crossing_count += 1;
        path.cell = hc_cross(path, path.cell, walls);
        path.from = min(walls.x, walls.y);
    }
    return false;
}

#endif

/* The first hit of origin + t * direction, 0 <= t <= t_max. The field is solid below its surface:
 * a ray that starts there hits at once (HC_INSIDE), one that comes in through a side wall hits it
 * (HC_SIDE). */
hc_hit hc_nearest(vec3 origin, vec3 direction, float t_max)
{
    hc_path  path;
    int      through;
    hc_found found = hc_found(HC_MISS, 0, 0);
    if (hc_enter(origin, direction, t_max, path, through)) {
        float gap = hc_gap_of(hc_patch_of(path.cell), path, path.cell, path.from).x;
#ifdef HC_OPEN_SIDES
        if (gap <= 0.0 && through < 2) {
            found.steps = 1;
            if (hc_come_up(path, found)) {
                int before = found.steps;
                found      = hc_march(path);
                found.steps += before;
            }
        } else
#endif
        if (gap <= 0.0) {
            found = hc_found(path.from, through == 3 ? HC_INSIDE : through == 2 ? 0 : HC_SIDE, 1);
        } else {
            found = hc_march(path);
        }
    }
    if (found.s > t_max) {
        found.s = HC_MISS;
    }
    return hc_hit(found.s, origin + min(found.s, t_max) * direction, found.flags, found.steps);
}

/* ---- tangent space, normals, depth ----------------------------------------------------------- */

/* A direction of the world -> texture space: unit vectors along u, along v and outwards, world
 * units per tile, and the world depth of the relief. Positions likewise, from the place where
 * height is 0. */
vec3 hc_to_texture(vec3 world, vec3 along_u, vec3 along_v, vec3 outwards, vec2 scale, float depth)
{
    return vec3(dot(world, along_u) / scale.x, dot(world, along_v) / scale.y,
                dot(world, outwards) / depth);
}

/* Slopes of the exact patch at a place, heights per tile. */
vec2 hc_patch_slopes(vec2 uv)
{
    vec2     place  = clamp(uv * hc_steps - hc_zero, hc_low(), hc_high());
    vec2     cell   = floor(place);
    vec2     f      = place - cell;
    hc_patch patch_ = hc_patch_of(ivec2(cell));
    return (patch_.slope + f.yx * patch_.twist) * hc_steps;
}

#ifdef HC_DUMMER

/* The slopes that the 2006 paper stores with each texel: heights per step of a texel. */
vec2 hc_stored_slope(ivec2 texel)
{
    hc_fetch_count += 1;
    vec2 code = texelFetch(hc_heights, hc_index(texel), 0).ba * 255.0 - 127.0;
    return code * vec2(1.0, -1.0) / 255.0; /* v is upwards in the map */
}

/* Of a cell's corners along u, and along v. */
void hc_corner_slopes(ivec2 cell, out vec4 along_u, out vec4 along_v)
{
    vec2 a  = hc_stored_slope(cell);
    vec2 b  = hc_stored_slope(cell + ivec2(1, 0));
    vec2 c  = hc_stored_slope(cell + ivec2(0, 1));
    vec2 d  = hc_stored_slope(cell + 1);
    along_u = vec4(a.x, b.x, c.x, d.x);
    along_v = vec4(a.y, b.y, c.y, d.y);
}

#else

/* How many samples lie between those whose difference is the slope: one at an unwrapped border. */
vec2 hc_slope_width(ivec2 texel)
{
    vec2 back  = vec2(hc_wraps.x || texel.x > 0, hc_wraps.y || texel.y > 0);
    vec2 ahead = vec2(hc_wraps.x || texel.x < hc_size.x - 1, hc_wraps.y || texel.y < hc_size.y - 1);
    return max(back + ahead, vec2(1.0));
}

/* Central differences at a cell's corners, along u and along v. */
void hc_corner_slopes(ivec2 cell, out vec4 along_u, out vec4 along_v)
{
    vec4 a  = hc_corners(cell - 1);
    vec4 b  = hc_corners(cell + ivec2(1, -1));
    vec4 c  = hc_corners(cell + ivec2(-1, 1));
    vec4 d  = hc_corners(cell + 1);
    vec2 l  = hc_slope_width(cell);
    vec2 h  = hc_slope_width(cell + 1);
    along_u = vec4(b.z - a.z, b.w - a.w, d.x - c.x, d.y - c.y) / vec4(l.x, h.x, l.x, h.x);
    along_v = vec4(c.y - a.y, d.x - b.x, c.w - a.w, d.z - b.z) / vec4(l.y, l.y, h.y, h.y);
}

#endif

/* Slopes of the samples, filtered: smooth shading, heights per tile. */
vec2 hc_smooth_slopes(vec2 uv)
{
    vec4  along_u, along_v;
    vec2  half_ = HC_TOPS ? vec2(0.5) : vec2(0.0); /* its samples sit amid its cells */
    vec2  place = uv * hc_steps - hc_zero - half_;
    vec2  on    = clamp(place, vec2(0.0), vec2(hc_size - 1)); /* beyond the border it is as there */
    place       = vec2(hc_wraps.x ? place.x : on.x, hc_wraps.y ? place.y : on.y);
    ivec2 cell  = ivec2(floor(place));
    vec2  f     = place - vec2(cell);
    vec4  share = vec4(1.0 - f.x, f.x, 1.0 - f.x, f.x) * vec4(vec2(1.0 - f.y), vec2(f.y));
    hc_corner_slopes(cell, along_u, along_v);
    return vec2(dot(share, along_u), dot(share, along_v)) * hc_steps;
}

/* The relief's normal in the world: that of the body, bent by the slopes. Names as in
 * hc_to_texture. */
vec3 hc_normal(vec2 slopes, vec3 along_u, vec3 along_v, vec3 outwards, vec2 scale, float depth)
{
    vec2 steep = depth * slopes / scale;
    return normalize(outwards - steep.x * along_u - steep.y * along_v);
}

/* What to write to gl_FragDepth for a hit at `distance` along the view axis, with the usual
 * perspective projection and depth range 0 .. 1, so that polygons and relief hide each other. */
float hc_fragment_depth(float distance_, float near, float far)
{
    return clamp(far * (distance_ - near) / (distance_ * (far - near)), 0.0, 1.0);
}

/* ---- distance -------------------------------------------------------------------------------- */

/* Steps that are enough at a distance, where a tile covers fewer pixels: all of hc_step_count
 * within `near`, `least` beyond `far`. Set hc_step_limit to it. */
int hc_steps_for(float distance_, float near, float far, int most, int least)
{
    return int(mix(float(most), float(least), smoothstep(near, max(far, near + 1e-6),
                                                            distance_)) + 0.5);
}

/* Share of the relief that is left at a distance: 1 before `near`, 0 beyond `far`. Multiply the
 * depth with it, and the slopes, and there is no seam where a plain polygon takes over. */
float hc_fade(float distance_, float near, float far)
{
    return 1.0 - smoothstep(near, max(far, near + 1e-6), distance_);
}
