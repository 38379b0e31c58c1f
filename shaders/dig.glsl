/* dig.glsl: rays to a height field with details cut into it. Stands behind detail.glsl, and finds
 * with heightcast.glsl's hc_nearest where a ray comes to the field. Functions are named as in
 * src/render/terrain/dig.c; docs/algorithms.md, section 22.9, has the formulas.
 *
 *     float left = 1.0;
 *     hc_hit hit = hc_nearest_detail(origin, direction, 1e9, left);
 *
 * By steps instead of safely: #define HC_DETAIL_STEPS. */

/* ---- what you set ---------------------------------------------------------------------------- */

#ifdef HC_DETAIL_STEPS
uniform int   hc_detail_steps;
uniform float hc_world; /* heights per world unit */
#else
/* Pyramids of maxima: R, texels from left to right, row by row. Level 0 is the highest of a texel
 * and of its right, lower and lower right neighbours; level k of a side n has max(1, n >> k). */
uniform sampler2D hc_detail_tops;
uniform int       hc_detail_level_first[4 * 17]; /* of a detail's levels: first texel */
uniform int       hc_detail_level_count[4];
uniform int       hc_detail_level_max; /* blocks above it are larger than the ground's cells */
#endif

#define HC_GRIDS 5
#define HC_GROUND 4 /* grids 0 .. are those of details */
#define HC_BISECTIONS 8
#define HC_LEAST_FALL (1.0 / 16.0)
#define HC_EMERGED (1.0 / 1048576.0)
#define HC_CAME_UP (1.0 / 8192.0)

/* ---- the first root -------------------------------------------------------------------------- */

#define HC_LEVELS 14

/* Least x in 0 .. reach where a + b.x x + b.y x^2 + b.z x^3 + b.w x^4 is 0 or less; HC_MISS: none.
 * By Bernstein coefficients, whose least bounds the polynomial; pieces that they do not clear are
 * halved, from the left. */
float hc_quartic_first(float a, vec4 b, float reach)
{
    if (a <= 0.0) {
        return 0.0;
    }
    int piece = 0; /* of 2^level */
    int level = 0;
    b *= reach * vec4(1.0, reach, reach * reach, reach * reach * reach);
    while (piece >> level == 0) {
        float h  = 1.0 / float(1 << level);
        float x  = float(piece) * h;
        float a0 = a + x * (b.x + x * (b.y + x * (b.z + x * b.w)));
        float a1 = h * (b.x + x * (2.0 * b.y + x * (3.0 * b.z + x * 4.0 * b.w)));
        float a2 = h * h * (b.y + x * (3.0 * b.z + x * 6.0 * b.w));
        float a3 = h * h * h * (b.z + x * 4.0 * b.w);
        float a4 = h * h * h * h * b.w;
        float least = min(min(a0, a0 + a1 / 4.0),
                          min(a0 + a1 / 2.0 + a2 / 6.0, a0 + 0.75 * a1 + a2 / 2.0 + a3 / 4.0));
        if (min(least, a0 + a1 + a2 + a3 + a4) > 0.0) {
            piece++;
            while (level > 0 && (piece & 1) == 0) {
                piece >>= 1;
                level--;
            }
        } else if (level == HC_LEVELS) {
            return reach * x;
        } else {
            piece <<= 1;
            level++;
        }
    }
    return HC_MISS;
}

/* ---- grids ----------------------------------------------------------------------------------- */

/* A ray in the cells of a grid, r after the hit of the ground. */
struct hc_grid {
    vec2  place, along;
    ivec2 cell;
    bool  used;
};

vec2 hc_grid_walls(hc_grid g)
{
    vec2 next = vec2(g.cell) + vec2(greaterThan(g.along, vec2(0.0)));
    return vec2(hc_reaches(g.place.x, g.along.x, next.x), hc_reaches(g.place.y, g.along.y, next.y));
}

