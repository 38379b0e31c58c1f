/* Text from outside, such as names and metadata of files, made fit to be shown. */
#ifndef HC_CLI_FOREIGN_H
#define HC_CLI_FOREIGN_H

/* Control characters become '?': none may start a line or steer a terminal. */
void hc_cli_keep_to_one_line(char *text);

/* Bytes that are no UTF-8 become '?': JSON holds nothing else. */
void hc_cli_keep_to_utf8(char *text);

#endif
