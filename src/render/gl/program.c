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

static hc_result link(unsigned program, unsigned vertex, unsigned fragment, hc_log *log)
{
    GLint good = GL_FALSE;
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
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

hc_result hc_gl_build(unsigned *program, const char *head, const hc_shader_text *vertex,
                      const hc_shader_text *fragment, hc_log *log)
{
    unsigned  first  = 0;
    unsigned  second = 0;
    hc_result result = compile(&first, GL_VERTEX_SHADER, head, vertex, log);
    *program         = 0;
    result = result != HC_OK ? result : compile(&second, GL_FRAGMENT_SHADER, head, fragment, log);
    if (result == HC_OK) {
        *program = glCreateProgram();
        result   = link(*program, first, second, log);
    }
    if (result != HC_OK) {
        glDeleteProgram(*program);
        *program = 0;
    }
    glDeleteShader(first);
    glDeleteShader(second);
    return result;
}

static const char *text_named(const char *name)
{
    const hc_shader_text *text = hc_shader_texts;
    while (strcmp(text->name, name) != 0) {
        text++;
    }
    return text->text;
}

hc_result hc_gl_build_relief(unsigned *program, const char *head, hc_log *log)
{
    const hc_shader_text vertex[]   = { { "relief.vert", text_named("relief.vert") },
                                        { NULL, NULL } };
    const hc_shader_text fragment[] = { { "heightcast.glsl", text_named("heightcast.glsl") },
                                        { "relief.frag", text_named("relief.frag") },
                                        { NULL, NULL } };
    return hc_gl_build(program, head, vertex, fragment, log);
}