void hc_grid_enter(inout hc_grid g, float r)
{
    vec2 place = g.place + r * g.along;
    g.cell.x   = int(g.along.x < 0.0 ? ceil(place.x) - 1.0 : floor(place.x));
    g.cell.y   = int(g.along.y < 0.0 ? ceil(place.y) - 1.0 : floor(place.y));
}

bool hc_grid_cross(inout hc_grid g, float r)
{
    vec2  walls   = hc_grid_walls(g);
    bvec2 crossed = lessThanEqual(walls, vec2(r));
    g.cell += ivec2(crossed) * (2 * ivec2(greaterThan(g.along, vec2(0.0))) - 1);
    return any(crossed);
}

/* Cells low .. high - 1 of a grid; no patch in it is higher than `top`. */
struct hc_block {
    ivec2 low, high;
    float top;
};

struct hc_walk {
    float    left, z, rise, leave;
    hc_grid  grids[HC_GRIDS];
    hc_patch shares[4]; /* of the mask, in this cell of the ground */
    int      steps, level; /* level: of blocks of texels; 0: texels */
    bool     emerged;
    bool     rising; /* the ray is under the detail, and has not hit it */
    bool     faced;  /* it has come to another top just now */
    bool     chosen; /* which details there are in the ground's cell */
};

hc_walk hc_w; /* not handed on: copies of arrays are what compilers are slow with */

/* Called from few places, since drivers put a copy of a function wherever it is called from. */
void hc_choose_details(float r)
{
    for (int i = 0; i < hc_detail_count && !hc_w.chosen; i++) {
        hc_patch mask = hc_mask_patch(i, hc_w.grids[HC_GROUND].cell);
        bool     none = mask.base == 0.0 && mask.slope == vec2(0.0) && mask.twist == 0.0;
        if (!none && !hc_w.grids[i].used) {
            hc_grid_enter(hc_w.grids[i], r);
        }
        hc_w.shares[i]     = mask;
        hc_w.grids[i].used = !none;
    }
    hc_w.chosen = true;
}

/* ---- rays ------------------------------------------------------------------------------------ */

/* place: in texture space, where the ground was hit; r counts from there. */
void hc_walk_from(vec3 place, vec3 along, float reach)
{
    hc_grid g     = hc_grid(place.xy * hc_steps - hc_zero, along.xy * hc_steps, ivec2(0), true);
    vec2    end   = vec2(along.x > 0.0 ? hc_high().x : hc_low().x,
                         along.y > 0.0 ? hc_high().y : hc_low().y);
    float deep       = 1.0;
    for (int i = 0; i < hc_detail_count; i++) {
        deep += hc_detail_cut[i];
    }
    /* Above all ground or below all details there is nothing farther on, though an upright ray
     * comes to no wall. */
    float layer      = hc_reaches(place.z, along.z, along.z > 0.0 ? 2.0 : -deep);
    hc_w.left        = 0.0;
    hc_w.z           = place.z;
    hc_w.rise        = along.z;
    hc_w.leave       = min(min(reach, layer), min(hc_reaches(g.place.x, g.along.x, end.x),
                                   hc_reaches(g.place.y, g.along.y, end.y)));
    hc_w.steps       = 0;
    hc_w.emerged     = false;
    hc_w.faced       = false;
    hc_w.rising      = false;
    hc_w.chosen      = false;
    for (int i = 0; i < 4; i++) {
        hc_w.shares[i]      = hc_patch(0.0, vec2(0.0), 0.0);
        hc_w.grids[i]       = hc_grid(vec2(0.0), vec2(0.0), ivec2(0), false);
    }
    for (int i = 0; i < hc_detail_count; i++) { /* whole tiles are taken out, for precision */
        vec2 tiles = hc_detail_rate[i] / vec2(hc_detail_size[i]) * place.xy;
        hc_w.grids[i].place = (tiles - floor(tiles)) * vec2(hc_detail_size[i]) - 0.5;
        hc_w.grids[i].along = hc_detail_rate[i] * along.xy;
    }
    hc_w.grids[HC_GROUND] = g;
}

