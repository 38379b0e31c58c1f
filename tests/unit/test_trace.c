/* Tracers: what is refused, what single hits must be, and a property of each published method that
 * can be worked out by hand. */
#include <heightcast/bake.h>
#include <heightcast/trace.h>

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>

#include <cmocka.h>

enum { SIDE = 16 };

/* h = u: a plane up to the border strips, which are level. */
static float plane[SIDE * SIDE];
/* One sample of height 1 on level ground. */
static float spike[SIDE * SIDE];
/* A cone upside down around a sample: |p - q| in texture units, at most 1. */
static float funnel[SIDE * SIDE];

static void fill_fields(void)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float x = (float)(i % SIDE - SIDE / 2) / SIDE;
        const float y = (float)(i / SIDE - SIDE / 2) / SIDE;
        plane[i]      = ((float)(i % SIDE) + 0.5F) / SIDE;
        spike[i]      = i == SIDE * SIDE / 2 + SIDE / 2 ? 1.0F : 0.0F;
        funnel[i]     = sqrtf(x * x + y * y);
    }
}

static hc_field field_of(const float *heights)
{
    return (hc_field){ .heights = heights, .width = SIDE, .height = SIDE };
}

static hc_tracer *make(const hc_field *field, const hc_trace_options *options)
{
    hc_log     log = { .text = "" };
    hc_tracer *tracer;
    if (hc_tracer_create(&tracer, field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    return tracer;
}

static bool fire(const hc_field *field, const hc_trace_options *options, hc_ray ray, hc_hit *hit)
{
    hc_tracer *tracer = make(field, options);
    const bool found  = hc_trace_nearest(tracer, hit, &ray);
    hc_tracer_destroy(tracer);
    return found;
}

static void bake(float *ratios, const hc_field *field, hc_cones cones, hc_method method)
{
    const hc_cone_options options = { .cones = cones, .method = method };
    assert_int_equal(hc_bake_cone_map(ratios, field, &options, NULL), HC_OK);
}

static void refusals_name_the_culprit(void **state)
{
    (void)state;
    static const float ratios[SIDE * SIDE];
    static const struct {
        hc_trace_options options;
        const char      *says;
    } cases[] = {
        { { .method = (hc_trace_method)99 }, "method is 99" },
        { { .method = HC_TRACE_SAFE }, "ratios is NULL" },
        { { .method = HC_TRACE_SAFE, .ratios = ratios, .cones = HC_CONES_L2 }, "cones is l2" },
        { { .method = HC_TRACE_QUICK, .ratios = ratios, .cones = HC_CONES_QUAD }, "cones is quad" },
        { { .method = HC_TRACE_LINEAR, .surface = HC_SURFACE_STEPS }, "surface is steps" },
        { { .surface = (hc_surface)7 }, "surface is 7" },
        { { .placement = { .spacing_x = 1.0 } }, "placement" },
        { { .placement = { 1.0, 1.0, -1.0, { 0.0, 0.0, 0.0 } } }, "scale_z -1" },
        { { .placement = { 1.0, (double)NAN, 1.0, { 0.0, 0.0, 0.0 } } }, "nan" },
        { { .method = HC_TRACE_LINEAR, .steps = 65537 }, "steps is 65537" },
        { { .method = HC_TRACE_RELIEF, .refinements = -3 }, "refinements is -3" },
        { { .threads = -1 }, "threads is -1" },
    };
    const hc_field field = field_of(plane);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        hc_log     log    = { .text = "" };
        hc_tracer *tracer = NULL;
        assert_int_equal(hc_tracer_create(&tracer, &field, &cases[i].options, &log),
                         HC_ERROR_ARGUMENT);
        assert_non_null(strstr(log.text, cases[i].says));
        assert_int_equal(hc_tracer_bytes(&field, &cases[i].options), 0);
    }
    hc_tracer_destroy(NULL);
}

/* The blocks that shaders march over: a top is not below the samples of its block, and level k
 * stands where the map says. */
static void blocks_are_lent(void **state)
{
    (void)state;
    enum { WIDE = 37, HIGH = 5, WORDS_MAX = 512 };
    static float     heights[WIDE * HIGH];
    uint32_t         texels[WORDS_MAX] = { 0 };
    hc_trace_options options           = { .method = HC_TRACE_FAST };
    const hc_field   field             = { .heights = heights, .width = WIDE, .height = HIGH };
    hc_block_map     map;
    hc_tracer       *tracer;
    heights[2 * WIDE + 20] = 0.75F;
    assert_int_equal(hc_tracer_create(&tracer, &field, &options, NULL), HC_OK);
    assert_true(hc_tracer_block_map(tracer, &map, NULL));
    assert_true(map.levels == 2 && map.cells[0] == WIDE + 1 && map.cells[1] == HIGH + 1);
    assert_true(map.first[0] == 1 && map.first[1] == 1 && map.room[1] == 0);
    assert_true(map.width * map.height * 2 <= WORDS_MAX);
    assert_true(hc_tracer_block_map(tracer, &map, texels));
    for (int level = 0; level < map.levels; level++) {
        const int bits  = 2 * level + 1;
        const int left  = map.room[0] - (map.room[0] >> (2 * level));
        const int texel = (3 >> bits) * map.width + left + (21 >> bits);
        float     top;
        memcpy(&top, &texels[2 * texel], sizeof top);
        assert_true(top >= 0.75F && top < 0.76F);
        memcpy(&top, &texels[2 * left], sizeof top);
        assert_true(top >= 0.0F && top < 0.01F);
        assert_true((texels[2 * left + 1] & 255) > (texels[2 * left + 1] >> 24));
    }
    hc_tracer_destroy(tracer);
    options.method = HC_TRACE_MAXMIP;
    assert_int_equal(hc_tracer_create(&tracer, &field, &options, NULL), HC_OK);
    assert_false(hc_tracer_block_map(tracer, &map, NULL));
    hc_tracer_destroy(tracer);
}

/* The pyramid that others may walk: the highest corner of each cell first, 1 x 1 last. */
static void bounds_are_lent(void **state)
{
    (void)state;
    const hc_field   field   = field_of(plane);
    hc_trace_options options = { .method = HC_TRACE_MAXMIP };
    hc_tracer       *tracer;
    assert_int_equal(hc_tracer_create(&tracer, &field, &options, NULL), HC_OK);
    const hc_pyramid *bounds = hc_tracer_bounds(tracer);
    assert_non_null(bounds);
    assert_int_equal(bounds->width, field.width);
    assert_true(bounds->values[0] == fmaxf(plane[1], plane[field.width + 1]));
    const float *last = hc_pyramid_level(bounds, bounds->levels - 1, NULL, NULL);
    assert_true(last[0] == plane[field.width * field.height - 1]);
    hc_tracer_destroy(tracer);
    options.method = HC_TRACE_LINEAR;
    assert_int_equal(hc_tracer_create(&tracer, &field, &options, NULL), HC_OK);
    assert_null(hc_tracer_bounds(tracer));
    hc_tracer_destroy(tracer);
}

static void names_and_needs(void **state)
{
    (void)state;
    assert_int_equal(hc_trace_method_steps(HC_TRACE_CONE_FIXED), 10);
    assert_int_equal(hc_trace_method_steps(HC_TRACE_SAFE), 0);
    assert_int_equal(hc_trace_method_steps((hc_trace_method)99), 0);
    assert_int_equal(hc_trace_method_count(), HC_TRACE_PDM + 1);
    assert_string_equal(hc_trace_method_name(HC_TRACE_CONE_EXACT), "cone-exact");
    assert_string_equal(hc_trace_method_name((hc_trace_method)-1), "unknown");
    assert_int_equal(hc_trace_method_needs(HC_TRACE_RELAXED), HC_NEEDS_RELAXED);
    assert_int_equal(hc_trace_method_needs(HC_TRACE_FAST), HC_NEEDS_NOTHING);
    assert_string_equal(hc_surface_name(HC_SURFACE_STEPS), "steps");
}

/* Down onto the plane h = u at u = 0.4, all three that promise the first hit, and the reference. */
static void a_plane_is_hit_where_it_is(void **state)
{
    (void)state;
    const hc_field field = field_of(plane);
    const hc_ray   ray   = { { 0.2F, 0.5F, 0.6F }, 0.0F, { 0.5F, 0.0F, -0.5F }, INFINITY };
    hc_hit         hit;
    for (int i = 0; i < 2; i++) {
        const hc_trace_method methods[] = { HC_TRACE_FAST, HC_TRACE_MAXMIP };
        assert_true(fire(&field, &(hc_trace_options){ .method = methods[i] }, ray, &hit));
        assert_true(fabs((double)hit.t - 0.4) < 1e-6);
        assert_true(fabs((double)hit.u - 0.4) < 1e-6);
        assert_true(fabs((double)hit.height - 0.4) < 1e-6);
        assert_int_equal(hit.cell_x, 5);
        assert_int_equal(hit.flags, 0);
    }
    assert_true(fabs(hc_reference_trace(&hit, &field, NULL, &ray) - 0.4) < 1e-7);
}

static void normals_of_a_plane_and_of_a_wall(void **state)
{
    (void)state;
    const hc_field field  = field_of(plane);
    hc_tracer     *tracer = make(&field, &(hc_trace_options){ .method = HC_TRACE_MAXMIP });
    const hc_ray   down   = { { 0.4F, 0.5F, 2.0F }, 0.0F, { 0.0F, 0.0F, -1.0F }, INFINITY };
    const hc_ray   wall   = { { 2.0F, 0.5F, 0.5F }, 0.0F, { -1.0F, 0.0F, 0.0F }, INFINITY };
    float          geometric[3], smooth[3];
    hc_hit         hit;
    assert_true(hc_trace_nearest(tracer, &hit, &down));
    hc_trace_normals(tracer, geometric, smooth, &hit);
    for (int i = 0; i < 3; i++) {
        const double wanted[] = { -sqrt(0.5), 0.0, sqrt(0.5) };
        assert_true(fabs((double)geometric[i] - wanted[i]) < 1e-6);
        assert_true(fabs((double)smooth[i] - wanted[i]) < 1e-6);
    }
    assert_true(hc_trace_nearest(tracer, &hit, &wall));
    assert_int_equal(hit.flags, HC_HIT_SIDE);
    assert_true(hit.t == 1.0F && hit.u == 1.0F && hit.cell_x == SIDE - 1);
    hc_trace_normals(tracer, geometric, NULL, &hit);
    assert_true(geometric[0] == 1.0F && geometric[1] == 0.0F && geometric[2] == 0.0F);
    hc_tracer_destroy(tracer);
}

static void profile_of_a_plane(void **state)
{
    (void)state;
    const hc_field         field   = field_of(plane);
    const hc_trace_options options = { .method    = HC_TRACE_MAXMIP,
                                       .placement = { 2.0, 2.0, 10.0, { 1.0, 0.0, 100.0 } } };
    hc_tracer             *tracer  = make(&field, &options);
    const hc_ray           ray     = { { -7.0F, 9.0F, 0.0F }, 0.0F, { 8.0F, 0.0F, 0.0F }, 2.0F };
    float                  heights[3];
    hc_trace_profile(tracer, heights, 3, &ray);
    assert_true(isnan(heights[0])); /* x = -7 is 4 samples before the first */
    assert_true(fabs((double)heights[1] - (100.0 + 10.0 * 0.5 / SIDE)) < 1e-5);
    assert_true(fabs((double)heights[2] - (100.0 + 10.0 * 4.5 / SIDE)) < 1e-5);
    hc_tracer_destroy(tracer);
}

/* Rays in the very walls of the box belong to the field. */
static void border_rays_hit(void **state)
{
    (void)state;
    const hc_field field = field_of(plane);
    for (int i = 0; i < 4; i++) {
        const hc_ray ray = {
            { (float)(i % 2), (float)(i / 2), 2.0F }, 0.0F, { 0.0F, 0.0F, -1.0F }, INFINITY
        };
        hc_hit hit;
        assert_true(fire(&field, &(hc_trace_options){ .method = HC_TRACE_MAXMIP }, ray, &hit));
        assert_true(hit.height == plane[i % 2 == 0 ? 0 : SIDE - 1]);
        assert_true(hc_reference_trace(&hit, &field, NULL, &ray) == (double)hit.t);
    }
}

/* ---- published methods ---------------------------------------------------------------------- */

/* Straight down from 1 to 0 in 8 steps: the first one at or below 0.4 is the fifth, at 3/8. */
static void linear_finds_the_first_step_below(void **state)
{
    (void)state;
    const hc_field         field   = field_of(plane);
    const hc_trace_options options = { .method = HC_TRACE_LINEAR, .steps = 8 };
    const hc_ray           ray     = { { 0.4F, 0.5F, 1.0F }, 0.0F, { 0.0F, 0.0F, -1.0F }, 1.0F };
    hc_hit                 hit;
    assert_true(fire(&field, &options, ray, &hit));
    assert_true(hit.t == 0.625F);
    assert_int_equal(hit.steps, 5);
}

static void bisection_and_secant_refine(void **state)
{
    (void)state;
    const hc_field   field   = field_of(plane);
    hc_trace_options options = { .method = HC_TRACE_RELIEF, .steps = 8, .refinements = 3 };
    const hc_ray     ray     = { { 0.4F, 0.5F, 1.0F }, 0.0F, { 0.0F, 0.0F, -1.0F }, 1.0F };
    hc_hit           hit;
    /* 0.6 in the bracket 1/2 .. 5/8, in 64ths 32 .. 40: 36 is above, 38 above, 39 below */
    assert_true(fire(&field, &options, ray, &hit));
    assert_true(hit.t == 39.0F / 64.0F);
    options.method = HC_TRACE_OCCLUSION;
    assert_true(fire(&field, &options, ray, &hit)); /* on a plane the secant is exact */
    assert_true(fabs((double)hit.t - 0.6) < 1e-7);
}

/* From (0.25, 1) with the gap 0.75 over the plane, along (3, -4) / 5: 0.75 * 3 / 5 further on. */
static void parallax_is_limited_to_the_depth(void **state)
{
    (void)state;
    const hc_field field = field_of(plane);
    const hc_ray   ray   = { { 0.25F, 0.5F, 1.0F }, 0.0F, { 3.0F, 0.0F, -4.0F }, INFINITY };
    hc_hit         hit;
    assert_false(fire(&field, &(hc_trace_options){ .method = HC_TRACE_PARALLAX },
                      (hc_ray){ { 0.25F, 0.5F, 0.9F }, 0.0F, { 3.0F, 0.0F, 4.0F }, INFINITY },
                      &hit));
    assert_true(fire(&field, &(hc_trace_options){ .method = HC_TRACE_PARALLAX }, ray, &hit));
    assert_true(fabs((double)hit.t - 0.75 / 5.0) < 1e-6);
    assert_true(fabs((double)hit.u - (0.25 + 0.75 * 0.6)) < 1e-6);
}

/* Over level ground cones are cut off at ratio 1: along (1, -1) each step takes half the gap. */
static void cone_steps_halve_the_gap_on_a_diagonal(void **state)
{
    (void)state;
    static float          level[SIDE * SIDE], ratios[SIDE * SIDE];
    const hc_field        field   = field_of(level);
    const hc_cone_options cut     = { .cones = HC_CONES_L2, .max_ratio = 1.0F };
    hc_trace_options      options = { .method = HC_TRACE_CONE_FIXED, .ratios = ratios, .steps = 3 };
    const hc_ray          ray     = { { 0.0F, 0.5F, 1.0F }, 0.0F, { 1.0F, 0.0F, -1.0F }, INFINITY };
    hc_hit                hit;
    assert_int_equal(hc_bake_cone_map(ratios, &field, &cut, NULL), HC_OK);
    assert_true(fire(&field, &options, ray, &hit));
    assert_true(hit.t == 0.875F && hit.flags == HC_HIT_UNCONVERGED);
    options.steps  = 0;
    options.method = HC_TRACE_CONE_LOOP;
    assert_true(fire(&field, &options, ray, &hit));
    assert_true(fabsf(hit.t - 1.0F) < 1e-6F && hit.flags == 0);
    options.method = HC_TRACE_CONE_EXACT; /* pierces the surface, and steps a texel back */
    assert_true(fire(&field, &options, ray, &hit));
    assert_int_equal(hit.flags, 0);
    assert_true(fabsf(hit.t - 1.0F) <= 1.0F / SIDE);
}

/* From above the funnel's tip, whose cone has ratio 1, along its side: one step goes all the way */
static void a_cone_is_crossed_in_one_step(void **state)
{
    (void)state;
    static float     ratios[SIDE * SIDE];
    const hc_field   field   = field_of(funnel);
    hc_trace_options options = { .method = HC_TRACE_CONE_FIXED, .ratios = ratios, .steps = 1 };
    const hc_ray     ray     = {
                { 8.5F / SIDE, 8.5F / SIDE, 0.25F }, 0.0F, { 1.0F, 0.0F, 0.0F }, INFINITY
    };
    hc_hit hit;
    bake(ratios, &field, HC_CONES_L2, HC_METHOD_EXACT);
    assert_true(fire(&field, &options, ray, &hit));
    assert_true(fabsf(hit.t - 0.25F) < 1e-5F);
}

static int hits_of_spike(const hc_field *field, const hc_trace_options *options, int rays)
{
    int count = 0;
    for (int i = 0; i < rays; i++) {
        const float  v   = 8.5F / SIDE + ((float)i / (float)rays - 0.5F) * 0.8F / SIDE;
        const hc_ray ray = { { 0.01F, v, 0.7F }, 0.0F, { 1.0F, 0.0F, -0.05F }, 0.95F };
        hc_hit       hit;
        count += fire(field, options, ray, &hit) ? 1 : 0;
    }
    return count;
}

/* Level rays past the middle of a spike that is two samples wide at its foot: few equal steps jump
 * over it; what promises the first hit finds exactly what the reference finds. */
static void thin_spikes_are_lost_by_steps_and_by_nothing_else(void **state)
{
    (void)state;
    enum { RAYS = 64 };
    static float   ratios[SIDE * SIDE], cells[SIDE * SIDE];
    const hc_field field = field_of(spike);
    int            truth = 0;
    for (int i = 0; i < RAYS; i++) {
        const float  v   = 8.5F / SIDE + ((float)i / RAYS - 0.5F) * 0.8F / SIDE;
        const hc_ray ray = { { 0.01F, v, 0.7F }, 0.0F, { 1.0F, 0.0F, -0.05F }, 0.95F };
        hc_hit       hit;
        truth += hc_reference_trace(&hit, &field, NULL, &ray) < INFINITY ? 1 : 0;
    }
    bake(ratios, &field, HC_CONES_L1, HC_METHOD_EXACT);
    hc_bake_cell_ratios(cells, ratios, SIDE, SIDE, HC_CONES_L1, HC_WRAP_NONE);
    const hc_trace_options safe = { .method = HC_TRACE_SAFE,
                                    .ratios = cells,
                                    .cones  = HC_CONES_L1 };
    assert_true(truth > RAYS / 4 && truth < RAYS);
    assert_int_equal(hits_of_spike(&field, &safe, RAYS), truth);
    assert_int_equal(hits_of_spike(&field, &(hc_trace_options){ .method = HC_TRACE_MAXMIP }, RAYS),
                     truth);
    const hc_trace_options linear = { .method = HC_TRACE_LINEAR, .steps = 16 };
    assert_true(hits_of_spike(&field, &linear, RAYS) < truth);
}

static void fan_of_rays(hc_ray *rays, int count)
{
    for (int i = 0; i < count; i++) {
        const float angle = 10.0F * (float)i / (float)count;
        rays[i]           = (hc_ray){ .origin    = { 0.5F, 0.5F, 0.3F },
                                      .direction = { 1.0F - angle, angle - 3.0F, 9.0F - angle },
                                      .tmax      = INFINITY };
    }
}

static void batches_are_the_same_for_all_threads(void **state)
{
    (void)state;
    enum { RAYS = 10000 };
    static hc_ray  rays[RAYS];
    static hc_hit  one[RAYS], three[RAYS];
    static uint8_t any[RAYS];
    const hc_field field  = field_of(funnel);
    hc_tracer     *tracer = make(&field, &(hc_trace_options){ .method = HC_TRACE_MAXMIP });
    fan_of_rays(rays, RAYS);
    assert_int_equal(hc_trace_batch(tracer, one, rays, RAYS, 1, (hc_progress){ NULL, NULL }, NULL),
                     HC_OK);
    assert_int_equal(
        hc_trace_batch(tracer, three, rays, RAYS, 3, (hc_progress){ NULL, NULL }, NULL), HC_OK);
    assert_memory_equal(one, three, sizeof one);
    assert_int_equal(
        hc_trace_any_batch(tracer, any, rays, RAYS, 2, (hc_progress){ NULL, NULL }, NULL), HC_OK);
    for (int i = 0; i < RAYS; i++) {
        assert_int_equal(any[i], one[i].t < INFINITY);
    }
    hc_tracer_destroy(tracer);
}

static bool refuse_to_go_on(void *user, double fraction)
{
    (void)user;
    (void)fraction;
    return false;
}

static void reference_batches_are_the_reference(void **state)
{
    (void)state;
    enum { RAYS = 1000 };
    static hc_ray              rays[RAYS];
    static hc_hit              hits[RAYS];
    static double              exact[RAYS];
    const hc_progress          none   = { NULL, NULL };
    const hc_field             field  = field_of(funnel);
    int                        found  = 0;
    hc_log                     log    = { .text = "" };
    const hc_reference_options raised = { .rise = 0.01 };
    fan_of_rays(rays, RAYS);
    assert_int_equal(hc_reference_batch(hits, NULL, &field, &raised, rays, RAYS, 3, none, &log),
                     HC_OK);
    assert_int_equal(hc_reference_batch(NULL, exact, &field, &raised, rays, RAYS, 1, none, &log),
                     HC_OK);
    for (int i = 0; i < RAYS; i++) {
        hc_hit hit;
        assert_true(hc_reference_trace(&hit, &field, &raised, &rays[i]) == exact[i]);
        assert_memory_equal(&hit, &hits[i], sizeof hit);
        found += exact[i] < INFINITY ? 1 : 0;
    }
    assert_true(found > RAYS / 10 && found < RAYS);
    const hc_progress refuse = { refuse_to_go_on, NULL };
    assert_int_equal(hc_reference_batch(hits, NULL, &field, NULL, rays, RAYS, 1, refuse, &log),
                     HC_ERROR_CANCELLED);
}

/* Each component in turn is what no ray has. */
static void what_is_no_ray_misses(void **state)
{
    (void)state;
    static const float height = 0.5F;
    const hc_field     field  = { .heights = &height, .width = 1, .height = 1 };
    const float        bad[]  = { NAN, INFINITY, -INFINITY };
    const hc_ray       good   = { { 0.5F, 0.5F, 1.0F }, 0.0F, { 0.0F, 0.0F, -1.0F }, INFINITY };
    hc_tracer         *tracer;
    hc_hit             hit;
    assert_int_equal(hc_tracer_create(&tracer, &field, NULL, NULL), HC_OK);
    assert_true(hc_trace_nearest(tracer, &hit, &good));
    assert_true(hit.t == 0.5F);
    for (int i = 0; i < 3 * 7; i++) {
        const int k    = i % 7;
        hc_ray    ray  = good;
        float    *part = k == 6 ? &ray.tmin : k < 3 ? &ray.origin[k] : &ray.direction[k - 3];
        *part          = bad[i / 7];
        assert_false(hc_trace_nearest(tracer, &hit, &ray));
        assert_true(isinf(hit.t));
    }
    hc_ray none       = good;
    none.direction[2] = 0.0F;
    assert_false(hc_trace_any(tracer, &none));
    hc_ray backwards = good;
    backwards.tmax   = -1.0F;
    assert_false(hc_trace_any(tracer, &backwards));
    hc_tracer_destroy(tracer);
}

/* On sparse ground, past the edge of a plateau by a hair, and out of the field before they come
 * down: whoever sees them behind the edge sees them below the plateau. */
static void rays_past_an_edge_hit_nothing(void **state)
{
    enum { WIDE = 32, RAYS = 64 };
    static float heights[WIDE * WIDE];
    hc_field     field = { .heights = heights, .width = WIDE, .height = WIDE };
    hc_ray       rays[RAYS];
    uint8_t      any[RAYS];
    (void)state;
    for (int y = 10; y <= 20; y++) {
        heights[y * WIDE + 26] = 0.9F;
        heights[y * WIDE + 27] = 0.9F;
        heights[y * WIDE + 28] = 0.9F;
    }
    heights[5 * WIDE + 5] = 1.0F;
    for (int i = 0; i < RAYS; i++) { /* level with the edge at column 28, and 10^-7 higher each */
        const float row  = (float)(14.5 + 0.07 * i);
        const float high = (float)(0.9 + 0.25 * 1.4 + 1e-7 * (i + 1));
        rays[i]          = (hc_ray){ .origin    = { 27.1F / WIDE, row / WIDE, high },
                                     .direction = { 1.0F / WIDE, 0.0F, -0.25F },
                                     .tmax      = INFINITY };
    }
    hc_tracer *tracer = make(&field, &(hc_trace_options){ .method = HC_TRACE_FAST });
    hc_trace_any_many(tracer, any, rays, RAYS);
    for (int i = 0; i < RAYS; i++) {
        hc_hit     hit;
        const bool found = hc_trace_nearest(tracer, &hit, &rays[i]);
        assert_int_equal(any[i], found);
        assert_int_equal(hc_trace_any(tracer, &rays[i]), found);
        assert_false(found && i >= 10); /* floats of heights are 10^-7 apart */
    }
    hc_tracer_destroy(tracer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refusals_name_the_culprit),
        cmocka_unit_test(bounds_are_lent),
        cmocka_unit_test(blocks_are_lent),
        cmocka_unit_test(names_and_needs),
        cmocka_unit_test(a_plane_is_hit_where_it_is),
        cmocka_unit_test(normals_of_a_plane_and_of_a_wall),
        cmocka_unit_test(profile_of_a_plane),
        cmocka_unit_test(border_rays_hit),
        cmocka_unit_test(linear_finds_the_first_step_below),
        cmocka_unit_test(bisection_and_secant_refine),
        cmocka_unit_test(parallax_is_limited_to_the_depth),
        cmocka_unit_test(cone_steps_halve_the_gap_on_a_diagonal),
        cmocka_unit_test(a_cone_is_crossed_in_one_step),
        cmocka_unit_test(thin_spikes_are_lost_by_steps_and_by_nothing_else),
        cmocka_unit_test(batches_are_the_same_for_all_threads),
        cmocka_unit_test(reference_batches_are_the_reference),
        cmocka_unit_test(what_is_no_ray_misses),
        cmocka_unit_test(rays_past_an_edge_hit_nothing),
    };
    fill_fields();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
