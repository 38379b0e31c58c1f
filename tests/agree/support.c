#include "support.h"

#include <heightcast/io.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint64_t agree_random(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15U;
    uint64_t z = *state;
    z          = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z          = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

double agree_uniform(uint64_t *state)
{
    return (double)(agree_random(state) >> 11) * 0x1p-53;
}

int agree_range(uint64_t *state, int low, int high)
{
    return low + (int)(agree_random(state) % (uint64_t)(high - low + 1));
}

/* ---- hard fields ---------------------------------------------------------------------------- */

typedef struct place {
    int       x, y, width, height;
    uint64_t *random;
} place;

typedef float (*make)(const place *p);

static float flat_low(const place *p)
{
    (void)p;
    return 0.0F;
}

static float flat_high(const place *p)
{
    (void)p;
    return 1.0F;
}

static float noise(const place *p)
{
    return (float)(agree_random(p->random) >> 40) * 0x1p-24F;
}

static float eight_bit(const place *p)
{
    return (float)agree_range(p->random, 0, 255) / 255.0F;
}

static float sixteen_bit(const place *p)
{
    return (float)agree_range(p->random, 0, 65535) / 65535.0F;
}

/* Smooth and quantised: long runs of equal heights, and ties between directions. */
static float terraces(const place *p)
{
    const float x = (float)p->x / (float)p->width;
    const float y = (float)p->y / (float)p->height;
    return floorf(8.0F * (x * (1.0F - x) + y * (1.0F - y))) / 8.0F;
}

static float stairs(const place *p)
{
    return (float)((p->x + p->y) / 3 * 3) / (float)(p->width + p->height);
}

static float checkerboard(const place *p)
{
    return (float)((p->x ^ p->y) & 1);
}

static float one_ulp_apart(const place *p)
{
    float height = 0.5F;
    for (int i = agree_range(p->random, 0, 3); i > 0; i--) {
        height = nextafterf(height, 1.0F);
    }
    return height;
}

/* Rises whose squares are subnormal or zero, beside some that are not. */
static float denormal_rises(const place *p)
{
    static const float heights[] = { 0.0F,     0x1p-149F, 0x1p-126F, 0x1p-80F,
                                     0x1p-74F, 0x1p-63F,  0x1p-59F,  0x1p-20F };
    return heights[agree_range(p->random, 0, 7)];
}

static float equal_maxima(const place *p)
{
    return agree_range(p->random, 0, 9) == 0 ? 1.0F : (float)agree_range(p->random, 0, 3) * 0.0625F;
}

static float spikes(const place *p)
{
    return agree_range(p->random, 0, 199) == 0 ? (float)agree_uniform(p->random) : 0.0F;
}

static float tower(const place *p, bool right, bool bottom)
{
    return p->x == (right ? p->width - 1 : 0) && p->y == (bottom ? p->height - 1 : 0) ? 1.0F : 0.0F;
}

static float tower_nw(const place *p)
{
    return tower(p, false, false);
}

static float tower_ne(const place *p)
{
    return tower(p, true, false);
}

static float tower_sw(const place *p)
{
    return tower(p, false, true);
}

static float tower_se(const place *p)
{
    return tower(p, true, true);
}

/* A cone standing on its tip: every sample limits the tip alike, up to rounding. */
static float funnel(const place *p)
{
    const float x = (float)(p->x - p->width / 2) / (float)p->width;
    const float y = (float)(p->y - p->height / 2) / (float)p->height;
    return fminf(1.0F, sqrtf(x * x + y * y));
}

/* Spread over all magnitudes: every pair has a limiting height of its own. */
static float magnitudes(const place *p)
{
    return ldexpf(1.0F + (float)agree_uniform(p->random), -agree_range(p->random, 1, 30));
}

static const struct {
    const char *name;
    make        make;
} kinds[AGREE_KINDS] = { { "flat at 0", flat_low },
                         { "flat at 1", flat_high },
                         { "noise", noise },
                         { "8-bit noise", eight_bit },
                         { "16-bit noise", sixteen_bit },
                         { "terraces", terraces },
                         { "stairs", stairs },
                         { "checkerboard", checkerboard },
                         { "one ulp apart", one_ulp_apart },
                         { "denormal rises", denormal_rises },
                         { "equal maxima", equal_maxima },
                         { "spikes", spikes },
                         { "tower nw", tower_nw },
                         { "tower ne", tower_ne },
                         { "tower sw", tower_sw },
                         { "tower se", tower_se },
                         { "funnel", funnel },
                         { "magnitudes", magnitudes } };

void agree_fill(float *heights, int width, int height, int kind, uint64_t seed)
{
    place p = { .width = width, .height = height, .random = &seed };
    for (p.y = 0; p.y < height; p.y++) {
        for (p.x = 0; p.x < width; p.x++) {
            heights[p.y * width + p.x] = kinds[kind].make(&p);
        }
    }
}

/* ---- shapes and whole fields ---------------------------------------------------------------- */

const agree_shapes agree_small  = { 16,
                                    { { 1, 1 },
                                      { 1, 2 },
                                      { 2, 1 },
                                      { 2, 2 },
                                      { 1, 13 },
                                      { 11, 1 },
                                      { 3, 3 },
                                      { 2, 9 },
                                      { 5, 4 },
                                      { 8, 8 },
                                      { 7, 9 },
                                      { 15, 3 },
                                      { 4, 17 },
                                      { 13, 11 },
                                      { 16, 15 },
                                      { 17, 16 } } };
