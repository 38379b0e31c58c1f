#include "lists.h"

#include <string.h>

bool hc_cli_split(hc_cli_list *list, const char *text)
{
    const size_t length = strlen(text);
    list->count         = 0;
    if (length >= sizeof list->text) {
        return false;
    }
    memcpy(list->text, text, length + 1);
    for (char *item = list->text;;) {
        char *comma = strchr(item, ',');
        if (comma != NULL) {
            *comma = '\0';
        }
        if (*item == '\0' || list->count == HC_CLI_LIST_MAX) {
            return false;
        }
        list->items[list->count++] = item;
        if (comma == NULL) {
            return true;
        }
        item = comma + 1;
    }
}