void hc_go_in(float r)
{
    hc_grid_enter(hc_w.grids[HC_GROUND], r);
    for (int i = 0; i < HC_GROUND; i++) {
        hc_w.grids[i].used = false;
    }
    hc_w.level  = 0;
    hc_w.faced  = false;
    hc_w.rising = false;
    hc_w.chosen = false;
}

/* ---- gaps ------------------------------------------------------------------------------------ */

/* A patch along the ray, from r: a + b x + c x^2. */
vec3 hc_along_ray(hc_patch patch_, hc_grid g, float r)
{
    vec2 at = g.place + r * g.along - vec2(g.cell);
    return vec3(hc_patch_at(patch_, at), dot(g.along, patch_.slope + at.yx * patch_.twist),
                g.along.x * g.along.y * patch_.twist);
}

vec3 hc_ground_gap(float r)
{
    hc_patch patch_ = hc_patch_of(hc_w.grids[HC_GROUND].cell);
    vec3     ground = hc_along_ray(patch_, hc_w.grids[HC_GROUND], r);
    return vec3(hc_w.z + r * hc_w.rise, hc_w.rise, 0.0) - ground;
}

/* Over what is left of it: x^1 and above; *zero: x^0. */
vec4 hc_detail_gap(float r, out float zero)
{
    vec3 ground = hc_ground_gap(r);
    vec4 rest   = vec4(ground.yz, 0.0, 0.0);
    zero        = ground.x;
    for (int i = 0; i < hc_detail_count; i++) {
        if (!hc_w.grids[i].used) {
            continue;
        }
        float cut   = hc_w.left * hc_detail_cut[i];
        vec3  share = cut * hc_along_ray(hc_w.shares[i], hc_w.grids[HC_GROUND], r);
        vec3  low   = hc_along_ray(hc_detail_patch(i, hc_w.grids[i].cell), hc_w.grids[i], r);
        low.x -= 1.0;
        zero -= share.x * low.x;
        rest -= vec4(share.x * low.y + share.y * low.x,
                     share.x * low.z + share.y * low.y + share.z * low.x,
                     share.y * low.z + share.z * low.y, share.z * low.z);
    }
    return rest;
}

#ifndef HC_DETAIL_STEPS

/* ---- safe ------------------------------------------------------------------------------------ */

hc_block hc_block_of(int detail, ivec2 cell)
{
    int   level = min(hc_w.level, hc_detail_level_count[detail] - 1);
    ivec2 size  = hc_detail_size[detail];
    ivec2 index = hc_detail_index(detail, cell);
    ivec2 sides = max(size >> level, ivec2(1));
    ivec2 which = min(index >> level, sides - 1);
    ivec2 next  = (which + 1) << level;
    ivec2 base  = cell - index;
    ivec2 high  = base + ivec2(which.x < sides.x - 1 ? next.x : size.x,
                               which.y < sides.y - 1 ? next.y : size.y);
    int   texel = hc_detail_level_first[detail * 17 + level] + which.y * sides.x + which.x;
    int   width = textureSize(hc_detail_tops, 0).x;
    hc_fetch_count += 1;
    return hc_block(base + (which << level), high,
                    texelFetch(hc_detail_tops, ivec2(texel % width, texel / width), 0).r);
}

vec2 hc_block_walls(hc_grid g, hc_block b)
{
    return vec2(hc_reaches(g.place.x, g.along.x, float(g.along.x > 0.0 ? b.high.x : b.low.x)),
                hc_reaches(g.place.y, g.along.y, float(g.along.y > 0.0 ? b.high.y : b.low.y)));
}

