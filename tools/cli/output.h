/* Outputs: refused before the long work instead of after it. */
#ifndef HC_CLI_OUTPUT_H
#define HC_CLI_OUTPUT_H

#include "cli.h"

typedef enum hc_cli_content { HC_CLI_FIELD, HC_CLI_MAP, HC_CLI_PYRAMID } hc_cli_content;

/* Depths that `container` writes such a content with; 0: none. HC_CLI_PYRAMID: with all levels. */
int hc_cli_container_bits(const hc_container *container, hc_cli_content content);
/* The endings of the containers that take the content with one of the depths: ".png, .tif, ..." */
void hc_cli_list_endings(char *text, size_t size, hc_cli_content content, int bits);

/* HC_CLI_DONE if a file could be put at `path`; else says why not and returns the exit code. */
int hc_cli_check_output(hc_cli *cli, const char *path);
/* The same for the picture that --`option` names: a .png. */
int hc_cli_check_picture(hc_cli *cli, const char *option, const char *path);

/* HC_CLI_DONE unless the options `first` and `second` name the same file, by paths a and b; either
 * may be NULL. Their folders must be there. */
int hc_cli_check_apart(hc_cli *cli, const char *first, const char *a, const char *second,
                       const char *b);

/* Bytes of the file at `path`; 0 if it is not there. */
double hc_cli_file_bytes(const char *path);

/* Write a text file: to a temporary name, then renamed. Returns the exit code. */
int hc_cli_write_text(hc_cli *cli, const char *path, const char *text);

#endif
