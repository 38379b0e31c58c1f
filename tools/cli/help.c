/* --help, made from the tables. */
#include "commands.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

enum { COLUMNS = 80, OPTION_INDENT = 6 };

/* Print `text` word by word; newlines in it start a new line. */
static void print_wrapped(const char *text, int indent)
{
    int column = 0;
    while (*text != '\0') {
        const int length = (int)strcspn(text, " \n");
        if (column > 0 && column + 1 + length > COLUMNS) {
            (void)putchar('\n');
            column = 0;
        }
        column += column == 0 ? printf("%*s%.*s", indent, "", length, text)
                              : printf(" %.*s", length, text);
        text += length;
        if (*text == '\n') {
            (void)putchar('\n');
            column = 0;
        }
        text += *text != '\0';
    }
    (void)putchar('\n');
}

static void print_option(const hc_cli_option *option)
{
    char        words[256];
    const char *value = option->metavar;
    if (value == NULL && option->words != NULL) {
        hc_cli_join_words(words, sizeof words, option->words, "|");
        value = words;
    }
    if (option->letter != '\0') {
        (void)printf("  -%c, --%s", option->letter, option->name);
    } else {
        (void)printf("  --%s", option->name);
    }
    (void)printf("%s%s\n", value == NULL ? "" : " ", value == NULL ? "" : value);
    print_wrapped(option->help, OPTION_INDENT);
}

static void print_section(hc_cli_section section, unsigned command)
{
    static const char *const titles[HC_CLI_SECTIONS] = { "Input", "Map", "This command", "Common" };
    bool                     titled                  = false;
    for (const hc_cli_option *option = hc_cli_options; option->name != NULL; option++) {
        if (option->section != section || (option->commands & command) == 0) {
            continue;
        }
        if (!titled) {
            (void)printf("\n%s\n", titles[section]);
            titled = true;
        }
        print_option(option);
    }
}

static void print_exit_codes(void)
{
    (void)puts("\nExit codes\n"
               "  0  done, and complete on disk        3  bad or unsupported file\n"
               "  1  wrong usage                       4  out of memory, or above a limit\n"
               "  2  cannot read or write              5  verification failed");
}

void hc_cli_help_command(const hc_cli_command *command)
{
    (void)printf("Usage: heightcast %s %s [options]\n\n%s.\n", command->name, command->arguments,
                 command->summary);
    if (command->notes != NULL) {
        (void)putchar('\n');
        print_wrapped(command->notes, 0);
    }
    for (int section = 0; section < HC_CLI_SECTIONS; section++) {
        print_section((hc_cli_section)section, command->bit);
    }
    print_exit_codes();
}

void hc_cli_help(void)
{
    (void)puts("Usage: heightcast COMMAND ...\n\n"
               "Height maps in, cone step maps, max-mip pyramids and ray hits out.\n\nCommands");
    for (const hc_cli_command *command = hc_cli_commands; command->name != NULL; command++) {
        (void)printf("  %-14s %s\n", command->name, command->summary);
    }
    (void)puts("\n'heightcast help COMMAND' shows its options; --version shows the version.");
    print_exit_codes();
}
