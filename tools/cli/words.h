/* The words that options take, by index; NULL beyond the last. */
#ifndef HC_CLI_WORDS_H
#define HC_CLI_WORDS_H

#include "options.h"

hc_cli_words hc_cli_wrap_words, hc_cli_registration_words, hc_cli_kind_words, hc_cli_method_words,
    hc_cli_cones_words, hc_cli_layout_words, hc_cli_isa_words, hc_cli_channel_words,
    hc_cli_range_words, hc_cli_holes_words, hc_cli_surface_words, hc_cli_space_words,
    hc_cli_marcher_words, hc_cli_backend_words, hc_cli_bits_words, hc_cli_compat_words,
    hc_cli_body_words, hc_cli_edge_words, hc_cli_view_words, hc_cli_refine_words,
    hc_cli_switch_words, hc_cli_tracer_words, hc_cli_terrain_view_words, hc_cli_ground_words,
    hc_cli_tour_words, hc_cli_seams_words, hc_cli_motion_words, hc_cli_polygons_words,
    hc_cli_detail_words;

#endif
