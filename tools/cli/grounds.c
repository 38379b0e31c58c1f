/* What rays are measured on, from the command line. */
#include "grounds.h"

#include <heightcast/io.h>

#include <string.h>

static int read_fields(hc_cli *cli, hc_cli_grounds *in, const char *otherwise)
{
    const char *text = cli->settings.fields == NULL ? otherwise : cli->settings.fields;
    int         code = hc_cli_read_list(cli, &in->fields, "field", text, NULL);
    for (int i = 0; code == HC_CLI_DONE && i < in->fields.count; i++) {
        const char *item = in->fields.items[i];
        const char *name = strrchr(item, '/');
        in->grounds[i]   = (hc_bench_ground){ .name = name == NULL ? item : name + 1 };
        if (strchr(item, '.') != NULL) {
            hc_load_options load   = cli->settings.load;
            load.normalise.range   = HC_RANGE_DATA; /* made fields use all of it, too */
            const hc_result result = hc_load_field(&in->tiles[i], item, &load, &cli->log);
            in->grounds[i].tile    = &in->tiles[i];
            code                   = result == HC_OK ? code : hc_cli_fail_result(cli, result);
        } else {
            code = hc_cli_check_item(cli, "field", item, hc_synth_name);
        }
    }
    return code;
}

int hc_cli_read_grounds(hc_cli *cli, hc_cli_grounds *grounds, const char *fields, const char *sides,
                        hc_cli_words *methods)
{
    const char *chosen = cli->settings.methods;
    int         code   = hc_cli_read_sides(cli, &grounds->sides, grounds->numbers, sides);
    if (code == HC_CLI_DONE && chosen != NULL) {
        code = hc_cli_read_list(cli, &grounds->methods, "methods", chosen, methods);
    }
    return code == HC_CLI_DONE ? read_fields(cli, grounds, fields) : code;
}

void hc_cli_free_grounds(hc_cli_grounds *grounds)
{
    for (int i = 0; i < HC_CLI_LIST_MAX; i++) {
        hc_free_field(&grounds->tiles[i]);
    }
}