/* To r, in the block or over its walls; never back. */
ivec2 hc_block_cross(hc_grid g, hc_block b, float r)
{
    vec2  walls = hc_block_walls(g, b);
    ivec2 there = ivec2(floor(g.place + r * g.along));
    ivec2 ahead = min(max(g.cell, there), b.high - 1);
    ivec2 back  = max(min(g.cell, there), b.low);
    return ivec2(walls.x <= r ? (g.along.x > 0.0 ? b.high.x : b.low.x - 1)
                 : g.along.x > 0.0 ? ahead.x : g.along.x < 0.0 ? back.x : g.cell.x,
                 walls.y <= r ? (g.along.y > 0.0 ? b.high.y : b.low.y - 1)
                 : g.along.y > 0.0 ? ahead.y : g.along.y < 0.0 ? back.y : g.cell.y);
}

/* Where the ray comes to the next wall of anything. clears: it does so above the blocks. */
float hc_next_end(float r, out bool clears)
{
    vec2  walls = hc_grid_walls(hc_w.grids[HC_GROUND]);
    vec3  gap   = hc_ground_gap(r);
    float end   = min(hc_w.leave, min(walls.x, walls.y));
    for (int i = 0; i < hc_detail_count; i++) {
        if (!hc_w.grids[i].used) {
            continue;
        }
        if (hc_w.level > 0) {
            hc_block b = hc_block_of(i, hc_w.grids[i].cell);
            walls      = hc_block_walls(hc_w.grids[i], b);
            gap += hc_w.left * hc_detail_cut[i] * (1.0 - b.top)
                   * hc_along_ray(hc_w.shares[i], hc_w.grids[HC_GROUND], r);
        } else {
            walls = hc_grid_walls(hc_w.grids[i]);
        }
        end = min(end, min(walls.x, walls.y));
    }
    end         = max(end, r);
    float reach = end - r;
    clears      = min(gap.x, min(gap.x + 0.5 * reach * gap.y,
                                 gap.x + reach * (gap.y + reach * gap.z))) > 0.0;
    return end;
}

/* Over the walls at r. */
void hc_cross_all(float r)
{
    for (int i = 0; i < hc_detail_count; i++) {
        if (hc_w.grids[i].used && hc_w.level > 0) {
            hc_block b           = hc_block_of(i, hc_w.grids[i].cell);
            hc_w.grids[i].cell = hc_block_cross(hc_w.grids[i], b, r);
        } else if (hc_w.grids[i].used) {
            hc_grid_cross(hc_w.grids[i], r);
        }
    }
    hc_w.faced  = hc_grid_cross(hc_w.grids[HC_GROUND], r);
    hc_w.chosen = hc_w.chosen && !hc_w.faced;
}

#ifdef HC_OPEN_SIDES

/* Down in the cell of the ground, where there is no detail? Then `end` is where it ends. */
bool hc_stays_deep(float r, inout float end)
{
    vec2  walls = hc_grid_walls(hc_w.grids[HC_GROUND]);
    vec3  gap   = hc_ground_gap(r);
    float wall  = max(min(hc_w.leave, min(walls.x, walls.y)), r);
    float reach = wall - r;
    for (int i = 0; i < hc_detail_count; i++) {
        if (hc_w.grids[i].used) {
            gap += hc_w.left * hc_detail_cut[i]
                   * hc_along_ray(hc_w.shares[i], hc_w.grids[HC_GROUND], r);
        }
    }
    if (max(gap.x, max(gap.x + 0.5 * reach * gap.y,
                       gap.x + reach * (gap.y + reach * gap.z))) >= 0.0) {
        return false;
    }
    for (int i = 0; i < HC_GROUND; i++) {
        hc_w.grids[i].used = false; /* it is left behind, and entered anew */
    }
    end = wall;
    return true;
}

#else
#define hc_stays_deep(r, end) false
#endif

/* Over the walls at the end. True: the ray has come out of the ground. */
bool hc_goes_over(inout float r, float end)
{
    r = end;
    hc_cross_all(r);
    hc_w.level   = min(hc_w.level + (hc_w.rising ? 0 : 1), hc_detail_level_max);
    hc_w.emerged = !hc_w.rising && hc_ground_gap(r).x > HC_EMERGED;
    return hc_w.emerged;
}

