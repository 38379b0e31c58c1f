/* Quick cone maps: the algorithms as printed, with sets of texels; never wider than brute force. */
#include "small_fields.h"

#include <heightcast/field.h>

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* ---- the printed algorithms with explicit sets ----------------------------------------------- */

/* Image coordinates from one period before the field to one after it. */
enum { ORIGIN = 32, PLANE = 96 };

/* The level that saw a texel first, plus 1; 0: none has. */
typedef struct plane {
    uint8_t level[PLANE][PLANE];
} plane;

static void block_range(int side, int level, int block, int *first, int *last)
{
    const int count = side >> level > 1 ? side >> level : 1;
    const int shift = block < 0 ? -side : block >= count ? side : 0;
    const int index = (block + count) % count;
    *first          = (index << level) + shift;
    *last           = (index == count - 1 ? side - 1 : ((index + 1) << level) - 1) + shift;
}

static int block_of(int side, int level, int place)
{
    const int count = side >> level > 1 ? side >> level : 1;
    return place >> level < count ? place >> level : count - 1;
}

static bool block_exists(int side, int level, int block, bool wraps)
{
    return wraps || (block >= 0 && block < (side >> level > 1 ? side >> level : 1));
}

static float apart(const hc_cone_job *job, int columns, int rows)
{
    const float u = (float)abs(columns) * job->step_u;
    const float v = (float)abs(rows) * job->step_v;
    return job->cones == HC_CONES_L2 ? sqrtf(u * u + v * v) : u + v;
}

static float height_of(const hc_cone_job *job, int x, int y)
{
    return job
        ->heights[(y + job->height) % job->height * job->width + (x + job->width) % job->width];
}

static bool in_quadrant(int quadrant, int columns, int rows)
{
    return quadrant < 0
           || ((quadrant & 1 ? columns <= 0 : columns >= 0)
               && (quadrant & 2 ? rows <= 0 : rows >= 0));
}

/* One block: its maximum, and the distance to its nearest texel that counts. `whole` takes all of
 * the block (algorithm 1), otherwise those that no finer level has visited. quadrant -1: any. */
static float block_steepness(const hc_cone_job *job, plane *seen, int level, int x, int y,
                             const int columns[2], const int rows[2], bool whole, int quadrant)
{
    float top  = 0.0F;
    float near = INFINITY;
    for (int qy = rows[0]; qy <= rows[1]; qy++) {
        for (int qx = columns[0]; qx <= columns[1]; qx++) {
            uint8_t *first = &seen->level[qy + ORIGIN][qx + ORIGIN];
            *first         = *first > 0 ? *first : (uint8_t)(level + 1);
            top            = fmaxf(top, height_of(job, qx, qy));
            if ((whole || *first == level + 1) && (qx != x || qy != y)
                && in_quadrant(quadrant, qx - x, qy - y)) {
                near = fminf(near, apart(job, qx - x, qy - y));
            }
        }
    }
    const float rise = top - height_of(job, x, y);
    return rise > 0.0F && near < INFINITY ? rise * (1.0F / near) : 0.0F;
}

static float printed_steepness(const hc_cone_job *job, int x, int y, bool improved, int quadrant)
{
    static plane seen;
    float        best = 0.0F;
    memset(&seen, 0, sizeof seen);
    for (int level = 0; level < hc_pyramid_levels(job->width, job->height); level++) {
        for (int n = 0; n < 9; n++) {
            const int bx = block_of(job->width, level, x) + n % 3 - 1;
            const int by = block_of(job->height, level, y) + n / 3 - 1;
            int       columns[2], rows[2];
            if (block_exists(job->width, level, bx, job->wrap_u)
                && block_exists(job->height, level, by, job->wrap_v)) {
                block_range(job->width, level, bx, &columns[0], &columns[1]);
                block_range(job->height, level, by, &rows[0], &rows[1]);
                best = fmaxf(best, block_steepness(job, &seen, level, x, y, columns, rows,
                                                   !improved && n != 4, quadrant));
            }
        }
    }
    return best;
}