const agree_shapes agree_middle = { 16,
                                    { { 1, 1 },
                                      { 257, 1 },
                                      { 1, 131 },
                                      { 2, 2 },
                                      { 3, 200 },
                                      { 31, 33 },
                                      { 64, 64 },
                                      { 63, 65 },
                                      { 97, 61 },
                                      { 16, 127 },
                                      { 79, 80 },
                                      { 101, 103 },
                                      { 2000, 1 },
                                      { 1, 1501 },
                                      { 700, 3 },
                                      { 2, 900 } } };

static float *allocate(int width, int height)
{
    float *heights = malloc((size_t)width * (size_t)height * sizeof *heights);
    assert_non_null(heights);
    return heights;
}

hc_field agree_make_field(agree_shape shape, int kind, uint64_t seed, hc_wrap wrap,
                          hc_registration registration)
{
    float *heights = allocate(shape.width, shape.height);
    agree_fill(heights, shape.width, shape.height, kind, seed);
    return (hc_field){ .heights      = heights,
                       .width        = shape.width,
                       .height       = shape.height,
                       .wrap         = wrap,
                       .registration = registration };
}

int agree_field_count(const agree_shapes *shapes)
{
    return shapes->count * 4 * AGREE_KINDS;
}

const char *agree_kind_of(int number)
{
    return kinds[number % AGREE_KINDS].name;
}

hc_field agree_field(const agree_shapes *shapes, int number)
{
    const int shape = number / AGREE_KINDS / 4;
    return agree_make_field(shapes->shapes[shape], number % AGREE_KINDS, (uint64_t)number,
                            (hc_wrap)(number / AGREE_KINDS % 4),
                            (number / 5 + shape) % 2 == 0 ? HC_TEXEL : HC_GRID);
}

/* Sample of a row of `size` that goes on in mirror images. */
static int mirrored(int at, int size)
{
    const int folded = at % (2 * size);
    return folded < size ? folded : 2 * size - 1 - folded;
}

static void fill_with_elevations(float *heights, int width, int height)
{
    hc_log    log  = { .text = "" };
    hc_field  dem  = { .heights = NULL };
    hc_result done = hc_load_field(&dem, HC_DATA_DIR "/jacksboro_fault_dem.pgm", NULL, &log);
    if (done != HC_OK) {
        fail_msg("%s", log.text);
    }
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            heights[y * width + x] =
                dem.heights[mirrored(y, dem.height) * dem.width + mirrored(x, dem.width)];
        }
    }
    hc_free_field(&dem);
}

hc_field agree_named_field(const char *name, int width, int height, uint64_t seed, hc_wrap wrap)
{
    float *heights = allocate(width, height);
    if (strcmp(name, "dem") == 0) {
        fill_with_elevations(heights, width, height);
    } else {
        hc_log log = { .text = "" };
        if (hc_synth(heights, width, height, name, seed, &log) != HC_OK) {
            fail_msg("%s", log.text);
        }
    }
    return (hc_field){ .heights = heights, .width = width, .height = height, .wrap = wrap };
}

void agree_free(hc_field *field)
{
    free((void *)(uintptr_t)field->heights);
    field->heights = NULL;
}

const char *agree_describe(const char *kind, const hc_field *field)
{
    static _Thread_local char text[128];
    (void)snprintf(text, sizeof text, "%s %dx%d wrap %s %s", kind, field->width, field->height,
                   hc_wrap_name(field->wrap), hc_registration_name(field->registration));
    return text;
}

/* ---- bakes ---------------------------------------------------------------------------------- */

size_t agree_count(const hc_field *field, hc_cones cones)
{
    return (size_t)field->width * (size_t)field->height * (size_t)hc_cones_channels(cones);
}

float *agree_bake(const hc_field *field, const hc_cone_options *options)
{
    float *ratios = malloc(agree_count(field, options->cones) * sizeof *ratios);
    assert_non_null(ratios);
    hc_log log = { .text = "" };
    if (hc_bake_cone_map(ratios, field, options, &log) != HC_OK) {
        fail_msg("%s with %s cones: %s", hc_method_name(options->method),
                 hc_cones_name(options->cones), log.text);
    }
    return ratios;
}

size_t agree_first_difference(const float *a, const float *b, size_t count)
{
    size_t i = 0;
    while (i < count && memcmp(&a[i], &b[i], sizeof *a) == 0) {
        i++;
    }
    return i;
}

void agree_expect_same(const hc_field *field, const char *kind, hc_cones cones, const char *what,
                       const float *expected, const float *found)
{
    const size_t count = agree_count(field, cones);
    const size_t at    = agree_first_difference(expected, found, count);
    if (at < count) {
        const size_t texel = at / (size_t)hc_cones_channels(cones);
        fail_msg("%s, %s cones, %s: ratio[%zu, %zu] is %.9g instead of %.9g",
                 agree_describe(kind, field), hc_cones_name(cones), what,
                 texel % (size_t)field->width, texel / (size_t)field->width, (double)found[at],
                 (double)expected[at]);
    }
}
