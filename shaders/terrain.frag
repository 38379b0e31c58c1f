/* terrain.frag: a landscape, a ray for each pixel and one from there to the sun. Stands behind
 * heightcast.glsl, whose marchers it uses, and ground.glsl, with #define DETAILS behind detail.glsl
 * and dig.glsl, too, and draws what heightcast/terrain.h describes; functions are named as in
 * src/render/terrain and stand in its files' order: air, see.
 *
 * It shows how to use those marchers for terrain: any eye (main), the sun's shadow (in_shadow), and
 * triangles in the same depth buffer, lit by the same sun: bodies.vert puts them there, with this
 * file behind #define BODIES. ground.vert draws the ground itself as triangles, with this file
 * behind #define POLYGONS, and the sky around them is its own behind #define SKY. All is in texture
 * space, where the CPU has put the eye; t of a ray is the distance in the world, since the field's
 * place is affine. */

/* forward: unit; right, down: to the picture's edges, at distance 1; orthographic: in the world */
uniform vec3  u_forward, u_right, u_down;
uniform bool  u_orthographic;
uniform vec2  u_picture;     /* pixels */
uniform float u_first_row;   /* rows are drawn from the top, some at a time */
uniform vec2  u_sample;      /* where in the pixel, 0 .. 1, y down */
uniform vec3  u_place;       /* of the eye, in texture space */
uniform vec3  u_scale;       /* texture space per world unit */
uniform float u_footprint;   /* width of a pixel at distance 1 */

uniform vec3  u_sun;        /* unit, towards it */
uniform bool  u_shadows;
uniform float u_shadow_slip; /* in the world */
uniform float u_haze;        /* in the world */
uniform float u_haze_top;    /* of the eye, below where haze ends, in the world */

/* Triangles that throw shadows, and the tree over them: texels from left to right, row by row. Of a
 * node 2: low corner and `first`, high corner and `count`; it is a leaf of so many triangles from
 * `first`, or has 0: then its children are the next node and node `first`. Behind the nodes, of a
 * triangle 3: its corners. All from an anchor in the world. */
uniform sampler2D u_bodies;
uniform int       u_node_count; /* 0: there are none */
uniform vec3      u_anchor;     /* from the anchor to the eye */
uniform float     u_body_slip;  /* rays leave an object so far from it */

/* What the sun sees, as a map of depths, or u_map_side 0: then shadows are cast. */
uniform sampler2D u_map;
uniform int       u_map_side;
uniform vec3      u_map_across, u_map_along; /* its axes, unit */
uniform vec2      u_map_first, u_map_texel;  /* its corner, from the anchor; world units */
uniform float     u_map_top;                 /* along the sun, from the anchor */

uniform float u_depth_unit; /* of the depth buffer: depth = unit / (unit + along), nearer is more */

layout(location = 0) out vec4 o_light;  /* linear rgb; distance along the ray, HC_MISS: nothing */
layout(location = 1) out vec4 o_normal; /* xyz in the world; height of the hit */
layout(location = 2) out vec4 o_counts; /* steps, texels read, came to the box: 1 + crossings, ran
                                           out of steps */

uniform float u_details_left; /* how much of details a picture's rays see; below 0: by distance */

/* How much of details there is where this pixel's ray came to; below 0: it will tell. */
float detail_left = 0.0;

/* Walls end so far below height 0. */
#define BASE 0.25

/* ---- air ------------------------------------------------------------------------------------- */

const vec3 ZENITH  = vec3(0.09, 0.22, 0.52);
const vec3 HORIZON = vec3(0.56, 0.68, 0.82);
const vec3 GLOW    = vec3(0.95, 0.72, 0.42);

float squared(float x, int times)
{
    for (int i = 0; i < times; i++) {
        x *= x;
    }
    return x;
}

vec3 air_colour(vec3 direction)
{
    float towards = max(dot(direction, u_sun), 0.0);
    return HORIZON + 0.35 * squared(towards, 2) * (GLOW - 0.5 * HORIZON);
}

