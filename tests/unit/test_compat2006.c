/* The 2006 preprocessor's bytes: by hand, and against its formulas spelled out once more. */
#include "small_fields.h"

#include "bake/compat2006.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RGBA = 4 };

static hc_result convert(uint8_t *rgba, const uint8_t *codes, int width, int height, int wrap)
{
    memset(rgba, 0, (size_t)(width * height * RGBA));
    for (int i = 0; i < width * height; i++) {
        rgba[i * RGBA] = codes[i];
    }
    return hc_compat2006(rgba, width, height, (hc_wrap)wrap, 2, (hc_progress){ NULL, NULL }, NULL);
}

static void expect_texel(const uint8_t *rgba, int texel, int red, int green, int blue, int alpha)
{
    const uint8_t wanted[RGBA] = { (uint8_t)red, (uint8_t)green, (uint8_t)blue, (uint8_t)alpha };
    if (memcmp(rgba + texel * RGBA, wanted, RGBA) != 0) {
        fail_msg("texel %d is %d %d %d %d", texel, rgba[texel * RGBA], rgba[texel * RGBA + 1],
                 rgba[texel * RGBA + 2], rgba[texel * RGBA + 3]);
    }
}

/* One peak at (1, 1) of 4 x 4 samples, 1/4 apart. */
static void test_peak_by_hand(void **state)
{
    (void)state;
    uint8_t       rgba[16 * RGBA];
    const uint8_t codes[16] = { 0, 0, 0, 0, 0, 255 };
    assert_int_equal(convert(rgba, codes, 4, 4, 0), HC_OK);
    /* ratio sqrt(2) / 4, its root 0.59460, 151.62 rounded; level around */
    expect_texel(rgba, 0, 0, 152, 127, 127);
    /* ratio 1/4, 127.5 up; below rises 255 / 2 = 127, then 63, upwards negative */
    expect_texel(rgba, 1, 0, 128, 127, 127 - 63);
    expect_texel(rgba, 4, 0, 128, 127 + 63, 127);
    /* nothing higher: 1; both slopes cancel */
    expect_texel(rgba, 5, 255, 255, 127, 127);
    /* inside, beyond the peak: -255 / 2 = -127 */
    expect_texel(rgba, 6, 0, 128, 127 - 127, 127);
    expect_texel(rgba, 9, 0, 128, 127, 127 + 127);
    /* two columns and rows away: sqrt(8) / 4, root 0.84090, 214.43 */
    expect_texel(rgba, 15, 0, 214, 127, 127);
}

/* A peak at (0, 0) is one step past the wrapped corner from (3, 3): not seen there, and across the
 * whole image it is farther than the limit. Along the border it is seen. */
static void test_wrapped_corner_fault(void **state)
{
    (void)state;
    uint8_t       rgba[16 * RGBA];
    const uint8_t codes[16] = { 255 };
    assert_int_equal(convert(rgba, codes, 4, 4, HC_WRAP_UV), HC_OK);
    assert_int_equal(rgba[15 * RGBA + 1], 255);
    assert_int_equal(rgba[3 * RGBA + 1], 128);
    assert_int_equal(rgba[12 * RGBA + 1], 128);
    /* and slopes at the border do not wrap */
    assert_int_equal(rgba[3 * RGBA + 2], 127);
}

/* 1 / 300000 rounds to code 0, which becomes 1. */
static void test_zero_becomes_one(void **state)
{
    (void)state;
    enum { WIDTH = 300000 };
    uint8_t *codes = calloc(2 * WIDTH, 1);
    uint8_t *rgba  = malloc((size_t)2 * WIDTH * RGBA);
    assert_non_null(codes);
    assert_non_null(rgba);
    codes[1] = 255;
    assert_int_equal(convert(rgba, codes, WIDTH, 2, 0), HC_OK);
    assert_int_equal(rgba[1], 1);
    free(codes);
    free(rgba);
}

/* ---- the formulas once more ------------------------------------------------------------------ */

typedef struct image {
    const uint8_t *codes;
    int            width, height;
    bool           wrap_u, wrap_v;
} image;

static double red(const image *from, int x, int y)
{
    return from->codes[y * from->width + x] / 255.0;
}

/* All offsets of a square in the order of the original: its left and right columns without corners,
 * then the upper and lower rows. False where the original does not look. */
