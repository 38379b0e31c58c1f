/* What docs/algorithms.md proves, tried on stored maps: with c the least ratio of the four corners
 * of x's cell, the bilinear surface never enters the cone at x,
 *   S(y) - S(x) <= (|du| + |dv|) / c(x)   for all x and y,
 * for diamonds, quadrants and pairs of slopes. And what it disproves: round cones are entered. */
#include "support.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Heights near 1 come out of the bilinear formula with an error of a few 2^-53. */
#define SURFACE_NOISE 0x1p-49

/* A map with its heights decoded, as a caster would have it. */
typedef struct stored {
    hc_map      map;
    hc_field    field; /* the heights that the map was made from */
    float      *heights;
    float      *ratios; /* as hc_bake_cone_map has them */
    int         channels;
    const char *kind;
} stored;

static void decode(stored *s, const hc_field *field)
{
    const int width = field->width;
    s->channels     = hc_cones_channels(s->map.info.cones);
    s->heights      = malloc(sizeof(float) * (size_t)width * (size_t)field->height);
    s->ratios       = malloc(sizeof(float) * agree_count(field, s->map.info.cones));
    for (int y = 0; y < field->height; y++) {
        for (int x = 0; x < width; x++) {
            const float height        = hc_map_height_at(&s->map, x, y);
            s->heights[y * width + x] = isnan(height) ? field->heights[y * width + x] : height;
            for (int c = 0; c < s->channels; c++) {
                s->ratios[(y * width + x) * s->channels + c] = hc_map_ratio_at(&s->map, x, y, c);
            }
        }
    }
    s->field         = *field;
    s->field.heights = s->heights;
}

