/* Ctrl-C and its like: at once while there is nothing to lose, else where the work can stop
 * cleanly. */
#ifndef HC_CLI_INTERRUPT_H
#define HC_CLI_INTERRUPT_H

#include <stdbool.h>

/* From now on SIGINT, SIGTERM and SIGHUP end the program with the exit code 128 + signal. Also
 * makes a file that grows beyond the shell's limit a write error instead of a death. */
void hc_cli_catch_signals(void);

/* True: signals are only noted, for work that asks or that must be finished; a second one of a kind
 * ends the program all the same. */
void hc_cli_defer_signals(bool defer);

/* The signal that was noted, or 0. */
int hc_cli_caught_signal(void);

#endif
