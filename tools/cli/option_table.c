/* All options of all commands. */
#include "options.h"

#include <float.h>
#include <string.h>

/* The library's name functions say "unknown", or NULL, beyond the last name. */
static const char *known(const char *name)
{
    return name == NULL || strcmp(name, "unknown") == 0 ? NULL : name;
}

static const char *wrap_words(int index)
{
    return known(hc_wrap_name((hc_wrap)index));
}

static const char *registration_words(int index)
{
    return known(hc_registration_name((hc_registration)index));
}

static const char *kind_words(int index)
{
    return known(hc_map_kind_name((hc_map_kind)index));
}

static const char *method_words(int index)
{
    return known(hc_method_name((hc_method)index));
}

static const char *cones_words(int index)
{
    return known(hc_cones_name((hc_cones)index));
}

static const char *layout_words(int index)
{
    return known(hc_layout_name((hc_layout)index));
}

static const char *isa_words(int index)
{
    return known(hc_isa_name((hc_isa)index));
}

/* In the order of the library's enums, which have no name functions. */
static const char *channel_words(int index)
{
    static const char *const words[] = { "auto", "r", "g", "b", "a", "luma", NULL };
    return words[index];
}

static const char *range_words(int index)
{
    static const char *const words[] = { "auto", "data", "type", NULL };
    return words[index];
}

static const char *holes_words(int index)
{
    static const char *const words[] = { "error", "fill", "lowest", NULL };
    return words[index];
}

static const char *backend_words(int index)
{
    static const char *const words[] = { "cpu", "gl", NULL };
    return words[index];
}

static const char *bits_words(int index)
{
    static const char *const words[] = { "8", "16", "32", NULL };
    return words[index];
}

static const char *compat_words(int index)
{
    static const char *const words[] = { "2006", NULL };
    return words[index];
}

#define TARGET(member) offsetof(hc_cli_settings, member)
#define LOADS (HC_CLI_BAKE | HC_CLI_INFO | HC_CLI_COMPARE | HC_CLI_VERIFY | HC_CLI_SHOW)
#define WRITES (HC_CLI_BAKE | HC_CLI_GEN | HC_CLI_COMPARE | HC_CLI_BENCH | HC_CLI_SHOW)

