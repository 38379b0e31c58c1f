/* Finds the command, reads its options, runs it. */
#include "commands.h"
#include "foreign.h"
#include "interrupt.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

const hc_cli_command hc_cli_commands[] = {
    { "bake", HC_CLI_BAKE, hc_cli_run_bake, "IN OUT", 2, 2,
      "Bake a height map into a cone map or pyramid",
      "IN is a height map (PNG, TIFF, EXR, PGM, PPM, PFM, NPY, raw samples; - is standard input), "
      "found by its content. The ending of OUT decides its format: .png .tif .exr .npy .ktx2 .dds. "
      "Heights are rounded to what OUT stores before the bake and ratios are rounded down, so that "
      "what the cones promise holds for the file.",
      false },
    { "gen", HC_CLI_GEN, hc_cli_run_gen, "NAME OUT", 0, 2,
      "Make one of the named synthetic height maps",
      "OUT is a height map: .png .tif .exr .pgm .pfm .npy .raw. The same name, size and seed give "
      "the "
      "same bytes everywhere. 'heightcast gen --list' shows the names.",
      false },
    { "info", HC_CLI_INFO, hc_cli_run_info, "FILE", 1, 1, "Say what a height map or a baked map is",
      NULL, true },
    { "show", HC_CLI_SHOW, hc_cli_run_show, "FILE", 1, 1,
      "Draw a height map or a baked map, in the terminal or into a file",
      "One panel for each channel, dark is low. The scale of ratios ends where 95 % of them lie "
      "below; unlimited ones are cyan.",
      false },
    { "compare", HC_CLI_COMPARE, hc_cli_run_compare, "A B", 2, 2,
      "Compare two height maps or two baked maps",
      "Gives the largest and the mean difference and the peak signal-to-noise ratio of each "
      "channel. "
      "Both must have the same size, and maps the same kind and layout.",
      true },
    { "verify", HC_CLI_VERIFY, hc_cli_run_verify, "MAP", 1, 1,
      "Check a cone map against brute force, and rays against the reference",
      "Exit code 5 if any ratio is wider than the truth, if the map's heights are not those of "
      "FIELD, or if a ray of fast, safe or maxmip loses a hit or makes one up. Give the options "
      "that FIELD was baked with (--invert, --range, ...); wrap and registration are the map's.\n"
      "The other methods' losses are shown: hits that come before or after those of a surface "
      "raised or lowered by 1/256 of the height and moved by a fifth of a sample sideways.",
      true },
    { "trace", HC_CLI_TRACE, hc_cli_run_trace, "FIELD", 1, 1, "Cast rays at a height field",
      "FIELD is a height map, or a baked map that holds the heights. The rays come from a file "
      "(--rays) or from a camera (--picture), the hits go to a file, a picture, or nowhere: then "
      "only their number and the time are shown. Rays and hits stream: any number of them takes "
      "little memory. docs/formats.md has the numbers of rays and hits.",
      false },
    { "render", HC_CLI_RENDER, hc_cli_run_render, "relief FIELD", 2, 2,
      "Draw a height field as relief on a body",
      "FIELD is a height map, or a baked map that holds the heights. Rays are cast at the relief "
      "itself, so it has true depth, shadows and silhouettes; there is no mesh. Heights are "
      "stretched to the full depth unless --range says otherwise.",
      false },
    { "render terrain", HC_CLI_TERRAIN, hc_cli_run_terrain, "FIELD...", 1, HC_CLI_PATHS_MAX,
      "Draw height fields as a landscape",
      "FIELD is a height map, or a baked map that holds the heights; it stands in world units. "
      "Rays "
      "are cast from any eye in any direction, and from what they hit to the sun; there is no "
      "mesh. "
      "'terrain' must come right behind 'render'.",
      false },
    { "bench", HC_CLI_BENCH, hc_cli_run_bench, "[bake|trace|steps|render|terrain]", 0, 1,
      "Measure bakers, casters of rays, their steps, frames of relief and terrain",
      "bake: each measurement runs in a process of its own, so that its peak memory is known.",
      true },
    { 0 },
};

static const char *command_word(int index)
{
    return hc_cli_commands[index].name;
}

