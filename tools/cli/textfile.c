#include "textfile.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX = 4096 };

static int split(char *words[HC_CLI_WORDS_MAX], char *line)
{
    int   count              = 0;
    char *rest               = NULL;
    line[strcspn(line, "#")] = '\0';
    for (char *word = strtok_r(line, " \t\r\n,", &rest); word != NULL && count < HC_CLI_WORDS_MAX;
         word       = strtok_r(NULL, " \t\r\n,", &rest)) {
        words[count++] = word;
    }
    return count;
}

/* Length of the next line, without its end; LINE_MAX: it is longer; -1: there is none. */
static int next_line(char line[LINE_MAX], FILE *file)
{
    int length = 0;
    int c      = getc(file);
    if (c == EOF) {
        return -1;
    }
    while (c != EOF && c != '\n' && length < LINE_MAX) {
        line[length++] = (char)c;
        c              = getc(file);
    }
    line[length < LINE_MAX ? length : LINE_MAX - 1] = '\0';
    return length;
}

int hc_cli_read_lines(hc_cli *cli, const char *path, hc_cli_line *take, void *user)
{
    char  line[LINE_MAX];
    int   code = HC_CLI_DONE;
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot read %s: %s", path, strerror(errno));
    }
    for (int i = 1; code == HC_CLI_DONE; i++) {
        char     *words[HC_CLI_WORDS_MAX];
        const int length = next_line(line, file);
        if (length < 0) {
            break;
        }
        if (length == LINE_MAX) {
            code = hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s, line %d: longer than %d characters", path,
                               i, LINE_MAX - 1);
        } else if (strlen(line) < (size_t)length) {
            code = hc_cli_fail(cli, HC_CLI_BAD_FILE,
                               "%s, line %d: has a zero byte; save it as text", path, i);
        } else {
            const int count = split(words, line);
            code            = count > 0 ? take(user, cli, words, count, i) : HC_CLI_DONE;
        }
    }
    if (code == HC_CLI_DONE && ferror(file)) {
        code = hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot read %s: %s", path, strerror(errno));
    }
    (void)fclose(file);
    return code;
}

bool hc_cli_word_number(double *value, const char *word)
{
    char *end = NULL;
    *value    = strtod(word, &end);
    return end != word && *end == '\0' && isfinite(*value);
}