/* From r to the first contact; rising: to the first after the ray has come up out of the detail.
 * HC_MISS: to where it has come out of the ground, or to the end. Blocks are walked as nodes of the
 * pyramid are: up a level after each that the ray passes over, down a level where it may not. Where
 * it rises a root may be one that it only touches: it goes on behind it, farther from time to
 * time. */
float hc_walk_on(inout float r)
{
    float slip   = HC_CAME_UP;
    hc_w.emerged = false;
    for (int most = 0; most < 65536; most++) {
        bool  clears = true;
        float end    = r;
        hc_choose_details(r);
        bool deep = hc_w.rising && hc_stays_deep(r, end);
        if (!deep) {
            end = hc_next_end(r, clears);
        }
        hc_w.steps++;
        if (hc_w.level > 0 && !clears) {
            hc_w.level--;
            continue;
        }
        if (hc_w.level == 0 && !deep) {
            float zero;
            vec4  rest  = hc_detail_gap(r, zero);
            hc_w.rising = hc_w.rising && zero <= 0.0;
            float turn  = hc_w.rising ? -1.0 : 1.0;
            float met   = hc_quartic_first(turn * zero, turn * rest, end - r);
            if (!hc_w.rising && met < HC_MISS) {
                hc_w.faced = hc_w.faced && met == 0.0;
                return r + met;
            }
            if (hc_w.rising && met + slip * (end - r) < end - r) {
                r += met + slip * (end - r);
                slip *= 2.0;
                continue;
            }
        }
        if (end >= hc_w.leave || hc_goes_over(r, end)) {
            return HC_MISS;
        }
        slip = HC_CAME_UP;
    }
    return HC_MISS;
}

#ifdef HC_OPEN_SIDES

/* Does the ray come in through a side, under the ground, where there is detail? Then `from` is
 * there. */
bool hc_comes_in_below(vec3 origin, vec3 along, float t_max, float left, inout float from)
{
    hc_path path;
    int     through;
    bool    below = hc_enter(origin, along, t_max, path, through) && through < 2
                 && hc_gap_of(hc_patch_of(path.cell), path, path.cell, path.from).x <= 0.0
                 && (left >= 0.0 ? left : hc_details_left(path.from)) > 0.0;
    from = below ? path.from : from;
    return below;
}

#else
#define hc_comes_in_below(origin, along, t_max, left, from) false
#endif

/* hc_nearest, on to the detail, and to where the ray comes to the ground next. along: of unit
 * length in the world. left: how much of details this ray sees; below 0: as the distance of where
 * it comes to the ground says, and then it is what it was there. Where the detail is met at once
 * the ground's own hit stands, a wall's, too. */
hc_hit hc_nearest_detail(vec3 origin, vec3 along, float t_max, inout float left)
{
    hc_hit hit;
    bool   given = left >= 0.0;
    float  from  = 0.0;
    float  r     = 0.0;
    int    steps = 0;
    bool   below = hc_comes_in_below(origin, along, t_max, left, from);
    for (int times = 0; times < 256; times++) {
        hc_hit next = hc_hit(0.0, origin + from * along, 0, 0);
        if (times > 0 || !below) {
            next = hc_nearest(next.place, along, t_max - from);
        }
        steps += next.steps;
        if (times == 0 || next.t > 0.0) { /* else rounded: it is in the ground still */
            hit   = next;
            hit.t = next.t < HC_MISS ? from + next.t : HC_MISS;
            left  = given ? left : hc_details_left(hit.t);
            if (!(hit.t < HC_MISS) || left <= 0.0) {
                break;
            }
            hc_walk_from(hit.place, along, t_max - hit.t);
            hc_w.left = left;
            r         = 0.0;
            hc_go_in(r);
            hc_w.rising = below && times == 0;
        }
        int   before = hc_w.steps;
        float met    = hc_walk_on(r);
        steps += hc_w.steps - before;
        if (!hc_w.emerged) {
            hit.flags = met > 0.0 ? (HC_TOPS && hc_w.faced ? HC_SIDE : 0) : hit.flags;
            hit.place += met < HC_MISS ? met * along : vec3(0.0);
            hit.t = met < HC_MISS ? hit.t + met : HC_MISS;
            break;
        }
        from = hit.t + r;
    }
    hit.steps = steps;
    return hit;
}

