/* Where figures were measured. */
#ifndef HC_BENCH_MACHINE_H
#define HC_BENCH_MACHINE_H

typedef struct hc_bench_machine {
    char        cpu[128];    /* "unknown" if the system does not say           */
    char        system[128]; /* kernel and its release                         */
    int         cores;       /* on line                                        */
    double      memory_bytes;
    double      load;     /* average of the last minute; -1: unknown           */
    const char *compiler; /* that built this program                           */
    const char *commit;   /* of the sources when they were configured          */
} hc_bench_machine;

void hc_bench_machine_read(hc_bench_machine *machine);

#endif
