/* Hard cases for ray casters and bakers: spikes, noise, ridge, saddle, fur; and the easiest,
 * flat. */
#include "noise.h"
#include "synth.h"

static void paint_spikes(float *run, int x, int y, int count, const hc_canvas *canvas,
                         const void *plan)
{
    const float share = 0.005F;
    (void)plan;
    for (int i = 0; i < count; i++) {
        const float draw = hc_hash_unit(canvas->seed, x + i, y);
        run[i]           = draw < share ? 0.25F + 0.75F * (draw / share) : 0.0F;
    }
}

hc_result hc_make_spikes(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_spikes, NULL, log);
}

static void paint_noise(float *run, int x, int y, int count, const hc_canvas *canvas,
                        const void *plan)
{
    (void)plan;
    for (int i = 0; i < count; i++) {
        run[i] = hc_hash_unit(canvas->seed, x + i, y);
    }
}

hc_result hc_make_noise(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_noise, NULL, log);
}

/* The texel that the diagonal of the field passes through at `place` along the other axis. */
static int on_diagonal(int place, int from_side, int to_side)
{
    return (int)((2 * (int64_t)place + 1) * to_side / (2 * (int64_t)from_side));
}

/* One texel for each step along the longer side, so that the wall has no gaps and is never
 * thicker. */
static void paint_ridge(float *run, int x, int y, int count, const hc_canvas *canvas,
                        const void *plan)
{
    const int width = canvas->width, height = canvas->height;
    (void)plan;
    for (int i = 0; i < count; i++) {
        const bool wall = width >= height ? on_diagonal(x + i, width, height) == y
                                          : on_diagonal(y, height, width) == x + i;
        run[i]          = wall ? 1.0F : 0.0F;
    }
}

hc_result hc_make_ridge(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_ridge, NULL, log);
}

static void paint_saddle(float *run, int x, int y, int count, const hc_canvas *canvas,
                         const void *plan)
{
    (void)canvas;
    (void)plan;
    for (int i = 0; i < count; i++) {
        run[i] = (float)((x + i + y) % 2);
    }
}

hc_result hc_make_saddle(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_saddle, NULL, log);
}

static void paint_flat(float *run, int x, int y, int count, const hc_canvas *canvas,
                       const void *plan)
{
    (void)canvas;
    (void)plan;
    (void)x;
    (void)y;
    for (int i = 0; i < count; i++) {
        run[i] = 0.5F;
    }
}

hc_result hc_make_flat(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_flat, NULL, log);
}

static void paint_skin(float *run, int x, int y, int count, const hc_canvas *canvas,
                       const void *plan)
{
    const uint64_t *key = plan;
    (void)canvas;
    for (int i = 0; i < count; i++) {
        run[i] = 0.08F * hc_hash_unit(*key, x + i, y);
    }
}

/* A hair lies across `steps` rows from its root down, drifting sideways, and rises to its tip. */
typedef struct hair {
    int   steps;
    float drift; /* columns per row */
    float tip;   /* height          */
} hair;

static hair grow_hair(uint64_t bits, float tuft)
{
    const float length = hc_unit(bits << 20);
    return (hair){ .steps = 3 + (int)(10.0F * length),
                   .drift = hc_unit(bits << 40) - 0.5F + 0.9F * tuft,
                   .tip   = (0.25F + 0.75F * length) * (0.75F + 0.35F * tuft) };
}

static int around(int place, int side)
{
    const int rest = place % side;
    return rest < 0 ? rest + side : rest;
}

/* Where hairs cross the higher one shows, so their order does not matter. */
static void comb_hair(const hc_canvas *canvas, hair strand, int x, int y)
{
    for (int k = 0; k < strand.steps; k++) {
        /* 64 makes the truncation round down. */
        const int column = (int)((float)k * strand.drift + 64.5F) - 64;
        const int row    = around(y + k, canvas->height);
        float    *at     = canvas->heights + (size_t)row * (size_t)canvas->width
                    + (size_t)around(x + column, canvas->width);
        const float height = strand.tip * (float)(k + 1) / (float)strand.steps;
        *at                = height > *at ? height : *at;
    }
}

/* Hairs reach into other rows, so this is one pass of one thread. */
static void comb_hairs(const hc_canvas *canvas, const hc_fractal *tufts)
{
    const float    share = 0.14F;
    const uint64_t key   = hc_stream(canvas->seed, 1);
    for (int y = 0; y < canvas->height; y++) {
        for (int x = 0; x < canvas->width; x += HC_RUN) {
            const int left  = canvas->width - x;
            const int count = left < HC_RUN ? left : HC_RUN;
            float     tuft[HC_RUN];
            hc_fractal_run(tuft, tufts, x, y, count);
            for (int i = 0; i < count; i++) {
                const uint64_t bits = hc_hash(key, x + i, y);
                if (hc_unit(bits) < share) {
                    comb_hair(canvas, grow_hair(bits, tuft[i]), x + i, y);
                }
            }
        }
    }
}

hc_result hc_make_fur(const hc_canvas *canvas, hc_log *log)
{
    const uint64_t   skin = hc_stream(canvas->seed, 0);
    const hc_fractal tufts =
        hc_make_fractal(canvas->width, canvas->height, 6.0, 2, hc_stream(canvas->seed, 2));
    const hc_result result = hc_paint(canvas, paint_skin, &skin, log);
    if (result == HC_OK) {
        comb_hairs(canvas, &tufts);
    }
    return result;
}