const hc_cli_option hc_cli_options[] = {
    /* ---- what is read ---- */
    { .name     = "channel",
      .commands = LOADS,
      .read     = hc_cli_read_word,
      .target   = TARGET(load.normalise.channel),
      .words    = channel_words,
      .help = "Channel that holds the heights. auto: the only one, or luma where colours differ." },
    { .name     = "invert",
      .commands = LOADS,
      .target   = TARGET(load.normalise.invert),
      .help     = "Dark is high: for depth maps." },
    { .name     = "range",
      .commands = LOADS,
      .read     = hc_cli_read_range,
      .target   = TARGET(load.normalise),
      .words    = range_words,
      .metavar  = "auto|data|type|LOW:HIGH",
      .allowed  = "auto, data, type, or LOW:HIGH with two different numbers",
      .help = "What becomes height 0 and 1. data: the lowest and highest sample; type: 0 and the "
              "largest code; auto: data for float and georeferenced files, else type." },
    { .name     = "wrap",
      .commands = LOADS,
      .read     = hc_cli_read_word,
      .target   = TARGET(load.wrap),
      .words    = wrap_words,
      .help     = "Axes along which the field repeats." },
    { .name     = "registration",
      .commands = LOADS,
      .read     = hc_cli_read_word,
      .target   = TARGET(load.registration),
      .words    = registration_words,
      .help     = "Samples sit at texel centres, or on grid posts from edge to edge." },
    { .name     = "holes",
      .commands = LOADS,
      .read     = hc_cli_read_word,
      .target   = TARGET(load.normalise.holes),
      .words    = holes_words,
      .help = "NaN, infinite and nodata samples: refuse the file, fill from the nearest, or take "
              "the lowest height." },
    { .name     = "raw",
      .commands = LOADS,
      .read     = hc_cli_read_raw,
      .target   = TARGET(load),
      .metavar  = "WxH:TYPE",
      .allowed =
          "WIDTHxHEIGHT:TYPE with TYPE u8, u16, i16, u32, i32, f32 or f64, and 'be' behind it "
          "for big-endian samples",
      .help = "The input has no header: size and sample type (u8, u16, i16, u32, i32, f32, f64; "
              "u16be and so on for big-endian samples)." },
    { .name     = "max-samples",
      .commands = LOADS,
      .read     = hc_cli_read_u64,
      .target   = TARGET(load.limits.max_samples),
      .low      = 1,
      .metavar  = "N",
      .allowed  = "whole numbers from 1",
      .help     = "Refuse larger inputs, channels counted (default 1073741824)." },

    /* ---- what is baked ---- */
    { .name     = "map",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_word,
      .target   = TARGET(map.kind),
      .words    = kind_words,
      .help     = "Kind of map (default cone)." },
    { .name     = "method",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_word,
      .target   = TARGET(map.cone.method),
      .words    = method_words,
      .help     = "How ratios are found. exact, brute and ring agree to the last bit; quick and "
                  "quick-improved are narrower; the others may cut the surface. For --map relaxed: "
                  "falling-edge (its default) or gems." },
    { .name     = "cones",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_word,
      .target   = TARGET(map.cone.cones),
      .words    = cones_words,
      .help = "Shape: round (l2), diamond (l1), diamond for each quadrant, diamond stretched along "
              "an axis. All but l2 are safe between samples too." },
    { .name     = "layout",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_word,
      .target   = TARGET(map.layout),
      .words    = layout_words,
      .help = "How channels are arranged. auto: what holds the map; for l2 and l1 cones that is "
              "dummer (the 8-bit RGBA texture of the 2006 paper) in a PNG without --bits 16, "
              "else rg (height, ratio)." },
    { .name     = "bits",
      .commands = HC_CLI_BAKE | HC_CLI_GEN,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_number_word,
      .target   = TARGET(map.bits),
      .words    = bits_words,
      .help     = "Bits per channel, 32 is float. Default: the most that the format holds (PNG 16, "
                  "others 32), 8 for layout dummer." },
    { .name     = "max-ratio",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_float,
      .target   = TARGET(map.cone.max_ratio),
      .high     = FLT_MAX,
      .metavar  = "R",
      .allowed  = "numbers above 0",
      .help     = "Widest cone kept, in texture widths per unit of height. Default: no limit in "
                  "float, 1 for 8 and 16 bits." },
    { .name     = "level",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_int,
      .target   = TARGET(save.level),
      .low      = 1,
      .high     = 31,
      .metavar  = "N",
      .allowed  = "levels from 1, the full size",
      .help     = "Pyramids in formats without levels: write only this one, 1 is the full size." },
    { .name     = "gems-steps",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_int,
      .target   = TARGET(map.cone.gems_steps),
      .low      = 1,
      .high     = 4096,
      .metavar  = "N",
      .allowed  = "1 to 4096",
      .help     = "Samples along each ray of --method gems (default 64)." },
    { .name     = "compat",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_number_word,
      .target   = TARGET(compat),
      .words    = compat_words,
      .help     = "The very bytes of the 2006 preprocessor, its faults included; implies --layout "
                  "dummer." },
    { .name     = "backend",
      .commands = HC_CLI_BAKE,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_word,
      .target   = TARGET(backend),
      .words    = backend_words,
      .help     = "Where to bake." },
    { .name     = "isa",
      .commands = HC_CLI_BAKE | HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_MAP,
      .read     = hc_cli_read_word,
      .target   = TARGET(map.cone.isa),
      .words    = isa_words,
      .help     = "Vector kernels to use; the bytes do not depend on it." },

    /* ---- what one command does ---- */
    { .name     = "size",
      .commands = HC_CLI_GEN,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_size,
      .target   = TARGET(size),
      .metavar  = "WxH",
      .allowed  = "WIDTHxHEIGHT, each 1 to 1048576, or one number for a square",
      .help     = "Samples; one number means a square." },
    { .name     = "seed",
      .commands = HC_CLI_GEN | HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_u64,
      .target   = TARGET(seed),
      .metavar  = "N",
      .allowed  = "whole numbers from 0",
      .help     = "Variant of a random field (default 0)." },
    { .name     = "list",
      .commands = HC_CLI_GEN,
      .section  = HC_CLI_SECTION_WORK,
      .target   = TARGET(list),
      .help     = "List the names with a line on each." },
    { .name     = "diff",
      .commands = HC_CLI_COMPARE,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(diff),
      .metavar  = "PNG",
      .allowed  = "the name of a .png file",
      .help = "Write a false-colour picture of the differences, one panel per channel, each with "
              "its scale." },
    { .name     = "out",
      .commands = HC_CLI_SHOW,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(out),
      .metavar  = "PNG",
      .allowed  = "the name of a .png file",
      .help     = "Write the picture, each panel with its scale, instead of drawing it here." },
    { .name     = "heights",
      .commands = HC_CLI_VERIFY,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(heights),
      .metavar  = "FIELD",
      .allowed  = "the height map that the map was baked from",
      .help     = "The height map that the map was baked from (needed)." },
    { .name     = "all",
      .commands = HC_CLI_VERIFY,
      .section  = HC_CLI_SECTION_WORK,
      .target   = TARGET(all),
      .help = "Check every texel. Default: all of a map with up to 65536, a sample of larger ones: "
              "4096 of 512 x 512, fewer the larger, at least 256." },
    { .name     = "texels",
      .commands = HC_CLI_VERIFY,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_int,
      .target   = TARGET(texels),
      .low      = 1,
      .high     = 999999999,
      .metavar  = "N",
      .allowed  = "1 to 999999999",
      .help     = "Check this many, spread over the map." },
    { .name     = "sizes",
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(sizes),
      .metavar  = "N,...",
      .allowed  = "sides from 1 to 1048576, separated by commas",
      .help     = "Sides of the square fields (default 512,4096)." },
    { .name     = "field",
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(fields),
      .metavar  = "NAME,...",
      .allowed  = "names that 'heightcast gen --list' shows, separated by commas",
      .help     = "Generated fields to bake (default fbm)." },
    { .name     = "methods",
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(methods),
      .metavar  = "NAME,...",
      .allowed  = "methods, and maps such as pyramid, separated by commas",
      .help = "Measure only these, at every size. Default: all, the slow ones at small sizes." },
    { .name     = "repeat",
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_int,
      .target   = TARGET(repeat),
      .low      = 1,
      .high     = 1000,
      .metavar  = "N",
      .allowed  = "1 to 1000",
      .help     = "Runs of each, of which the median counts (default 5; slow ones are run less "
                  "often)." },
    { .name     = "json",
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(report),
      .metavar  = "[FILE]",
      .allowed  = "the name of a file, or -",
      .help     = "Write the measurements as one JSON object; without FILE to standard output.",
      .optional = true },
    { .name     = "csv",
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_WORK,
      .read     = hc_cli_read_text,
      .target   = TARGET(csv),
      .metavar  = "FILE",
      .allowed  = "the name of a file",
      .help     = "Write one line of comma-separated values for each measurement." },

    /* ---- common ---- */
    { .name     = "threads",
      .letter   = 'j',
      .commands = HC_CLI_ALL & ~(unsigned)HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_COMMON,
      .read     = hc_cli_read_int,
      .target   = TARGET(threads),
      .high     = 1024,
      .metavar  = "N",
      .allowed  = "0 (one for each core) to 1024",
      .help     = "Threads; the bytes do not depend on it. Default 0: one for each core." },
    { .name     = "threads",
      .letter   = 'j',
      .commands = HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_COMMON,
      .read     = hc_cli_read_int,
      .target   = TARGET(threads),
      .low      = 1,
      .high     = 1024,
      .metavar  = "N",
      .allowed  = "1 to 1024",
      .help     = "Threads of the measurement beside those with one thread (default 2)." },
    { .name     = "overwrite",
      .commands = WRITES,
      .section  = HC_CLI_SECTION_COMMON,
      .target   = TARGET(save.overwrite),
      .help     = "Replace an existing output; without this it is refused." },
    { .name     = "json",
      .commands = HC_CLI_ALL & ~(unsigned)HC_CLI_BENCH,
      .section  = HC_CLI_SECTION_COMMON,
      .target   = TARGET(json),
      .help     = "Print one JSON object on standard output instead of text." },
    { .name     = "quiet",
      .letter   = 'q',
      .commands = HC_CLI_ALL,
      .section  = HC_CLI_SECTION_COMMON,
      .target   = TARGET(quiet),
      .help     = "Errors only: no progress, warnings or figures for people." },
    { .name     = "verbose",
      .letter   = 'v',
      .commands = HC_CLI_ALL,
      .section  = HC_CLI_SECTION_COMMON,
      .target   = TARGET(verbose),
      .help     = "All figures, not only the important ones." },
    { .name     = "help",
      .letter   = 'h',
      .commands = HC_CLI_ALL,
      .section  = HC_CLI_SECTION_COMMON,
      .target   = TARGET(help),
      .help     = "Show this help." },
    { .name     = "version",
      .commands = HC_CLI_ALL,
      .section  = HC_CLI_SECTION_COMMON,
      .target   = TARGET(version),
      .help     = "Show the version." },
    { 0 },
};
