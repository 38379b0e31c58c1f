/* quick, relaxed, robust, qdm and pdm on fields where the answer can be worked out on paper. */
#include <heightcast/bake.h>
#include <heightcast/trace.h>

#include <math.h>
#include <stdarg.h>
#include <stddef.h>

#include <setjmp.h>

#include <cmocka.h>

enum { SIDE = 16 };

static float plane[SIDE * SIDE];  /* h = u between the border strips                      */
static float steep[SIDE * SIDE];  /* h = 2 u, at most 1                                   */
static float step[SIDE * SIDE];   /* 0 up to sample 7, 1 from sample 8: a ramp about 1/2  */
static float spike[SIDE * SIDE];  /* sample (8, 8) is 1, all others are 0                 */
static float ones[SIDE * SIDE];   /* ratios: wider than those of steep, step and spike    */
static float ratios[SIDE * SIDE]; /* of the present test */

static void fill_fields(void)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE;
        plane[i]    = ((float)x + 0.5F) / SIDE;
        steep[i]    = fminf(2.0F * plane[i], 1.0F);
        step[i]     = x < 8 ? 0.0F : 1.0F;
        spike[i]    = x == 8 && i / SIDE == 8 ? 1.0F : 0.0F;
        ones[i]     = 1.0F;
    }
}

static hc_field field_of(const float *heights)
{
    return (hc_field){ .heights = heights, .width = SIDE, .height = SIDE };
}

static bool fire(const float *heights, const hc_trace_options *options, hc_ray ray, hc_hit *hit)
{
    const hc_field field = field_of(heights);
    hc_tracer     *tracer;
    assert_int_equal(hc_tracer_create(&tracer, &field, options, NULL), HC_OK);
    const bool found = hc_trace_nearest(tracer, hit, &ray);
    hc_tracer_destroy(tracer);
    return found;
}

static void bake(const float *heights, hc_method method)
{
    const hc_field        field   = field_of(heights);
    const hc_cone_options options = { .cones = HC_CONES_L2, .method = method };
    assert_int_equal(hc_bake_cone_map(ratios, &field, &options, NULL), HC_OK);
}

static void expect_near(double found, double expected, double error)
{
    if (!(fabs(found - expected) <= error)) {
        fail_msg("%.9g instead of %.9g", found, expected);
    }
}

static hc_ray ray_at(float u, float v, float z, float du, float dv, float dz)
{
    return (hc_ray){ { u, v, z }, 0.0F, { du, dv, dz }, INFINITY };
}

/* ---- quick ---------------------------------------------------------------------------------- */

/* The cone of h = u has ratio 1. Across the slope, along (0, 1, -1), it takes half of the gap. */
static void quick_halves_the_gap_across_a_slope(void **state)
{
    (void)state;
    hc_trace_options options = { .method = HC_TRACE_QUICK, .ratios = ratios, .steps = 4 };
    const hc_ray     ray     = ray_at(0.25F, 0.1F, 0.5F, 0.0F, 0.5F, -0.5F);
    hc_hit           hit;
    bake(plane, HC_METHOD_EXACT);
    assert_true(fire(plane, &options, ray, &hit));
    expect_near((double)hit.t, 0.5 * (1.0 - 1.0 / 16.0), 1e-6);
    assert_int_equal(hit.flags, HC_HIT_UNCONVERGED); /* the gap is 1/64 */
    assert_int_equal(hit.steps, 4);
    options.steps = 7;
    assert_true(fire(plane, &options, ray, &hit));
    expect_near((double)hit.t, 0.5 * (1.0 - 1.0 / 128.0), 1e-6);
    assert_int_equal(hit.flags, 0); /* 1/512: within a code of 8 bits */
}

/* On h = 2 u a cone of ratio 1 is too wide: from the gap 1/2, along (1, 0, -1) / 2, one step is 1/2
 * long, the gap is then -1/4, and the root was at 1/3. */
