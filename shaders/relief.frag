/* relief.frag: relief on a plane, a cylinder, a sphere or a torus, a ray for each pixel. Stands
 * behind heightcast.glsl, whose marchers it uses, and draws what heightcast/render.h describes;
 * functions are named as in src/render and stand in the same order.
 *
 * It shows how to use those marchers: bodies and the curved rays round them (place_of,
 * along_shell), normals (shade), shadows (in_shadow), depth for the depth buffer (main). */

/* Bodies, as HC_BODY: */
#define PLANE 0
#define CYLINDER 1
#define SPHERE 2
#define TORUS 3

/* What becomes of rays beside the plane's top face, as HC_EDGE: a block with walls; they are
 * dropped; they go on over the rim's heights. */
#define WALL 0
#define DISCARD 1
#define CLAMP 2

/* forward: unit; right, down: to the picture's edges, at distance 1; orthographic: in the world */
uniform vec3  u_eye, u_forward, u_right, u_down;
uniform bool  u_orthographic;
uniform vec2  u_picture;     /* pixels */
uniform float u_first_row;   /* rows are drawn from the top, some at a time */
uniform vec2  u_sample;      /* where in the pixel, 0 .. 1, y down */
uniform vec2  u_depth_range; /* near and far plane */

uniform int   u_body;
uniform int   u_edge;            /* of the plane, as HC_EDGE below */
uniform float u_depth;           /* of the relief, in the world */
uniform vec2  u_fade;            /* where it begins to sink into the hull, and is gone; 0: never */
uniform vec2  u_lod;             /* where steps begin to get fewer, and are u_lod_steps; 0: never */
uniform int   u_lod_steps;
uniform float u_radius, u_ring;  /* of the hull; of the circle a torus goes along */
uniform vec2  u_half;            /* half sides of the plane; y: half the cylinder's height */
uniform vec2  u_repeat;          /* tiles */
uniform float u_bound;           /* radius of a ball that holds the body */

uniform bool  u_lamp;
uniform vec3  u_light; /* the lamp's place; or the unit direction to the sun */
uniform bool  u_shadows;
uniform float u_shadow_slip;

uniform sampler2D u_albedo;
uniform bool  u_textured;
uniform vec3  u_colour;
uniform vec3  u_shares; /* ambient, diffuse, specular */
uniform int   u_gloss;

layout(location = 0) out vec4 o_light;  /* linear rgb; distance along the ray, HC_MISS: nothing */
layout(location = 1) out vec4 o_normal; /* xyz in the world; height of the hit */
layout(location = 2) out vec4 o_counts; /* steps, texels read, came to the hull, ran out of steps */

/* The relief's depth as this pixel sees it. */
float relief_depth;

#define PI 3.14159265358979
#define SUN_AWAY 8.0
#define FLATTEST (1.0 / 1024.0) /* of faded relief: there is still something to divide by */

/* Pieces of a bent ray are nowhere farther than this from it, in depths of the relief; nor shorter
 * than on this radius. */
#define BEND (1.0 / 512.0)
#define RADIUS_LEAST 0.004

/* Rays end so far before the sides of the plane, in tiles: beyond them the next tile of a field
 * that wraps would begin. */
#define BRINK 1e-6

/* Rays that come down end so far below the bottom, in depths of the relief: ground of height 0 is
 * a hit, however the end is rounded. */
#define BELOW (1.0 / 16384.0)

/* ---- angles: what atan gives is too coarse on some cards
 * -------------------------------------- */

float arctangent(float x)
{
    bool  turned = x > 0.4142;
    float y      = turned ? (x - 1.0) / (x + 1.0) : x;
    float sum    = 0.0;
    for (int i = 8; i >= 0; i--) {
        sum = 1.0 / float(2 * i + 1) - y * y * sum;
    }
    return (turned ? PI / 4.0 : 0.0) + y * sum;
}

float angle(float y, float x)
{
    float a = abs(x);
    float b = abs(y);
    if (a == 0.0 && b == 0.0) {
        return 0.0;
    }
    float turn = b > a ? PI / 2.0 - arctangent(a / b) : arctangent(b / a);
    turn       = x < 0.0 ? PI - turn : turn;
    return y < 0.0 ? -turn : turn;
}

/* ---- bodies
 * ----------------------------------------------------------------------------------- */

/* Distance from where the hull's radius is counted: an axis, a point, a circle. */
float from_core(vec3 point)
{
    float flat_ = length(point.xy) - u_ring;
    return u_body == CYLINDER ? flat_ : length(vec2(flat_, point.z));
}

