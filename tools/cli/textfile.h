/* Text files of words: one thing on each line, # begins a comment. */
#ifndef HC_CLI_TEXTFILE_H
#define HC_CLI_TEXTFILE_H

#include "cli.h"

enum { HC_CLI_WORDS_MAX = 16 };

/* What becomes of a line; returns an exit code. count: of its words, HC_CLI_WORDS_MAX if there are
 * as many or more. */
typedef int hc_cli_line(void *user, hc_cli *cli, char **words, int count, int line);

/* Hand on each line that has words, until one gives anything but HC_CLI_DONE. Returns the exit
 * code: also for files that cannot be read, are no text, or have too long lines. */
int hc_cli_read_lines(hc_cli *cli, const char *path, hc_cli_line *take, void *user);

/* A finite number and nothing else. */
bool hc_cli_word_number(double *value, const char *word);

#endif