vec3 sky_colour(vec3 direction)
{
    float deep    = 1.0 - squared(1.0 - clamp(direction.z, 0.0, 1.0), 2);
    float towards = max(dot(direction, u_sun), 0.0);
    float disc    = towards > 0.99996 ? 12.0 : 0.0;
    return mix(air_colour(direction), ZENITH, deep)
           + GLOW * (0.25 * squared(towards, 5) + 0.7 * squared(towards, 10) + disc);
}

/* How much of a ray lies in the haze; top: where it ends, above the ray's origin. */
float way_in_haze(float top, float rise, float distance_)
{
    if (top < 0.0) {
        return rise < 0.0 ? max(distance_ - top / rise, 0.0) : 0.0;
    }
    return rise > 0.0 ? min(distance_, top / rise) : distance_;
}

vec3 haze(vec3 colour, vec3 direction, float top, float distance_)
{
    float way = way_in_haze(top, direction.z, distance_);
    return mix(air_colour(direction), colour, squared(1.0 / (1.0 + way / (8.0 * u_haze)), 3));
}

/* ---- see ------------------------------------------------------------------------------------- */

const vec3 SUNLIGHT   = vec3(2.75, 2.40, 1.90);
const vec3 SKYLIGHT   = vec3(0.26, 0.34, 0.50);
const vec3 BOUNCED    = vec3(0.14, 0.13, 0.10);
const vec3 CUT_GROUND = vec3(0.16, 0.12, 0.085);

bool is_cut(hc_hit hit)
{
    bool faces = HC_TOPS;
    return (hit.flags & HC_INSIDE) != 0 || ((hit.flags & HC_SIDE) != 0 && !faces);
}

/* A vector of texture space that is across a surface, in the world. */
vec3 across(vec3 normal)
{
    return normalize(normal * u_scale);
}

/* The wall the hit is on is the one it is nearest to: of the field, or of a sample's top. It faces
 * the ray. */
vec3 wall_normal(vec3 place, vec3 along)
{
    vec2 at   = place.xy * hc_steps - hc_zero;
    vec2 away = min(abs(at - hc_low()), abs(at - hc_high()));
    away      = HC_TOPS ? min(away, abs(at - floor(at + 0.5))) : away;
    return across(away.x <= away.y ? vec3(along.x > 0.0 ? -1.0 : 1.0, 0.0, 0.0)
                                   : vec3(0.0, along.y > 0.0 ? -1.0 : 1.0, 0.0));
}

vec3 normal_at(hc_hit hit, vec3 along)
{
    if ((hit.flags & HC_SIDE) != 0) {
        return wall_normal(hit.place, along);
    }
    bool flat_  = u_blocky || is_cut(hit) || HC_TOPS;
    vec2 slopes = flat_ ? hc_patch_slopes(hit.place.xy) : hc_smooth_slopes(hit.place.xy);
#ifdef DETAILS
    slopes += is_cut(hit) ? vec2(0.0) : hc_details_slopes(hit.place.xy, detail_left);
#endif
    return across(vec3(-slopes, 1.0));
}

/* How far it is from a point to where the field's box ends, towards the sun. */
float way_out(vec3 place, vec3 along)
{
    float up   = along.z > 0.0 ? (1.0 - place.z) / along.z : HC_MISS;
    float left = hc_reaches(place.x, along.x, along.x > 0.0 ? 1.0 : 0.0);
    float ahead = hc_reaches(place.y, along.y, along.y > 0.0 ? 1.0 : 0.0);
    return max(min(up, min(left, ahead)), 0.0);
}

hc_hit nearest(vec3 origin, vec3 along, float reach)
{
#ifdef DETAILS
    return hc_nearest_detail(origin, along, reach, detail_left);
#else
    return hc_nearest(origin, along, reach);
#endif
}

/* Must it be asked whether this sees the sun? */
bool asks_sun(vec3 normal)
{
    return u_shadows && u_map_side == 0 && dot(normal, u_sun) > 0.0;
}