static stored bake(const hc_field *field, const char *kind, hc_cones cones, int bits)
{
    const hc_map_options options = { .kind = HC_MAP_CONE,
                                     .bits = bits,
                                     .cone = { .cones = cones } };
    hc_log               log     = { .text = "" };
    stored               s       = { .kind = kind };
    if (hc_map_info_for(&s.map.info, field, &options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    s.map.texels = malloc(hc_map_bytes(&s.map.info));
    if (hc_bake_map(&s.map, field, &options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    decode(&s, field);
    return s;
}

static void drop(stored *s)
{
    free(s->map.texels);
    free(s->heights);
    free(s->ratios);
}

/* Slopes of channel `c` in the cell that owns (u, v): what a caster may rely on. Ratio 0 promises
 * nothing: false. */
static bool cell_slope(const stored *s, int c, double u, double v, double *slope)
{
    int x;
    int y;
    hc_ref_cell_at(&s->field, u, v, &x, &y);
    const float ratio = hc_ref_cell_extreme(s->ratios, s->channels, c, s->field.width,
                                            s->field.height, s->field.wrap, x, y, HC_REF_MINIMUM);
    *slope            = 1.0 / (double)ratio;
    return ratio > 0.0F;
}

/* Excess of the surface over the cones of channel `c` at (u, v); 0 where nothing is promised. */
static double excess_at(const stored *s, int c, double u, double v)
{
    double slope_u;
    double slope_v;
    if (s->map.info.cones == HC_CONES_QUAD) {
        return cell_slope(s, c, u, v, &slope_u)
                   ? hc_ref_surface_excess(&s->field, c + 1, slope_u, slope_u, u, v)
                   : 0.0;
    }
    if (s->map.info.cones == HC_CONES_ANISO && c == 0) {
        return cell_slope(s, 0, u, v, &slope_u) && cell_slope(s, 1, u, v, &slope_v)
                   ? hc_ref_surface_excess(&s->field, 0, slope_u, slope_v, u, v)
                   : 0.0;
    }
    return cell_slope(s, c, u, v, &slope_u)
               ? hc_ref_surface_excess(&s->field, 0, slope_u, slope_u, u, v)
               : 0.0;
}

/* Channels that stand for a cone of their own; aniso's second belongs to its first. */
static bool starts_cone(const stored *s, int c)
{
    return !(s->map.info.cones == HC_CONES_ANISO && c == 1);
}

/* Positions anywhere, on samples, on grid lines, in the border strips and beyond. */
static double random_coordinate(double first, double step, int size, uint64_t *random)
{
    switch (agree_range(random, 0, 3)) {
    case 0: return first + step * agree_range(random, 0, size - 1);
    case 1: return agree_uniform(random) * 1.2 - 0.1;
    default: return agree_uniform(random);
    }
}

static void check_positions(const stored *s, int positions, uint64_t *random)
{
    const hc_field *f      = &s->field;
    const double    step_u = hc_field_step_u(f);
    const double    step_v = hc_field_step_v(f);
    const double    first  = f->registration == HC_GRID ? 0.0 : 0.5;
    for (int i = 0; i < positions; i++) {
        const double u = random_coordinate(first * step_u, step_u, f->width, random);
        const double v = random_coordinate(first * step_v, step_v, f->height, random);
        for (int c = 0; c < s->channels; c++) {
            const double excess = starts_cone(s, c) ? excess_at(s, c, u, v) : 0.0;
            if (!(excess <= SURFACE_NOISE)) {
                fail_msg(
                    "%s, %s cones, %d bits: the surface is %.3g inside cone %d at (%.17g, %.17g)",
                    agree_describe(s->kind, f), hc_cones_name(s->map.info.cones), s->map.info.bits,
                    excess, c, u, v);
            }
        }
    }
}

static void check_cones(hc_cones cones)
{
    static const int bits[] = { 8, 16, 32 };
    uint64_t         random = 11;
    for (int i = 0; i < agree_field_count(&agree_small); i += AGREE_STRIDE) {
        hc_field field = agree_field(&agree_small, i);
        stored   s     = bake(&field, agree_kind_of(i), cones, bits[i % 3]);
        check_positions(&s, 12, &random);
        drop(&s);
        agree_free(&field);
    }
}

static void surface_stays_out_of_diamonds(void **state)
{
    (void)state;
    check_cones(HC_CONES_L1);
}

static void surface_stays_out_of_quadrants(void **state)
{
    (void)state;
    check_cones(HC_CONES_QUAD);
}

static void surface_stays_out_of_two_slope_cones(void **state)
{
    (void)state;
    check_cones(HC_CONES_ANISO);
}

static void made_fields_and_elevations_stay_out(void **state)
{
    (void)state;
    static const hc_cones cones[] = { HC_CONES_L1, HC_CONES_QUAD, HC_CONES_ANISO };
    uint64_t              random  = 12;
    for (int i = 0; i <= hc_synth_count(); i++) {
        const char *name  = i < hc_synth_count() ? hc_synth_name(i) : "dem";
        hc_field    field = agree_named_field(name, 48, 37, 3, (hc_wrap)(i % 4));
        stored      s     = bake(&field, name, cones[i % 3], 8 << i % 3);
        check_positions(&s, 60, &random);
        drop(&s);
        agree_free(&field);
    }
}

/* The check must be able to fail: cones wider by a tenth are entered on nearly any field. */
static void the_check_sees_cones_that_are_too_wide(void **state)
{
    (void)state;
    hc_field field   = agree_make_field((agree_shape){ 16, 15 }, 2, 5, HC_WRAP_U, HC_TEXEL);
    stored   s       = bake(&field, "noise", HC_CONES_L1, 32);
    int      entered = 0;
    for (int i = 0; i < 16 * 15; i++) {
        s.ratios[i] *= 1.1F;
    }
    for (int y = 0; y < 15; y++) {
        for (int x = 0; x < 16; x++) {
            entered += excess_at(&s, 0, (x + 0.5) / 16, (y + 0.5) / 15) > SURFACE_NOISE ? 1 : 0;
        }
    }
    assert_true(entered > 10);
    drop(&s);
    agree_free(&field);
}

/* Largest factor by which the surface exceeds the round cone of ratio `ratio` at (u, v), tried at
 * `tries` random places up to two samples away. */
static double round_factor(const hc_field *field, double ratio, double u, double v, int tries,
                           uint64_t *random)
{
    double factor = 0.0;
    for (int i = 0; i < tries; i++) {
        const double du   = (agree_uniform(random) - 0.5) * 4.0 * hc_field_step_u(field);
        const double dv   = (agree_uniform(random) - 0.5) * 4.0 * hc_field_step_v(field);
        const double rise = hc_ref_surface(field, u + du, v + dv) - hc_ref_surface(field, u, v);
        factor            = fmax(factor, rise * ratio / sqrt(du * du + dv * dv));
    }
    return factor;
}

/* Worked example of section 4.5: at the tip of a funnel the surface exceeds its exact round cone
 * by almost sqrt 2. */
static void round_cones_are_entered_at_a_funnel(void **state)
{
    (void)state;
    hc_field field  = agree_make_field((agree_shape){ 16, 16 }, 0, 0, HC_WRAP_NONE, HC_TEXEL);
    float   *height = (float *)(uintptr_t)field.heights;
    for (int i = 0; i < 256; i++) {
        const float x = (float)(i % 16 - 8) / 16.0F;
        const float y = (float)(i / 16 - 8) / 16.0F;
        height[i]     = sqrtf(x * x + y * y);
    }
    stored       s      = bake(&field, "funnel", HC_CONES_L2, 32);
    uint64_t     random = 13;
    const double own    = (double)s.ratios[8 * 16 + 8];
    const double factor = round_factor(&field, own, 8.5 / 16, 8.5 / 16, 20000, &random);
    assert_true(factor > 1.38 && factor < sqrt(2.0));
    drop(&s);
    agree_free(&field);
}

/* Nor does the minimum over the cell mend it. */
static void round_cones_are_entered_in_spite_of_the_cell_minimum(void **state)
{
    (void)state;
    hc_field field   = agree_make_field((agree_shape){ 16, 15 }, 2, 5, HC_WRAP_UV, HC_TEXEL);
    stored   s       = bake(&field, "noise", HC_CONES_L2, 32);
    uint64_t random  = 14;
    int      entered = 0;
    double   widest  = 0.0;
    for (int i = 0; i < 400; i++) {
        const double u = agree_uniform(&random);
        const double v = agree_uniform(&random);
        double       slope;
        assert_true(cell_slope(&s, 0, u, v, &slope));
        const double factor = round_factor(&s.field, 1.0 / slope, u, v, 500, &random);
        entered += factor > 1.0 + 0x1p-20 ? 1 : 0;
        widest = fmax(widest, factor);
    }
    assert_true(entered > 0);
    assert_true(widest > 1.05);
    drop(&s);
    agree_free(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surface_stays_out_of_diamonds),
        cmocka_unit_test(surface_stays_out_of_quadrants),
        cmocka_unit_test(surface_stays_out_of_two_slope_cones),
        cmocka_unit_test(made_fields_and_elevations_stay_out),
        cmocka_unit_test(the_check_sees_cones_that_are_too_wide),
        cmocka_unit_test(round_cones_are_entered_at_a_funnel),
        cmocka_unit_test(round_cones_are_entered_in_spite_of_the_cell_minimum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
