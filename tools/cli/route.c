#include "route.h"

#include "options.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEYS_MAX = 100000, LINE_MAX = 512, NUMBERS = 7, SAMPLES = 4 };

/* ---- path files ------------------------------------------------------------------------------ */

/* The numbers on a line; -1: there is something else. */
static int read_numbers(double numbers[NUMBERS], char *line)
{
    int count                = 0;
    line[strcspn(line, "#")] = '\0';
    for (char *at = line;;) {
        char *end = at;
        while (isspace((unsigned char)*at) || *at == ',') {
            at++;
        }
        if (*at == '\0') {
            return count;
        }
        const double value = strtod(at, &end);
        if (end == at || !isfinite(value) || count == NUMBERS) {
            return -1;
        }
        numbers[count++] = value;
        at               = end;
    }
}

static bool set_key(hc_camera *key, const double numbers[NUMBERS], int count, float fov)
{
    *key = (hc_camera){ .fov = count == NUMBERS ? (float)numbers[6] : fov };
    memcpy(key->eye, numbers, sizeof key->eye);
    memcpy(key->at, numbers + 3, sizeof key->at);
    return memcmp(key->eye, key->at, sizeof key->eye) != 0
           && (count < NUMBERS || (numbers[6] > 0.0 && numbers[6] <= 170.0));
}

static bool grow(hc_cli_route *route)
{
    if ((route->count & (route->count - 1)) != 0) {
        return true; /* there is room up to the next power of two */
    }
    const size_t room = route->count == 0 ? 1 : 2 * (size_t)route->count;
    hc_camera   *keys = realloc(route->keys, room * sizeof *keys);
    route->keys       = keys != NULL ? keys : route->keys;
    return keys != NULL;
}

static int read_line(hc_cli_route *route, hc_cli *cli, char *line, int number)
{
    const char *path = cli->settings.terrain.path;
    double      numbers[NUMBERS];
    const bool  whole = strchr(line, '\n') != NULL || strlen(line) < LINE_MAX - 1;
    const int   count = whole ? read_numbers(numbers, line) : -1;
    if (count == 0) {
        return HC_CLI_DONE;
    }
    if (count < NUMBERS - 1) {
        return hc_cli_fail(
            cli, HC_CLI_BAD_FILE,
            "%s, line %d: a camera is 6 or 7 finite numbers: eye x y z, target x y z, "
            "angle",
            path, number);
    }
    if (route->count == KEYS_MAX) {
        return hc_cli_fail(cli, HC_CLI_MEMORY, "%s: more than %d cameras", path, KEYS_MAX);
    }
    if (!grow(route)) {
        return hc_cli_fail_memory(cli);
    }
    if (!set_key(&route->keys[route->count], numbers, count, cli->settings.rays.fov)) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE,
                           "%s, line %d: eye and target must differ, and the angle be above 0, at "
                           "most 170",
                           path, number);
    }
    route->count++;
    return HC_CLI_DONE;
}

int hc_cli_route_load(hc_cli_route *route, hc_cli *cli)
{
    const char *path = cli->settings.terrain.path;
    char        line[LINE_MAX];
    int         code = HC_CLI_DONE;
    *route           = (hc_cli_route){ .keys = NULL };
    if (path == NULL) {
        return HC_CLI_DONE;
    }
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot read %s: %s", path, strerror(errno));
    }
    for (int i = 1; code == HC_CLI_DONE && fgets(line, sizeof line, file) != NULL; i++) {
        code = read_line(route, cli, line, i);
    }
    if (code == HC_CLI_DONE && ferror(file)) {
        code = hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot read %s: %s", path, strerror(errno));
    } else if (code == HC_CLI_DONE && route->count == 0) {
        code = hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s: there is no camera in it", path);
    }
    (void)fclose(file);
    return code;
}

void hc_cli_route_free(hc_cli_route *route)
{
    free(route->keys);
}

/* ---- cameras --------------------------------------------------------------------------------- */

/* A tour ends where it begins, a path does not. */
static double moment_of(const hc_cli_route *route, const hc_cli *cli, int frame)
{
    const int frames = cli->settings.terrain.frames;
    if (frames == 0) {
        return cli->settings.terrain.moment;
    }
    return route->keys == NULL ? (double)frame / frames
           : frames > 1        ? (double)frame / (frames - 1)
                               : 0.0;
}

/* The ground in the middle, which orbits look at. */
static void set_at(hc_camera *camera, const hc_cli *cli, const hc_terrain *terrain)
{
    hc_camera round;
    if (hc_cli_given(&cli->settings, "at")) {
        memcpy(camera->at, cli->settings.rays.at, sizeof camera->at);
        return;
    }
    hc_terrain_tour(&round, terrain, HC_TOUR_ORBIT, 0.0);
    memcpy(camera->at, round.at, sizeof camera->at);
    camera->at[2] = hc_terrain_ground(terrain, camera->at[0], camera->at[1]);
}

void hc_cli_route_camera(hc_camera *camera, const hc_cli_route *route, const hc_cli *cli,
                         const hc_terrain *terrain, int frame)
{
    const hc_cli_settings *settings = &cli->settings;
    const double           moment   = moment_of(route, cli, frame);
    if (route->keys != NULL) {
        hc_camera_between(camera, route->keys, route->count, moment);
    } else {
        hc_terrain_tour(camera, terrain, settings->terrain.tour, moment);
    }
    if (hc_cli_given(settings, "eye")) {
        memcpy(camera->eye, settings->rays.eye, sizeof camera->eye);
        set_at(camera, cli, terrain);
    } else if (hc_cli_given(settings, "at")) {
        set_at(camera, cli, terrain);
    }
    if (settings->terrain.above > 0.0F) {
        camera->eye[2] = hc_terrain_ground(terrain, camera->eye[0], camera->eye[1])
                         + (double)settings->terrain.above;
    }
    if (route->keys == NULL && settings->rays.fov > 0.0F) {
        camera->fov = settings->rays.fov;
    }
    camera->samples = settings->render.samples > 0 ? settings->render.samples : SAMPLES;
}

/* ---- names ----------------------------------------------------------------------------------- */

bool hc_cli_frame_name(char *name, size_t size, const hc_cli *cli, const char *path, int frame)
{
    const char *dot    = strrchr(path, '.');
    const int   length = dot != NULL ? (int)(dot - path) : (int)strlen(path);
    const int   wrote  = cli->settings.terrain.frames == 0
                             ? snprintf(name, size, "%s", path)
                             : snprintf(name, size, "%.*s_%04d%s", length, path, frame, path + length);
    return wrote >= 0 && (size_t)wrote < size;
}