/* The ray from the sun to a hit, which ends before it: where it begins, and how long it is. */
vec3 sun_ray(vec3 place, out float reach)
{
    vec3  along = u_sun * u_scale;
    float away  = way_out(place, along) + u_shadow_slip;
    reach       = away - u_shadow_slip;
    return place + away * along;
}

bool hides(hc_hit cause)
{
#ifdef HC_DETAIL_STEPS
    if ((cause.flags & HC_UNCONVERGED) != 0) {
        return false; /* steps that come to nothing hide nothing */
    }
#endif
    return cause.t < HC_MISS;
}

bool in_shadow(vec3 place)
{
    float reach;
    vec3  from = sun_ray(place, reach);
    return hides(nearest(from, -u_sun * u_scale, reach));
}

/* ---- bodies ---------------------------------------------------------------------------------- */

vec4 body_texel(int index)
{
    int width = textureSize(u_bodies, 0).x;
    return texelFetch(u_bodies, ivec2(index % width, index / width), 0);
}

bool comes_to(vec3 low, vec3 high, vec3 origin, vec3 direction)
{
    float from = 0.0;
    float to   = HC_MISS;
    for (int k = 0; k < 3; k++) {
        if (direction[k] != 0.0) {
            float a = (low[k] - origin[k]) / direction[k];
            float b = (high[k] - origin[k]) / direction[k];
            from    = max(from, min(a, b));
            to      = min(to, max(a, b));
        } else if (origin[k] < low[k] || origin[k] > high[k]) {
            return false;
        }
    }
    return from <= to;
}

bool meets(int index, vec3 origin, vec3 direction)
{
    vec3  corner = body_texel(index).xyz;
    vec3  one    = body_texel(index + 1).xyz - corner;
    vec3  two    = body_texel(index + 2).xyz - corner;
    vec3  from   = origin - corner;
    vec3  across_ = cross(direction, two);
    vec3  over   = cross(from, one);
    float volume = dot(one, across_);
    if (volume == 0.0) {
        return false;
    }
    vec3 found = vec3(dot(from, across_), dot(direction, over), dot(two, over)) / volume;
    return found.x >= 0.0 && found.y >= 0.0 && found.x + found.y <= 1.0 && found.z > u_body_slip;
}

/* Is an object between a point, from the anchor, and the sun? */
bool body_shades(vec3 point)
{
    int stack[32];
    int waiting = 0;
    if (u_node_count > 0) {
        stack[waiting++] = 0;
    }
    while (waiting > 0) {
        int  index = stack[--waiting];
        vec4 low   = body_texel(2 * index);
        vec4 high  = body_texel(2 * index + 1);
        int  first = int(low.a);
        int  count = int(high.a);
        if (!comes_to(low.xyz, high.xyz, point, u_sun)) {
            continue;
        }
        if (count == 0) {
            stack[waiting++] = first;
            stack[waiting++] = index + 1;
        }
        for (int i = first; i < first + count; i++) {
            if (meets(2 * u_node_count + 3 * i, point, u_sun)) {
                return true;
            }
        }
    }
    return false;
}

/* ---- see: light ------------------------------------------------------------------------------ */

vec3 light(vec3 colour, vec3 normal, float lit)
{
    float facing = lit * max(dot(normal, u_sun), 0.0);
    float open_  = 0.5 + 0.5 * normal.z;
    return colour * (SUNLIGHT * facing + SKYLIGHT * open_ + BOUNCED * (1.0 - open_));
}

/* Outside of the map there is nothing. */
float map_depth(ivec2 texel)
{
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(u_map_side)));
    return inside ? texelFetch(u_map, texel, 0).r : HC_MISS;
}

