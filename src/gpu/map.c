/* Maps that stay: heights, what searches found and ratios in textures, from one change to the
 * next. */
#include "cones.h"

#include "base/fail.h"
#include "gl/map.h"

#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

typedef struct kept_map {
    struct hc_gpu_map shown; /* first: what the world has a pointer to */
    hc_gpu           *gpu;
    hc_cone_job       job; /* log and progress: of the call that is running */
    hc_gpu_baking     baking;
    float            *heights;
    float             max_ratio;
    unsigned          found[HC_CONE_SEARCHES_MAX];
    unsigned          samples; /* ratios of samples */
} kept_map;

static size_t samples_of(const kept_map *map)
{
    return (size_t)map->job.width * (size_t)map->job.height;
}

/* ---- ratios --------------------------------------------------------------------------------- */

static void run_over_all(const kept_map *map, unsigned program, unsigned out)
{
    const int first[2] = { 0, 0 };
    const int end[2]   = { map->job.width, map->job.height };
    glBindImageTexture(1, out, 0, GL_FALSE, 0, GL_WRITE_ONLY,
                       map->job.channels == 1 ? GL_R32F : GL_RGBA32F);
    (void)hc_gpu_run(map->gpu, program, first, end);
}

static hc_result to_ratios(const kept_map *map)
{
    GLint           units[HC_CONE_SEARCHES_MAX];
    unsigned        program;
    const hc_result result =
        hc_gpu_use(map->gpu, &program, HC_GPU_RATIOS, false, false, map->job.log);
    if (result != HC_OK) {
        return result;
    }
    for (int i = 0; i < HC_CONE_SEARCHES_MAX; i++) {
        units[i] = HC_GPU_FREE_UNIT + i;
        glActiveTexture(GL_TEXTURE0 + (GLenum)units[i]);
        glBindTexture(GL_TEXTURE_2D, map->found[i]);
    }
    glUniform1iv(glGetUniformLocation(program, "u_found"), HC_CONE_SEARCHES_MAX, units);
    glUniform1i(glGetUniformLocation(program, "u_searches"), hc_gpu_finds(&map->baking));
    glUniform1f(glGetUniformLocation(program, "u_outwards"), hc_gpu_outwards(map->gpu));
    glUniform1f(glGetUniformLocation(program, "u_max_ratio"), map->max_ratio);
    run_over_all(map, program, map->samples);
    return hc_gl_check("ratios", map->job.log);
}

static hc_result to_cells(const kept_map *map)
{
    unsigned        program;
    const hc_result result =
        hc_gpu_use(map->gpu, &program, HC_GPU_CELLS, false, false, map->job.log);
    if (result != HC_OK) {
        return result;
    }
    hc_gpu_set_pair(program, "u_size", map->job.width, map->job.height);
    hc_gpu_set_pair(program, "u_wraps", map->job.wrap_u, map->job.wrap_v);
    glActiveTexture(GL_TEXTURE0 + HC_GPU_FREE_UNIT);
    glBindTexture(GL_TEXTURE_2D, map->samples);
    glUniform1i(glGetUniformLocation(program, "u_ratios"), HC_GPU_FREE_UNIT);
    run_over_all(map, program, map->shown.ratios);
    return hc_gl_check("ratios", map->job.log);
}

/* ---- searches ------------------------------------------------------------------------------- */

/* *searched: how many searches of a sample were run. */
static hc_result search_all(kept_map *map, size_t *searched)
{
    hc_gpu_baking *b      = &map->baking;
    hc_result      result = HC_OK;
    hc_gpu_bind(b);
    *searched = 0;
    for (b->current = 0; b->current < b->count && result == HC_OK; b->current++) {
        b->best = map->found[hc_gpu_finds(b) == 1 ? 0 : b->current];
        if (b->change != NULL) {
            hc_gpu_set_count(b, HC_GPU_SEARCHED, 0);
        }
        result = hc_gpu_search(b);
        *searched += b->change != NULL ? hc_gpu_count(b, HC_GPU_SEARCHED) : samples_of(map);
    }
    b->current = 0;
    result     = result == HC_OK ? to_ratios(map) : result;
    return result == HC_OK && map->shown.cells ? to_cells(map) : result;
}

/* ---- making --------------------------------------------------------------------------------- */

static hc_result take_textures(kept_map *map)
{
    const hc_cone_job *job    = &map->job;
    hc_result          result = HC_OK;
    glActiveTexture(GL_TEXTURE0 + HC_GPU_FREE_UNIT);
    for (int i = 0; i < hc_gpu_finds(&map->baking) && result == HC_OK; i++) {
        result = hc_gpu_texture(&map->found[i], job->width, job->height, 1, NULL, job->log);
    }
    if (result == HC_OK) {
        result =
            hc_gpu_empty_texture(&map->samples, job->width, job->height, job->channels, job->log);
    }
    if (result == HC_OK && map->shown.cells) {
        result = hc_gpu_empty_texture(&map->shown.ratios, job->width, job->height, job->channels,
                                      job->log);
    }
    result             = result == HC_OK ? hc_gpu_load(&map->baking) : result;
    map->shown.heights = map->baking.heights;
    map->shown.ratios  = map->shown.cells ? map->shown.ratios : map->samples;
    return result;
}

static hc_result copy_field(kept_map *map, const hc_field *field, hc_log *log)
{
    map->heights = malloc(samples_of(map) * sizeof *map->heights);
    if (map->heights == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a map of %d x %d samples", field->width,
                       field->height);
    }
    memcpy(map->heights, field->heights, samples_of(map) * sizeof *map->heights);
    map->job.heights         = map->heights;
    map->shown.field         = *field;
    map->shown.field.heights = map->heights;
    return HC_OK;
}