vec3 place_of(vec3 point)
{
    if (u_body == PLANE) {
        vec2 uv = 0.5 + vec2(0.5, -0.5) * point.xy / u_half;
        return vec3(u_repeat * uv, 1.0 + point.z / relief_depth);
    }
    float flat_ = length(point.xy) - u_ring;
    float v     = 0.5 - 0.5 * point.z / u_half.y;
    if (u_body == SPHERE) {
        v = angle(flat_, point.z) / PI;
    } else if (u_body == TORUS) {
        v = 0.5 - angle(point.z, flat_) / (2.0 * PI);
    }
    vec2 uv = vec2(0.5 + angle(point.y, point.x) / (2.0 * PI), clamp(v, 0.0, 1.0));
    return vec3(u_repeat * uv, 1.0 + (from_core(point) - u_radius) / relief_depth);
}

/* Of all images along axes that close, the one nearest to `before`. */
vec3 unwrapped(vec3 place, vec3 before)
{
    vec2 turns = floor((place.xy - before.xy) / u_repeat + 0.5);
    turns.y    = u_body == TORUS ? turns.y : 0.0;
    return vec3(place.xy - u_repeat * turns, place.z);
}

struct frame {
    vec3 along_u, along_v, out_;
    vec2 scale;
};

frame frame_at(vec3 point)
{
    if (u_body == PLANE) {
        return frame(vec3(1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, 1.0),
                     2.0 * u_half / u_repeat);
    }
    float axis = max(length(point.xy), 1e-9);
    float core = max(from_core(point), 1e-9);
    vec2  turn = point.xy / axis;
    frame f    = frame(vec3(-turn.y, turn.x, 0.0), vec3(0.0, 0.0, -1.0), vec3(turn, 0.0),
                       vec2(2.0 * PI * axis, 2.0 * u_half.y));
    if (u_body != CYLINDER) {
        float up    = point.z / core;
        float flat_ = (length(point.xy) - u_ring) / core;
        f.along_v   = vec3(up * turn, -flat_);
        f.out_      = vec3(flat_ * turn, up);
        f.scale.y   = (u_body == SPHERE ? 1.0 : 2.0) * PI * core;
    }
    f.scale /= u_repeat;
    return f;
}

/* ---- sights: what a ray of the world comes to
 * ------------------------------------------------- */

struct sight {
    float distance_; /* HC_MISS: nothing */
    vec3  place;
    vec3  cut; /* normal of the cut face it is on; zero: none */
    int   steps;
    bool  entered, unconverged;
};

/* The straight piece from a to b in texture space; true: a hit, at the returned share of it. */
bool march(inout sight s, vec3 a, vec3 b, out hc_hit hit)
{
    hit       = hc_nearest(a, b - a, 1.0);
    s.entered = true;
    s.steps += hit.steps;
    s.place       = hit.place;
    s.unconverged = hit.t < HC_MISS && (hit.flags & HC_UNCONVERGED) != 0;
    return hit.t < HC_MISS;
}

bool starts_in_solid(hc_hit hit)
{
    return hit.t == 0.0 && (hit.flags & (HC_INSIDE | HC_SIDE)) != 0;
}

void clip(inout vec2 span, inout int through, float place, float along, float low, float high,
          int axis)
{
    if (along == 0.0) {
        span.y = place >= low && place <= high ? span.y : -HC_MISS;
        return;
    }
    float enters = ((along > 0.0 ? low : high) - place) / along;
    float leaves = ((along > 0.0 ? high : low) - place) / along;
    through      = enters > span.x ? axis : through;
    span         = vec2(max(span.x, enters), min(span.y, leaves));
}

