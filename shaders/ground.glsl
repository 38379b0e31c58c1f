/* ground.glsl: the colour of a landscape's ground. Stands behind heightcast.glsl and before
 * terrain.frag; functions are named as in src/render/terrain/ground.c. */

uniform vec2 u_spacing; /* world units between samples */
uniform int  u_ground;  /* as hc_ground: */
#define NATURAL 0
#define ELEVATION 1
#define SLOPE 2
#define IMAGE 3
uniform bool      u_blocky; /* one colour for each sample */
uniform sampler2D u_image;

/* ---- speckles -------------------------------------------------------------------------------- */

#define ROUGHNESS 0.05

/* 0 .. 1, of a point of a grid. */
float random_at(ivec2 place, uint octave)
{
    uint h = uint(place.x) * 0x9E3779B1u ^ uint(place.y) * 0x85EBCA77u ^ octave * 0xC2B2AE3Du;
    h      = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h      = (h ^ (h >> 12)) * 0x297A2D39u;
    return float((h ^ (h >> 15)) >> 8) / 16777216.0;
}

/* Smooth from point to point: slope along both axes, and a value of -1 .. 1. */
vec3 ripple(vec2 place, uint octave)
{
    ivec2 cell  = ivec2(floor(place));
    vec2  a     = place - vec2(cell);
    vec2  f     = a * a * (3.0 - 2.0 * a);
    float p     = random_at(cell, octave);
    float q     = random_at(cell + ivec2(1, 0), octave) - p;
    float r     = random_at(cell + ivec2(0, 1), octave) - p;
    float twist = random_at(cell + 1, octave) - p - q - r;
    vec2  slope = 12.0 * a * (1.0 - a) * (vec2(q, r) + twist * f.yx);
    return vec3(slope, 2.0 * (p + q * f.x + r * f.y + twist * f.x * f.y) - 1.0);
}

/* Ripples of rising frequency; those that a pixel cannot show are left out smoothly. All in
 * samples. */
vec3 speckle(vec2 place, float footprint)
{
    vec3  sum    = vec3(0.0);
    float size   = 0.5;
    float length_ = 4.0;
    for (uint octave = 0u; octave < 8u; octave++) {
        float seen = clamp(length_ / max(footprint, 1e-9) - 1.0, 0.0, 1.0);
        if (seen <= 0.0) {
            break;
        }
        sum += seen * vec3(vec2(ROUGHNESS), size) * ripple(place / length_, octave);
        length_ *= 0.4;
        size *= 0.8;
    }
    return sum;
}

/* ---- colours --------------------------------------------------------------------------------- */

const vec4 NATURAL_STOPS[6] =
    vec4[6](vec4(0.120, 0.150, 0.048, 0.00), vec4(0.095, 0.125, 0.040, 0.14),
            vec4(0.046, 0.078, 0.028, 0.34), vec4(0.064, 0.088, 0.032, 0.62),
            vec4(0.170, 0.145, 0.075, 0.82), vec4(0.300, 0.275, 0.240, 1.00));
const vec4 MAP_STOPS[6] =
    vec4[6](vec4(0.08, 0.22, 0.10, 0.00), vec4(0.26, 0.42, 0.14, 0.20),
            vec4(0.62, 0.54, 0.22, 0.45), vec4(0.36, 0.20, 0.10, 0.70),
            vec4(0.34, 0.30, 0.28, 0.88), vec4(0.85, 0.86, 0.88, 1.00));
/* At tangents of the slope. */
const vec4 SLOPE_STOPS[6] =
    vec4[6](vec4(0.05, 0.25, 0.10, 0.00), vec4(0.30, 0.42, 0.06, 0.25),
            vec4(0.66, 0.48, 0.05, 0.60), vec4(0.55, 0.05, 0.03, 1.00),
            vec4(0.25, 0.03, 0.32, 2.00), vec4(0.25, 0.03, 0.32, 3.00));
const vec3 ROCK = vec3(0.215, 0.190, 0.165);

vec3 along_stops(vec4 stops[6], float at)
{
    int i = 0;
    while (i < 4 && at > stops[i + 1].a) {
        i++;
    }
    float share = clamp((at - stops[i].a) / (stops[i + 1].a - stops[i].a), 0.0, 1.0);
    return mix(stops[i].rgb, stops[i + 1].rgb, share);
}

float steepness(vec3 normal)
{
    return length(normal.xy) / max(normal.z, 1e-6);
}

/* The normal is bent by what is too small for the samples. */
vec3 natural(vec3 place, inout vec3 normal, float footprint)
{
    vec3  grain  = speckle(place.xy * hc_steps, footprint / min(u_spacing.x, u_spacing.y));
    float bare   = clamp((steepness(normal) + 0.22 * grain.z - 0.55) / 0.35, 0.0, 1.0);
    vec3  colour = mix(along_stops(NATURAL_STOPS, place.z + 0.14 * grain.z), ROCK, bare);
    normal       = normalize(normal + vec3(-grain.x, grain.y, 0.0) * normal.z);
    return colour * (1.0 + 0.45 * grain.z);
}

vec3 image_texel(ivec2 texel)
{
    return texelFetch(u_image, clamp(texel, ivec2(0), textureSize(u_image, 0) - 1), 0).rgb;
}

vec3 draped(vec2 uv)
{
    vec2  place = uv * vec2(textureSize(u_image, 0)) - (u_blocky ? 0.0 : 0.5);
    ivec2 cell  = ivec2(floor(place));
    vec2  f     = u_blocky ? vec2(0.0) : place - vec2(cell);
    return mix(mix(image_texel(cell), image_texel(cell + ivec2(1, 0)), f.x),
               mix(image_texel(cell + ivec2(0, 1)), image_texel(cell + ivec2(1, 1)), f.x), f.y);
}

/* Of the samples on the field's posts: 0, else half a step. */
float first_sample(void)
{
    return HC_TOPS ? hc_zero.x + 0.5 : hc_zero.x;
}

/* The nearest sample instead of what lies between. */
vec3 snapped(vec3 place)
{
    float half_  = first_sample();
    ivec2 sample_ = clamp(ivec2(floor(place.xy * hc_steps - half_ + 0.5)), ivec2(0), hc_size - 1);
    return vec3((vec2(sample_) + half_) / hc_steps, hc_sample(sample_));
}

vec3 ground_colour(vec3 place, inout vec3 normal, float footprint)
{
    vec3 at = u_blocky ? snapped(place) : place;
    switch (u_ground) {
    case NATURAL: return natural(at, normal, footprint);
    case ELEVATION: return along_stops(MAP_STOPS, at.z);
    case SLOPE: return along_stops(SLOPE_STOPS, steepness(normal));
    case IMAGE: return draped(place.xy);
    default: return vec3(0.3, 0.29, 0.27);
    }
}
