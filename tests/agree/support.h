/* What the agreement tests share: fields that are hard on bakers, shapes, and a random source. */
#ifndef AGREE_SUPPORT_H
#define AGREE_SUPPORT_H

#include <heightcast/bake.h>

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <setjmp.h>

#include <cmocka.h>

/* Tests of many fields take one of so many where a sanitizer makes them a dozen times slower: what
 * it looks for is found on few. Has no common factors with the kinds and modes of fields. */
#if defined(__has_feature)
#define AGREE_CLANG_SANITIZES (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define AGREE_CLANG_SANITIZES 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || AGREE_CLANG_SANITIZES
enum { AGREE_STRIDE = 7 };
#else
enum { AGREE_STRIDE = 1 };
#endif

/* ---- random numbers: splitmix64, the same on every machine ---------------------------------- */

uint64_t agree_random(uint64_t *state);
double   agree_uniform(uint64_t *state);                  /* [0, 1)             */
int      agree_range(uint64_t *state, int low, int high); /* low .. high, both in */

/* ---- fields --------------------------------------------------------------------------------- */

/* Hard fields by number, 0 .. AGREE_KINDS - 1. */
enum { AGREE_KINDS = 18 };
void agree_fill(float *heights, int width, int height, int kind, uint64_t seed);

typedef struct agree_shape {
    int width, height;
} agree_shape;

typedef struct agree_shapes {
    int         count;
    agree_shape shapes[16];
} agree_shapes;

/* Every size class: single samples, rows, columns, 2x2, odd, prime, not square, powers of two and
 * one beside them. Small enough for the all-pairs reference; or several blocks and tiles large,
 * for comparisons among bakers. */
extern const agree_shapes agree_small, agree_middle;

/* All shapes with all wrap modes with all kinds, by number; the registrations take turns. Heights
 * are allocated; free them with agree_free. A stride without common factors with 4 and AGREE_KINDS
 * still visits all modes and kinds. */
int      agree_field_count(const agree_shapes *shapes);
hc_field agree_field(const agree_shapes *shapes, int number);
/* The name of that field's kind. */
const char *agree_kind_of(int number);

/* One such field of one's choice. */
hc_field agree_make_field(agree_shape shape, int kind, uint64_t seed, hc_wrap wrap,
                          hc_registration registration);

/* A field of hc_synth, or the real elevations ("dem") cut or repeated in mirror image to that
 * size. */
hc_field agree_named_field(const char *name, int width, int height, uint64_t seed, hc_wrap wrap);
void     agree_free(hc_field *field);

/* "funnel 17x3 wrap uv grid", for messages. Static; each call
 * overwrites the last of the thread. */
const char *agree_describe(const char *kind, const hc_field *field);

/* ---- bakes ---------------------------------------------------------------------------------- */

/* Ratios from malloc; fails the test if the bake does. */
float *agree_bake(const hc_field *field, const hc_cone_options *options);

size_t agree_count(const hc_field *field, hc_cones cones); /* floats in a ratio array */

/* Index of the first float whose bits differ, or `count`. */
size_t agree_first_difference(const float *a, const float *b, size_t count);

/* Fails the test, naming the place, unless two maps have the same bits. `what` was found. */
void agree_expect_same(const hc_field *field, const char *kind, hc_cones cones, const char *what,
                       const float *expected, const float *found);

#endif
