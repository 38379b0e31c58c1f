/* bench_bake: `heightcast bench bake` as a program of its own, with the same options. */
#include "commands.h"

#include <stdio.h>

enum { ARGUMENTS_MAX = 256 };

int main(int argc, char **argv)
{
    static char program[]               = "heightcast";
    static char command[]               = "bench";
    static char target[]                = "bake";
    char       *full[ARGUMENTS_MAX + 1] = { program, command, target };
    if (argc + 2 > ARGUMENTS_MAX) {
        (void)fputs("bench_bake: too many arguments\n", stderr);
        return 1;
    }
    for (int i = 1; i < argc; i++) {
        full[i + 2] = argv[i];
    }
    return hc_cli_main(argc + 2, full);
}
