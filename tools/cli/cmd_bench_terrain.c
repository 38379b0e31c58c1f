/* heightcast bench terrain: frames of landscapes of growing size by every method, as a table, JSON
 * and CSV. */
#include "bench_run.h"
#include "meaning.h"
#include "words.h"

#include "bench/terrain_bench.h"

#include <stdio.h>
#include <string.h>

enum { LINE_MAX_BYTES = 256 };

static const hc_bench_terrain_row *row_at(const hc_cli_run *r, int i)
{
    return (const hc_bench_terrain_row *)r->rows + i;
}

/* Of a row that is not whole. */
static const char *why(const hc_bench_terrain_row *row)
{
    return row->stopped == HC_OK                ? ""
           : row->stopped == HC_ERROR_CANCELLED ? "limit"
                                                : hc_result_name(row->stopped);
}

static void add_tour(cJSON *object, const char *name, const hc_bench_tour *tour)
{
    cJSON *part = cJSON_AddObjectToObject(object, name);
    (void)cJSON_AddNumberToObject(part, "frames", tour->frames);
    (void)cJSON_AddNumberToObject(part, "frames_per_second", tour->frames_per_second);
    (void)cJSON_AddNumberToObject(part, "mean_crossings", tour->mean_crossings);
    (void)cJSON_AddNumberToObject(part, "judged", tour->judged);
    (void)cJSON_AddNumberToObject(part, "lost", tour->lost);
    (void)cJSON_AddNumberToObject(part, "made_up", tour->made_up);
}

static cJSON *to_json(const hc_bench_terrain_row *row)
{
    cJSON *object = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(object, "field", row->field);
    (void)cJSON_AddNumberToObject(object, "side", row->side);
    (void)cJSON_AddStringToObject(object, "method", row->method);
    (void)cJSON_AddNumberToObject(object, "runs", row->runs);
    (void)cJSON_AddNumberToObject(object, "seconds", row->seconds);
    (void)cJSON_AddNumberToObject(object, "bytes", row->bytes);
    add_tour(object, "fly", &row->fly);
    add_tour(object, "walk", &row->walk);
    (void)cJSON_AddStringToObject(object, "stopped", why(row));
    return object;
}

static void add_csv_tour(char *line, size_t size, const hc_bench_tour *tour)
{
    (void)snprintf(line + strlen(line), size - strlen(line), ",%d,%.6g,%.6g,%d,%.6g,%.6g",
                   tour->frames, tour->frames_per_second, tour->mean_crossings, tour->judged,
                   tour->lost, tour->made_up);
}

static void to_csv(char *line, size_t size, const hc_bench_terrain_row *row)
{
    (void)snprintf(line, size, "%s,%d,%s,%d,%.6g,%.0f", row->field, row->side, row->method,
                   row->runs, row->seconds, row->bytes);
    add_csv_tour(line, size, &row->fly);
    add_csv_tour(line, size, &row->walk);
    (void)snprintf(line + strlen(line), size - strlen(line), ",%s\n", why(row));
}

/* Numbers that there are none of are a dash. */
static void show_number(hc_cli *cli, int width, int digits, bool there, double number)
{
    if (there) {
        hc_cli_say(cli, " %*.*f", width, digits, number);
    } else {
        hc_cli_say(cli, " %*s", width, "-");
    }
}

static void show_tours(hc_cli *cli, const hc_bench_terrain_row *row)
{
    const hc_bench_tour *tours[] = { &row->fly, &row->walk };
    for (int i = 0; i < 2; i++) {
        show_number(cli, 7, 3, tours[i]->frames > 0, tours[i]->frames_per_second);
    }
    for (int i = 0; i < 2; i++) { /* triangles make no moves */
        show_number(cli, 6, 1, tours[i]->mean_crossings > 0.0, tours[i]->mean_crossings);
    }
    for (int i = 0; i < 2; i++) {
        show_number(cli, 8, 3, tours[i]->judged > 0, 100.0 * (tours[i]->lost + tours[i]->made_up));
    }
}

static void row_done(void *user, const hc_bench_terrain_row *row)
{
    hc_cli_run *r = user;
    char        line[LINE_MAX_BYTES];
    to_csv(line, sizeof line, row);
    if (!hc_cli_run_add(r, row, sizeof *row, to_json(row), line)) {
        return;
    }
    hc_cli_say(r->cli, "%-8s %5d %-10s %8.3f", row->field, row->side, row->method, row->seconds);
    show_number(r->cli, 8, 1, row->bytes > 0.0, row->bytes / (1024.0 * 1024.0));
    show_tours(r->cli, row);
    hc_cli_say(r->cli, "%s%s\n", row->stopped != HC_OK ? "  stopped: " : "", why(row));
    hc_cli_run_flush(r);
}