static int fail_word(const char *what, const char *word)
{
    char        shown[64];
    const char *nearest = hc_cli_nearest(word, command_word);
    (void)snprintf(shown, sizeof shown, "%s", word);
    hc_cli_keep_to_one_line(shown);
    (void)fprintf(stderr, "heightcast: unknown %s '%s'; ", what, shown);
    if (nearest != NULL) {
        (void)fprintf(stderr, "did you mean '%s'?\n", nearest);
    } else {
        (void)fputs("'heightcast --help' lists the commands\n", stderr);
    }
    return HC_CLI_USAGE;
}

/* Of one word, or of the two that stand there: the longer name counts. *words: how many it has. */
static const hc_cli_command *command_named(const char *name, const char *second, int *words)
{
    char both[64];
    (void)snprintf(both, sizeof both, "%s %s", name, second != NULL ? second : "");
    for (*words = 2; *words > 0; --*words) {
        for (const hc_cli_command *command = hc_cli_commands; command->name != NULL; command++) {
            if (strcmp(command->name, *words == 2 ? both : name) == 0) {
                return command;
            }
        }
    }
    return NULL;
}

/* Help and version are data too: a full disk must not look like success. */
static int end_of_output(void)
{
    if (fflush(stdout) != 0) {
        perror("heightcast: cannot write to standard output");
        return HC_CLI_INPUT_OUTPUT;
    }
    return HC_CLI_DONE;
}

static int show_version(void)
{
    (void)printf("heightcast %s\n", hc_version());
    return end_of_output();
}

static int show_help(const char *name, const char *second)
{
    int                   words   = 0;
    const hc_cli_command *command = name == NULL ? NULL : command_named(name, second, &words);
    if (command != NULL) {
        hc_cli_help_command(command);
    } else if (name != NULL) {
        return fail_word("command", name);
    } else {
        hc_cli_help();
    }
    return end_of_output();
}

static int run_checked(hc_cli *cli, const hc_cli_command *command)
{
    const int paths = cli->settings.path_count;
    if (paths < command->paths_min) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "needs %s; got %d of %d", command->arguments, paths,
                           command->paths_min);
    }
    if (paths > command->paths_max) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "unexpected argument '%s'; needs %s",
                           cli->settings.paths[command->paths_max], command->arguments);
    }
    for (int i = 0; i < paths; i++) {
        if (cli->settings.paths[i][0] == '\0') {
            return hc_cli_fail(cli, HC_CLI_USAGE, "argument %d is empty; needs %s", i + 1,
                               command->arguments);
        }
    }
    return command->run(cli);
}

static int run(const hc_cli_command *command, int argc, char **argv)
{
    hc_cli     cli = { .command = command->name, .on_stdout = command->on_stdout };
    char       error[HC_LOG_TEXT_SIZE];
    const bool parsed = hc_cli_parse(&cli.settings, command->bit, argc, argv, error, sizeof error);
    if (parsed && cli.settings.help) {
        return show_help(command->name, NULL);
    }
    if (parsed && cli.settings.version) {
        return show_version();
    }
    cli.settings.either = cli.settings.backend == HC_CLI_AUTO;
    if (cli.settings.either) {
        cli.settings.backend = HC_CLI_GL;
    }
    hc_cli_begin(&cli);
    const int code =
        parsed ? run_checked(&cli, command) : hc_cli_fail(&cli, HC_CLI_USAGE, "%s", error);
    return hc_cli_finish(&cli, code);
}

int hc_cli_main(int argc, char **argv)
{
    if (argc < 2) {
        (void)fputs("heightcast: needs a command; 'heightcast --help' lists them\n", stderr);
        return HC_CLI_USAGE;
    }
    const char *word = argv[1];
    if (strcmp(word, "--version") == 0) {
        return show_version();
    }
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
        return show_help(NULL, NULL);
    }
    if (strcmp(word, "help") == 0) {
        return show_help(argc > 2 ? argv[2] : NULL, argc > 3 ? argv[3] : NULL);
    }
    int                   words   = 0;
    const hc_cli_command *command = command_named(word, argc > 2 ? argv[2] : NULL, &words);
    if (command == NULL) {
        return fail_word(word[0] == '-' ? "option" : "command", word);
    }
    hc_cli_catch_signals();
    return run(command, argc - words, argv + words);
}
