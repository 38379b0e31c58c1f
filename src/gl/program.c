#include "program.h"

#include "base/fail.h"

#include <epoxy/gl.h>

#include <stdio.h>
#include <string.h>

enum { FILES_MAX = 4, MESSAGE_MAX = 512 };

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
    const char *texts[1 + FILES_MAX] = { head };
    int         count                = 0;
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

static hc_result build(unsigned *program, const char *head, const stage *stages, int count,
                       hc_log *log)
{
    hc_result result = HC_OK;
    *program         = glCreateProgram();
    for (int i = 0; i < count && result == HC_OK; i++) {
        unsigned shader = 0;
        result          = compile(&shader, stages[i].kind, head, stages[i].files, log);
        glAttachShader(*program, shader);
        glDeleteShader(shader); /* as soon as the program is */
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

hc_result hc_gl_build(unsigned *program, const char *head, const hc_shader_text *vertex,
                      const hc_shader_text *fragment, hc_log *log)
{
    const stage stages[] = { { GL_VERTEX_SHADER, vertex }, { GL_FRAGMENT_SHADER, fragment } };
    return build(program, head, stages, 2, log);
}

hc_result hc_gl_build_compute(unsigned *program, const char *head, const hc_shader_text *compute,
                              hc_log *log)
{
    const stage stages[] = { { GL_COMPUTE_SHADER, compute } };
    return build(program, head, stages, 1, log);
}
