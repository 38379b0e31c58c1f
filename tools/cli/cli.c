/* Errors, phases and figures, for people and for programs. */
#include "cli.h"

#include "foreign.h"
#include "interrupt.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void warn_from_library(void *user, const char *line)
{
    hc_cli_warn(user, "%s", line);
}

void hc_cli_begin(hc_cli *cli)
{
    cli->json = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(cli->json, "command", cli->command);
    (void)cJSON_AddStringToObject(cli->json, "version", hc_version());
    cli->seconds     = cJSON_CreateObject();
    cli->group       = cli->json;
    cli->log.warn    = warn_from_library;
    cli->log.user    = cli;
    cli->total_start = hc_cli_now();
    if (!cli->settings.quiet) {
        hc_cli_bar_init(&cli->bar);
    }
}

/* ---- errors ---- */

int hc_cli_fail(hc_cli *cli, int code, const char *format, ...)
{
    char    line[HC_LOG_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    hc_cli_keep_to_one_line(line);
    hc_cli_bar_clear(&cli->bar);
    (void)fprintf(stderr, "heightcast %s: %s\n", cli->command, line);
    (void)cJSON_AddStringToObject(cli->json, "error", line);
    return code;
}

static int exit_code(hc_result result)
{
    switch (result) {
    case HC_OK: return HC_CLI_DONE;
    case HC_ERROR_ARGUMENT: return HC_CLI_USAGE;
    case HC_ERROR_IO:
    case HC_ERROR_EXISTS: return HC_CLI_INPUT_OUTPUT;
    case HC_ERROR_FORMAT:
    case HC_ERROR_UNSUPPORTED:
    case HC_ERROR_FIELD: return HC_CLI_BAD_FILE;
    case HC_ERROR_MEMORY:
    case HC_ERROR_LIMIT: return HC_CLI_MEMORY;
    case HC_ERROR_CANCELLED: break;
    }
    return 128;
}

/* A signal may show as a cancelled bake or as a write that failed. */
int hc_cli_fail_result(hc_cli *cli, hc_result result)
{
    const int number = hc_cli_caught_signal();
    if (number != 0) {
        return hc_cli_fail(cli, 128 + number, "stopped by a signal; nothing was written");
    }
    const char *text = cli->log.text[0] != '\0' ? cli->log.text : hc_result_name(result);
    return hc_cli_fail(cli, exit_code(result), "%s", text);
}

bool hc_cli_falls_back(hc_cli *cli, hc_result result, const char *does)
{
    hc_cli_settings *settings = &cli->settings;
    const bool       graphics =
        result == HC_ERROR_MEMORY || result == HC_ERROR_LIMIT || result == HC_ERROR_IO;
    if (settings->backend != HC_CLI_GL
        || (result != HC_ERROR_UNSUPPORTED && !(settings->either && graphics))) {
        return false;
    }
    hc_cli_warn(cli, "%s; the CPU %s", cli->log.text, does);
    settings->backend = HC_CLI_CPU;
    return true;
}

int hc_cli_fail_memory(hc_cli *cli)
{
    return hc_cli_fail(cli, HC_CLI_MEMORY, "out of memory");
}

void hc_cli_warn(hc_cli *cli, const char *format, ...)
{
    char    line[HC_LOG_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    hc_cli_keep_to_one_line(line);
    if (!cli->settings.quiet) {
        hc_cli_bar_clear(&cli->bar);
        (void)fprintf(stderr, "heightcast %s: warning: %s\n", cli->command, line);
    }
    cJSON *warnings = cJSON_GetObjectItem(cli->json, "warnings");
    if (warnings == NULL) {
        warnings = cJSON_AddArrayToObject(cli->json, "warnings");
    }
    (void)cJSON_AddItemToArray(warnings, cJSON_CreateString(line));
}

/* ---- phases ---- */

/* Baking, verifying and casting ask through their progress whether to stop, and a file that is
 * being written is finished; all else can be left where it stands. */
static bool defers_signals(const char *phase)
{
    static const char *const careful[] = { "bake", "verify", "save", "cast" };
    for (size_t i = 0; phase != NULL && i < sizeof careful / sizeof *careful; i++) {
        if (strcmp(phase, careful[i]) == 0) {
            return true;
        }
    }
    return false;
}

void hc_cli_phase(hc_cli *cli, const char *name)
{
    const double now = hc_cli_now();
    hc_cli_bar_clear(&cli->bar);
    if (cli->phase != NULL) {
        const double before = hc_cli_seconds(cli, cli->phase); /* a phase may come again */
        cJSON_DeleteItemFromObject(cli->seconds, cli->phase);
        (void)cJSON_AddNumberToObject(cli->seconds, cli->phase, before + now - cli->phase_start);
    }
    cli->phase       = name;
    cli->phase_start = now;
    hc_cli_defer_signals(defers_signals(name));
    if (name != NULL) {
        hc_cli_bar_start(&cli->bar, name);
    }
}

static bool report(void *user, double fraction)
{
    hc_cli *cli = user;
    hc_cli_bar_draw(&cli->bar, fraction);
    return hc_cli_caught_signal() == 0;
}

hc_progress hc_cli_progress(hc_cli *cli)
{
    return (hc_progress){ .report = report, .user = cli };
}

double hc_cli_seconds(const hc_cli *cli, const char *phase)
{
    const cJSON *seconds = cJSON_GetObjectItem(cli->seconds, phase);
    return seconds == NULL ? 0.0 : seconds->valuedouble;
}

/* ---- figures ---- */

void hc_cli_say(hc_cli *cli, const char *format, ...)
{
    if (cli->settings.quiet || cli->settings.json || (cli->detail && !cli->settings.verbose)) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    hc_cli_bar_clear(&cli->bar);
    (void)vfprintf(cli->on_stdout ? stdout : stderr, format, arguments);
    va_end(arguments);
}

static void say_figure(hc_cli *cli, const char *name, const char *value, const char *unit)
{
    char         label[32];
    const bool   inner  = cli->group != cli->json;
    const size_t length = strlen(name) < sizeof label - 1 ? strlen(name) : sizeof label - 1;
    for (size_t i = 0; i < length; i++) {
        label[i] = (char)(name[i] == '_' ? ' ' : name[i]);
    }
    label[length] = '\0';
    char shown[4096];
    (void)snprintf(shown, sizeof shown, "%s%s%s", value, unit == NULL ? "" : " ",
                   unit == NULL ? "" : unit);
    hc_cli_keep_to_one_line(shown);
    hc_cli_say(cli, "%s%-*s %s\n", inner ? "  " : "", inner ? 14 : 16, label, shown);
}

void hc_cli_group(hc_cli *cli, const char *name)
{
    cli->group = name == NULL ? cli->json : cJSON_AddObjectToObject(cli->json, name);
    if (name != NULL) {
        hc_cli_say(cli, "%s\n", name);
    }
}

void hc_cli_details(hc_cli *cli, bool on)
{
    cli->detail = on;
}

void hc_cli_text(hc_cli *cli, const char *name, const char *value)
{
    (void)cJSON_AddStringToObject(cli->group, name, value);
    say_figure(cli, name, value, NULL);
}

void hc_cli_number(hc_cli *cli, const char *name, double value, const char *unit)
{
    char text[64];
    (void)snprintf(text, sizeof text, "%.9g", value);
    (void)cJSON_AddNumberToObject(cli->group, name, value);
    say_figure(cli, name, text, unit);
}

void hc_cli_flag(hc_cli *cli, const char *name, bool value)
{
    (void)cJSON_AddBoolToObject(cli->group, name, value);
    say_figure(cli, name, value ? "yes" : "no", NULL);
}

/* ---- the end ---- */

static void say_seconds(hc_cli *cli)
{
    char   line[128] = "";
    size_t used      = 0;
    cJSON *phase     = NULL;
    cJSON_ArrayForEach(phase, cli->seconds)
    {
        const int wrote = snprintf(line + used, sizeof line - used, "%s%s %.3f",
                                   used == 0 ? "" : ", ", phase->string, phase->valuedouble);
        used += wrote > 0 && (size_t)wrote < sizeof line - used ? (size_t)wrote : 0;
    }
    hc_cli_say(cli, "%-16s %s\n", "seconds", line);
}

char *hc_cli_json_text(const hc_cli *cli)
{
    char *text = cJSON_Print(cli->json);
    if (text != NULL) {
        hc_cli_keep_to_utf8(text);
    }
    return text;
}

static int print_json(hc_cli *cli)
{
    char *text = hc_cli_json_text(cli);
    if (text == NULL) {
        return hc_cli_fail_memory(cli);
    }
    (void)puts(text);
    cJSON_free(text);
    return HC_CLI_DONE;
}

int hc_cli_finish(hc_cli *cli, int code)
{
    hc_cli_phase(cli, NULL);
    if (code == HC_CLI_DONE && cJSON_GetArraySize(cli->seconds) > 0) {
        (void)cJSON_AddNumberToObject(cli->seconds, "total", hc_cli_now() - cli->total_start);
        say_seconds(cli);
    }
    (void)cJSON_AddItemToObject(cli->json, "seconds", cli->seconds);
    (void)cJSON_AddNumberToObject(cli->json, "exit_code", code);
    if (cli->settings.json) {
        const int printed = print_json(cli);
        code              = code == HC_CLI_DONE ? printed : code;
    }
    if (fflush(stdout) != 0 || ferror(stdout)) {
        const int failed = hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT,
                                       "cannot write to standard output: %s", strerror(errno));
        code             = code == HC_CLI_DONE ? failed : code;
    }
    cJSON_Delete(cli->json);
    return code;
}
