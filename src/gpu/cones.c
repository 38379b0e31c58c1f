/* hc_bake_cone_map's work on the GPU: each search of a job into a texture of steepness, which the
 * CPU turns into ratios. */
#include "cones.h"

#include "base/fail.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdlib.h>

enum {
    ROWS_AT_FIRST = 16,
    WAITING_ROW   = 1024,    /* searches that go on */
    BRUTE_TEXELS  = 1 << 14, /* of a dispatch that looks at all samples */
    FALLING       = 4        /* searches of relaxed cones */
};

/* Dispatches are made smaller and larger to take this long. */
static const double PIECE_SECONDS = 0.05;

static size_t samples(const hc_gpu_baking *b)
{
    return (size_t)b->job->width * (size_t)b->job->height;
}

/* ---- pieces --------------------------------------------------------------------------------- */

static hc_result report(const hc_gpu_baking *b, double share)
{
    const hc_progress *progress = &b->job->progress;
    const double       all      = (b->current + share) / b->count;
    return progress->report == NULL || progress->report(progress->user, all) ? HC_OK
                                                                             : HC_ERROR_CANCELLED;
}

static int paced(int rows, double seconds)
{
    const int more = seconds < 0.125 * PIECE_SECONDS ? 4 : seconds < 0.5 * PIECE_SECONDS ? 2 : 1;
    const int less = seconds > 2.0 * PIECE_SECONDS && rows > 1 ? 2 : 1;
    return rows > HC_SIDE_MAX ? rows : rows * more / less;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Searches that took more looks than one dispatch allows. */
static hc_result go_on(const hc_gpu_baking *b, unsigned program, int row, int end_row)
{
    const int waiting  = (int)hc_gpu_count(b, HC_GPU_UNFINISHED);
    const int first[2] = { 0, 0 };
    const int end[2]   = { WAITING_ROW, (waiting + WAITING_ROW - 1) / WAITING_ROW };
    hc_result result   = HC_OK;
    glUniform1i(glGetUniformLocation(program, "u_resume"), 1);
    glUniform1i(glGetUniformLocation(program, "u_waiting"), waiting);
    for (int left = waiting; left > 0 && result == HC_OK;) {
        const double rows = end_row - row - (double)left / b->job->width;
        result            = report(b, (row + rows) / b->job->height);
        hc_gpu_set_count(b, HC_GPU_UNFINISHED, 0);
        if (result == HC_OK) {
            (void)hc_gpu_run(b->gpu, program, first, end);
            left   = (int)hc_gpu_count(b, HC_GPU_UNFINISHED);
            result = hc_gl_check("baking", b->job->log);
        }
    }
    glUniform1i(glGetUniformLocation(program, "u_resume"), 0);
    return result;
}

/* All texels, some rows at a time. */
static hc_result run_rows(const hc_gpu_baking *b, unsigned program, bool pruned)
{
    const int most   = HC_GPU_WAITING_MAX / least(b->job->width, HC_GPU_WAITING_MAX);
    hc_result result = HC_OK;
    int       rows   = least(ROWS_AT_FIRST, most);
    for (int y = 0; y < b->job->height && result == HC_OK;) {
        const int first[2] = { 0, y };
        const int end[2]   = { b->job->width, least(y + rows, b->job->height) };
        rows               = least(paced(rows, hc_gpu_run(b->gpu, program, first, end)), most);
        result             = hc_gl_check("baking", b->job->log);
        if (result == HC_OK && pruned) {
            result = go_on(b, program, y, end[1]);
        }
        y      = end[1];
        result = result == HC_OK ? report(b, (double)y / b->job->height) : result;
    }
    return result;
}

/* Some texels against all samples, some rows of them at a time. before: texels that are done. */
static hc_result run_against_all(const hc_gpu_baking *b, unsigned program, const int first[2],
                                 const int end[2], double before, int *rows)
{
    const double texels = (end[0] - first[0]) * (double)(end[1] - first[1]);
    hc_result    result = HC_OK;
    for (int y = 0; y < b->job->height && result == HC_OK;) {
        const int next = least(y + *rows, b->job->height);
        hc_gpu_set_pair(program, "u_rows", y, next);
        glUniform1i(glGetUniformLocation(program, "u_go_on"), y > 0);
        *rows  = paced(*rows, hc_gpu_run(b->gpu, program, first, end));
        y      = next;
        result = hc_gl_check("baking", b->job->log);
        if (result == HC_OK) {
            const double done = before + texels * ((double)y / b->job->height);
            result            = report(b, done / (double)samples(b));
        }
    }
    return result;
}

static hc_result run_brute(const hc_gpu_baking *b, unsigned program)
{
    const int width  = b->job->width;
    const int height = b->job->height;
    const int deep   = BRUTE_TEXELS / least(width, BRUTE_TEXELS);
    hc_result result = HC_OK;
    int       rows   = 1;
    for (int y = 0; y < height && result == HC_OK; y += deep) {
        for (int x = 0; x < width && result == HC_OK; x += BRUTE_TEXELS) {
            const int    first[2] = { x, y };
            const int    end[2]   = { least(x + BRUTE_TEXELS, width), least(y + deep, height) };
            const double before   = (double)y * width + (double)x * (end[1] - y);
            result                = run_against_all(b, program, first, end, before, &rows);
        }
    }
    return result;
}

/* ---- searches ------------------------------------------------------------------------------- */

static void set_search(const hc_gpu_baking *b, unsigned program)
{
    const hc_cone_search *search = &b->searches[b->current];
    const bool            centre =
        b->method == HC_METHOD_QUICK_CENTRE || b->method == HC_METHOD_QUICK_NAIVE_CENTRE;
    const bool improved =
        b->method == HC_METHOD_QUICK_IMPROVED || b->method == HC_METHOD_QUICK_CENTRE;
    hc_gpu_set_pair(program, "u_size", b->job->width, b->job->height);
    hc_gpu_set_pair(program, "u_wraps", b->job->wrap_u, b->job->wrap_v);
    hc_gpu_set_pair(program, "u_sides", search->sign_u, search->sign_v);
    glUniform2f(glGetUniformLocation(program, "u_step"), search->step_u, search->step_v);
    glUniform1i(glGetUniformLocation(program, "u_levels"),
                hc_pyramid_levels(b->job->width, b->job->height));
    glUniform1i(glGetUniformLocation(program, "u_heights"), HC_GPU_HEIGHTS_UNIT);
    glUniform1i(glGetUniformLocation(program, "u_highest"), HC_GPU_BLOCKS_UNIT);
    glUniform1i(glGetUniformLocation(program, "u_families"), HC_GPU_BLOCKS_UNIT);
    glUniform1i(glGetUniformLocation(program, "u_top_level"), hc_gpu_top_level(b));
    glUniform1i(glGetUniformLocation(program, "u_looks"), b->gpu->looks);
    glUniform1i(glGetUniformLocation(program, "u_resume"), 0);
    glUniform1i(glGetUniformLocation(program, "u_improved"), improved);
    glUniform1i(glGetUniformLocation(program, "u_gems_steps"), b->job->gems_steps);
    glUniform1i(glGetUniformLocation(program, "u_centre"), centre);
    glUniform1i(glGetUniformLocation(program, "u_go_on"),
                b->method == HC_METHOD_FALLING_EDGE && b->current > 0);
}

static void bind_best(unsigned texture)
{
    glBindImageTexture(HC_GPU_BEST_UNIT, texture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
}

static void set_change(unsigned program, const hc_gpu_change *change)
{
    GLint         rects[HC_CHANGES_MAX][4];
    float         tops[HC_CHANGES_MAX], top = -1.0F;
    const hc_rect all = change->rect;
    for (int i = 0; i < change->count; i++) {
        const hc_rect r = change->pieces[i].rect;
        rects[i][0]     = r.x;
        rects[i][1]     = r.y;
        rects[i][2]     = r.x + r.width - 1;
        rects[i][3]     = r.y + r.height - 1;
        tops[i]         = change->pieces[i].top;
        top             = fmaxf(top, tops[i]);
    }
    glUniform4i(glGetUniformLocation(program, "u_changed"), all.x, all.y, all.x + all.width - 1,
                all.y + all.height - 1);
    glUniform1f(glGetUniformLocation(program, "u_top"), top);
    glUniform1i(glGetUniformLocation(program, "u_piece_count"), change->count);
    glUniform4iv(glGetUniformLocation(program, "u_pieces"), change->count, rects[0]);
    glUniform1fv(glGetUniformLocation(program, "u_tops"), change->count, tops);
}

static hc_gpu_shader shader_of(const hc_gpu_baking *b)
{
    switch (b->method) {
    case HC_METHOD_EXACT: return b->change != NULL ? HC_GPU_UPDATE : HC_GPU_EXACT;
    case HC_METHOD_FALLING_EDGE: return HC_GPU_EXACT;
    case HC_METHOD_BRUTE: return HC_GPU_BRUTE;
    case HC_METHOD_GEMS: return HC_GPU_GEMS;
    default: return HC_GPU_QUICK;
    }
}

hc_result hc_gpu_search(const hc_gpu_baking *b)
{
    const bool sided = b->searches[b->current].sign_u != 0;
    unsigned   program;
    hc_result  result = HC_OK;
    if (hc_gpu_walks(b->method) == HC_GPU_LIMITING) {
        const hc_rect all = { 0, 0, b->job->width, b->job->height };
        result            = hc_gpu_fill_blocks(b, all);
    }
    if (result == HC_OK) {
        result = hc_gpu_use(b->gpu, &program, shader_of(b), b->l2, sided, b->job->log);
    }
    if (result != HC_OK) {
        return result;
    }
    set_search(b, program);
    if (b->change != NULL) {
        set_change(program, b->change);
    }
    bind_best(b->best);
    if (b->method == HC_METHOD_BRUTE) {
        return run_brute(b, program);
    }
    return run_rows(b, program, hc_gpu_walks(b->method) >= HC_GPU_ALL);
}

/* ---- planning ------------------------------------------------------------------------------- */

/* Relaxed cones are searched by quadrants, too. */
hc_gpu_baking hc_gpu_plan(hc_gpu *gpu, const hc_cone_job *job, const hc_cone_options *options)
{
    hc_gpu_baking b = {
        .gpu = gpu, .job = job, .method = options->method, .l2 = options->cones == HC_CONES_L2
    };
    b.count = hc_cone_searches(b.searches, job);
    if (b.method == HC_METHOD_FALLING_EDGE) {
        for (int i = 0; i < FALLING; i++) {
            b.searches[i] = (hc_cone_search){ .step_u = job->step_u,
                                              .step_v = job->step_v,
                                              .sign_u = i % 2 == 0 ? 1 : -1,
                                              .sign_v = i / 2 == 0 ? 1 : -1 };
        }
        b.count = FALLING;
    }
    return b;
}

int hc_gpu_finds(const hc_gpu_baking *b)
{
    return b->method == HC_METHOD_FALLING_EDGE ? 1 : b->count;
}

/* ---- ratios, read back ---------------------------------------------------------------------- */

float hc_gpu_outwards(const hc_gpu *gpu)
{
    return gpu->rounds ? 1.0F : 1.0F + 0x1p-18F;
}

static hc_result read_back(const hc_gpu_baking *b, float *steepness)
{
    glActiveTexture(GL_TEXTURE0 + HC_GPU_BEST_UNIT);
    glBindTexture(GL_TEXTURE_2D, b->best);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT,
                  steepness + (hc_gpu_finds(b) == 1 ? 0 : (size_t)b->current * samples(b)));
    return hc_gl_check("reading back", b->job->log);
}

static void write_ratios(const hc_gpu_baking *b, const float *found)
{
    const size_t count    = samples(b);
    const int    channels = b->job->channels;
    for (size_t i = 0; i < count; i++) {
        float steepness[HC_CONE_SEARCHES_MAX];
        for (int k = 0; k < hc_gpu_finds(b); k++) {
            steepness[k] = found[(size_t)k * count + i] * hc_gpu_outwards(b->gpu);
        }
        hc_write_ratios(b->job->ratios + i * (size_t)channels, b->job->cones, steepness);
    }
}

static hc_result bake(hc_gpu_baking *b, float *steepness)
{
    const hc_cone_job *job = b->job;
    glActiveTexture(GL_TEXTURE0 + HC_GPU_BEST_UNIT);
    hc_result result = hc_gpu_texture(&b->best, job->width, job->height, 1, NULL, job->log);
    result           = result == HC_OK ? hc_gpu_load(b) : result;
    for (b->current = 0; b->current < b->count && result == HC_OK; b->current++) {
        result = hc_gpu_search(b);
        result = result == HC_OK ? read_back(b, steepness) : result;
    }
    if (result == HC_OK) {
        write_ratios(b, steepness);
    }
    glDeleteTextures(1, &b->best);
    hc_gpu_unload(b);
    return result;
}

hc_result hc_gpu_check_method(hc_method method, hc_log *log)
{
    return method != HC_METHOD_RING
               ? HC_OK
               : hc_fail(log, HC_ERROR_UNSUPPORTED,
                         "options.method ring is the CPU's alone; exact gives the same");
}

hc_result hc_gpu_bake_cone_map(hc_gpu *gpu, float *ratios, const hc_field *field,
                               const hc_cone_options *options, hc_log *log)
{
    const hc_cone_options given = options != NULL ? *options : (hc_cone_options){ 0 };
    hc_cone_job           job;
    hc_result             result = hc_cone_job_init(&job, ratios, field, &given, log);
    result = result == HC_OK ? hc_gpu_check_method(given.method, log) : result;
    result = result == HC_OK ? hc_gpu_begin(gpu, log) : result;
    if (result != HC_OK) {
        return result;
    }
    hc_gpu_baking b         = hc_gpu_plan(gpu, &job, &given);
    float        *steepness = malloc(samples(&b) * (size_t)hc_gpu_finds(&b) * sizeof *steepness);
    if (steepness == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for what the GPU finds");
    }
    result = bake(&b, steepness);
    free(steepness);
    if (result == HC_OK) {
        hc_limit_ratios(ratios, samples(&b) * (size_t)job.channels, given.max_ratio);
    }
    return result;
}
