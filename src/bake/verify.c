/* A map's ratios against brute force. */
#include "base/fail.h"
#include "base/parallel.h"
#include "brute_texel.h"
#include "maps/codes.h"
#include "quantise.h"

#include <math.h>
#include <stdlib.h>

enum { CHUNK_MIN = 16, CHUNKS_MAX = 1 << 16, CONES_MAX = 4 };

/* Results of one chunk of texels; added up in their order, so that sums do not depend on
 * threads. */
typedef struct tally {
    size_t wider;
    double widest_factor;
    double kept;
    size_t worst; /* texel */
} tally;

typedef struct verifying {
    const hc_map  *map;
    hc_brute_texel field;
    size_t         count, chunk;
    const size_t  *chosen; /* texels to check; NULL: all */
    tally         *tallies;
    int           *columns; /* width for each thread */
} verifying;

/* ---- one texel ------------------------------------------------------------------------------- */

static double limited(float ratio, const hc_map_info *info)
{
    const double limit = info->max_ratio > 0.0F ? (double)info->max_ratio : 1.0;
    return ratio >= 0.0F ? fmin((double)ratio, limit) : 0.0; /* NaN: nothing kept */
}

static void note_wider(tally *into, size_t channels, double factor, size_t texel)
{
    into->wider += channels;
    if (factor > into->widest_factor) {
        into->widest_factor = factor;
        into->worst         = texel;
    }
}

static void judge_ratio(tally *into, const hc_map_info *info, float stored, float truth,
                        size_t texel)
{
    if (!(stored <= truth)) {
        note_wider(into, 1, isnan(stored) ? INFINITY : (double)stored / (double)truth, texel);
    }
    into->kept += limited(stored, info) / limited(truth, info);
}

/* Both ratios of an elongated diamond together: a method may choose another elongation than the
 * canonical one and still be right, so the diamond is held against the samples. Kept is measured by
 * the sum of the slopes, which the choice is to make small. */
static void judge_pair(tally *into, const verifying *self, size_t texel, const float *stored,
                       const float *truth)
{
    const hc_map_info *info   = &self->map->info;
    const int          x      = (int)(texel % (size_t)info->width);
    const int          y      = (int)(texel / (size_t)info->width);
    const bool         none   = stored[0] == 0.0F || stored[1] == 0.0F; /* no cone, no fault */
    const bool         wrong  = !(stored[0] >= 0.0F && stored[1] >= 0.0F);
    double             excess = wrong ? INFINITY : 0.0;
    if (!wrong && !none) {
        excess = (double)hc_brute_excess(&self->field, x, y, stored[0], stored[1]);
    }
    if (excess > 1.0) {
        note_wider(into, 2, excess, texel);
    }
    const double slopes = 1.0 / limited(stored[0], info) + 1.0 / limited(stored[1], info);
    const double needed = 1.0 / limited(truth[0], info) + 1.0 / limited(truth[1], info);
    into->kept += 2.0 * needed / slopes;
}

static void judge_texel(tally *into, const verifying *self, size_t texel)
{
    const hc_map_info *info     = &self->map->info;
    const int          channels = hc_cones_channels(info->cones);
    const int          x        = (int)(texel % (size_t)info->width);
    const int          y        = (int)(texel / (size_t)info->width);
    float              truth[CONES_MAX];
    float              stored[CONES_MAX];
    hc_brute_ratios(&self->field, x, y, info->cones, truth);
    for (int c = 0; c < channels; c++) {
        stored[c] = hc_map_ratio_at(self->map, x, y, c);
    }
    int first = 0;
    if (info->cones == HC_CONES_ANISO) {
        judge_pair(into, self, texel, stored, truth);
        first = 2;
    }
    for (int c = first; c < channels; c++) {
        judge_ratio(into, info, stored[c], truth[c], texel);
    }
}

static void judge_chunk(void *context, int item, int worker)
{
    verifying    local  = *(const verifying *)context;
    const size_t first  = (size_t)item * local.chunk;
    const size_t end    = first + local.chunk < local.count ? first + local.chunk : local.count;
    tally        sums   = { .widest_factor = 1.0 };
    local.field.columns = local.columns + (size_t)worker * (size_t)local.map->info.width;
    for (size_t i = first; i < end; i++) {
        judge_texel(&sums, &local, local.chosen != NULL ? local.chosen[i] : i);
    }
    local.tallies[item] = sums;
}

/* ---- which texels ---------------------------------------------------------------------------- */

/* A one-to-one mixing of the numbers below 2^bits: each step can be undone. */
static uint64_t mixed(uint64_t value, int bits)
{
    const uint64_t mask = ((uint64_t)1 << bits) - 1;
    for (int round = 0; round < 3; round++) {
        value = (value * 0x9E3779B97F4A7C15U + 0x632BE59BD9B4E019U) & mask;
        value ^= value >> (bits / 2 + 1);
    }
    return value;
}

/* The first `count` of a fixed permutation of 0 .. texels - 1: numbers beyond are passed over. */
static void choose(size_t *chosen, size_t count, size_t texels)
{
    int bits = 1;
    while (((uint64_t)1 << bits) < texels) {
        bits++;
    }
    size_t found = 0;
    for (uint64_t i = 0; found < count; i++) {
        const uint64_t candidate = mixed(i, bits);
        if (candidate < texels) {
            chosen[found++] = (size_t)candidate;
        }
    }
}

/* ---- the whole map --------------------------------------------------------------------------- */

static bool stores_heights(const hc_map_info *info)
{
    return info->layout != HC_LAYOUT_QUAD;
}

