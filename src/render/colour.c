#include "colour.h"

#include <math.h>

/* x^2.4 by Newton's method for the fifth root, since pow differs between machines. */
static double linear_of(double code)
{
    if (code <= 0.04045) {
        return code / 12.92;
    }
    const double x    = (code + 0.055) / 1.055;
    double       root = 1.0; /* of x^2 */
    for (int i = 0; i < 32; i++) {
        const double fourth = root * root * root * root;
        root -= (root * fourth - x * x) / (5.0 * fourth);
    }
    return x * x * root;
}

void hc_set_code(float rgb[3], double r, double g, double b)
{
    rgb[0] = (float)linear_of(r);
    rgb[1] = (float)linear_of(g);
    rgb[2] = (float)linear_of(b);
}

void hc_picture_bytes(uint8_t *rgb8, const hc_picture *picture)
{
    const size_t count = (size_t)picture->width * (size_t)picture->height * 3;
    float        from[256]; /* least value of each code */
    for (int code = 0; code < 256; code++) {
        from[code] = code == 0 ? -INFINITY : (float)linear_of((code - 0.5) / 255.0);
    }
    for (size_t i = 0; i < count; i++) {
        int code = 0;
        for (int bit = 128; bit > 0; bit /= 2) {
            code += picture->rgb[i] >= from[code + bit] ? bit : 0;
        }
        rgb8[i] = (uint8_t)code;
    }
}

/* Dark to bright, so that the order of values survives a print in grey. */
void hc_heat_colour(float rgb[3], double value)
{
    static const double stops[6][3] = { { 0.06, 0.05, 0.20 }, { 0.16, 0.22, 0.62 },
                                        { 0.10, 0.55, 0.62 }, { 0.45, 0.75, 0.30 },
                                        { 0.96, 0.78, 0.18 }, { 1.00, 0.97, 0.85 } };
    const double        at          = fmin(fmax(value, 0.0), 1.0) * 5.0;
    const int           stop        = at < 5.0 ? (int)at : 4;
    double              c[3];
    for (int i = 0; i < 3; i++) {
        c[i] = stops[stop][i] + (at - stop) * (stops[stop + 1][i] - stops[stop][i]);
    }
    hc_set_code(rgb, c[0], c[1], c[2]);
}

void hc_mix(float rgb[3], float share, float r, float g, float b)
{
    const float other[3] = { r, g, b };
    for (int i = 0; i < 3; i++) {
        rgb[i] += share * (other[i] - rgb[i]);
    }
}

void hc_grey_down(float rgb[3])
{
    const float grey = 0.3F * rgb[0] + 0.6F * rgb[1] + 0.1F * rgb[2];
    rgb[0] = rgb[1] = rgb[2] = grey;
}

void hc_mark_wrong(float rgb[3], int lost, int made_up, float samples)
{
    hc_mix(rgb, (float)made_up / samples, 0.9F, 0.75F, 0.0F);
    hc_mix(rgb, (float)lost / samples, 0.9F, 0.0F, 0.0F);
}
