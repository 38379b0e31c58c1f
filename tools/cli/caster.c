#include "caster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rays at a time: buffers of some 25 MB, and threads that are kept busy. */
enum { PIECE = 1 << 18 };

static bool by_reference(const hc_cli_caster *c)
{
    return c->cli->settings.rays.method == hc_trace_method_count();
}

/* ---- opening --------------------------------------------------------------------------------- */

static int open_tracer(hc_cli_caster *c, hc_cli_scene *scene)
{
    const hc_trace_method method =
        by_reference(c) ? HC_TRACE_MAXMIP : (hc_trace_method)c->cli->settings.rays.method;
    const int code = hc_cli_scene_ratios(scene, c->cli, hc_trace_method_needs(method));
    if (code != HC_CLI_DONE) {
        return code;
    }
    const hc_trace_options options = hc_cli_scene_options(scene, c->cli, method);
    hc_cli_phase(c->cli, "build");
    const hc_result result = hc_tracer_create(&c->tracer, &scene->field, &options, &c->cli->log);
    c->tracer_bytes        = (double)hc_tracer_bytes(&scene->field, &options);
    hc_cli_phase(c->cli, NULL);
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(c->cli, result);
}

static hc_result open_source(hc_cli_caster *c)
{
    const hc_cli_settings *settings = &c->cli->settings;
    if (settings->rays.in == NULL) {
        c->camera = hc_cli_camera_of(settings, c->scene);
        c->count  = (uint64_t)c->camera.width * (uint64_t)c->camera.height;
        return HC_OK;
    }
    const hc_result result =
        hc_ray_file_open(&c->source, settings->rays.in, &settings->load.limits, &c->cli->log);
    c->count = result == HC_OK ? hc_ray_file_count(c->source) : 0;
    return result;
}

static hc_result open_outputs(hc_cli_caster *c)
{
    const hc_cli_settings *settings = &c->cli->settings;
    const hc_rows          rows     = settings->rays.any ? HC_ROWS_ANY : HC_ROWS_HITS;
    hc_log                *log      = &c->cli->log;
    hc_result              result   = HC_OK;
    if (settings->out != NULL) {
        result = hc_row_file_create(&c->out, settings->out, rows, c->count, &settings->save, log);
    }
    if (result == HC_OK && settings->rays.save != NULL) {
        result = hc_row_file_create(&c->save, settings->rays.save, HC_ROWS_RAYS, c->count,
                                    &settings->save, log);
    }
    return result;
}

static bool take_memory(hc_cli_caster *c)
{
    const size_t room = c->count < PIECE ? (size_t)c->count + 1 : PIECE;
    c->rays           = malloc(room * sizeof *c->rays);
    c->hits           = malloc(room * sizeof *c->hits);
    c->rows           = malloc(room * sizeof *c->rows);
    c->any            = malloc(room);
    c->rgb            = c->cli->settings.rays.picture == NULL ? NULL : malloc((size_t)c->count * 3);
    return c->rays != NULL && c->hits != NULL && c->rows != NULL && c->any != NULL
           && (c->rgb != NULL || c->cli->settings.rays.picture == NULL);
}

