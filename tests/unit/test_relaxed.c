/* Relaxed cones: the exact ones against their all-pairs definition, the sampled ones against the
 * same rays marched to the end. */
#include "small_fields.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* ---- falling edge ---------------------------------------------------------------------------- */

static int step_on(int place, int side, bool wraps, int direction)
{
    const int to = place + direction;
    return to >= 0 && to < side ? to : wraps ? (to + side) % side : place;
}

/* Whether sample v limits cones seen towards (direction_u, direction_v): some edge of the cell
 * beyond it falls outwards. */
static bool limits(const hc_cone_job *job, int x, int y, int direction_u, int direction_v)
{
    const int   x1  = step_on(x, job->width, job->wrap_u, direction_u);
    const int   y1  = step_on(y, job->height, job->wrap_v, direction_v);
    const float h00 = job->heights[y * job->width + x];
    const float h10 = job->heights[y * job->width + x1];
    const float h01 = job->heights[y1 * job->width + x];
    const float h11 = job->heights[y1 * job->width + x1];
    return h00 > h10 || h00 > h01 || h10 > h11 || h01 > h11;
}

static float all_pairs_falling(const hc_cone_job *job, int x, int y)
{
    float best = 0.0F;
    for (int n = 0; n < 4 * job->width * job->height; n++) {
        const int   qx          = n / 4 % job->width;
        const int   qy          = n / 4 / job->width;
        const int   direction_u = n & 1 ? -1 : 1;
        const int   direction_v = n & 2 ? -1 : 1;
        const int   i           = oracle_distance(x, qx, job->width, job->wrap_u, direction_u);
        const int   j           = oracle_distance(y, qy, job->height, job->wrap_v, direction_v);
        const float rise = job->heights[qy * job->width + qx] - job->heights[y * job->width + x];
        if (i >= 0 && j >= 0 && rise > 0.0F && limits(job, qx, qy, direction_u, direction_v)) {
            const float u      = (float)i * job->step_u;
            const float v      = (float)j * job->step_v;
            const float weight = 1.0F / sqrtf(u * u + v * v);
            best               = fmaxf(best, rise * weight);
        }
    }
    return oracle_limit(best);
}

static void test_falling_edge_is_its_definition(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * SMALL_KINDS; i++) {
        small_case small;
        small_make(&small, i / SMALL_KINDS / 4, i / SMALL_KINDS % 4, (small_kind)(i % SMALL_KINDS),
                   HC_CONES_L2);
        small.job.threads = 1 + i % 3;
        assert_int_equal(hc_cone_falling_edge(&small.job), HC_OK);
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            const int   x = p % small.job.width;
            const int   y = p / small.job.width;
            float       truth[4];
            const float wanted = all_pairs_falling(&small.job, x, y);
            oracle_ratios(&small.job, x, y, truth);
            assert_true(same_bits(small.ratios[p], wanted));
            assert_true(small.ratios[p] >= truth[0]); /* fewer samples limit */
        }
    }
}

/* A rise to a plateau limits nothing from below: what enters it stays inside. From behind the same
 * samples fall. */
static void test_falling_edge_by_hand(void **state)
{
    (void)state;
    const float heights[6] = { 0.0F, 0.0F, 0.5F, 1.0F, 1.0F, 0.25F };
    float       ratios[6];
    hc_cone_job job = { .ratios  = ratios,
                        .heights = heights,
                        .width   = 6,
                        .height  = 1,
                        .step_u  = 0.25F,
                        .step_v  = 1.0F,
                        .threads = 1 };
    assert_int_equal(hc_cone_falling_edge(&job), HC_OK);
    const float keep = 1.0F - 0x1p-20F;
    assert_true(same_bits(ratios[0], 1.0F * keep)); /* the plateau's far end, 4 samples away */
    assert_true(same_bits(ratios[2], 1.0F * keep)); /* 2 samples, 0.5 higher                 */
    assert_true(isinf(ratios[3]));
    /* leftwards nothing falls behind sample 4, but behind 3 it does: 2 samples, 0.75 higher */
    assert_true(same_bits(ratios[5], 1.0F / (0.75F * (1.0F / 0.5F)) * keep));
}

/* ---- gems ------------------------------------------------------------------------------------ */

static float bilinear(const hc_cone_job *job, float column, float row)
{
    const float place[2] = { column, row };
    const int   side[2]  = { job->width, job->height };
    const bool  wraps[2] = { job->wrap_u, job->wrap_v };
    int         low[2], high[2];
    float       weight[2];
    for (int axis = 0; axis < 2; axis++) {
        const float size = (float)side[axis];
        float       at   = place[axis];
        if (wraps[axis]) {
            at = at - size * floorf(at / size);
            at = at < 0.0F || at >= size ? 0.0F : at;
        } else {
            at = fminf(fmaxf(at, 0.0F), size - 1.0F);
        }
        low[axis]    = (int)at;
        high[axis]   = step_on(low[axis], side[axis], wraps[axis], 1);
        weight[axis] = at - (float)low[axis];
    }
    const float *upper = job->heights + low[1] * job->width;
    const float *lower = job->heights + high[1] * job->width;
    const float  above = upper[low[0]] + (upper[high[0]] - upper[low[0]]) * weight[0];
    const float  below = lower[low[0]] + (lower[high[0]] - lower[low[0]]) * weight[0];
    return above + (below - above) * weight[1];
}

