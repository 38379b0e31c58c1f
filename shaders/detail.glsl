/* detail.glsl: small height maps that tile, cut into a height field by the shares of a mask: their
 * patches, and slopes and colours at a hit. Stands behind heightcast.glsl and before dig.glsl,
 * which finds the hits; terrain.frag shows how to use both. Functions are named as in
 * src/render/terrain/detail.c; docs/algorithms.md, section 22.9, has the formulas.
 *
 * Needs a field that does not wrap. On flat tops (HC_STEPS, HC_QDM) the mask is a share for
 * each. */

/* ---- what you set ---------------------------------------------------------------------------- */

/* Colour in rgb, height in a; all details beside each other, their upper edges at the top. */
uniform sampler2D hc_details;
uniform int       hc_detail_count;
uniform int       hc_detail_first[4];   /* column of its first texel */
uniform vec2      hc_detail_rate[4];    /* texels per texture unit of the field */
uniform ivec2     hc_detail_size[4];
uniform float     hc_detail_cut[4];     /* depth, in the field's heights */
uniform vec3      hc_detail_mean[4];    /* of its colours */
uniform bool      hc_detail_colours[4]; /* whether it has some */
uniform bool      hc_detail_flat;       /* facets and nearest texels */
uniform vec2      hc_detail_fade;       /* distances at which they begin to sink, and are gone */
uniform sampler2D hc_mask;              /* a texel per sample: shares of details */
uniform bool      hc_masked;            /* else each has the same share */

/* ---- patches --------------------------------------------------------------------------------- */

ivec2 hc_detail_index(int detail, ivec2 texel)
{
    ivec2 size  = hc_detail_size[detail];
    ivec2 index = texel - size * ivec2(floor(vec2(texel) / vec2(size)));
    index += size * ivec2(lessThan(index, ivec2(0))); /* where the quotient was rounded */
    return index - size * ivec2(greaterThanEqual(index, size));
}

vec4 hc_detail_texel(int detail, ivec2 texel)
{
    hc_fetch_count += 1;
    return texelFetch(hc_details,
                      hc_detail_index(detail, texel) + ivec2(hc_detail_first[detail], 0), 0);
}

hc_patch hc_through(vec4 h)
{
    return hc_patch(h.x, h.yz - h.x, h.w - h.y - h.z + h.x);
}

hc_patch hc_mask_patch(int detail, ivec2 cell)
{
    if (!hc_masked) {
        return hc_patch(1.0 / float(hc_detail_count), vec2(0.0), 0.0);
    }
    ivec2 a = clamp(cell, ivec2(0), hc_size - 1);
    ivec2 b = clamp(cell + 1, ivec2(0), hc_size - 1);
    if (HC_TOPS) {
        hc_fetch_count += 1;
        return hc_patch(texelFetch(hc_mask, a, 0)[detail], vec2(0.0), 0.0);
    }
    hc_fetch_count += 4;
    return hc_through(vec4(texelFetch(hc_mask, a, 0)[detail],
                           texelFetch(hc_mask, ivec2(b.x, a.y), 0)[detail],
                           texelFetch(hc_mask, ivec2(a.x, b.y), 0)[detail],
                           texelFetch(hc_mask, b, 0)[detail]));
}

hc_patch hc_detail_patch(int detail, ivec2 cell)
{
    return hc_through(vec4(hc_detail_texel(detail, cell).a,
                           hc_detail_texel(detail, cell + ivec2(1, 0)).a,
                           hc_detail_texel(detail, cell + ivec2(0, 1)).a,
                           hc_detail_texel(detail, cell + 1).a));
}

float hc_patch_at(hc_patch patch_, vec2 place)
{
    return patch_.base + dot(place, patch_.slope) + place.x * place.y * patch_.twist;
}

/* What is left of details at a distance from the eye: 1 .. 0. */
float hc_details_left(float distance_)
{
    return 1.0 - smoothstep(hc_detail_fade.x, hc_detail_fade.y, distance_);
}