int hc_cli_caster_open(hc_cli_caster *caster, hc_cli *cli, hc_cli_scene *scene)
{
    *caster  = (hc_cli_caster){ .cli = cli, .scene = scene };
    int code = open_tracer(caster, scene);
    if (code != HC_CLI_DONE) {
        return code;
    }
    hc_cli_phase(cli, "cast"); /* from here on there is something to lose */
    hc_result result = open_source(caster);
    if (result == HC_OK && !take_memory(caster)) {
        return hc_cli_fail_memory(cli);
    }
    result = result == HC_OK ? open_outputs(caster) : result;
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

/* ---- casting --------------------------------------------------------------------------------- */

/* Progress of a piece, as that of the whole. */
static bool report_part(void *user, double fraction)
{
    const hc_cli_caster *c     = user;
    const hc_progress    whole = hc_cli_progress(c->cli);
    return whole.report(whole.user,
                        ((double)c->done + fraction * (double)c->part) / (double)c->count);
}

static hc_result trace_reference(hc_cli_caster *c, hc_progress progress)
{
    const hc_cli_rays         *rays    = &c->cli->settings.rays;
    const hc_reference_options options = { .surface    = rays->surface,
                                           .open_sides = rays->open_sides,
                                           .placement  = c->scene->placement };
    const hc_result            result =
        hc_reference_batch(c->hits, NULL, &c->scene->field, &options, c->rays, c->part,
                           c->cli->settings.threads, progress, &c->cli->log);
    for (size_t i = 0; result == HC_OK && i < c->part; i++) {
        c->any[i] = isfinite(c->hits[i].t) ? 1 : 0;
    }
    return result;
}

static hc_result trace_part(hc_cli_caster *c)
{
    const hc_progress progress = { .report = report_part, .user = c };
    const int         threads  = c->cli->settings.threads;
    if (by_reference(c)) {
        return trace_reference(c, progress);
    }
    if (c->cli->settings.rays.any) {
        return hc_trace_any_batch(c->tracer, c->any, c->rays, c->part, threads, progress,
                                  &c->cli->log);
    }
    return hc_trace_batch(c->tracer, c->hits, c->rays, c->part, threads, progress, &c->cli->log);
}

static void count_part(hc_cli_caster *c)
{
    hc_cli_counts *counts = &c->counts;
    for (size_t i = 0; i < c->part; i++) {
        if (c->cli->settings.rays.any) {
            counts->hits += c->any[i];
            continue;
        }
        const hc_hit *hit = &c->hits[i];
        counts->hits += isfinite(hit->t) ? 1 : 0;
        counts->inside += (hit->flags & HC_HIT_INSIDE) != 0;
        counts->side += (hit->flags & HC_HIT_SIDE) != 0;
        counts->unconverged += (hit->flags & HC_HIT_UNCONVERGED) != 0;
        counts->steps += hit->steps;
    }
}

/* ---- results --------------------------------------------------------------------------------- */

static void fill_rows(hc_cli_caster *c)
{
    for (size_t i = 0; i < c->part; i++) {
        const hc_hit *hit   = &c->hits[i];
        const float   steps = (float)hit->steps;
        c->rows[i] =
            (hc_hit_row){ hit->t, hit->u, hit->v, hit->height, { 0.0F, 0.0F, 0.0F }, steps };
        if (isfinite(hit->t)) {
            hc_trace_normals(c->tracer, c->rows[i].normal, NULL, hit);
        }
    }
}

static hc_result write_part(hc_cli_caster *c)
{
    const bool any    = c->cli->settings.rays.any;
    hc_log    *log    = &c->cli->log;
    hc_result  result = HC_OK;
    if (c->save != NULL) {
        result = hc_row_file_append(c->save, c->rays, c->part, log);
    }
    if (c->out == NULL || result != HC_OK) {
        return result;
    }
    if (!any) {
        fill_rows(c);
    }
    return hc_row_file_append(c->out, any ? (const void *)c->any : c->rows, c->part, log);
}

/* The rays make room for those to the sun. */
static hc_result draw_part(hc_cli_caster *c)
{
    const int threads = c->cli->settings.threads;
    for (size_t i = 0; i < c->part; i++) {
        c->rays[i] = hc_cli_camera_shadow(&c->camera, c->tracer, &c->rays[i], &c->hits[i]);
    }
    const hc_result result = hc_trace_any_batch(c->tracer, c->any, c->rays, c->part, threads,
                                                (hc_progress){ 0 }, &c->cli->log);
    for (size_t i = 0; i < c->part; i++) {
        const uint64_t pixel = c->done + i;
        hc_cli_camera_shade(c->rgb + 3 * pixel, &c->camera, c->tracer, &c->hits[i], pixel,
                            c->any[i] != 0);
    }
    return result;
}

static hc_result read_part(hc_cli_caster *c)
{
    const uint64_t left = c->count - c->done;
    if (c->source != NULL) {
        return hc_ray_file_read(c->source, c->rays, PIECE, &c->part, &c->cli->log);
    }
    c->part = left < PIECE ? (size_t)left : PIECE;
    hc_cli_camera_rays(&c->camera, c->rays, c->done, c->part);
    return HC_OK;
}

static hc_result cast_part(hc_cli_caster *c)
{
    const double start  = hc_cli_now();
    hc_result    result = read_part(c);
    const double read   = hc_cli_now();
    c->seconds_reading += read - start;
    result              = result == HC_OK ? trace_part(c) : result;
    const double traced = hc_cli_now();
    c->seconds_tracing += traced - read;
    if (result == HC_OK) {
        count_part(c);
        result = write_part(c);
    }
    if (result == HC_OK && c->rgb != NULL) {
        result = draw_part(c);
    }
    c->seconds_writing += hc_cli_now() - traced;
    c->done += c->part;
    return result;
}

int hc_cli_caster_run(hc_cli_caster *caster)
{
    hc_result result = HC_OK;
    while (result == HC_OK && caster->done < caster->count) {
        result = cast_part(caster);
    }
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(caster->cli, result);
}

/* ---- closing --------------------------------------------------------------------------------- */

int hc_cli_caster_close(hc_cli_caster *caster, int code)
{
    hc_cli   *cli    = caster->cli;
    hc_result result = code == HC_CLI_DONE ? HC_OK : HC_ERROR_CANCELLED;
    result           = hc_row_file_close(caster->save, result, &cli->log);
    result           = hc_row_file_close(caster->out, result, &cli->log);
    if (result == HC_OK && caster->rgb != NULL) {
        result = hc_save_picture(caster->rgb, caster->camera.width, caster->camera.height,
                                 cli->settings.rays.picture, &cli->settings.save, &cli->log);
    }
    hc_cli_phase(cli, NULL);
    if (code == HC_CLI_DONE && result != HC_OK) {
        code = hc_cli_fail_result(cli, result);
    }
    free(caster->rgb);
    free(caster->any);
    free(caster->rows);
    free(caster->hits);
    free(caster->rays);
    hc_ray_file_close(caster->source);
    hc_tracer_destroy(caster->tracer);
    return code;
}