#else

/* ---- steps ----------------------------------------------------------------------------------- */

float hc_gap_at(float r)
{
    float zero;
    hc_go_in(r);
    hc_choose_details(r);
    hc_detail_gap(r, zero);
    hc_w.steps++;
    return zero;
}

/* How far it is from `first` through the layer that details are cut from, as if the ground went on
 * as it lies there, and a quarter more. 0: there are no details. */
float hc_way_through(float first)
{
    float deep = 0.0;
    for (int i = 0; i < hc_detail_count; i++) {
        vec3 share = hc_along_ray(hc_w.shares[i], hc_w.grids[HC_GROUND], first);
        deep += hc_w.left * hc_detail_cut[i] * share.x;
    }
    vec3 gap = hc_ground_gap(first);
    return deep > 0.0
               ? 1.25 * (deep + max(gap.x, 0.0)) / max(-gap.y, HC_LEAST_FALL * hc_world)
               : 0.0;
}

/* From a face of a top on it is that top's detail, on whichever side of the face the hit was
 * rounded to. */
float hc_way_into_face(void)
{
    vec2 along = abs(hc_w.grids[HC_GROUND].along);
    return 1.0 / (1024.0 * max(along.x, along.y));
}

/* hc_nearest, then equal steps and bisection, as in the RaycastTerrain sample; names as above.
 * HC_UNCONVERGED: the steps came to nothing, and the ground's own hit stands. */
hc_hit hc_nearest_detail(vec3 origin, vec3 along, float t_max, inout float left)
{
    hc_hit hit = hc_nearest(origin, along, t_max);
    left       = left >= 0.0 ? left : hc_details_left(hit.t);
    if (!(hit.t < HC_MISS) || left <= 0.0) {
        return hit;
    }
    hc_walk_from(hit.place, along, t_max - hit.t);
    hc_w.left   = left;
    float first = HC_TOPS && (hit.flags & HC_SIDE) != 0 ? hc_way_into_face() : 0.0;
    float way   = 0.0;
    float gap   = 1.0;                  /* at the hit itself */
    vec2  ends  = vec2(first, HC_MISS); /* above and below */
    for (int i = 0; i <= hc_detail_steps + HC_BISECTIONS && gap > 0.0; i++) {
        bool  halves = i > hc_detail_steps;
        bool  found  = ends.y < HC_MISS;
        float r      = halves ? 0.5 * (ends.x + ends.y)
                              : first + way * float(i) / float(hc_detail_steps);
        if (halves && !found) {
            break;
        }
        if (!halves && (found || r > hc_w.leave)) {
            i = hc_detail_steps; /* bisections come next */
            continue;
        }
        float here = hc_gap_at(r);
        if (i == 0) {
            way = hc_way_through(first);
            gap = way > 0.0 ? here : 0.0;
        } else {
            ends = here > 0.0 ? vec2(r, ends.y) : vec2(ends.x, r);
        }
    }
    if (ends.y < HC_MISS) {
        hc_go_in(ends.x);
        ivec2 before = hc_w.grids[HC_GROUND].cell;
        hc_go_in(ends.y);
        hit.t += ends.y;
        hit.place += ends.y * along;
        hit.flags = HC_TOPS && before != hc_w.grids[HC_GROUND].cell ? HC_SIDE : 0;
    } else if (gap > 0.0) {
        hit.flags |= HC_UNCONVERGED;
    }
    hit.steps += hc_w.steps;
    return hit;
}

#endif