/* The ray over p through q: the steepness of where it comes out, 0 if that is not above p. */
static float ray_steepness(const hc_cone_job *job, int x, int y, int i, int j)
{
    const float apex  = job->heights[y * job->width + x];
    const float entry = job->heights[(y + j + job->height) % job->height * job->width
                                     + (x + i + job->width) % job->width];
    const float u     = (float)i * job->step_u;
    const float v     = (float)j * job->step_v;
    const float steps = (float)job->gems_steps;
    if (entry <= apex) {
        return 0.0F;
    }
    if (entry >= 1.0F) {
        return (entry - apex) * (1.0F / sqrtf(u * u + v * v));
    }
    const float stretch = entry / ((1.0F - entry) * steps);
    for (int step = 1; step <= job->gems_steps; step++) {
        const float height = entry - entry * ((float)step / steps);
        const float way    = 1.0F + (float)step * stretch;
        if (bilinear(job, (float)x + (float)i * way, (float)y + (float)j * way) < height) {
            const float apart = sqrtf((u * u + v * v) * (way * way));
            return height > apex ? (height - apex) * (1.0F / apart) : 0.0F;
        }
    }
    return 0.0F;
}

static int first_offset(int place, int side, bool wraps)
{
    return wraps ? -((side - 1) / 2) : -place;
}

static float all_rays(const hc_cone_job *job, int x, int y)
{
    float best = 0.0F;
    for (int q = 0; q < job->width * job->height; q++) {
        const int i = first_offset(x, job->width, job->wrap_u) + q % job->width;
        const int j = first_offset(y, job->height, job->wrap_v) + q / job->width;
        if (i != 0 || j != 0) {
            best = fmaxf(best, ray_steepness(job, x, y, i, j));
        }
    }
    return oracle_limit(best);
}

static void test_gems_marches_every_ray(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * SMALL_KINDS; i++) {
        small_case small;
        small_make(&small, i / SMALL_KINDS / 4, i / SMALL_KINDS % 4, (small_kind)(i % SMALL_KINDS),
                   HC_CONES_L2);
        small.job.gems_steps = 5 + i % 60;
        small.job.threads    = 1 + i % 2;
        assert_int_equal(hc_cone_gems(&small.job), HC_OK);
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            const int   x      = p % small.job.width;
            const int   y      = p / small.job.width;
            const float wanted = all_rays(&small.job, x, y);
            float       truth[4];
            oracle_ratios(&small.job, x, y, truth);
            if (!same_bits(small.ratios[p], wanted)) {
                fail_msg("%d x %d, wrap %d, kind %d, texel %d: %a is not %a", small.job.width,
                         small.job.height, i / SMALL_KINDS % 4, i % SMALL_KINDS, p,
                         (double)small.ratios[p], (double)wanted);
            }
            assert_true(small.ratios[p] >= truth[0] * (1.0F - 0x1p-20F));
        }
    }
}

/* A wall of height 1/2 and four samples' width: the ray comes out at its far side. */
static void test_gems_by_hand(void **state)
{
    (void)state;
    float       heights[64] = { 0.0F };
    float       ratios[64];
    hc_cone_job job = { .ratios     = ratios,
                        .heights    = heights,
                        .width      = 64,
                        .height     = 1,
                        .step_u     = 1.0F / 64,
                        .step_v     = 1.0F,
                        .threads    = 1,
                        .gems_steps = 4096 };
    for (int x = 20; x < 24; x++) {
        heights[x] = 0.5F;
    }
    assert_int_equal(hc_cone_gems(&job), HC_OK);
    /* From sample 10 through the wall's far top (23): height 1 - d / 26 at distance d, the face
     * falls from 1/2 at d = 13 to 0 at d = 14: steeper than the ray, so it is out at once there. */
    assert_true(ratios[10] >= 13.0F / 64 / 0.5F * 0.999F);
    assert_true(ratios[10] <= 13.1F / 64 / 0.49F);
}

static bool rising(void *user, double fraction)
{
    double *last = user;
    assert_true(fraction >= *last && fraction <= 1.0);
    *last = fraction;
    return true;
}

static void test_progress_never_falls(void **state)
{
    (void)state;
    double     last = 0.0;
    small_case small;
    small_make(&small, 12, 0, NOISE, HC_CONES_L2);
    small.job.progress = (hc_progress){ rising, &last };
    assert_int_equal(hc_cone_falling_edge(&small.job), HC_OK);
    assert_true(last > 0.75);
}

static bool refuse(void *user, double fraction)
{
    (void)user;
    return fraction < 0.5;
}

static void test_stops_on_request(void **state)
{
    (void)state;
    small_case small;
    small_make(&small, 12, 0, NOISE, HC_CONES_L2);
    small.job.progress = (hc_progress){ refuse, NULL };
    assert_int_equal(hc_cone_falling_edge(&small.job), HC_ERROR_CANCELLED);
    assert_int_equal(hc_cone_gems(&small.job), HC_ERROR_CANCELLED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_falling_edge_is_its_definition),
        cmocka_unit_test(test_falling_edge_by_hand),
        cmocka_unit_test(test_gems_marches_every_ray),
        cmocka_unit_test(test_gems_by_hand),
        cmocka_unit_test(test_progress_never_falls),
        cmocka_unit_test(test_stops_on_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