/* Both algorithms are what they say, in every metric; so also not narrower than they may be. */
static void test_is_the_printed_algorithm(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * 3 * 2; i++) {
        const bool improved = i % 2 == 1;
        small_case small;
        small_make(&small, i / 24, i / 6 % 4, i % 4 < 2 ? NOISE : LEVELS, (hc_cones)(i / 2 % 3));
        const hc_cone_job *job = &small.job;
        assert_int_equal(hc_cone_quick(job, improved, false), HC_OK);
        for (int p = 0; p < job->width * job->height; p++) {
            for (int c = 0; c < job->channels; c++) {
                const float wanted = oracle_limit(printed_steepness(
                    job, p % job->width, p / job->width, improved, job->channels == 4 ? c : -1));
                if (!same_bits(small.ratios[p * job->channels + c], wanted)) {
                    fail_msg("%d x %d, wrap %d, cones %s, improved %d, texel %d: %a is not %a",
                             job->width, job->height, i / 6 % 4, hc_cones_name(job->cones),
                             improved, p, (double)small.ratios[p * job->channels + c],
                             (double)wanted);
                }
            }
        }
    }
}

/* ---- safety and quality ---------------------------------------------------------------------- */

static void test_never_wider_than_brute_force(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * SMALL_KINDS * 3; i++) {
        small_case naive, improved;
        const int  size = i / 3 / SMALL_KINDS / 4;
        const int  wrap = i / 3 / SMALL_KINDS % 4;
        small_make(&naive, size, wrap, (small_kind)(i / 3 % SMALL_KINDS), (hc_cones)(i % 3));
        small_make(&improved, size, wrap, (small_kind)(i / 3 % SMALL_KINDS), (hc_cones)(i % 3));
        const hc_cone_job *job = &naive.job;
        assert_int_equal(hc_cone_quick(&naive.job, false, false), HC_OK);
        assert_int_equal(hc_cone_quick(&improved.job, true, false), HC_OK);
        for (int p = 0; p < job->width * job->height; p++) {
            float truth[4];
            oracle_ratios(job, p % job->width, p / job->width, truth);
            for (int c = 0; c < job->channels; c++) {
                assert_true(improved.ratios[p * job->channels + c] <= truth[c]);
                assert_true(naive.ratios[p * job->channels + c]
                            <= improved.ratios[p * job->channels + c]);
                assert_true(naive.ratios[p * job->channels + c] > 0.0F);
            }
        }
    }
}

/* An elongated diamond may be another one than the canonical, but no sample may be inside it. */
static void test_elongated_diamonds_stay_empty(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * 2; i++) {
        small_case small;
        small_make(&small, i / 8, i / 2 % 4, SLOPE, HC_CONES_ANISO);
        const hc_cone_job *job = &small.job;
        assert_int_equal(hc_cone_quick(job, i % 2 == 1, false), HC_OK);
        for (int p = 0; p < job->width * job->height; p++) {
            const float *own = small.ratios + 3 * p;
            float        truth[4];
            oracle_ratios(job, p % job->width, p / job->width, truth);
            assert_true(own[2] <= truth[2]);
            assert_true(oracle_steepness(job, p % job->width, p / job->width, 0, 0,
                                         job->step_u / own[0], job->step_v / own[1], false)
                        <= 1.0F);
        }
    }
}

static double mean_of(const float *ratios, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += fmin((double)ratios[i], 1.0);
    }
    return sum / count;
}

/* On natural fields the improved variant keeps much of the true width, the naive one little, and
 * the centres go beyond it: by a known direction, not by a known amount. */
static void test_width_kept(void **state)
{
    (void)state;
    enum { SIDE = 64, TEXELS = SIDE * SIDE };
    static float heights[TEXELS], ring[TEXELS], ratios[4][TEXELS];
    assert_int_equal(hc_synth(heights, SIDE, SIDE, "fbm", 1, NULL), HC_OK);
    hc_cone_job job = { .ratios   = ring,
                        .heights  = heights,
                        .width    = SIDE,
                        .height   = SIDE,
                        .step_u   = 1.0F / SIDE,
                        .step_v   = 1.0F / SIDE,
                        .channels = 1,
                        .threads  = 2 };
    assert_int_equal(hc_cone_ring(&job), HC_OK);
    for (int variant = 0; variant < 4; variant++) {
        job.ratios = ratios[variant];
        assert_int_equal(hc_cone_quick(&job, (variant & 1) != 0, (variant & 2) != 0), HC_OK);
    }
    const double truth = mean_of(ring, TEXELS);
    assert_true(mean_of(ratios[0], TEXELS) < 0.7 * truth);
    assert_true(mean_of(ratios[1], TEXELS) > 0.6 * truth);
    assert_true(mean_of(ratios[3], TEXELS) > mean_of(ratios[1], TEXELS));
    int wider = 0;
    for (int p = 0; p < TEXELS; p++) {
        assert_true(ratios[2][p] >= ratios[0][p]);
        assert_true(ratios[3][p] >= ratios[1][p]);
        wider += ratios[3][p] > ring[p];
    }
    assert_true(wider > 0); /* NOT safe, as bake.h says */
}

