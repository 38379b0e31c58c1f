#include "gpu.h"

#include "base/clock.h"
#include "base/fail.h"
#include "gl/program.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRIAL_SIDE = 64, TRIALS = TRIAL_SIDE * TRIAL_SIDE, GROUP = 8, LOOKS = 1024 };

/* ---- programs ------------------------------------------------------------------------------- */

static const char *part_of(hc_gpu_shader shader)
{
    switch (shader) {
    case HC_GPU_BRUTE:
    case HC_GPU_EXACT:
    case HC_GPU_UPDATE:
    case HC_GPU_GEMS: return "bake_search.comp";
    case HC_GPU_QUICK: return "bake_quick.comp";
    default: return "bake_samples.comp";
    }
}

hc_result hc_gpu_use(hc_gpu *gpu, unsigned *program, hc_gpu_shader shader, bool l2, bool sided,
                     hc_log *log)
{
    char head[128];
    (void)snprintf(head, sizeof head,
                   "#version 430 core\n#define HC_BAKE %d\n#define HC_L2 %d\n#define HC_SIDED %d\n",
                   (int)shader, l2 ? 1 : 0, sided ? 1 : 0);
    const char        *part   = part_of(shader);
    const hc_gl_recipe recipe = { .head    = head,
                                  .compute = { { "bake.comp", hc_shader_text_named("bake.comp") },
                                               { part, hc_shader_text_named(part) } } };
    *program                  = 0;
    const hc_result result    = hc_gl_program_of(program, &gpu->context, &recipe, log);
    glUseProgram(*program);
    return result;
}

void hc_gpu_set_pair(unsigned program, const char *name, int x, int y)
{
    glUniform2i(glGetUniformLocation(program, name), x, y);
}

static unsigned groups(int first, int end)
{
    return (unsigned)((end - first + GROUP - 1) / GROUP);
}

static void dispatch(unsigned program, const int first[2], const int end[2], unsigned across,
                     unsigned down)
{
    hc_gpu_set_pair(program, "u_first", first[0], first[1]);
    hc_gpu_set_pair(program, "u_end", end[0], end[1]);
    glDispatchCompute(across, down, 1);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT
                    | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_ATOMIC_COUNTER_BARRIER_BIT
                    | GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

/* One group, all of it beyond the last texel. */
void hc_gpu_warm_up(hc_gpu *gpu, unsigned program)
{
    static const int none[2] = { 0, 0 };
    if (hc_gl_first_run(&gpu->context, program)) {
        dispatch(program, none, none, 1, 1);
        glFinish();
    }
}

void hc_gpu_dispatch(unsigned program, const int first[2], const int end[2])
{
    dispatch(program, first, end, groups(first[0], end[0]), groups(first[1], end[1]));
}

/* Between two time stamps that the GPU took. */
static double seconds_between(const unsigned stamps[2])
{
    GLuint64 times[2];
    for (int i = 0; i < 2; i++) {
        glGetQueryObjectui64v(stamps[i], GL_QUERY_RESULT, &times[i]);
    }
    return 1e-9 * (double)(times[1] - times[0]);
}

void hc_gpu_start(hc_gpu *gpu)
{
    gpu->started = hc_clock_now();
    glGenQueries(2, gpu->stamps);
    glQueryCounter(gpu->stamps[0], GL_TIMESTAMP);
}

/* The stamp is taken when the work is done, before anybody waits for it. */
double hc_gpu_stop(hc_gpu *gpu)
{
    glQueryCounter(gpu->stamps[1], GL_TIMESTAMP);
    glFinish();
    const double by_clock = hc_clock_now() - gpu->started;
    gpu->seconds += gpu->timer ? seconds_between(gpu->stamps) : by_clock;
    glDeleteQueries(2, gpu->stamps);
    return by_clock;
}

double hc_gpu_run(hc_gpu *gpu, unsigned program, const int first[2], const int end[2])
{
    hc_gpu_warm_up(gpu, program);
    hc_gpu_start(gpu);
    hc_gpu_dispatch(program, first, end);
    return hc_gpu_stop(gpu);
}

/* ---- textures ------------------------------------------------------------------------------- */

static hc_result make_texture(unsigned *texture, GLenum format, int width, int height, int levels,
                              const float *values, hc_log *log)
{
    const hc_result result = hc_gl_check_size(width, height, "field", log);
    if (result != HC_OK) {
        return result;
    }
    glGenTextures(1, texture);
    glBindTexture(GL_TEXTURE_2D, *texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexStorage2D(GL_TEXTURE_2D, levels, format, width, height);
    if (values != NULL) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_FLOAT, values);
    }
    return hc_gl_check("field", log);
}

