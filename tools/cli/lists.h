/* Comma-separated values. */
#ifndef HC_CLI_LISTS_H
#define HC_CLI_LISTS_H

#include <stdbool.h>

enum { HC_CLI_LIST_MAX = 32, HC_CLI_LIST_TEXT_MAX = 512 };

typedef struct hc_cli_list {
    char        text[HC_CLI_LIST_TEXT_MAX]; /* the items, each ended by '\0' */
    const char *items[HC_CLI_LIST_MAX];
    int         count;
} hc_cli_list;

/* False if there are too many items, too long a text, or an empty item. */
bool hc_cli_split(hc_cli_list *list, const char *text);

#endif