static void quick_refines_a_bracket(void **state)
{
    (void)state;
    hc_trace_options options = { .method = HC_TRACE_QUICK, .ratios = ones, .refinements = -1 };
    const hc_ray     ray     = ray_at(0.125F, 0.5F, 0.75F, 0.5F, 0.0F, -0.5F);
    hc_hit           hit;
    assert_true(fire(steep, &options, ray, &hit));
    expect_near((double)hit.t, 1.0 / 3.0, 1e-7);
    expect_near((double)hit.height, 7.0 / 12.0, 1e-7);
    assert_int_equal(hit.steps, 2);
    options.refinements = 3; /* eighths of 1/2: 4 and 5 are above, 6 is below */
    assert_true(fire(steep, &options, ray, &hit));
    assert_true(hit.t == 0.375F);
    assert_int_equal(hit.steps, 4);
    options.refinements = -2;
    assert_true(fire(steep, &options, ray, &hit));
    assert_true(hit.t == 0.5F);
    assert_int_equal(hit.steps, 1);
}

/* The last of equal steps is at tmax, and a hit there counts. */
static void linear_reaches_tmax(void **state)
{
    (void)state;
    const hc_trace_options options = { .method = HC_TRACE_LINEAR, .steps = 3 };
    hc_ray                 ray     = ray_at(0.75F, 0.5F, 1.5F, 0.0F, 0.0F, -0.5F);
    hc_hit                 hit;
    ray.tmax = 1.0F; /* at height 1, where steep is level */
    assert_true(fire(steep, &options, ray, &hit));
    assert_true(hit.t == 1.0F);
    ray.origin[2] = 1.0F;
    ray.origin[0] = 0.40625F; /* sample 6: height 13/16 */
    ray.tmax      = 0.375F;
    assert_true(fire(steep, &options, ray, &hit));
    assert_true(hit.t == 0.375F);
    assert_int_equal(hit.steps, 3);
    ray.tmax = 0.37F;
    assert_false(fire(steep, &options, ray, &hit));
}

/* ---- relaxed -------------------------------------------------------------------------------- */

/* A ray that goes into the step does not come out of it, so no relaxed cone is limited by it: from
 * 0.1 at half height, level, one step of 1/2 goes in. The ramp is at that height at 0.5, t = 0.4,
 * and of the 64 parts that six bisections tell apart 52 are the first that are inside. */
static void relaxed_goes_into_a_step_and_back(void **state)
{
    (void)state;
    hc_trace_options options = { .method = HC_TRACE_RELAXED, .ratios = ratios };
    const hc_ray     ray     = ray_at(0.1F, 0.5F, 0.5F, 1.0F, 0.0F, 0.0F);
    hc_hit           hit;
    bake(step, HC_METHOD_FALLING_EDGE);
    assert_true(fire(step, &options, ray, &hit));
    expect_near((double)hit.t, 0.5 * 52.0 / 64.0, 1e-6);
    assert_int_equal(hit.steps, 1 + 6);
    bake(step, HC_METHOD_EXACT);
    options.method = HC_TRACE_QUICK; /* the cone of what rises ahead is narrower than 1/2 */
    assert_true(fire(step, &options, ray, &hit));
    assert_true(hit.steps > 1 + 6);
}

/* The back of a single tower falls: a cone is limited by it, and no ray jumps over. */
static void relaxed_stops_at_a_tower(void **state)
{
    (void)state;
    const hc_trace_options options = { .method = HC_TRACE_RELAXED, .ratios = ratios };
    const hc_ray           ray     = ray_at(0.1F, 8.5F / SIDE, 0.5F, 1.0F, 0.0F, 0.0F);
    hc_hit                 hit;
    bake(spike, HC_METHOD_FALLING_EDGE);
    assert_true(fire(spike, &options, ray, &hit)); /* half way up, half a sample before its top */
    expect_near((double)hit.u, 8.0 / SIDE, 0.01);
}

