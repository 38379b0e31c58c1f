/* What pictures are made of: angles without libm, and codes. */
#include "render/angle.h"

#include <heightcast/render.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void angles_are_those_of_libm(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const double turn = (i - 500) * (HC_PI / 500.0);
        const double far  = 1e-3 + i;
        const double y    = far * sin(turn);
        const double x    = far * cos(turn);
        assert_true(fabs(hc_angle(y, x) - atan2(y, x)) < 0x1p-49);
        const double flat = 0.00148 * (i - 500) * 2.0;
        assert_true(fabs(hc_tangent(flat) - tan(flat)) <= 0x1p-49 * (1.0 + fabs(tan(flat))));
    }
    assert_true(hc_angle(0.0, 0.0) == 0.0);
    assert_true(hc_angle(0.0, -1.0) == HC_PI);
}

static double srgb(double code)
{
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

static void codes_are_srgb(void **state)
{
    (void)state;
    float      rgb[256 * 3];
    uint8_t    bytes[256 * 3];
    hc_picture picture = { .width = 256, .height = 1, .rgb = rgb };
    for (int code = 0; code < 256; code++) {
        rgb[3 * code]     = (float)srgb(code / 255.0);
        rgb[3 * code + 1] = (float)srgb((code + 0.49) / 255.0);
        rgb[3 * code + 2] = (float)srgb(fmax(code - 0.49, 0.0) / 255.0);
    }
    hc_picture_bytes(bytes, &picture);
    for (int i = 0; i < 256 * 3; i++) {
        assert_int_equal(bytes[i], i / 3);
    }
    rgb[0] = -1.0F;
    rgb[1] = 7.0F;
    rgb[2] = NAN;
    hc_picture_bytes(bytes, &picture);
    assert_int_equal(bytes[0], 0);
    assert_int_equal(bytes[1], 255);
    assert_int_equal(bytes[2], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(angles_are_those_of_libm),
        cmocka_unit_test(codes_are_srgb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