hc_result hc_gpu_texture(unsigned *texture, int width, int height, int levels, const float *values,
                         hc_log *log)
{
    return make_texture(texture, GL_R32F, width, height, levels, values, log);
}

hc_result hc_gpu_empty_texture(unsigned *texture, int width, int height, int channels, hc_log *log)
{
    return make_texture(texture, channels == 1 ? GL_R32F : GL_RGBA32F, width, height, 1, NULL, log);
}

/* ---- arithmetic ----------------------------------------------------------------------------- */

/* Distances and their squares, as fields of all sizes have them, with all bits in use. */
static void fill_trials(float trials[TRIALS])
{
    uint32_t bits = 1;
    for (int i = 0; i < TRIALS; i++) {
        bits      = bits * 1664525U + 1013904223U;
        trials[i] = ldexpf(1.0F + (float)(bits >> 9) * 0x1p-23F, i % 48 - 40);
    }
}

static bool same_weights(const float weights[TRIALS], const float trials[TRIALS], bool l2)
{
    for (int i = 0; i < TRIALS; i++) {
        const float wanted = 1.0F / (l2 ? sqrtf(trials[i]) : trials[i]);
        if (weights[i] != wanted) {
            return false;
        }
    }
    return true;
}

static hc_result try_weights(hc_gpu *gpu, bool l2, hc_log *log)
{
    static const int first[2] = { 0, 0 }, end[2] = { TRIAL_SIDE, TRIAL_SIDE };
    unsigned         textures[2] = { 0, 0 }, program;
    float            trials[TRIALS], weights[TRIALS];
    fill_trials(trials);
    const int side   = TRIAL_SIDE;
    hc_result result = hc_gpu_use(gpu, &program, HC_GPU_ROUNDING, l2, false, log);
    if (result == HC_OK) {
        result = hc_gpu_texture(&textures[0], side, side, 1, NULL, log);
    }
    if (result == HC_OK) {
        result = hc_gpu_texture(&textures[1], side, side, 1, trials, log);
    }
    if (result == HC_OK) {
        glBindImageTexture(0, textures[0], 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
        glUniform1i(glGetUniformLocation(program, "u_heights"), 0);
        (void)hc_gpu_run(gpu, program, first, end);
        glBindTexture(GL_TEXTURE_2D, textures[0]);
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, weights);
        result      = hc_gl_check("trial of arithmetic", log);
        gpu->rounds = gpu->rounds && same_weights(weights, trials, l2);
    }
    glDeleteTextures(2, textures);
    return result;
}

/* ---- making and ending ---------------------------------------------------------------------- */

hc_result hc_gpu_begin(hc_gpu *gpu, hc_log *log)
{
    gpu->seconds = 0.0;
    return hc_gl_use(&gpu->context, log);
}

/* Mesa's renderers on the CPU, whose timers count other things. */
static bool is_software(const char *name)
{
    return strstr(name, "llvmpipe") != NULL || strstr(name, "softpipe") != NULL;
}

hc_result hc_gpu_create(hc_gpu **gpu, hc_log *log)
{
    *gpu         = NULL;
    hc_gpu *made = calloc(1, sizeof *made);
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a context");
    }
    made->rounds     = true;
    made->looks      = LOOKS;
    hc_result result = hc_gl_open(&made->context, log);
    if (result == HC_OK) {
        (void)snprintf(made->name, sizeof made->name, "%s", (const char *)glGetString(GL_RENDERER));
        (void)snprintf(made->driver, sizeof made->driver, "%s, OpenGL %s",
                       (const char *)glGetString(GL_VENDOR), (const char *)glGetString(GL_VERSION));
        made->timer = !is_software(made->name);
        result      = try_weights(made, false, log);
        result      = result == HC_OK ? try_weights(made, true, log) : result;
    }
    if (result != HC_OK) {
        hc_gpu_destroy(made);
        return result;
    }
    *gpu = made;
    return HC_OK;
}

const char *hc_gpu_timer(const hc_gpu *gpu)
{
    return gpu->timer ? "GPU time stamps" : "wall clock, all finished";
}

/* With the context go its programs. */
void hc_gpu_destroy(hc_gpu *gpu)
{
    if (gpu != NULL) {
        hc_gl_close(&gpu->context);
        free(gpu);
    }
}

const char *hc_gpu_name(const hc_gpu *gpu)
{
    return gpu->name;
}

const char *hc_gpu_driver(const hc_gpu *gpu)
{
    return gpu->driver;
}

bool hc_gpu_rounds(const hc_gpu *gpu)
{
    return gpu->rounds;
}

double hc_gpu_seconds(const hc_gpu *gpu)
{
    return gpu->seconds;
}
