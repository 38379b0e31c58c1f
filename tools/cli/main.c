/* heightcast */
#include "commands.h"

int main(int argc, char **argv)
{
    return hc_cli_main(argc, argv);
}
