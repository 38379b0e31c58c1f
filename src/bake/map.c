/* Whole maps: what is stored is rounded first, and what is baked is baked from that. */
#include "base/fail.h"
#include "base/parallel.h"
#include "compat2006.h"
#include "quantise.h"
#include "texels.h"

#include <stdlib.h>

/* A map on its way, with what its rows are written from. */
typedef struct making {
    const hc_map         *map;
    const hc_field       *field;
    const hc_map_options *options;
    const float          *heights; /* those that the map will store */
    const float          *ratios;
    hc_log               *log;
} making;

typedef void (*row_writer)(const making *self, int y);

typedef struct rows {
    const making *self;
    row_writer    write;
} rows;

static void write_row(void *context, int y, int worker)
{
    (void)worker;
    const rows *job = context;
    job->write(job->self, y);
}

/* Short beside any search, so nothing is reported. */
static void write_rows(const making *self, row_writer write)
{
    rows job = { self, write };
    (void)hc_parallel_for(self->map->info.height, hc_threads_resolve(self->options->cone.threads),
                          write_row, &job, (hc_progress){ .report = NULL }, NULL);
}

static void write_cones(const making *self, int y)
{
    hc_put_cone_row(self->map, y, self->heights, self->ratios);
}

static void write_dummer_slopes(const making *self, int y)
{
    hc_put_dummer_slopes(self->map, y);
}

static void write_slopes(const making *self, int y)
{
    hc_put_slope_row(self->map, y, self->field);
}

static size_t samples(const hc_map_info *info)
{
    return (size_t)info->width * (size_t)info->height;
}

static hc_result out_of_memory(const making *self)
{
    return hc_fail(self->log, HC_ERROR_MEMORY, "no memory to bake a map of %d x %d texels",
                   self->map->info.width, self->map->info.height);
}

/* Ratios of the heights that will be stored. */
static hc_result bake_ratios(const making *self, float *ratios)
{
    hc_field        stored = *self->field;
    hc_cone_options cone   = self->options->cone;
    stored.heights         = self->heights;
    cone.max_ratio         = self->map->info.max_ratio;
    if (self->map->info.kind == HC_MAP_RELAXED && cone.method == HC_METHOD_EXACT) {
        cone.method = HC_METHOD_FALLING_EDGE;
    }
    const hc_map_baker *baker = self->options->baker;
    return baker != NULL ? baker->cones(baker->user, ratios, &stored, &cone, self->log)
                         : hc_bake_cone_map(ratios, &stored, &cone, self->log);
}

/* Float texels are baked in place: the ratios go to the end of the texels, and since each texel has
 * at least the ratios' channels, writing the texels from the first one on never overtakes the
 * reading. One thread, because of that order. */
static hc_result bake_float_cones(making *self)
{
    const hc_map_info *info   = &self->map->info;
    const size_t       cones  = (size_t)hc_cones_channels(info->cones);
    const size_t       spare  = (size_t)info->channels - cones;
    float             *ratios = (float *)self->map->texels + samples(info) * spare;
    self->heights             = self->field->heights;
    self->ratios              = ratios;
    const hc_result result    = bake_ratios(self, ratios);
    for (int y = 0; result == HC_OK && spare > 0 && y < info->height; y++) {
        write_cones(self, y);
    }
    return result;
}

static hc_result bake_coded_cones(making *self)
{
    const size_t cones  = (size_t)hc_cones_channels(self->map->info.cones);
    float       *ratios = malloc(samples(&self->map->info) * cones * sizeof *ratios);
    if (ratios == NULL) {
        return out_of_memory(self);
    }
    self->ratios           = ratios;
    const hc_result result = bake_ratios(self, ratios);
    if (result == HC_OK) {
        write_rows(self, write_cones);
    }
    if (result == HC_OK && self->map->info.layout == HC_LAYOUT_DUMMER) {
        write_rows(self, write_dummer_slopes);
    }
    free(ratios);
    return result;
}

/* Layout height: nothing to search for. */
static hc_result write_heights(making *self)
{
    self->heights = self->field->heights; /* rounding is in the codes */
    write_rows(self, write_cones);
    return HC_OK;
}

static hc_result bake_compat2006(making *self)
{
    const hc_map_info *info  = &self->map->info;
    uint8_t           *texel = self->map->texels;
    for (size_t i = 0; i < samples(info); i++) {
        texel[4 * i] = (uint8_t)hc_height_code(self->field->heights[i], 8);
    }
    return hc_compat2006(self->map->texels, info->width, info->height, info->wrap,
                         hc_threads_resolve(self->options->cone.threads),
                         self->options->cone.progress, self->log);
}