/* ---- at a hit -------------------------------------------------------------------------------- */

/* In cells of the mask, and of a detail. */
vec2 hc_on_ground(vec2 uv)
{
    return uv * hc_steps - hc_zero;
}

vec2 hc_on_detail(int detail, vec2 uv)
{
    vec2 tiles = hc_detail_rate[detail] / vec2(hc_detail_size[detail]) * uv;
    return (tiles - floor(tiles)) * vec2(hc_detail_size[detail]) - 0.5;
}

/* Heights per texel: of the patch, or of central differences between its corners. */
vec2 hc_detail_slopes(int detail, vec2 at)
{
    ivec2 cell = ivec2(floor(at));
    vec2  f    = at - vec2(cell);
    vec2  sum  = vec2(0.0);
    if (hc_detail_flat) {
        hc_patch patch_ = hc_detail_patch(detail, cell);
        return patch_.slope + f.yx * patch_.twist;
    }
    for (int i = 0; i < 4; i++) {
        ivec2 texel  = cell + ivec2(i & 1, i >> 1);
        vec2  weight = mix(1.0 - f, f, vec2(i & 1, i >> 1));
        sum += 0.5 * weight.x * weight.y
               * vec2(hc_detail_texel(detail, texel + ivec2(1, 0)).a
                          - hc_detail_texel(detail, texel - ivec2(1, 0)).a,
                      hc_detail_texel(detail, texel + ivec2(0, 1)).a
                          - hc_detail_texel(detail, texel - ivec2(0, 1)).a);
    }
    return sum;
}

/* To be added to the slopes of the ground, heights per texture unit. */
vec2 hc_details_slopes(vec2 uv, float left)
{
    vec2  ground = hc_on_ground(uv);
    ivec2 cell   = ivec2(floor(ground));
    vec2  f      = ground - vec2(cell);
    vec2  sum    = vec2(0.0);
    for (int i = 0; i < hc_detail_count; i++) {
        vec2     at    = hc_on_detail(i, uv);
        hc_patch mask  = hc_mask_patch(i, cell);
        float    share = hc_patch_at(mask, f);
        float    low   = 1.0 - hc_patch_at(hc_detail_patch(i, ivec2(floor(at))), fract(at));
        sum += left * hc_detail_cut[i]
               * (share * hc_detail_slopes(i, at) * hc_detail_rate[i]
                  - low * (mask.slope + f.yx * mask.twist) * hc_steps);
    }
    return sum;
}

vec3 hc_detail_colour(int detail, vec2 at)
{
    ivec2 cell = ivec2(floor(at));
    vec2  f    = hc_detail_flat ? floor(at - vec2(cell) + 0.5) : at - vec2(cell);
    vec3  top  = mix(hc_detail_texel(detail, cell).rgb,
                     hc_detail_texel(detail, cell + ivec2(1, 0)).rgb, f.x);
    vec3  low  = mix(hc_detail_texel(detail, cell + ivec2(0, 1)).rgb,
                     hc_detail_texel(detail, cell + 1).rgb, f.x);
    return mix(top, low, f.y);
}

/* Laid over that of the ground. Shares that come to more than 1 are as good as 1. top: uv, but of a
 * face between tops a place on that which it is of. */
vec3 hc_details_colour(vec3 colour, vec2 uv, vec2 top, float left)
{
    vec2  ground = hc_on_ground(top);
    ivec2 cell   = ivec2(floor(ground));
    vec3  sum    = vec3(0.0);
    float shares = 0.0;
    for (int i = 0; i < hc_detail_count; i++) {
        if (hc_detail_colours[i]) {
            float share = hc_patch_at(hc_mask_patch(i, cell), ground - vec2(cell));
            vec3  own   = hc_detail_colour(i, hc_on_detail(i, uv));
            sum += share * mix(hc_detail_mean[i], own, left);
            shares += share;
        }
    }
    return colour * (1.0 - min(shares, 1.0)) + sum / max(shares, 1.0);
}
