/* The parser: getopt_long does the splitting, the table does the rest. */
#include "options.h"
#include "commands.h"

#include <assert.h>
#include <getopt.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { LONG_ONLY = 256 };

/* What getopt_long wants to know, and where its messages would have gone. */
typedef struct parser {
    hc_cli_settings *settings;
    unsigned         command;
    int              argc;
    char           **argv;
    char            *error;
    size_t           error_size;
    struct option    longs[HC_CLI_OPTIONS_MAX + 1];
    char             letters[2 * HC_CLI_OPTIONS_MAX + 2];
} parser;

static int option_index(const char *name)
{
    int index = 0;
    while (hc_cli_options[index].name != NULL && strcmp(hc_cli_options[index].name, name) != 0) {
        index++;
    }
    return index;
}

const hc_cli_option *hc_cli_option_named(const char *name)
{
    const hc_cli_option *option = &hc_cli_options[option_index(name)];
    assert(option->name != NULL);
    return option;
}

/* Two commands may have a row of the same name; at most one of them can have been given. */
bool hc_cli_given(const hc_cli_settings *settings, const char *name)
{
    bool given = false;
    for (int i = 0; hc_cli_options[i].name != NULL; i++) {
        given = given || (strcmp(hc_cli_options[i].name, name) == 0 && settings->given[i]);
    }
    return given;
}

__attribute__((format(printf, 2, 3))) static bool fail(const parser *p, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(p->error, p->error_size, format, arguments);
    va_end(arguments);
    return false;
}

static void fill_tables(parser *p)
{
    int    longs          = 0;
    size_t letters        = 0;
    p->letters[letters++] = ':'; /* tell a missing value from an unknown option */
    for (int i = 0; hc_cli_options[i].name != NULL; i++) {
        const hc_cli_option *option = &hc_cli_options[i];
        assert(i < HC_CLI_OPTIONS_MAX);
        if ((option->commands & p->command) == 0) {
            continue;
        }
        const int value   = option->read == NULL ? no_argument
                            : option->optional   ? optional_argument
                                                 : required_argument;
        p->longs[longs++] = (struct option){ option->name, value, NULL, LONG_ONLY + i };
        if (option->letter != '\0') {
            p->letters[letters++] = option->letter;
            if (option->read != NULL) {
                p->letters[letters++] = ':';
            }
        }
    }
    p->longs[longs]     = (struct option){ 0 };
    p->letters[letters] = '\0';
}

/* Row of what getopt_long returned or left in optopt; NULL if it is not in the table. */
static const hc_cli_option *option_of(const parser *p, int value)
{
    for (int i = 0; hc_cli_options[i].name != NULL; i++) {
        const bool mine = (hc_cli_options[i].commands & p->command) != 0;
        if (value == LONG_ONLY + i || (mine && value != 0 && value == hc_cli_options[i].letter)) {
            return &hc_cli_options[i];
        }
    }
    return NULL;
}

static const parser *suggesting; /* hc_cli_words takes no context */

static const char *long_name(int index)
{
    return suggesting->longs[index].name;
}

/* The command that has an option `name`, or NULL. */
static const char *owner_of(const char *name)
{
    const unsigned owners = hc_cli_options[option_index(name)].commands;
    for (const hc_cli_command *command = hc_cli_commands; command->name != NULL; command++) {
        if ((command->bit & owners) != 0) {
            return command->name;
        }
    }
    return NULL;
}

static bool fail_unknown(parser *p, const char *flag)
{
    char name[64];
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(flag, "="), flag);
    suggesting             = p;
    const char *bare       = name + strspn(name, "-");
    const char *owner      = owner_of(bare);
    const char *suggestion = hc_cli_nearest(bare, long_name);
    if (owner != NULL) {
        return fail(p, "option %s belongs to 'heightcast %s'", name, owner);
    }
    if (suggestion != NULL) {
        return fail(p, "unknown option %s; did you mean --%s?", name, suggestion);
    }
    return fail(p, "unknown option %s; --help lists the options", name);
}

