/* Casters to measure: our own, and those of others where their packages are found. */
#ifndef HC_BENCH_PEERS_H
#define HC_BENCH_PEERS_H

#include <heightcast/trace.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HC_PEER_MODES = 4 };

typedef struct hc_bench_peer {
    const char *name;
    const char *modes[HC_PEER_MODES]; /* NULL: fewer */
    int         share; /* measured on one chunk of rays in so many: slow ones would take hours */
    /* Scene of a field in the world of trace_rays.h, built on one thread; NULL: it failed. */
    void *(*create)(const hc_field *field, hc_isa isa);
    void (*destroy)(void *scene);
    double (*bytes)(const void *scene); /* held, without what it borrows; 0: not known */
    /* nearest: t of hits[i]; INFINITY for a miss. Called from several threads at once. */
    void (*nearest)(const void *scene, int mode, hc_hit *hits, const hc_ray *rays, size_t count);
    void (*any)(const void *scene, int mode, uint8_t *any, const hc_ray *rays, size_t count);
} hc_bench_peer;

extern const hc_bench_peer hc_peer_fast, hc_peer_embree_triangles, hc_peer_embree_grids,
    hc_peer_bullet;

#ifdef __cplusplus
}
#endif

#endif
