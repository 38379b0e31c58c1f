/* The words that options take. */
#include "words.h"

#include <string.h>

/* The library's name functions say "unknown", or NULL, beyond the last name. */
static const char *known(const char *name)
{
    return name == NULL || strcmp(name, "unknown") == 0 ? NULL : name;
}

const char *hc_cli_wrap_words(int index)
{
    return known(hc_wrap_name((hc_wrap)index));
}

const char *hc_cli_registration_words(int index)
{
    return known(hc_registration_name((hc_registration)index));
}

const char *hc_cli_kind_words(int index)
{
    return known(hc_map_kind_name((hc_map_kind)index));
}

const char *hc_cli_method_words(int index)
{
    return known(hc_method_name((hc_method)index));
}

const char *hc_cli_cones_words(int index)
{
    return known(hc_cones_name((hc_cones)index));
}

const char *hc_cli_layout_words(int index)
{
    return known(hc_layout_name((hc_layout)index));
}

const char *hc_cli_isa_words(int index)
{
    return known(hc_isa_name((hc_isa)index));
}

/* In the order of the library's enums, which have no name functions. */
const char *hc_cli_channel_words(int index)
{
    static const char *const words[] = { "auto", "r", "g", "b", "a", "luma", NULL };
    return words[index];
}

const char *hc_cli_range_words(int index)
{
    static const char *const words[] = { "auto", "data", "type", NULL };
    return words[index];
}

const char *hc_cli_holes_words(int index)
{
    static const char *const words[] = { "error", "fill", "lowest", NULL };
    return words[index];
}

const char *hc_cli_surface_words(int index)
{
    return known(hc_surface_name((hc_surface)index));
}

const char *hc_cli_space_words(int index)
{
    static const char *const words[] = { "texture", "local", "world", NULL };
    return words[index];
}

/* The reference stands behind the methods of the tracers. */
const char *hc_cli_marcher_words(int index)
{
    const int count = hc_trace_method_count();
    return index < count    ? hc_trace_method_name((hc_trace_method)index)
           : index == count ? "reference"
                            : NULL;
}

const char *hc_cli_backend_words(int index)
{
    static const char *const words[] = { "cpu", "gl", "auto", NULL };
    return words[index];
}

const char *hc_cli_bits_words(int index)
{
    static const char *const words[] = { "8", "16", "32", NULL };
    return words[index];
}

const char *hc_cli_compat_words(int index)
{
    static const char *const words[] = { "2006", NULL };
    return words[index];
}

/* The reference is no tracer that a picture can be drawn with. */
const char *hc_cli_tracer_words(int index)
{
    return index < hc_trace_method_count() ? hc_cli_marcher_words(index) : NULL;
}

const char *hc_cli_body_words(int index)
{
    return hc_body_name((hc_body)index);
}

const char *hc_cli_edge_words(int index)
{
    return hc_edge_name((hc_edge)index);
}

const char *hc_cli_view_words(int index)
{
    return index < HC_VIEW_CROSSINGS ? hc_view_name((hc_view)index) : NULL;
}

const char *hc_cli_terrain_view_words(int index)
{
    static const hc_view views[] = { HC_VIEW_SHADED, HC_VIEW_HEIGHT,    HC_VIEW_NORMAL,
                                     HC_VIEW_DEPTH,  HC_VIEW_CROSSINGS, HC_VIEW_MISSED };
    return index < 6 ? hc_view_name(views[index]) : NULL;
}

/* An image is --albedo's. */
const char *hc_cli_ground_words(int index)
{
    static const hc_ground grounds[] = { HC_GROUND_NATURAL, HC_GROUND_ELEVATION, HC_GROUND_SLOPE,
                                         HC_GROUND_PLAIN };
    return index < 4 ? hc_ground_name(grounds[index]) : NULL;
}

const char *hc_cli_motion_words(int index)
{
    static const char *const words[] = { "none", "waves", "erode", NULL };
    return words[index];
}

const char *hc_cli_tour_words(int index)
{
    return hc_tour_name((hc_tour)index);
}

const char *hc_cli_refine_words(int index)
{
    static const char *const words[] = { "binary", "secant", "none", NULL };
    return words[index];
}

const char *hc_cli_switch_words(int index)
{
    static const char *const words[] = { "on", "off", NULL };
    return words[index];
}

const char *hc_cli_polygons_words(int index)
{
    return hc_polygons_name((hc_polygons)index);
}

const char *hc_cli_detail_words(int index)
{
    return hc_detail_method_name((hc_detail_method)index);
}

const char *hc_cli_seams_words(int index)
{
    static const char *const words[] = { "auto", "shared", "apart", NULL };
    return words[index];
}
