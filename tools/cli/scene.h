/* What rays are cast at: a field, the ratios that a method needs, and their place in the world. */
#ifndef HC_CLI_SCENE_H
#define HC_CLI_SCENE_H

#include "cli.h"

typedef struct hc_cli_scene {
    bool           is_map;
    hc_map         map; /* zero unless is_map                          */
    hc_field       field;
    float         *heights; /* the field's, if they are the map's */
    hc_trace_needs has;     /* what `ratios` are for; HC_NEEDS_NOTHING: none */
    float         *ratios;
    hc_cones       cones; /* of `ratios` */
    hc_placement   placement;
} hc_cli_scene;

/* Load `path`, a field or a map that stores heights (or --heights beside it), and find its
 * placement. Returns the exit code. Free with hc_cli_scene_free, whatever it is. */
int  hc_cli_scene_load(hc_cli_scene *scene, hc_cli *cli, const char *path);
void hc_cli_scene_free(hc_cli_scene *scene);

/* Load --heights with the wrap and registration of a map, unless the command line has others. */
hc_result hc_cli_load_heights(hc_cli *cli, hc_field *field, const hc_map_info *info);

/* True if the scene's map holds the ratios for `needs`. */
bool hc_cli_scene_holds(const hc_cli_scene *scene, hc_trace_needs needs);
/* Cones of the ratios for `needs`: the map's, those of --cones, or those that suit. */
hc_cones hc_cli_scene_cones(const hc_cli_scene *scene, const hc_cli *cli, hc_trace_needs needs);
/* Put the ratios for `needs` into scene->ratios: the map's, or baked. Returns the exit code. */
int hc_cli_scene_ratios(hc_cli_scene *scene, hc_cli *cli, hc_trace_needs needs);

/* Options for a tracer of `method`, whose ratios the scene has. */
hc_trace_options hc_cli_scene_options(const hc_cli_scene *scene, const hc_cli *cli,
                                      hc_trace_method method);

/* Of --refine and --refinements, as hc_trace_options has them. */
int hc_cli_refinements(const hc_cli_settings *settings);

#endif