/* Share of the sun's light at a point, from the anchor: the four texels around it, weighed. */
float map_light(vec3 point, float facing)
{
    float slope = sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.05);
    float depth = u_map_top - dot(point, u_sun) - max(u_map_texel.x, u_map_texel.y) * (0.5 + slope);
    vec2  at    = vec2(dot(point, u_map_across), dot(point, u_map_along)) - u_map_first;
    at          = at / u_map_texel - 0.5;
    ivec2 cell  = ivec2(floor(at));
    vec2  f     = at - vec2(cell);
    vec4  held  = vec4(map_depth(cell), map_depth(cell + ivec2(1, 0)),
                       map_depth(cell + ivec2(0, 1)), map_depth(cell + 1));
    vec4  open_ = vec4(lessThanEqual(vec4(depth), held));
    return mix(mix(open_.x, open_.y, f.x), mix(open_.z, open_.w, f.x), f.y);
}

/* Share of the sun's light; from_eye: in the world; dark: it is known to lie in shadow */
float lit_at(vec3 normal, vec3 from_eye, bool dark)
{
    float facing = dot(normal, u_sun);
    vec3  point  = u_anchor + from_eye;
    if (!u_shadows || facing <= 0.0) {
        return u_shadows ? 0.0 : 1.0; /* rough ground may face the sun where the ground does not */
    }
    if (u_map_side > 0) {
        return map_light(point, facing);
    }
    return dark || body_shades(point) ? 0.0 : 1.0;
}

vec3 see_ground(hc_hit hit, vec3 normal, float lit, vec3 direction, float top)
{
    bool  face  = (hit.flags & HC_SIDE) != 0;
    vec2  back  = face ? 0.25 * sign(normal.xy * u_scale.xy) / hc_steps : vec2(0.0);
    vec2  on    = hit.place.xy - back;
    vec3 colour = is_cut(hit) ? CUT_GROUND
                              : ground_colour(hit.place, normal, u_footprint * hit.t);
#ifdef DETAILS
    colour = is_cut(hit) ? colour : hc_details_colour(colour, hit.place.xy, on, detail_left);
#endif
    return haze(light(colour, normal, lit), direction, top, hit.t);
}

float depth_of(float along)
{
    return u_depth_unit / (u_depth_unit + max(along, 0.0));
}

/* ---- pixels ---------------------------------------------------------------------------------- */

#ifdef BODIES

/* Of a triangle that is drawn: from the eye, in the world. */
in vec3 v_from_eye, v_normal, v_colour;

void main(void)
{
    float along     = dot(v_from_eye, u_forward);
    vec3  direction = u_orthographic ? u_forward : normalize(v_from_eye);
    vec3  normal    = normalize(v_normal);
    vec3  shift     = u_orthographic ? v_from_eye - along * u_forward : vec3(0.0);
    float distance_ = u_orthographic ? along : length(v_from_eye);
    vec3  place     = u_place + v_from_eye * u_scale;
    normal          = dot(normal, direction) > 0.0 ? -normal : normal;
    if (along < 0.0) {
        discard;
    }
#ifdef DETAILS
    detail_left = hc_details_left(distance_);
#endif
    float lit    = lit_at(normal, v_from_eye, asks_sun(normal) && in_shadow(place));
    vec3 colour  = haze(light(v_colour, normal, lit), direction, u_haze_top - shift.z, distance_);
    o_light      = vec4(colour, distance_);
    o_normal     = vec4(normal, place.z);
    o_counts     = vec4(0.0);
    gl_FragDepth = depth_of(along);
}

#elif defined(POLYGONS)

/* Of the ground's triangles: from the eye, in the world; in texture space. */
in vec3 v_from_eye, v_place;

/* Triangles lie beside the patches that throw shadows; light is that of the patch. */
vec3 on_patch(vec3 place)
{
    vec2     at     = clamp(place.xy * hc_steps - hc_zero, hc_low(), hc_high());
    vec2     f      = at - floor(at);
    hc_patch patch_ = hc_patch_of(ivec2(floor(at)));
    return vec3(place.xy, patch_.base + dot(f, patch_.slope) + f.x * f.y * patch_.twist);
}