vec3 cut_normal(int axis, vec3 direction)
{
    vec3 normal  = vec3(0.0);
    normal[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
    return normal;
}

void clip_slab(inout vec2 span, inout int through, vec3 origin, vec3 direction)
{
    float low = relief_depth * (direction.z < 0.0 ? 1.0 + BELOW : 1.0);
    clip(span, through, origin.z, direction.z, -low, 0.0, 2);
}

vec2 plane_span(vec3 origin, vec3 direction, out int through)
{
    vec2 span = vec2(0.0, HC_MISS);
    through   = -1;
    clip(span, through, origin.x, direction.x, -u_half.x, u_half.x, 0);
    clip(span, through, origin.y, direction.y, -u_half.y, u_half.y, 1);
    clip_slab(span, through, origin, direction);
    return span;
}

/* Where the rim goes on outwards the ray ends at the bottom, wherever that is. */
vec2 edge_span(vec3 origin, vec3 direction, bool of_light, out int through)
{
    vec2 inside = plane_span(origin, direction, through);
    if (u_edge != CLAMP || (!of_light && inside.x > inside.y)) {
        return inside;
    }
    vec2 span = vec2(0.0, HC_MISS);
    int  slab = -1;
    clip_slab(span, slab, origin, direction);
    return vec2(of_light ? span.x : inside.x, span.y);
}

bool comes_in(vec2 span, int through, bool of_light, vec3 direction)
{
    bool top = (through == 2 || (u_edge == CLAMP && of_light)) && direction.z < 0.0;
    return span.x <= span.y && (u_edge == WALL || top);
}

/* Beyond a side the clamped place stands still along that axis, so the ray is straight in texture
 * space from one crossing of the sides' planes to the next: this one, after t. */
float next_crossing(float t, float end, vec3 origin, vec3 direction)
{
    float next = end;
    for (int i = 0; i < 4; i++) {
        int   axis   = i / 2;
        float side   = i % 2 == 0 ? -u_half[axis] : u_half[axis];
        float cross_ = direction[axis] == 0.0 ? HC_MISS : (side - origin[axis]) / direction[axis];
        next         = cross_ > t && cross_ < next ? cross_ : next;
    }
    return next;
}

void across_plane(inout sight s, vec3 origin, vec3 direction, bool of_light)
{
    int   through;
    vec2  span   = edge_span(origin, direction, of_light, through);
    bool  top    = through == 2 && direction.z < 0.0;
    float brink  = u_edge == CLAMP ? BRINK : 0.0;
    float t      = span.x;
    int   pieces = !comes_in(span, through, of_light, direction) ? 0 : u_edge == CLAMP ? 5 : 1;
    frame f      = frame_at(origin);
    vec3  along  = hc_to_texture(direction, f.along_u, f.along_v, f.out_, f.scale, relief_depth);
    vec3  start  = place_of(origin + t * direction);
    for (; pieces > 0; pieces--) {
        float  next = u_edge == CLAMP ? next_crossing(t, span.y, origin, direction) : span.y;
        vec3   from = start + (t - span.x) * along;
        vec3   to   = start + (next - span.x) * along;
        hc_hit hit;
        from.xy = clamp(from.xy, vec2(brink), u_repeat - brink);
        to.xy   = clamp(to.xy, vec2(BRINK), u_repeat - BRINK);
        if (march(s, from, to, hit)) {
            s.distance_ = t + (next - t) * hit.t;
            if (!top && through >= 0 && starts_in_solid(hit)) {
                s.cut = cut_normal(through, direction);
            }
            return;
        }
        t      = next;
        pieces = t < span.y ? pieces : 1;
    }
}

/* docs/algorithms.md, section 21, has the bound. */
float piece_length(vec3 point)
{
    float stray  = 8.0 * BEND * relief_depth;
    float radius = min(from_core(point), length(point.xy));
    return sqrt(stray * max(radius - sqrt(stray * radius), RADIUS_LEAST));
}

vec2 round_span(vec3 origin, vec3 direction, out int through)
{
    float middle  = -dot(origin, direction);
    vec3  nearest = origin + middle * direction;
    float square  = u_bound * u_bound - dot(nearest, nearest);
    through       = -1;
    if (square < 0.0) {
        return vec2(0.0, -HC_MISS);
    }
    vec2 span = vec2(max(middle - sqrt(square), 0.0), middle + sqrt(square));
    if (u_body == CYLINDER) {
        clip(span, through, origin.z, direction.z, -u_half.y, u_half.y, 2);
    }
    return span;
}

void along_shell(inout sight s, vec3 origin, vec3 direction)
{
    int   through;
    vec2  span  = round_span(origin, direction, through);
    float t     = span.x;
    vec3  point = origin + t * direction;
    vec3  here  = place_of(point);
    bool  first = through >= 0;
    for (int i = 0; i < 1024 && t < span.y; i++) {
        float away  = (here.z - 1.0) * relief_depth;
        float step_ = piece_length(point);
        float next  = min(t + max(step_, away), span.y);
        point       = origin + next * direction;
        vec3 there  = unwrapped(place_of(point), here);
        if (here.z < 0.0 && !first) {
            return; /* into the core: the method has lost its hit */
        }
        hc_hit hit;
        if (away <= step_ && march(s, here, there, hit)) {
            s.distance_ = t + (next - t) * hit.t;
            if (first && starts_in_solid(hit)) {
                s.cut = cut_normal(through, direction);
            }
            return;
        }
        here  = there;
        t     = next;
        first = false;
    }
}

/* of_light: the ray comes from there, not from the eye. They differ at a clamped edge: the light
 * also comes down to ground that only continues the texture. */
sight look(vec3 origin, vec3 direction, bool of_light)
{
    sight s = sight(HC_MISS, vec3(0.0), vec3(0.0), 0, false, false);
    if (u_body == PLANE) {
        across_plane(s, origin, direction, of_light);
    } else {
        along_shell(s, origin, direction);
    }
    return s;
}

/* The relief as a ray of the eye sees it, and that of the light from there: flatter where it
 * fades, with fewer steps far away. */
void gaze(vec3 origin, vec3 direction)
{
    int   through;
    float away = (u_body == PLANE ? plane_span(origin, direction, through)
                                  : round_span(origin, direction, through)).x;
    float left = u_fade.y > 0.0 ? max(hc_fade(away, u_fade.x, u_fade.y), FLATTEST) : 1.0;
    relief_depth *= left;
    if (u_lod.y > 0.0) {
        hc_step_limit = hc_steps_for(away, u_lod.x, u_lod.y, hc_step_count, u_lod_steps);
    }
}

/* ---- light
 * ------------------------------------------------------------------------------------ */

vec3 albedo_texel(ivec2 texel)
{
    ivec2 size   = textureSize(u_albedo, 0);
    ivec2 inside = clamp(texel, ivec2(0), size - 1);
    ivec2 folded = texel - size * ivec2(floor(vec2(texel) / vec2(size)));
    folded += size * ivec2(lessThan(folded, ivec2(0)));
    folded -= size * ivec2(greaterThanEqual(folded, size));
    return texelFetch(u_albedo, ivec2(hc_wraps.x ? folded.x : inside.x,
                                      hc_wraps.y ? folded.y : inside.y), 0).rgb;
}

vec3 albedo_at(sight s)
{
    if (!u_textured || dot(s.cut, s.cut) > 0.0) {
        return u_colour;
    }
    vec2  place = s.place.xy * vec2(textureSize(u_albedo, 0)) - 0.5;
    ivec2 cell  = ivec2(floor(place));
    vec2  f     = place - vec2(cell);
    return mix(mix(albedo_texel(cell), albedo_texel(cell + ivec2(1, 0)), f.x),
               mix(albedo_texel(cell + ivec2(0, 1)), albedo_texel(cell + ivec2(1, 1)), f.x), f.y);
}

vec3 normal_at(sight s, vec3 point)
{
    frame f = frame_at(point);
    return dot(s.cut, s.cut) > 0.0 ? s.cut
                                   : hc_normal(hc_smooth_slopes(s.place.xy), f.along_u, f.along_v,
                                               f.out_, f.scale, relief_depth);
}

/* A ray from the light that ends before the point leaves it in shadow. */
bool in_shadow(vec3 point, vec3 to_light, float distance_)
{
    return look(point + distance_ * to_light, -to_light, true).distance_
           < distance_ - u_shadow_slip;
}

vec3 shade(sight s, vec3 normal, vec3 point, vec3 direction)
{
    vec3  albedo    = albedo_at(s);
    vec3  to_light  = u_lamp ? normalize(u_light - point) : u_light;
    float distance_ = u_lamp ? length(u_light - point) : SUN_AWAY;
    float facing    = dot(normal, to_light);
    float shine     = max(dot(normal, normalize(to_light - direction)), 0.0);
    vec3  colour    = albedo * u_shares.x * (0.7 + 0.3 * normal.z);
    for (int i = 0; i < u_gloss; i++) {
        shine *= shine;
    }
    if (facing > 0.0 && !(u_shadows && in_shadow(point, to_light, distance_))) {
        colour += albedo * u_shares.y * facing + u_shares.z * shine;
    }
    return colour;
}

/* ---- pixels
 * ----------------------------------------------------------------------------------- */

void main(void)
{
    vec2  pixel     = gl_FragCoord.xy - 0.5 + vec2(0.0, u_first_row) + u_sample;
    vec2  place     = 2.0 * pixel / u_picture - 1.0;
    vec3  moved     = place.x * u_right + place.y * u_down;
    vec3  origin    = u_orthographic ? u_eye + moved : u_eye;
    vec3  direction = u_orthographic ? u_forward : normalize(u_forward + moved);
    relief_depth    = u_depth;
    gaze(origin, direction);
    sight s         = look(origin, direction, false);
    vec3  point     = origin + min(s.distance_, 1e6) * direction;
    float fetches   = float(hc_fetch_count);
    bool  hit       = s.distance_ < HC_MISS;
    vec3  normal    = hit ? normal_at(s, point) : vec3(0.0);
    o_light         = vec4(hit ? shade(s, normal, point, direction) : vec3(0.0), s.distance_);
    o_normal        = vec4(normal, s.place.z);
    o_counts        = vec4(float(s.steps), fetches, float(s.entered), float(s.unconverged));
    float along     = s.distance_ * dot(direction, u_forward);
    gl_FragDepth    = hit ? hc_fragment_depth(along, u_depth_range.x, u_depth_range.y) : 1.0;
}
