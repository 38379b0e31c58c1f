/* What the command line said: the one struct that all options of all commands write into. */
#ifndef HC_CLI_SETTINGS_H
#define HC_CLI_SETTINGS_H

#include <heightcast/bake.h>
#include <heightcast/io.h>
#include <heightcast/terrain.h>

#define HC_CLI_PATHS_MAX 256
#define HC_CLI_OPTIONS_MAX 128 /* rows of the option table */

/* auto stands here as gl once the command line is read, with `either` set. */
typedef enum hc_cli_backend { HC_CLI_CPU = 0, HC_CLI_GL, HC_CLI_AUTO } hc_cli_backend;

typedef struct hc_cli_size {
    int width, height; /* 0: not given */
} hc_cli_size;

/* What the numbers of a ray are.
 * texture  u, v, height
 * local    world units, counted from sample (0, 0), x to the right, y to the top row, z the
 *          elevation
 * world    the same, counted from where the file says that its place is */
typedef enum hc_cli_space { HC_CLI_TEXTURE = 0, HC_CLI_LOCAL, HC_CLI_WORLD } hc_cli_space;

/* trace, and verify with rays */
typedef struct hc_cli_rays {
    const char  *in, *save, *picture;
    int          method; /* an hc_trace_method; the one beyond the last is the reference */
    bool         any, open_sides, secant;
    hc_surface   surface;
    hc_cli_space space;
    int          steps, refinements;
    int          count;        /* verify */
    double       spacing[2];   /* world units between samples, as the command line says */
    double       elevation[2]; /* of heights 0 and 1, likewise                          */
    double       eye[3], at[3];
    float        fov; /* degrees across the picture; 0: 60 */
} hc_cli_rays;

/* How a bracket between above and below the surface is refined. */
typedef enum hc_cli_refine { HC_CLI_BINARY = 0, HC_CLI_SECANT, HC_CLI_NO_REFINEMENT } hc_cli_refine;

/* How heights change from frame to frame. */
typedef enum hc_cli_motion { HC_CLI_STILL = 0, HC_CLI_WAVES, HC_CLI_ERODE } hc_cli_motion;

/* render */
typedef struct hc_cli_render {
    hc_body       body;
    hc_edge       edge;
    hc_view       view;
    hc_cli_refine refine;
    float         depth, aspect, ortho, top;
    int           repeat[2];
    int           samples;
    double        fade[2], lod[2];
    int           lod_steps;
    double        camera[3], light[3], lamp[3], colour[3];
    hc_cli_motion motion;
    int           shadows; /* 0: on, 1: off */
    const char   *albedo, *depth_out;
} hc_cli_render;

/* --detail, up to as many times as there are channels in a mask. */
#define HC_CLI_PATH_LENGTH 1024
typedef struct hc_cli_detail {
    char   map[HC_CLI_PATH_LENGTH], colour[HC_CLI_PATH_LENGTH]; /* colour "": none */
    double tile, depth;                                         /* 0: not given    */
} hc_cli_detail;

typedef struct hc_cli_detail_list {
    hc_cli_detail    maps[HC_DETAILS_MAX];
    int              count;
    const char      *mask;
    hc_detail_method method;
    int              steps;
    double           fade[2];
} hc_cli_detail_list;

/* render terrain, beside what it shares with render */
typedef struct hc_cli_terrain {
    int                view, ground; /* indices of words */
    hc_tour            tour;
    float              exaggeration, above, haze;
    double             offset[3], moment;
    bool               blocky;
    int                shadow_map;
    const char        *path, *objects;
    hc_cli_size        tiles; /* columns and rows */
    hc_seams           seams;
    hc_polygons        polygons;
    hc_cli_detail_list details;
} hc_cli_terrain;

/* All zero: the defaults, as the library's own option structs have them. */
typedef struct hc_cli_settings {
    const char     *paths[HC_CLI_PATHS_MAX]; /* what is not an option, in order */
    int             path_count;
    hc_load_options load;
    hc_map_options  map;
    hc_save_options save;
    int             compat; /* 2006, or 0 */
    hc_cli_backend  backend;
    bool            either; /* whatever goes wrong with gl, the CPU may do it */
    int             threads;
    hc_cli_size     size;
    uint64_t        seed;
    bool            list, all;
    int             texels;
    const char     *diff, *heights, *out;
    const char     *sizes, *fields, *methods; /* bench: comma-separated */
    int             repeat;
    float           limit;
    const char     *report; /* bench: file for --json, "-" is standard output */
    const char     *csv;
    hc_cli_rays     rays;
    int             frames; /* of pictures; 0: one. Terrain: at `moment` */
    hc_cli_render   render;
    hc_cli_terrain  terrain;
    bool            json, quiet, verbose, help, version;
    bool            given[HC_CLI_OPTIONS_MAX]; /* which rows of the option table were */
} hc_cli_settings;

#endif
