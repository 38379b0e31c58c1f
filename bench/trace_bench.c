#include "trace_bench.h"

#include "peers.h"
#include "trace_rays.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { DEFAULT_THREADS = 2, THREADS_MAX = 64, CHUNK = 1 << 14 };

static const hc_bench_peer *const peers[] = {
    &hc_peer_fast,
#if defined(HC_HAVE_EMBREE)
    &hc_peer_embree_triangles,
    &hc_peer_embree_grids,
#endif
#if defined(HC_HAVE_BULLET)
    &hc_peer_bullet,
#endif
};

enum { PEERS = (int)(sizeof peers / sizeof *peers) };

typedef struct bench {
    const hc_bench_trace_options *options;
    const char                   *name;
    hc_field                      field;
    hc_ray                       *rays[HC_RAYS_TIMED];
    hc_hit                       *hits; /* of one set; or its bytes, for any hit */
    size_t                        count;
} bench;

/* A scene, and what was measured of making it. */
typedef struct stage {
    const hc_bench_peer *peer;
    void                *scene;
    double               build_seconds;
} stage;

/* Part of a set for one thread: every `share`-th chunk, beginning with chunk `first`. */
typedef struct part {
    const bench *bench;
    const stage *stage;
    int          mode, set, first, step;
} part;