/* ---- centres: a row of eight, one tower ------------------------------------------------------ */

static float row_ratio(bool improved, int tower)
{
    float       heights[8] = { 0.0F };
    float       ratios[8];
    hc_cone_job job = { .ratios   = ratios,
                        .heights  = heights,
                        .width    = 8,
                        .height   = 1,
                        .step_u   = 0.125F,
                        .step_v   = 1.0F,
                        .channels = 1,
                        .threads  = 1 };
    heights[tower]  = 1.0F;
    assert_int_equal(hc_cone_quick(&job, improved, true), HC_OK);
    return ratios[0] / (1.0F - 0x1p-20F) * 8.0F;
}

static void test_centres_by_hand(void **state)
{
    (void)state;
    /* texel 0: level 0 sees 1; level 1 sees 2..3, all unvisited; level 2 sees 4..7 */
    assert_true(fabsf(row_ratio(true, 1) - 1.0F) < 1e-5F);
    assert_true(fabsf(row_ratio(true, 2) - 2.5F) < 1e-5F);
    assert_true(fabsf(row_ratio(true, 3) - 2.5F) < 1e-5F);
    assert_true(fabsf(row_ratio(true, 4) - 5.5F) < 1e-5F);
    /* the naive variant meets 2..3 on level 1 as well, and 4..7 on level 2 */
    assert_true(fabsf(row_ratio(false, 3) - 2.5F) < 1e-5F);
    assert_true(fabsf(row_ratio(false, 7) - 5.5F) < 1e-5F);
}

/* ---- threads --------------------------------------------------------------------------------- */

static void test_threads_do_not_show(void **state)
{
    (void)state;
    enum { WIDTH = 150, HEIGHT = 70 };
    static float heights[WIDTH * HEIGHT], one[WIDTH * HEIGHT * 4], three[WIDTH * HEIGHT * 4];
    small_fill(heights, WIDTH, HEIGHT, SLOPE, 5);
    hc_cone_job job = { .ratios   = one,
                        .heights  = heights,
                        .width    = WIDTH,
                        .height   = HEIGHT,
                        .wrap_u   = true,
                        .step_u   = 1.0F / WIDTH,
                        .step_v   = 1.0F / HEIGHT,
                        .cones    = HC_CONES_QUAD,
                        .channels = 4,
                        .threads  = 1 };
    assert_int_equal(hc_cone_quick(&job, true, false), HC_OK);
    job.ratios  = three;
    job.threads = 3;
    assert_int_equal(hc_cone_quick(&job, true, false), HC_OK);
    assert_memory_equal(one, three, sizeof one);
}

static void test_methods(void **state)
{
    (void)state;
    assert_string_equal(hc_method_name(HC_METHOD_EXACT), "exact");
    assert_string_equal(hc_method_name(HC_METHOD_QUICK_NAIVE_CENTRE), "quick-naive-centre");
    assert_string_equal(hc_method_name(HC_METHOD_FALLING_EDGE), "falling-edge");
    assert_null(hc_method_name((hc_method)9));
    assert_null(hc_method_name((hc_method)-1));
    assert_true(hc_method_makes(HC_METHOD_QUICK, HC_CONES_ANISO));
    assert_true(hc_method_makes(HC_METHOD_RING, HC_CONES_L1));
    assert_false(hc_method_makes(HC_METHOD_RING, HC_CONES_QUAD));
    assert_true(hc_method_makes(HC_METHOD_GEMS, HC_CONES_L2));
    assert_false(hc_method_makes(HC_METHOD_FALLING_EDGE, HC_CONES_L1));
    assert_false(hc_method_makes(HC_METHOD_EXACT, (hc_cones)4));
    assert_false(hc_method_makes((hc_method)9, HC_CONES_L2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_is_the_printed_algorithm),
        cmocka_unit_test(test_never_wider_than_brute_force),
        cmocka_unit_test(test_elongated_diamonds_stay_empty),
        cmocka_unit_test(test_width_kept),
        cmocka_unit_test(test_centres_by_hand),
        cmocka_unit_test(test_threads_do_not_show),
        cmocka_unit_test(test_methods),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
