#include "interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t caught;
static volatile sig_atomic_t deferred;

static void note(int number)
{
    if (!deferred || caught == number) {
        _exit(128 + number);
    }
    caught = number;
}

/* A signal that the parent ignores (nohup) stays ignored. */
static void catch_one(int number)
{
    struct sigaction old;
    struct sigaction action = { .sa_handler = note };
    (void)sigemptyset(&action.sa_mask);
    if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN) {
        (void)sigaction(number, &action, NULL);
    }
}

void hc_cli_catch_signals(void)
{
    catch_one(SIGINT);
    catch_one(SIGTERM);
    catch_one(SIGHUP);
    (void)signal(SIGXFSZ, SIG_IGN);
}

void hc_cli_defer_signals(bool defer)
{
    deferred = defer;
}

int hc_cli_caught_signal(void)
{
    return caught;
}