static bool looks_at(const image *from, int x, int y, int dx, int dy, bool in_column, int *qx,
                     int *qy)
{
    *qx = x + dx;
    *qy = y + dy;
    if (in_column) {
        while (from->wrap_u && *qx < 0) {
            *qx += from->width;
        }
        while (from->wrap_u && *qx >= from->width) {
            *qx -= from->width;
        }
    } else {
        while (from->wrap_v && *qy < 0) {
            *qy += from->height;
        }
        while (from->wrap_v && *qy >= from->height) {
            *qy -= from->height;
        }
    }
    return *qx >= 0 && *qx < from->width && *qy >= 0 && *qy < from->height;
}

static void meet(const image *from, int x, int y, int dx, int dy, bool in_column, float *least)
{
    int qx, qy;
    if (!looks_at(from, x, y, dx, dy, in_column, &qx, &qy)) {
        return;
    }
    const float inverse_width  = (float)(1.0 / from->width);
    const float inverse_height = (float)(1.0 / from->height);
    const float u              = (float)dx * inverse_width;
    const float v              = (float)dy * inverse_height;
    const float squared        = u * u + v * v;
    const float own            = (float)red(from, x, y);
    const float rise           = (float)(red(from, qx, qy) - (double)own);
    if (rise > 0.0F && rise * rise * *least > squared) {
        *least = squared / (rise * rise);
    }
}

static int green(const image *from, int x, int y)
{
    const float own   = (float)red(from, x, y);
    float       least = 1.0F;
    for (int r = 1;; r++) {
        const double left = 1.0 - (double)own;
        if (!(r * r <= 1.1 * 1.1 * left * left * (double)least * (double)from->width
                           * (double)from->height)
            || !(r <= 1.1 * left * from->width) || !(r <= 1.1 * left * from->height)) {
            break;
        }
        for (int i = 1 - r; i <= r - 1; i++) {
            meet(from, x, y, -r, i, true, &least);
        }
        for (int i = 1 - r; i <= r - 1; i++) {
            meet(from, x, y, r, i, true, &least);
        }
        for (int i = -r; i <= r; i++) {
            meet(from, x, y, i, -r, false, &least);
        }
        for (int i = -r; i <= r; i++) {
            meet(from, x, y, i, r, false, &least);
        }
    }
    const int code = (int)(255.0 * (double)sqrtf(sqrtf(least)) + 0.5);
    return code < 1 ? 1 : code;
}

static int code_at(const image *from, int x, int y)
{
    return from->codes[y * from->width + x];
}

static int slope_u(const image *from, int x, int y)
{
    if (x == 0) {
        return (code_at(from, 1, y) - code_at(from, 0, y)) / 2 / 2;
    }
    if (x == from->width - 1) {
        return (code_at(from, x, y) - code_at(from, x - 1, y)) / 2 / 2;
    }
    return (code_at(from, x + 1, y) - code_at(from, x - 1, y)) / 2;
}

static int slope_v(const image *from, int x, int y)
{
    if (y == 0) {
        return (code_at(from, x, 1) - code_at(from, x, 0)) / 2 / 2;
    }
    if (y == from->height - 1) {
        return (code_at(from, x, y) - code_at(from, x, y - 1)) / 2 / 2;
    }
    return (code_at(from, x, y + 1) - code_at(from, x, y - 1)) / 2;
}

static void expect_image(const image *from)
{
    static uint8_t rgba[SMALL_TEXELS * RGBA];
    const int      wrap = (from->wrap_u ? 1 : 0) + (from->wrap_v ? 2 : 0);
    assert_int_equal(convert(rgba, from->codes, from->width, from->height, wrap), HC_OK);
    for (int p = 0; p < from->width * from->height; p++) {
        const int x = p % from->width;
        const int y = p / from->width;
        expect_texel(rgba, p, from->codes[p], green(from, x, y), 127 + slope_u(from, x, y),
                     127 - slope_v(from, x, y));
    }
}

static void test_formulas(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * SMALL_KINDS; i++) {
        static uint8_t codes[SMALL_TEXELS];
        small_case     small;
        small_make(&small, i / SMALL_KINDS / 4, i / SMALL_KINDS % 4, (small_kind)(i % SMALL_KINDS),
                   HC_CONES_L2);
        if (small.job.width < 2 || small.job.height < 2) {
            continue;
        }
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            codes[p] = (uint8_t)(small.heights[p] * 255.0F + 0.5F);
        }
        expect_image(&(image){ codes, small.job.width, small.job.height, small.job.wrap_u,
                               small.job.wrap_v });
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_peak_by_hand),
        cmocka_unit_test(test_wrapped_corner_fault),
        cmocka_unit_test(test_zero_becomes_one),
        cmocka_unit_test(test_formulas),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
