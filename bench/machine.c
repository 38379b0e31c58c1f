#include "machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#if defined(__clang__)
#define COMPILER __VERSION__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "unknown"
#endif

/* The first "model name" of /proc/cpuinfo. */
static void read_cpu(char *name, size_t size)
{
    char  line[256];
    FILE *file = fopen("/proc/cpuinfo", "r");
    (void)snprintf(name, size, "unknown");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            (void)snprintf(name, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
            break;
        }
    }
    if (file != NULL) {
        (void)fclose(file);
    }
}

static double read_load(void)
{
    char   line[64] = "";
    double load     = -1.0;
    FILE  *file     = fopen("/proc/loadavg", "r");
    if (file != NULL) {
        if (fgets(line, sizeof line, file) != NULL) {
            load = strtod(line, NULL);
        }
        (void)fclose(file);
    }
    return load;
}

void hc_bench_machine_read(hc_bench_machine *machine)
{
    struct utsname system;
    *machine = (hc_bench_machine){ .compiler = COMPILER, .commit = HC_COMMIT };
    read_cpu(machine->cpu, sizeof machine->cpu);
    if (uname(&system) == 0) {
        (void)snprintf(machine->system, sizeof machine->system, "%.40s %.80s", system.sysname,
                       system.release);
    }
    machine->cores        = (int)sysconf(_SC_NPROCESSORS_ONLN);
    machine->memory_bytes = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    machine->load         = read_load();
}