/* ---- against the 2009 paper, and against the smallest size ---- */

/* The first row of that method on the field of `like`; side 0: of any side. */
static const hc_bench_terrain_row *find(const hc_cli_run *r, const hc_bench_terrain_row *like,
                                        const char *method, int side)
{
    for (int i = 0; i < r->count; i++) {
        const hc_bench_terrain_row *row = row_at(r, i);
        if (row->field == like->field && strcmp(row->method, method) == 0 && row->fly.frames > 0
            && (side == 0 || row->side == side)) {
            return row;
        }
    }
    return NULL;
}

/* How many times the time of `other` a frame takes. */
static void add_ratio(hc_cli_run *r, cJSON *object, const char *name,
                      const hc_bench_terrain_row *row, const hc_bench_terrain_row *other)
{
    const double fly  = other->fly.frames_per_second / row->fly.frames_per_second;
    const double walk = other->walk.frames_per_second / row->walk.frames_per_second;
    cJSON       *part = cJSON_AddObjectToObject(object, name);
    (void)cJSON_AddStringToObject(part, "method", other->method);
    (void)cJSON_AddNumberToObject(part, "side", other->side);
    (void)cJSON_AddNumberToObject(part, "fly", fly);
    (void)cJSON_AddNumberToObject(part, "walk", walk);
    hc_cli_say(r->cli, "  %.2f (fly) and %.2f (walk) of the time of %s %d\n", fly, walk,
               other->method, other->side);
}

static void add_figures(hc_cli_run *r)
{
    cJSON *list = cJSON_AddArrayToObject(r->cli->json, "figures");
    for (int i = 0; i < r->count; i++) {
        const hc_bench_terrain_row *row   = row_at(r, i);
        const hc_bench_terrain_row *first = find(r, row, row->method, 0);
        const hc_bench_terrain_row *pdm   = find(r, row, "pdm", row->side);
        if (row->fly.frames == 0) {
            continue;
        }
        cJSON *object = cJSON_CreateObject();
        (void)cJSON_AddStringToObject(object, "field", row->field);
        (void)cJSON_AddNumberToObject(object, "side", row->side);
        (void)cJSON_AddStringToObject(object, "method", row->method);
        hc_cli_say(r->cli, "\n%s %d %s: a frame takes\n", row->field, row->side, row->method);
        add_ratio(r, object, "growth", row, first);
        if (pdm != NULL) {
            add_ratio(r, object, "over_pdm", row, pdm);
        }
        (void)cJSON_AddItemToArray(list, object);
    }
}

/* ---- the work ---- */

static hc_result measure(hc_cli_run *r)
{
    const hc_cli_settings         *settings = &r->cli->settings;
    const hc_bench_terrain_options options  = { .plan     = hc_cli_run_plan(r),
                                                .width    = settings->size.width,
                                                .height   = settings->size.height,
                                                .backend  = hc_cli_drawn_by(settings),
                                                .limit    = (double)settings->limit,
                                                .row_done = row_done,
                                                .user     = r };
    return hc_bench_terrain(&options, &r->cli->log);
}

static void head(hc_cli_run *r)
{
    hc_cli_text(r->cli, "backend", hc_cli_backend_words((int)r->cli->settings.backend));
    hc_cli_say(r->cli, "\n%-8s %5s %-10s %8s %8s %15s %13s %17s\n", "", "", "", "", "",
               "frames / s", "moves", "wrong, %");
    hc_cli_say(r->cli, "%-8s %5s %-10s %8s %8s %7s %7s %6s %6s %8s %8s\n", "field", "side",
               "method", "ready s", "MiB", "fly", "walk", "fly", "walk", "fly", "walk");
}

int hc_cli_run_bench_terrain(hc_cli *cli)
{
    static const hc_cli_run_kind kind = {
        .name    = "terrain",
        .fields  = "fbm",
        .sides   = "256,512,1024,2048,4096,8192",
        .methods = hc_bench_terrain_method,
        .columns = "field,side,method,runs,seconds,bytes,fly_frames,fly_frames_per_second,"
                   "fly_crossings,fly_judged,fly_lost,fly_made_up,walk_frames,"
                   "walk_frames_per_second,walk_crossings,walk_judged,walk_lost,walk_made_up,"
                   "stopped\n",
        .head    = head,
        .measure = measure,
        .figures = add_figures
    };
    return hc_cli_bench_run(cli, &kind);
}
