/* Results, messages and progress: how every cold function of heightcast reports.
 *
 * Cold functions (load, normalise, bake, save) check everything they are given, return an hc_result
 * and, when an hc_log is passed, leave one line in it that names the culprit, its value and the
 * remedy. They never print. */
#ifndef HEIGHTCAST_RESULT_H
#define HEIGHTCAST_RESULT_H

#include <heightcast/version.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum hc_result {
    HC_OK = 0,
    HC_ERROR_ARGUMENT,    /* an option or size that no input could make right                     */
    HC_ERROR_IO,          /* a file could not be opened, read, written, renamed; the disk is full */
    HC_ERROR_EXISTS,      /* the output exists and overwriting was not asked for                  */
    HC_ERROR_FORMAT,      /* the bytes are damaged or not the format they claim                   */
    HC_ERROR_UNSUPPORTED, /* well-formed, but a variant that is not read or cannot be written     */
    HC_ERROR_FIELD,       /* heights that cannot be used: NaN, infinite, nodata, outside 0..1     */
    HC_ERROR_MEMORY,      /* allocation failed                                                    */
    HC_ERROR_LIMIT,       /* a size above a stated, adjustable limit                              */
    HC_ERROR_CANCELLED    /* the progress callback asked to stop; outputs are unspecified         */
} hc_result;

/* Name of a result, such as "HC_ERROR_FORMAT"; "unknown" for any other value. Static. */
HC_API const char *hc_result_name(hc_result result);

#define HC_LOG_TEXT_SIZE 1024

/* Where messages go. Zero is a good default: keeps the last error's text, drops warnings.
 * One log serves one thread at a time. */
typedef struct hc_log {
    char text[HC_LOG_TEXT_SIZE];                /* last error, one line, no newline; "" if none */
    void (*warn)(void *user, const char *line); /* called for each warning, may be NULL         */
    void *user;
} hc_log;

/* Progress and cancelling. Zero: none.
 * `report` is called with a fraction that never falls, from the thread that called the library,
 * about 200 times at most per operation; returning false asks to stop, and the operation returns
 * HC_ERROR_CANCELLED soon after. */
typedef struct hc_progress {
    bool (*report)(void *user, double fraction);
    void *user;
} hc_progress;

/* Instruction set of the vector kernels. Results do not depend on it: same bytes for each. */
typedef enum hc_isa {
    HC_ISA_AUTO = 0, /* the widest that this machine and this build have */
    HC_ISA_SCALAR,
    HC_ISA_AVX2,
    HC_ISA_AVX512
} hc_isa;

/* The instruction set that `wanted` comes to on this machine and in this build; never
 * HC_ISA_AUTO. */
HC_API hc_isa      hc_isa_resolve(hc_isa wanted);
HC_API const char *hc_isa_name(hc_isa isa); /* "auto", "scalar", "avx2", "avx512"; static */

#ifdef __cplusplus
}
#endif

#endif