static double read_clock(clockid_t clock)
{
    struct timespec now;
    (void)clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

const char *hc_bench_caster(int index)
{
    return index >= 0 && index < PEERS ? peers[index]->name : NULL;
}

static void *run_part(void *context)
{
    const part          *p    = context;
    const bench         *b    = p->bench;
    const hc_bench_peer *peer = p->stage->peer;
    uint8_t             *any  = (uint8_t *)b->hits;
    const size_t         step = (size_t)p->step * CHUNK;
    for (size_t i = (size_t)p->first * CHUNK; i < b->count; i += step) {
        const size_t  count = b->count - i < CHUNK ? b->count - i : CHUNK;
        const hc_ray *rays  = b->rays[p->set] + i;
        if (hc_bench_rays_any((hc_bench_rays)p->set)) {
            peer->any(p->stage->scene, p->mode, any + i, rays, count);
        } else {
            peer->nearest(p->stage->scene, p->mode, b->hits + i, rays, count);
        }
    }
    return NULL;
}

/* Time of a set on so many threads: by the clock on the wall, on one thread by that of the
 * processor, which other programs disturb less. */
static double run_set(const bench *b, const stage *s, int mode, int set, int threads)
{
    pthread_t       ids[THREADS_MAX];
    part            parts[THREADS_MAX];
    int             started = 0;
    const clockid_t clock   = threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
    const double    start   = read_clock(clock);
    for (int i = 0; i < threads; i++) {
        parts[i] = (part){ b, s, mode, set, i * s->peer->share, threads * s->peer->share };
    }
    while (started + 1 < threads
           && pthread_create(&ids[started], NULL, run_part, &parts[started + 1]) == 0) {
        started++;
    }
    (void)run_part(&parts[0]);
    for (int i = 0; i < started; i++) {
        (void)pthread_join(ids[i], NULL);
    }
    for (int i = started + 1; i < threads; i++) { /* threads that were not to be had */
        (void)run_part(&parts[i]);
    }
    return read_clock(clock) - start;
}

/* Rays that a run casts, and how many of them hit. */
static size_t count_hits(const bench *b, const stage *s, int set, size_t *cast)
{
    const uint8_t *any  = (const uint8_t *)b->hits;
    size_t         hits = 0;
    *cast               = 0;
    for (size_t i = 0; i < b->count; i++) {
        if (i / CHUNK % (size_t)s->peer->share == 0) {
            (*cast)++;
            hits += hc_bench_rays_any((hc_bench_rays)set) ? any[i] != 0 : b->hits[i].t < INFINITY;
        }
    }
    return hits;
}

/* A row in the making. */
typedef struct line {
    const stage *stage;
    int          mode, threads;
    double       fastest;
    size_t       cast, hits;
} line;

enum { LINES = PEERS * HC_PEER_MODES * 2 };

static int list_lines(line *lines, const bench *b, const stage *stages, int count)
{
    const int asked   = b->options->plan.threads;
    const int wanted  = asked > 0 ? asked : DEFAULT_THREADS;
    const int threads = wanted < THREADS_MAX ? wanted : THREADS_MAX;
    int       made    = 0;
    for (int i = 0; i < count; i++) {
        for (int mode = 0; mode < HC_PEER_MODES && stages[i].peer->modes[mode] != NULL; mode++) {
            for (int n = 1; n <= threads; n += threads > 1 ? threads - 1 : 1) {
                lines[made++] = (line){ .stage = &stages[i], .mode = mode, .threads = n };
            }
        }
    }
    return made;
}

static void report(const bench *b, const line *l, int set)
{
    const hc_bench_trace_options *options = b->options;
    const stage                  *s       = l->stage;
    const hc_bench_trace_row      row     = { .field           = b->name,
                                              .side            = b->field.width,
                                              .rays            = hc_bench_rays_name(set),
                                              .caster          = s->peer->name,
                                              .mode            = s->peer->modes[l->mode],
                                              .threads         = l->threads,
                                              .count           = l->cast,
                                              .runs            = hc_bench_repeat(&options->plan),
                                              .seconds         = l->fastest,
                                              .rays_per_second = (double)l->cast / l->fastest,
                                              .hits            = (double)l->hits / (double)l->cast,
                                              .build_seconds   = s->build_seconds,
                                              .bytes           = s->peer->bytes(s->scene) };
    options->row_done(options->user, &row);
}

/* Casters take turns: a machine that is slower for a while is so for all. */
static hc_result measure_set(const bench *b, line *lines, int count, int set)
{
    for (int i = 0; i < count; i++) {
        lines[i].fastest = INFINITY;
    }
    for (int run = 0; run < hc_bench_repeat(&b->options->plan); run++) {
        for (line *l = lines; l < lines + count; l++) {
            if (hc_bench_stopped(&b->options->plan)) {
                return HC_ERROR_CANCELLED;
            }
            l->fastest = fmin(l->fastest, run_set(b, l->stage, l->mode, set, l->threads));
            if (run == 0) { /* each run has the same */
                l->hits = count_hits(b, l->stage, set, &l->cast);
            }
        }
    }
    for (int i = 0; i < count; i++) {
        report(b, &lines[i], set);
    }
    return HC_OK;
}

static hc_result measure_all(const bench *b, const stage *stages, int count)
{
    line      lines[LINES];
    const int made   = list_lines(lines, b, stages, count);
    hc_result result = HC_OK;
    for (int set = 0; set < HC_RAYS_TIMED && result == HC_OK; set++) {
        result = measure_set(b, lines, made, set);
    }
    return result;
}

static bool build(stage *s, const bench *b, const hc_bench_peer *peer)
{
    const double start = read_clock(CLOCK_PROCESS_CPUTIME_ID);
    s->peer            = peer;
    s->scene           = peer->create(&b->field, b->options->plan.isa);
    s->build_seconds   = read_clock(CLOCK_PROCESS_CPUTIME_ID) - start;
    return s->scene != NULL;
}

static hc_result run_peers(const bench *b)
{
    stage stages[PEERS];
    int   count = 0;
    bool  built = true;
    for (int i = 0; i < PEERS && built; i++) {
        if (hc_bench_chosen(&b->options->plan, peers[i]->name)) {
            built = build(&stages[count], b, peers[i]);
            count += built ? 1 : 0;
        }
    }
    const hc_result result = built ? measure_all(b, stages, count) : HC_ERROR_MEMORY;
    for (int i = 0; i < count; i++) {
        stages[i].peer->destroy(stages[i].scene);
    }
    return result;
}

static bool take(bench *b)
{
    bool taken = true;
    b->hits    = calloc(b->count, sizeof *b->hits);
    for (int set = 0; set < HC_RAYS_TIMED; set++) {
        b->rays[set] = malloc(b->count * sizeof **b->rays);
        taken        = taken && b->rays[set] != NULL;
    }
    return taken && b->hits != NULL;
}

static hc_result run_field(void *job, const char *name, const hc_field *field)
{
    const hc_bench_trace_options *options = job;
    const size_t                  asked   = options->rays;
    const size_t                  count   = asked > 0 ? asked : HC_RAYS_PICTURE;
    bench     b      = { .options = options, .name = name, .field = *field, .count = count };
    hc_result result = HC_ERROR_MEMORY;
    if (take(&b)) {
        for (int set = 0; set < HC_RAYS_TIMED; set++) {
            hc_bench_fill_rays(b.rays[set], b.count, (hc_bench_rays)set, &b.field);
        }
        result = run_peers(&b);
    }
    for (int set = 0; set < HC_RAYS_TIMED; set++) {
        free(b.rays[set]);
    }
    free(b.hits);
    return result;
}

hc_result hc_bench_trace(const hc_bench_trace_options *options, hc_log *log)
{
    hc_bench_trace_options job = *options;
    return hc_bench_each_field(&options->plan, run_field, &job, log);
}