static hc_result make(kept_map *map, hc_gpu *gpu, const hc_field *field,
                      const hc_gpu_map_options *options, hc_log *log)
{
    const hc_method method = options->cone.method;
    size_t          searched;
    hc_result       result = hc_cone_job_init(&map->job, NULL, field, &options->cone, log);
    result                 = result == HC_OK ? hc_gpu_check_method(method, log) : result;
    result                 = result == HC_OK ? hc_gpu_begin(gpu, log) : result;
    if (result != HC_OK) {
        return result;
    }
    map->gpu       = gpu;
    map->max_ratio = options->cone.max_ratio;
    map->shown     = (struct hc_gpu_map){ .context = &gpu->context,
                                          .cones   = options->cone.cones,
                                          .cells   = options->cells,
                                          .relaxed = method == HC_METHOD_GEMS
                                                     || method == HC_METHOD_FALLING_EDGE };
    result         = copy_field(map, field, log);
    if (result == HC_OK) {
        map->baking = hc_gpu_plan(gpu, &map->job, &options->cone);
        result      = take_textures(map);
    }
    return result == HC_OK ? search_all(map, &searched) : result;
}

hc_result hc_gpu_map_create(hc_gpu_map **map, hc_gpu *gpu, const hc_field *field,
                            const hc_gpu_map_options *options, hc_log *log)
{
    const hc_gpu_map_options given = options != NULL ? *options : (hc_gpu_map_options){ 0 };
    kept_map                *made  = calloc(1, sizeof *made);
    *map                           = NULL;
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a map");
    }
    const hc_result result = make(made, gpu, field, &given, log);
    if (result != HC_OK) {
        hc_gpu_map_destroy(&made->shown);
        return result;
    }
    made->job.log = NULL;
    *map          = &made->shown;
    return HC_OK;
}

void hc_gpu_map_destroy(hc_gpu_map *map)
{
    kept_map *kept = (kept_map *)map;
    if (kept != NULL && kept->gpu != NULL && hc_gl_use(&kept->gpu->context, NULL) == HC_OK) {
        glDeleteTextures(HC_CONE_SEARCHES_MAX, kept->found);
        glDeleteTextures(1, &kept->samples);
        hc_gpu_unload(&kept->baking);
        if (kept->shown.cells) {
            glDeleteTextures(1, &kept->shown.ratios);
        }
    }
    if (kept != NULL) {
        free(kept->heights);
        free(kept);
    }
}

/* ---- changes -------------------------------------------------------------------------------- */

static float height_before(const void *owner, int x, int y)
{
    const kept_map *map = owner;
    return map->heights[(size_t)y * (size_t)map->job.width + (size_t)x];
}

static void upload(const kept_map *map, unsigned texture, const float *heights, hc_rect r)
{
    const float *first = heights + (size_t)r.y * (size_t)map->job.width + (size_t)r.x;
    glActiveTexture(GL_TEXTURE0 + HC_GPU_FREE_UNIT);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, map->job.width);
    glTexSubImage2D(GL_TEXTURE_2D, 0, r.x, r.y, r.width, r.height, GL_RED, GL_FLOAT, first);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

static hc_result take_over(kept_map *map, const float *heights, hc_rect r)
{
    const size_t width  = (size_t)map->job.width;
    hc_result    result = HC_OK;
    upload(map, map->baking.heights, heights, r);
    if (hc_gpu_walks(map->baking.method) == HC_GPU_MIPS) {
        upload(map, map->baking.blocks, heights, r);
    }
    if (hc_gpu_walks(map->baking.method) != HC_GPU_LIMITING) {
        hc_gpu_bind(&map->baking);
        result = hc_gpu_fill_blocks(&map->baking, r);
    }
    for (size_t y = (size_t)r.y; y < (size_t)(r.y + r.height); y++) {
        const size_t first = y * width + (size_t)r.x;
        memcpy(map->heights + first, heights + first, (size_t)r.width * sizeof *heights);
    }
    return result;
}

hc_result hc_gpu_map_update(hc_gpu_map *map, const float *heights, hc_rect changed, size_t *rebaked,
                            hc_log *log)
{
    kept_map     *kept     = (kept_map *)map;
    size_t        searched = 0;
    hc_gpu_change change   = { .rect = changed };
    hc_result result = hc_check_change(heights, kept->job.width, kept->job.height, changed, log);
    result           = result == HC_OK ? hc_gpu_begin(kept->gpu, log) : result;
    if (result == HC_OK) {
        change.count =
            hc_find_changes(change.pieces, heights, kept->job.width, changed, height_before, kept);
    }
    if (change.count > 0) {
        kept->job.log       = log;
        kept->baking.change = kept->baking.method == HC_METHOD_EXACT ? &change : NULL;
        result              = take_over(kept, heights, changed);
        result              = result == HC_OK ? search_all(kept, &searched) : result;
        kept->baking.change = NULL;
        kept->job.log       = NULL;
    }
    if (rebaked != NULL) {
        *rebaked = searched;
    }
    return result;
}

/* ---- reading back --------------------------------------------------------------------------- */

hc_result hc_gpu_map_read(const hc_gpu_map *map, float *ratios, hc_log *log)
{
    static const GLenum layouts[] = { 0, GL_RED, 0, GL_RGB, GL_RGBA };
    const hc_result     result    = hc_gl_use(map->context, log);
    if (result != HC_OK) {
        return result;
    }
    glActiveTexture(GL_TEXTURE0 + HC_GPU_FREE_UNIT);
    glBindTexture(GL_TEXTURE_2D, map->ratios);
    glGetTexImage(GL_TEXTURE_2D, 0, layouts[hc_cones_channels(map->cones)], GL_FLOAT, ratios);
    return hc_gl_check("reading back", log);
}