/* ---- robust --------------------------------------------------------------------------------- */

static void robust_goes_straight_down(void **state)
{
    (void)state;
    const hc_trace_options options = { .method = HC_TRACE_ROBUST, .ratios = ratios };
    const hc_ray           ray     = ray_at(0.4F, 0.5F, 1.0F, 0.0F, 0.0F, -1.0F);
    hc_hit                 hit;
    bake(plane, HC_METHOD_EXACT);
    assert_true(fire(plane, &options, ray, &hit));
    expect_near((double)hit.t, 0.6, 1e-7);
    assert_int_equal(hit.flags, 0);
}

/* Along (1, 0, -64) / 64 the next wall is under the floor. The bracket is 0 .. 0.9 then. */
static void robust_comes_back_from_a_far_wall(void **state)
{
    (void)state;
    hc_trace_options options = { .method = HC_TRACE_ROBUST, .ratios = ratios, .refinements = -1 };
    const hc_ray     ray     = ray_at(0.42F, 0.5F, 0.9F, 1.0F / 64.0F, 0.0F, -1.0F);
    const double     truth   = 0.48 * 64.0 / 65.0;
    hc_hit           hit;
    bake(plane, HC_METHOD_EXACT);
    assert_true(fire(plane, &options, ray, &hit));
    expect_near((double)hit.t, truth, 1e-6);
    assert_int_equal(hit.steps, 2);
    options.refinements = 6;
    assert_true(fire(plane, &options, ray, &hit));
    expect_near((double)hit.t, 0.9 / 64.0 * ceil(truth * 64.0 / 0.9), 1e-6);
}

/* Across the patch beside the tower, h = (1 - x)(1 - y), on its diagonal x + y = 1: 0 at both
 * walls, 1/4 between them, so a level ray at 1/5 goes in and out of it, first at
 * x = (1 - sqrt(1/5)) / 2. */
static void robust_loses_what_lies_between_two_walls(void **state)
{
    (void)state;
    const hc_trace_options robust = { .method = HC_TRACE_ROBUST, .ratios = ratios };
    const hc_trace_options maxmip = { .method = HC_TRACE_MAXMIP };
    const float            u      = 8.0F / SIDE; /* half a sample before sample 8 */
    const float            v      = 10.0F / SIDE;
    const hc_ray           ray    = ray_at(u, v, 0.2F, 1.0F / SIDE, -1.0F / SIDE, 0.0F);
    hc_hit                 hit;
    bake(spike, HC_METHOD_EXACT);
    assert_true(fire(spike, &maxmip, ray, &hit));
    expect_near((double)hit.t, 0.5 + (1.0 - sqrt(0.2)) / 2.0, 1e-6);
    assert_false(fire(spike, &robust, ray, &hit));
}

/* ---- qdm ------------------------------------------------------------------------------------ */

/* Every sample is a flat top, as wide as the samples are apart. */
static void qdm_meets_the_tops_of_a_plane(void **state)
{
    (void)state;
    const hc_trace_options options = { .method = HC_TRACE_QDM };
    hc_hit                 hit;
    assert_true(fire(plane, &options, ray_at(0.4F, 0.5F, 1.0F, 0.0F, 0.0F, -1.0F), &hit));
    assert_true(hit.height == 6.5F / SIDE && hit.t == 1.0F - 6.5F / SIDE);
    /* Level at 1/2: the first top that is as high is that of sample 8, from u = 8/16 on. */
    assert_true(fire(plane, &options, ray_at(0.1F, 0.5F, 0.5F, 1.0F, 0.0F, 0.0F), &hit));
    expect_near((double)hit.u, 8.0 / SIDE, 1e-6);
    assert_int_equal(hit.cell_x, 8);
}

