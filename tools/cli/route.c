#include "route.h"

#include "options.h"
#include "textfile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEYS_MAX = 100000, NUMBERS = 7, SAMPLES = 4 };

/* ---- path files ------------------------------------------------------------------------------ */

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

static int take_line(void *user, hc_cli *cli, char **words, int count, int line)
{
    hc_cli_route *route = user;
    const char   *path  = cli->settings.terrain.path;
    double        numbers[NUMBERS];
    bool          good = count == NUMBERS || count == NUMBERS - 1;
    for (int i = 0; good && i < count; i++) {
        good = hc_cli_word_number(&numbers[i], words[i]);
    }
    if (!good) {
        return hc_cli_fail(
            cli, HC_CLI_BAD_FILE,
            "%s, line %d: a camera is 6 or 7 finite numbers: eye x y z, target x y z, "
            "angle",
            path, line);
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
                           path, line);
    }
    route->count++;
    return HC_CLI_DONE;
}

int hc_cli_route_load(hc_cli_route *route, hc_cli *cli)
{
    const char *path = cli->settings.terrain.path;
    *route           = (hc_cli_route){ .keys = NULL };
    if (path == NULL) {
        return HC_CLI_DONE;
    }
    const int code = hc_cli_read_lines(cli, path, take_line, route);
    return code == HC_CLI_DONE && route->count == 0
               ? hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s: there is no camera in it", path)
               : code;
}

void hc_cli_route_free(hc_cli_route *route)
{
    free(route->keys);
}

/* ---- cameras --------------------------------------------------------------------------------- */

/* A tour ends where it begins, a path does not. */
static double moment_of(const hc_cli_route *route, const hc_cli *cli, int frame)
{
    const int frames = cli->settings.frames;
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