static bool fail_ambiguous(parser *p, const char *flag)
{
    char         list[256] = "";
    const size_t length    = strcspn(flag + 2, "=");
    for (int i = 0; p->longs[i].name != NULL; i++) {
        const size_t used = strlen(list);
        if (strncmp(p->longs[i].name, flag + 2, length) == 0) {
            (void)snprintf(list + used, sizeof list - used, "%s--%s", used == 0 ? "" : ", ",
                           p->longs[i].name);
        }
    }
    return fail(p, "option %s could be any of %s", flag, list);
}

/* getopt_long could not make sense of the element before optind. */
static bool fail_option(parser *p)
{
    const char          *flag   = p->argv[optind - 1];
    const hc_cli_option *option = option_of(p, optopt);
    if (option != NULL) {
        return fail(p, "--%s takes no value, got '%s'", option->name, flag);
    }
    if (optopt != 0) {
        return fail(p, "unknown option -%c; --help lists the options", optopt);
    }
    int          same   = 0;
    const size_t length = strcspn(flag + 2, "=");
    for (int i = 0; p->longs[i].name != NULL; i++) {
        same += strncmp(p->longs[i].name, flag + 2, length) == 0;
    }
    return same > 1 ? fail_ambiguous(p, flag) : fail_unknown(p, flag);
}

static const char *allowed_text(const hc_cli_option *option, char *buffer, size_t size)
{
    if (option->allowed != NULL) {
        return option->allowed;
    }
    hc_cli_join_words(buffer, size, option->words, ", ");
    return buffer;
}

static bool fail_value(parser *p, const hc_cli_option *option, const char *text)
{
    char        words[256];
    const char *allowed = allowed_text(option, words, sizeof words);
    const bool  named   = option->words != NULL && option->read != hc_cli_read_number_word;
    const char *near    = named ? hc_cli_nearest(text, option->words) : NULL;
    if (near != NULL) {
        return fail(p, "--%s %s: allowed are %s; did you mean '%s'?", option->name, text, allowed,
                    near);
    }
    return fail(p, "--%s %s: allowed are %s", option->name, text, allowed);
}

/* The value of an option whose value may be left out: the next element unless that is an option
 * too. */
static const char *optional_value(const parser *p)
{
    if (optarg != NULL) {
        return optarg;
    }
    if (optind < p->argc && (p->argv[optind][0] != '-' || p->argv[optind][1] == '\0')) {
        return p->argv[optind++];
    }
    return "-";
}

static bool take_option(parser *p, const hc_cli_option *option)
{
    p->settings->given[option - hc_cli_options] = true;
    if (option->read == NULL) {
        *(bool *)((char *)p->settings + option->target) = true;
        return true;
    }
    const char *text = option->optional ? optional_value(p) : optarg;
    return option->read(option, text, p->settings) || fail_value(p, option, text);
}

static bool take_paths(parser *p)
{
    for (int i = optind; i < p->argc; i++) {
        if (p->settings->path_count == HC_CLI_PATHS_MAX) {
            return fail(p, "unexpected argument '%s'", p->argv[i]);
        }
        p->settings->paths[p->settings->path_count++] = p->argv[i];
    }
    return true;
}

bool hc_cli_parse(hc_cli_settings *settings, unsigned command, int argc, char **argv, char *error,
                  size_t error_size)
{
    parser p = { .settings   = settings,
                 .command    = command,
                 .argc       = argc,
                 .argv       = argv,
                 .error      = error,
                 .error_size = error_size };
    fill_tables(&p);
    opterr = 0;
    for (;;) {
        const int value = getopt_long(argc, argv, p.letters, p.longs, NULL);
        if (value == -1) {
            return take_paths(&p);
        }
        const hc_cli_option *option = option_of(&p, value == ':' ? optopt : value);
        if (value == '?' || option == NULL) {
            return fail_option(&p);
        }
        if (value == ':') {
            char words[256];
            return fail(&p, "--%s needs a value: %s", option->name,
                        allowed_text(option, words, sizeof words));
        }
        if (!take_option(&p, option)) {
            return false;
        }
    }
}
