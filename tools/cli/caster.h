/* Rays through a tracer, piece by piece: from a file or a camera into files and a picture. */
#ifndef HC_CLI_CASTER_H
#define HC_CLI_CASTER_H

#include "camera.h"

typedef struct hc_cli_counts {
    uint64_t hits, inside, side, unconverged;
    double   steps; /* of all rays */
} hc_cli_counts;

/* Everything but the counts and times belongs to caster.c. */
typedef struct hc_cli_caster {
    hc_cli             *cli;
    const hc_cli_scene *scene;
    hc_tracer          *tracer; /* of the reference: of another method, for normals and shadows */
    hc_ray_file        *source; /* NULL: the camera                                             */
    hc_cli_camera       camera;
    hc_row_file        *out, *save;
    uint64_t            count, done; /* rays in all, and so far */
    size_t              part;        /* rays in the buffers     */
    hc_ray             *rays;
    hc_hit             *hits;
    hc_hit_row         *rows;
    uint8_t            *any;
    uint8_t            *rgb; /* NULL: no picture */
    hc_cli_counts       counts;
    double              tracer_bytes;
    double              seconds_reading, seconds_tracing, seconds_writing;
} hc_cli_caster;

/* Build the tracer, open the source and the outputs that the settings name. Returns the exit code.
 * hc_cli_caster_close must follow, whatever it is. */
int hc_cli_caster_open(hc_cli_caster *caster, hc_cli *cli, hc_cli_scene *scene);
/* Cast all rays. */
int hc_cli_caster_run(hc_cli_caster *caster);
/* Put the outputs into place if `code` is HC_CLI_DONE, else leave none. Returns the exit code. */
int hc_cli_caster_close(hc_cli_caster *caster, int code);

#endif