static hc_result bake_cones(making *self)
{
    const hc_map_info *info = &self->map->info;
    if (info->compat2006) {
        return bake_compat2006(self);
    }
    if (info->layout == HC_LAYOUT_HEIGHT) {
        return write_heights(self);
    }
    if (info->bits == 32) {
        return bake_float_cones(self);
    }
    if (info->layout == HC_LAYOUT_QUAD) { /* stores no heights: they stay as they are elsewhere */
        self->heights = self->field->heights;
        return bake_coded_cones(self);
    }
    float *rounded = malloc(samples(info) * sizeof *rounded);
    if (rounded == NULL) {
        return out_of_memory(self);
    }
    hc_round_heights(rounded, self->field->heights, samples(info), info->bits);
    self->heights          = rounded;
    const hc_result result = bake_coded_cones(self);
    free(rounded);
    return result;
}

static hc_result fill_pyramid(const making *self, hc_pyramid *pyramid, float *values,
                              const float *base, hc_extreme extreme)
{
    const hc_map_info  *info  = &self->map->info;
    const hc_map_baker *baker = self->options->baker;
    if (baker != NULL) {
        return baker->pyramid(baker->user, pyramid, values, base, info->width, info->height,
                              extreme, self->log);
    }
    hc_bake_pyramid(pyramid, values, base, info->width, info->height, extreme);
    return HC_OK;
}

static hc_result fill_bounds(const making *self, float *values, hc_extreme extreme)
{
    const hc_map_baker *baker = self->options->baker;
    if (baker != NULL) {
        return baker->bounds(baker->user, values, self->field, extreme, self->log);
    }
    hc_bake_bounds(values, self->field, extreme);
    return HC_OK;
}

/* One channel after the other, so that one pyramid's memory is enough. */
static hc_result bake_pyramids(making *self)
{
    const hc_map_info *info   = &self->map->info;
    float             *values = malloc(hc_pyramid_size(info->width, info->height) * sizeof *values);
    if (values == NULL) {
        return out_of_memory(self);
    }
    hc_result result = HC_OK;
    for (int channel = 0; channel < info->channels && result == HC_OK; channel++) {
        const hc_extreme extreme = channel == 0 ? HC_MAXIMUM : HC_MINIMUM;
        const float     *base    = self->field->heights;
        hc_pyramid       pyramid;
        if (info->kind == HC_MAP_BOUNDS) {
            result = fill_bounds(self, values, extreme);
            base   = values;
        }
        if (result == HC_OK) {
            result = fill_pyramid(self, &pyramid, values, base, extreme);
        }
        for (int level = 0; level < info->levels && result == HC_OK; level++) {
            const float *from = hc_pyramid_level(&pyramid, level, NULL, NULL);
            hc_put_extremes(self->map, level, channel, from, extreme);
        }
    }
    free(values);
    return result;
}

static hc_result bake_gradient(making *self)
{
    const hc_map_baker *baker = self->options->baker;
    if (self->map->info.bits == 32 && baker != NULL) {
        return baker->gradient(baker->user, self->map->texels, self->field, self->log);
    }
    if (self->map->info.bits == 32) {
        hc_bake_gradient(self->map->texels, self->field);
    } else {
        write_rows(self, write_slopes);
    }
    return HC_OK;
}

static bool same_shape(const hc_map_info *a, const hc_map_info *b)
{
    return a->kind == b->kind && a->layout == b->layout && a->cones == b->cones
           && a->bits == b->bits && a->width == b->width && a->height == b->height
           && a->channels == b->channels && a->levels == b->levels && a->wrap == b->wrap
           && a->registration == b->registration && a->max_ratio == b->max_ratio
           && a->compat2006 == b->compat2006;
}

hc_result hc_bake_map(hc_map *map, const hc_field *field, const hc_map_options *options,
                      hc_log *log)
{
    static const hc_map_options usual = { .bits = 0 };

    hc_map_info wanted;
    hc_result   result = hc_map_info_for(&wanted, field, options, log);
    if (result != HC_OK) {
        return result;
    }
    if (!same_shape(&map->info, &wanted) || map->texels == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       map->texels == NULL
                           ? "map.texels is NULL; allocate hc_map_bytes(&map.info)"
                           : "map.info differs from what hc_map_info_for says for these options");
    }
    making self = {
        .map = map, .field = field, .options = options != NULL ? options : &usual, .log = log
    };
    switch (wanted.kind) {
    case HC_MAP_CONE:
    case HC_MAP_RELAXED: return bake_cones(&self);
    case HC_MAP_PYRAMID:
    case HC_MAP_BOUNDS: return bake_pyramids(&self);
    case HC_MAP_GRADIENT: return bake_gradient(&self);
    }
    return HC_ERROR_ARGUMENT; /* refused above */
}
