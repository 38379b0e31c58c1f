/* Small awkward fields, and the canonical formula of bake.h written down once more, without any
 * code of the bakers: what their tests compare with. */
#ifndef HC_TESTS_SMALL_FIELDS_H
#define HC_TESTS_SMALL_FIELDS_H

#include "bake/cone_job.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef enum small_kind { NOISE = 0, LEVELS, SPIKES, SLOPE, TINY, SMALL_KINDS } small_kind;

static inline uint32_t small_random(uint32_t *state)
{
    *state = *state * 1664525U + 1013904223U;
    return *state >> 8;
}

static inline float small_height(small_kind kind, int x, int y, int width, int height,
                                 uint32_t *state)
{
    const float random = (float)small_random(state) / (float)0xFFFFFF;
    switch (kind) {
    case LEVELS: return floorf(random * 7.99F) / 7.0F;
    case SPIKES: return random > 0.95F ? random : 0.125F;
    case SLOPE: return ((float)x / (float)width + (float)y / (float)height) * 0.45F + random * 0.1F;
    case TINY: return random * 1e-24F;
    default: return random;
    }
}

static inline void small_fill(float *heights, int width, int height, small_kind kind, uint32_t seed)
{
    uint32_t state = seed * 2654435761U + 12345U;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            heights[y * width + x] = small_height(kind, x, y, width, height, &state);
        }
    }
}

static const int small_sizes[][2] = { { 1, 1 },   { 2, 1 },  { 1, 5 }, { 2, 2 },  { 3, 3 },
                                      { 5, 4 },   { 7, 3 },  { 8, 8 }, { 13, 9 }, { 16, 5 },
                                      { 11, 15 }, { 31, 2 }, { 6, 23 } };
enum { SMALL_SIZES = sizeof small_sizes / sizeof *small_sizes, SMALL_TEXELS = 256 };

/* One field with everything a baker needs; `ratios` is its own memory. */
typedef struct small_case {
    float       heights[SMALL_TEXELS];
    float       ratios[SMALL_TEXELS * 4];
    hc_cone_job job;
} small_case;

static inline void small_make(small_case *made, int size, int wrap, small_kind kind, hc_cones cones)
{
    const int width  = small_sizes[size][0];
    const int height = small_sizes[size][1];
    small_fill(made->heights, width, height, kind, (uint32_t)(size * 100 + wrap * 10) + kind);
    memset(made->ratios, 0, sizeof made->ratios);
    made->job = (hc_cone_job){ .ratios     = made->ratios,
                               .heights    = made->heights,
                               .width      = width,
                               .height     = height,
                               .wrap_u     = (wrap & 1) != 0,
                               .wrap_v     = (wrap & 2) != 0,
                               .step_u     = (float)(1.0 / width),
                               .step_v     = (float)(1.0 / height),
                               .cones      = cones,
                               .channels   = hc_cones_channels(cones),
                               .threads    = 1,
                               .isa        = HC_ISA_SCALAR,
                               .gems_steps = 64 };
}

/* Distance from one sample to another: nearest image, or (direction +1, -1) nearest one that way;
 * -1 if there is none. */
static inline int oracle_distance(int from, int to, int side, bool wraps, int direction)
{
    const int apart = to - from;
    if (direction == 0) {
        const int straight = abs(apart);
        return wraps && side - straight < straight ? side - straight : straight;
    }
    const int along = apart * direction;
    return along >= 0 ? along : wraps ? along + side : -1;
}

static inline float oracle_steepness(const hc_cone_job *job, int x, int y, int direction_u,
                                     int direction_v, float step_u, float step_v, bool l2)
{
    const float own  = job->heights[y * job->width + x];
    float       best = 0.0F;
    for (int qy = 0; qy < job->height; qy++) {
        for (int qx = 0; qx < job->width; qx++) {
            const int   i    = oracle_distance(x, qx, job->width, job->wrap_u, direction_u);
            const int   j    = oracle_distance(y, qy, job->height, job->wrap_v, direction_v);
            const float rise = job->heights[qy * job->width + qx] - own;
            if (i < 0 || j < 0 || !(rise > 0.0F)) {
                continue;
            }
            const float u      = (float)i * step_u;
            const float v      = (float)j * step_v;
            const float apart  = l2 ? sqrtf(u * u + v * v) : u + v;
            const float weight = 1.0F / apart;
            best               = fmaxf(best, rise * weight);
        }
    }
    return best;
}

static inline float oracle_limit(float steepness)
{
    const float ratio = 1.0F / steepness;
    return ratio > 0x1p60F ? INFINITY : ratio * (1.0F - 0x1p-20F);
}

/* The canonical ratios of one sample: `ratios` has room for 4. */
static inline void oracle_ratios(const hc_cone_job *job, int x, int y, float *ratios)
{
    static const float elongations[] = { 0.25F, 0.5F, 1.0F, 2.0F, 4.0F };

    const float u = job->step_u;
    const float v = job->step_v;
    if (job->cones == HC_CONES_L2 || job->cones == HC_CONES_L1) {
        const bool l2 = job->cones == HC_CONES_L2;
        ratios[0]     = oracle_limit(oracle_steepness(job, x, y, 0, 0, u, v, l2));
    } else if (job->cones == HC_CONES_QUAD) {
        ratios[0] = oracle_limit(oracle_steepness(job, x, y, 1, 1, u, v, false));
        ratios[1] = oracle_limit(oracle_steepness(job, x, y, -1, 1, u, v, false));
        ratios[2] = oracle_limit(oracle_steepness(job, x, y, 1, -1, u, v, false));
        ratios[3] = oracle_limit(oracle_steepness(job, x, y, -1, -1, u, v, false));
    } else {
        float least = INFINITY;
        ratios[0] = ratios[1] = INFINITY;
        for (int a = 0; a < 5; a++) {
            const float e    = elongations[a];
            const float best = oracle_steepness(job, x, y, 0, 0, u * e, v / e, false);
            if (best * e + best / e < least) {
                least     = best * e + best / e;
                ratios[0] = oracle_limit(best * e);
                ratios[1] = oracle_limit(best / e);
            }
        }
        ratios[2] = oracle_limit(oracle_steepness(job, x, y, 0, 0, u, v, false));
    }
}

static inline bool same_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

#endif