static void qdm_sees_a_tower_as_a_box(void **state)
{
    (void)state;
    const hc_trace_options options = { .method = HC_TRACE_QDM };
    hc_hit                 hit;
    for (int i = 0; i <= 8; i++) { /* eighths of a sample from (8, 8) to (9, 8) */
        const float u = (8.5F + (float)i / 8.0F) / SIDE;
        assert_true(fire(spike, &options, ray_at(u, 8.5F / SIDE, 2.0F, 0.0F, 0.0F, -1.0F), &hit));
        assert_true(hit.t == (i <= 4 ? 1.0F : 2.0F)); /* the wall itself belongs to the box */
    }
    assert_true(fire(spike, &options, ray_at(0.1F, 8.9F / SIDE, 0.9F, 1.0F, 0.0F, 0.0F), &hit));
    expect_near((double)hit.u, 8.0 / SIDE, 1e-6);
}

/* ---- pdm ------------------------------------------------------------------------------------ */

static float uniform(uint32_t *seed)
{
    *seed = *seed * 1664525U + 1013904223U;
    return (float)(*seed >> 8) / 16777216.0F;
}

/* Down and up, from above, inside and outside: the hits and the crossings of maxmip, but for a few
 * in ten thousand. */
static void pdm_walks_as_maxmip_does(void **state)
{
    enum { NOISE = 64, RAYS = 20000 };
    static float           noise[NOISE * NOISE];
    const hc_trace_options options[2] = { { .method = HC_TRACE_MAXMIP },
                                          { .method = HC_TRACE_PDM } };
    const hc_field         field      = { .heights = noise, .width = NOISE, .height = NOISE };
    hc_tracer             *tracers[2];
    double                 crossings[2] = { 0.0, 0.0 };
    uint32_t               seed         = 5;
    int                    hits = 0, other = 0;
    (void)state;
    assert_int_equal(hc_synth(noise, NOISE, NOISE, "noise", 1, NULL), HC_OK);
    for (int k = 0; k < 2; k++) {
        assert_int_equal(hc_tracer_create(&tracers[k], &field, &options[k], NULL), HC_OK);
    }
    for (int i = 0; i < RAYS; i++) {
        hc_ray ray = { .tmax = INFINITY };
        hc_hit hit[2];
        for (int axis = 0; axis < 3; axis++) {
            ray.origin[axis]    = axis < 2 ? 1.4F * uniform(&seed) - 0.2F : 0.5F + uniform(&seed);
            ray.direction[axis] = (axis < 2 ? uniform(&seed) : 0.5F * uniform(&seed)) - 0.4F;
        }
        for (int k = 0; k < 2; k++) {
            (void)hc_trace_nearest(tracers[k], &hit[k], &ray);
            crossings[k] += hit[k].crossings;
        }
        hits += hit[0].t < INFINITY ? 1 : 0;
        other += hit[0].t != hit[1].t && !(fabsf(hit[0].t - hit[1].t) < 1e-5F) ? 1 : 0;
    }
    print_message("pdm: %d of %d hits are others\n", other, hits);
    assert_true(hits > RAYS / 3);
    assert_true(other < RAYS / 1000);
    assert_true(fabs(crossings[1] - crossings[0]) < 0.01 * crossings[0]);
    for (int k = 0; k < 2; k++) {
        hc_tracer_destroy(tracers[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quick_halves_the_gap_across_a_slope),
        cmocka_unit_test(quick_refines_a_bracket),
        cmocka_unit_test(linear_reaches_tmax),
        cmocka_unit_test(relaxed_goes_into_a_step_and_back),
        cmocka_unit_test(relaxed_stops_at_a_tower),
        cmocka_unit_test(robust_goes_straight_down),
        cmocka_unit_test(robust_comes_back_from_a_far_wall),
        cmocka_unit_test(robust_loses_what_lies_between_two_walls),
        cmocka_unit_test(qdm_meets_the_tops_of_a_plane),
        cmocka_unit_test(qdm_sees_a_tower_as_a_box),
        cmocka_unit_test(pdm_walks_as_maxmip_does),
    };
    fill_fields();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
