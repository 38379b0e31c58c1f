/* "Did you mean": the known name with the fewest typing errors. */
#include "options.h"

#include <string.h>

enum { NAME_MAX_LENGTH = 31 };

static int least(int a, int b, int c)
{
    const int ab = a < b ? a : b;
    return ab < c ? ab : c;
}

/* Letters to insert, delete, replace or swap with their neighbour to turn `a` into `b`. */
static int edits(const char *a, const char *b)
{
    const int length_a = (int)strlen(a);
    const int length_b = (int)strlen(b);
    int       cost[NAME_MAX_LENGTH + 1][NAME_MAX_LENGTH + 1];
    for (int i = 0; i <= length_a; i++) {
        for (int j = 0; j <= length_b; j++) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            cost[i][j] = least(cost[i - 1][j] + 1, cost[i][j - 1] + 1,
                               cost[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]
                && cost[i][j] > cost[i - 2][j - 2] + 1) {
                cost[i][j] = cost[i - 2][j - 2] + 1;
            }
        }
    }
    return cost[length_a][length_b];
}

const char *hc_cli_nearest(const char *text, hc_cli_words *words)
{
    const size_t length = strlen(text);
    const char  *best   = NULL;
    /* A third of the letters wrong is a typing error, more is another word. */
    int allowed = length < 3 ? 1 : (int)(length / 3) + 1;
    if (length > NAME_MAX_LENGTH) {
        return NULL;
    }
    for (int i = 0; words(i) != NULL; i++) {
        const int wrong = strlen(words(i)) <= NAME_MAX_LENGTH ? edits(text, words(i)) : allowed;
        if (wrong < allowed || (best == NULL && wrong == allowed && wrong < (int)length)) {
            allowed = wrong;
            best    = words(i);
        }
    }
    return best;
}
