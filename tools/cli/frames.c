#include "frames.h"

#include "interrupt.h"
#include "options.h"
#include "output.h"

#include <stdio.h>
#include <string.h>

enum { NAME_MAX = 4096 };

/* ---- names ---- */

bool hc_cli_frame_name(char *name, size_t size, const hc_cli *cli, const char *path, int frame)
{
    const char *dot   = strrchr(path, '.');
    const char *rest  = dot != NULL ? dot : path + strlen(path);
    const int   stem  = (int)(rest - path);
    const bool  many  = cli->settings.frames > 0;
    const int   wrote = many ? snprintf(name, size, "%.*s_%04d%s", stem, path, frame, rest)
                             : snprintf(name, size, "%s", path);
    return wrote >= 0 && (size_t)wrote < size;
}

static int check_output(hc_cli *cli, const char *option, const char *path, const char *endings)
{
    const int frames = cli->settings.frames;
    int       code   = HC_CLI_DONE;
    for (int i = 0; code == HC_CLI_DONE && (i == 0 || i < frames); i++) {
        char name[NAME_MAX];
        if (!hc_cli_frame_name(name, sizeof name, cli, path, i)) {
            return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s: the name is too long", path);
        }
        code = hc_cli_check_ending(cli, option, name, endings);
    }
    return code;
}

int hc_cli_check_frames(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    if (settings->out == NULL) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "needs --out FILE.png");
    }
    int code = check_output(cli, "out", settings->out, ".png, .exr");
    if (code == HC_CLI_DONE && settings->render.depth_out != NULL) {
        code = check_output(cli, "depth-out", settings->render.depth_out, ".exr, .pfm, .npy");
    }
    return code != HC_CLI_DONE ? code
                               : hc_cli_check_apart(cli, "out", settings->out, "depth-out",
                                                    settings->render.depth_out);
}

/* ---- files ---- */

hc_result hc_cli_save_frame(hc_cli *cli, const hc_picture *picture, int frame, hc_cli_over *over)
{
    const hc_cli_settings *settings = &cli->settings;
    const char            *depths   = settings->render.depth_out;
    char                   out[NAME_MAX], depth_out[NAME_MAX];
    (void)hc_cli_frame_name(out, sizeof out, cli, settings->out, frame); /* they were checked */
    if (depths != NULL) {
        (void)hc_cli_frame_name(depth_out, sizeof depth_out, cli, depths, frame);
    }
    return hc_cli_save_drawing(cli, picture, out, depths != NULL ? depth_out : NULL, over);
}

int hc_cli_stop_frames(hc_cli *cli, hc_result result, int frame)
{
    const int number = hc_cli_caught_signal();
    if (number != 0 && frame > 0) {
        return hc_cli_fail(cli, 128 + number, "stopped by a signal after %d frames of %d", frame,
                           cli->settings.frames);
    }
    return hc_cli_fail_result(cli, result);
}

/* ---- figures ---- */

void hc_cli_add_figures(hc_cli_totals *totals, const hc_render_figures *figures)
{
    hc_cli_totals           *t = totals;
    const hc_render_figures *f = figures;
    t->frames++;
    t->sum.rays += f->rays;
    t->sum.hits += f->hits;
    t->sum.entered += f->entered;
    t->sum.unconverged += f->unconverged;
    t->sum.lost += f->lost;
    t->sum.made_up += f->made_up;
    t->sum.mean_error += f->mean_error;
    t->sum.mean_steps += f->mean_steps * (double)f->entered;
    t->sum.mean_fetches += f->mean_fetches * (double)f->entered;
    t->sum.mean_crossings += f->mean_crossings * (double)f->entered;
    t->sum.seconds += f->seconds;
    for (int i = 0; i < 3; i++) {
        t->sum.within[i] += f->within[i] * (double)f->entered;
    }
}