void main(void)
{
    float along     = dot(v_from_eye, u_forward);
    vec3  direction = u_orthographic ? u_forward : normalize(v_from_eye);
    vec3  shift     = u_orthographic ? v_from_eye - along * u_forward : vec3(0.0);
    float distance_ = u_orthographic ? along : length(v_from_eye);
    if (along < 0.0) {
        discard;
    }
    hc_hit hit   = hc_hit(distance_, on_patch(v_place), 0, 0);
    vec3 normal  = normal_at(hit, direction * u_scale);
    vec3 lit_by  = (hit.place - u_place) / u_scale;
    float lit    = lit_at(normal, lit_by, asks_sun(normal) && in_shadow(hit.place));
    vec3 colour  = see_ground(hit, normal, lit, direction, u_haze_top - shift.z);
    o_light      = vec4(colour, distance_);
    o_normal     = vec4(normal, v_place.z);
    o_counts     = vec4(0.0, 0.0, 1.0, 0.0);
    gl_FragDepth = depth_of(along);
}

#else

/* What the eye's ray comes to. */
struct sight {
    hc_hit hit;
    vec3   normal; /* in the world; 0: it comes to nothing */
    int    fetches, crossings;
    bool   dark; /* in shadow */
};

/* The field has no end below, its picture does. The ray from the sun follows that of the eye
 * through the same call: drivers put a copy of a function wherever it is called from, and compile
 * for as much longer. */
sight look(vec3 place, vec3 along)
{
    sight seen  = sight(hc_hit(HC_MISS, place, 0, 0), vec3(0.0), 0, 0, false);
    vec3  from  = place;
    vec3  way   = along;
    float reach = 1e30;
    detail_left = u_details_left;
#ifndef SKY
    for (int rays = 0; rays < (u_shadows ? 2 : 1); rays++) {
        hc_hit hit = nearest(from, way, reach);
        if (rays > 0) {
            seen.dark = hides(hit);
            break;
        }
        if ((hit.flags & HC_SIDE) != 0 && hit.place.z < -BASE) {
            hit.t = HC_MISS;
        }
        seen.hit       = hit;
        seen.fetches   = hc_fetch_count;
        seen.crossings = hc_crossing_count > 0 ? hc_crossing_count : hit.steps;
        if (!(hit.t < HC_MISS)) {
            break;
        }
        seen.normal = normal_at(hit, along);
        if (!asks_sun(seen.normal)) {
            break;
        }
        from = sun_ray(hit.place, reach);
        way  = -u_sun * u_scale;
    }
#endif
    return seen;
}

void main(void)
{
    vec2   pixel     = gl_FragCoord.xy - 0.5 + vec2(0.0, u_first_row) + u_sample;
    vec2   centred   = 2.0 * pixel / u_picture - 1.0;
    vec3   moved     = centred.x * u_right + centred.y * u_down;
    vec3   shift     = u_orthographic ? moved : vec3(0.0);
    vec3   direction = u_orthographic ? u_forward : normalize(u_forward + moved);
    vec3   along     = direction * u_scale;
    sight  seen      = look(u_place + shift * u_scale, along);
    hc_hit hit       = seen.hit;
    bool   entered   = hit.t < HC_MISS || hit.steps > 0;
    vec3   colour    = sky_colour(direction);
    if (hit.t < HC_MISS) {
        float lit = lit_at(seen.normal, shift + hit.t * direction, seen.dark);
        colour    = see_ground(hit, seen.normal, lit, direction, u_haze_top - shift.z);
    }
    o_light      = vec4(colour, hit.t);
    o_normal     = vec4(seen.normal, hit.place.z);
    o_counts     = vec4(float(hit.steps), float(seen.fetches),
                        entered ? 1.0 + float(seen.crossings) : 0.0,
                        float((hit.flags & HC_UNCONVERGED) != 0));
    gl_FragDepth = hit.t < HC_MISS ? depth_of(hit.t * dot(direction, u_forward)) : 0.0;
}

#endif