static hc_result check(const hc_map *map, const hc_field *field, hc_log *log)
{
    const hc_map_info *info   = &map->info;
    hc_result          result = hc_map_info_check(info, log);
    if (result == HC_OK) {
        result = hc_field_check(field, log);
    }
    if (result != HC_OK) {
        return result;
    }
    if ((info->kind != HC_MAP_CONE && info->kind != HC_MAP_RELAXED)
        || info->layout == HC_LAYOUT_HEIGHT) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "a %s map in layout %s has no ratios to verify",
                       hc_map_kind_name(info->kind), hc_layout_name(info->layout));
    }
    if (info->width != field->width || info->height != field->height) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "the map has %d x %d texels, the field %d x %d",
                       info->width, info->height, field->width, field->height);
    }
    return HC_OK;
}

/* The heights that the map stores, and how many of them are not what the field's round to. */
static size_t decode_heights(float *heights, const hc_map *map, const hc_field *field)
{
    const int bits    = map->info.bits;
    size_t    differs = 0;
    size_t    i       = 0;
    for (int y = 0; y < map->info.height; y++) {
        for (int x = 0; x < map->info.width; x++, i++) {
            const float own    = field->heights[i];
            const float wanted = bits == 32 ? own : hc_code_height(hc_height_code(own, bits), bits);
            heights[i]         = hc_map_height_at(map, x, y);
            differs += heights[i] == wanted ? 0 : 1;
        }
    }
    return differs;
}

static void sum_up(hc_verdict *verdict, const verifying *self, size_t chunks)
{
    const size_t channels  = (size_t)hc_cones_channels(self->map->info.cones);
    const size_t width     = (size_t)self->map->info.width;
    double       kept      = 0.0;
    size_t       worst     = 0;
    verdict->checked       = self->count * channels;
    verdict->widest_factor = 1.0;
    for (size_t i = 0; i < chunks; i++) {
        const tally *part = &self->tallies[i];
        verdict->wider += part->wider;
        kept += part->kept;
        if (part->widest_factor > verdict->widest_factor) {
            verdict->widest_factor = part->widest_factor;
            worst                  = part->worst;
        }
    }
    verdict->mean_kept = kept / (double)verdict->checked;
    verdict->worst_x   = (int)(worst % width);
    verdict->worst_y   = (int)(worst / width);
}

static hc_brute_texel field_of(const hc_map_info *info, const float *heights)
{
    const hc_field like = { .width        = info->width,
                            .height       = info->height,
                            .wrap         = info->wrap,
                            .registration = info->registration };
    return (hc_brute_texel){ .heights = heights,
                             .width   = info->width,
                             .height  = info->height,
                             .wrap_u  = ((unsigned)info->wrap & HC_WRAP_U) != 0,
                             .wrap_v  = ((unsigned)info->wrap & HC_WRAP_V) != 0,
                             .step_u  = (float)hc_field_step_u(&like),
                             .step_v  = (float)hc_field_step_v(&like) };
}

/* All memory of a verification. */
typedef struct memory {
    float  *heights;
    size_t *chosen;
    tally  *tallies;
    int    *columns;
} memory;

static hc_result allocate(memory *taken, const hc_map_info *info, size_t count, size_t chunks,
                          int threads, hc_log *log)
{
    const size_t texels = (size_t)info->width * (size_t)info->height;
    taken->heights      = stores_heights(info) ? malloc(texels * sizeof(float)) : NULL;
    taken->chosen       = count < texels ? malloc(count * sizeof(size_t)) : NULL;
    taken->tallies      = malloc(chunks * sizeof(tally));
    taken->columns      = malloc((size_t)threads * (size_t)info->width * sizeof(int));
    if ((taken->heights == NULL && stores_heights(info))
        || (taken->chosen == NULL && count < texels) || taken->tallies == NULL
        || taken->columns == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory to verify %d x %d texels", info->width,
                       info->height);
    }
    return HC_OK;
}

hc_result hc_verify_map(hc_verdict *verdict, const hc_map *map, const hc_field *field,
                        size_t texels, int threads, hc_progress progress, hc_log *log)
{
    hc_result result = check(map, field, log);
    if (result != HC_OK) {
        return result;
    }
    const hc_map_info *info  = &map->info;
    const size_t       all   = (size_t)info->width * (size_t)info->height;
    const size_t       count = texels == 0 || texels > all ? all : texels;
    const size_t       least = (count + CHUNKS_MAX - 1) / CHUNKS_MAX;
    const size_t       chunk = least > CHUNK_MIN ? least : CHUNK_MIN;
    const size_t       parts = (count + chunk - 1) / chunk;
    memory             taken;
    threads = hc_threads_resolve(threads);
    result  = allocate(&taken, info, count, parts, threads, log);
    if (result == HC_OK) {
        *verdict = (hc_verdict){ .checked = 0 };
        if (taken.heights != NULL) {
            verdict->height_differs = decode_heights(taken.heights, map, field);
        }
        if (taken.chosen != NULL) {
            choose(taken.chosen, count, all);
        }
        const float *heights = taken.heights != NULL ? taken.heights : field->heights;
        verifying    self    = { map,          field_of(info, heights), count,        chunk,
                                 taken.chosen, taken.tallies,           taken.columns };
        result = hc_parallel_for((int)parts, threads, judge_chunk, &self, progress, log);
        if (result == HC_OK) {
            sum_up(verdict, &self, parts);
        }
    }
    free(taken.heights);
    free(taken.chosen);
    free(taken.tallies);
    free(taken.columns);
    return result;
}
