#include "program.h"

#include "base/fail.h"

#include <epoxy/gl.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_MAX = 512, STAGES = 3 };

static int count_lines(const char *text)
{
    int lines = 0;
    for (; *text != '\0'; text++) {
        lines += *text == '\n' ? 1 : 0;
    }
    return lines;
}

/* Drivers write "0:23(4): error: ..." or "0(23) : error ...", and what #line says about files does
 * not come through all of them: so lines are counted over all texts. */
static hc_result complain(const char *message, const char *head, const hc_shader_text *files,
                          hc_log *log)
{
    int         line   = 0;
    const int   length = (int)strcspn(message, "\n");
    const char *name   = "head";
    if (sscanf(message, "%*d:%d", &line) != 1) {
        (void)sscanf(message, "%*d(%d)", &line);
    }
    for (int before = count_lines(head); line > before && files->name != NULL; files++) {
        line -= before;
        name   = files->name;
        before = count_lines(files->text);
    }
    return hc_fail(log, HC_ERROR_UNSUPPORTED, "shader %s, line %d does not compile: %.*s", name,
                   line, length, message);
}

static hc_result compile(unsigned *shader, GLenum stage, const char *head,
                         const hc_shader_text *files, hc_log *log)
{
    const char *texts[1 + HC_GL_FILES_MAX] = { head };
    int         count                      = 0;
    for (; files[count].name != NULL; count++) {
        texts[1 + count] = files[count].text;
    }
    GLint good = GL_FALSE;
    *shader    = glCreateShader(stage);
    glShaderSource(*shader, 1 + count, texts, NULL);
    glCompileShader(*shader);
    glGetShaderiv(*shader, GL_COMPILE_STATUS, &good);
    if (good == GL_TRUE) {
        return HC_OK;
    }
    char message[MESSAGE_MAX] = "";
    glGetShaderInfoLog(*shader, sizeof message, NULL, message);
    return complain(message, head, files, log);
}

static hc_result link(unsigned program, hc_log *log)
{
    GLint good = GL_FALSE;
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (good == GL_TRUE) {
        return HC_OK;
    }
    char message[MESSAGE_MAX] = "";
    glGetProgramInfoLog(program, sizeof message, NULL, message);
    return hc_fail(log, HC_ERROR_UNSUPPORTED, "shaders do not link: %.*s",
                   (int)strcspn(message, "\n"), message);
}

typedef struct stage {
    GLenum                kind;
    const hc_shader_text *files;
} stage;

static void list_stages(stage stages[STAGES], const hc_gl_recipe *recipe)
{
    stages[0] = (stage){ GL_VERTEX_SHADER, recipe->vertex };
    stages[1] = (stage){ GL_FRAGMENT_SHADER, recipe->fragment };
    stages[2] = (stage){ GL_COMPUTE_SHADER, recipe->compute };
}

hc_result hc_gl_build(unsigned *program, const hc_gl_recipe *recipe, hc_log *log)
{
    hc_result result = HC_OK;
    stage     stages[STAGES];
    list_stages(stages, recipe);
    *program = glCreateProgram();
    for (int i = 0; i < STAGES && result == HC_OK; i++) {
        unsigned shader = 0;
        if (stages[i].files->name != NULL) {
            result = compile(&shader, stages[i].kind, recipe->head, stages[i].files, log);
            glAttachShader(*program, shader);
            glDeleteShader(shader); /* as soon as the program is */
        }
    }
    result = result == HC_OK ? link(*program, log) : result;
    if (result != HC_OK) {
        glDeleteProgram(*program);
        *program = 0;
    }
    return result;
}

const char *hc_shader_text_named(const char *name)
{
    const hc_shader_text *text = hc_shader_texts;
    while (strcmp(text->name, name) != 0) {
        text++;
    }
    return text->text;
}

/* ---- kept with the context ------------------------------------------------------------------ */

enum { KEY_MAX = 512 };

struct hc_gl_program {
    struct hc_gl_program *next;
    unsigned              name;
    bool                  ran;
    char                  key[KEY_MAX];
};

static void add_words(char key[KEY_MAX], const char *words)
{
    const size_t length = strlen(key);
    (void)snprintf(key + length, KEY_MAX - length, "%s\n", words);
}

static void write_key(char key[KEY_MAX], const hc_gl_recipe *recipe)
{
    stage stages[STAGES];
    list_stages(stages, recipe);
    key[0] = '\0';
    for (int i = 0; i < STAGES; i++) {
        for (const hc_shader_text *file = stages[i].files; file->name != NULL; file++) {
            add_words(key, file->name);
        }
    }
    add_words(key, recipe->head);
}

static struct hc_gl_program *find(const hc_gl_context *context, const char *key)
{
    struct hc_gl_program *kept = context->programs;
    while (kept != NULL && strcmp(kept->key, key) != 0) {
        kept = kept->next;
    }
    return kept;
}

hc_result hc_gl_program_of(unsigned *program, hc_gl_context *context, const hc_gl_recipe *recipe,
                           hc_log *log)
{
    char key[KEY_MAX];
    write_key(key, recipe);
    struct hc_gl_program *kept = find(context, key);
    if (kept != NULL) {
        *program = kept->name;
        return HC_OK;
    }
    kept = calloc(1, sizeof *kept);
    if (kept == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a shader");
    }
    const hc_result result = hc_gl_build(&kept->name, recipe, log);
    if (result != HC_OK) {
        free(kept);
        return result;
    }
    memcpy(kept->key, key, sizeof key);
    kept->next        = context->programs;
    context->programs = kept;
    *program          = kept->name;
    return HC_OK;
}

bool hc_gl_first_run(hc_gl_context *context, unsigned program)
{
    struct hc_gl_program *kept = context->programs;
    while (kept->name != program) {
        kept = kept->next;
    }
    const bool first = !kept->ran;
    kept->ran        = true;
    return first;
}

void hc_gl_forget_programs(hc_gl_context *context)
{
    while (context->programs != NULL) {
        struct hc_gl_program *gone = context->programs;
        context->programs          = gone->next;
        free(gone);
    }
}
