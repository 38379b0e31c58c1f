/* heightcast: version of the headers and of the library. */
#ifndef HEIGHTCAST_VERSION_H
#define HEIGHTCAST_VERSION_H

#define HC_VERSION_MAJOR 0
#define HC_VERSION_MINOR 1
#define HC_VERSION_PATCH 0
#define HC_VERSION_STRING "0.1.0"

#if defined(_WIN32)
#define HC_API
#else
#define HC_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* "MAJOR.MINOR.PATCH" of the library that was linked; compare it with HC_VERSION_STRING. Static. */
HC_API const char *hc_version(void);

#ifdef __cplusplus
}
#endif

#endif
