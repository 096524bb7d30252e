// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glProgram.h"

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/programCache.h"
#include "shaders/deadBranches.h"
#include "shaders/shaderText.h"
#include "shaders/unusedFunctions.h"

namespace patina {

namespace {

std::string log(GLuint object, PFNGLGETSHADERIVPROC get, PFNGLGETSHADERINFOLOGPROC read) {
    GLint length = 0;
    get(object, GL_INFO_LOG_LENGTH, &length);
    std::string text(size_t(length > 0 ? length : 0), '\0');
    if (!text.empty()) read(object, length, nullptr, &text[0]);
    while (!text.empty() && (text.back() == '\0' || text.back() == '\n'))
        text.pop_back();
    return text;
}

/// The text as the driver gets it.
ShaderText sourceOf(const GlStage& stage, std::string& error) {
    ShaderText source = flattenShader(stage.name, stage.text, error);
    // The number of a draw in its call.
    const std::string draw = stage.type != GL_VERTEX_SHADER ? ""
                             : gl.tellsDraws
                                 ? "#extension GL_ARB_shader_draw_parameters : require\n"
                                   "#define DRAW_OF_CALL gl_DrawIDARB\n"
                                 : "#define DRAW_OF_CALL 0\n";
    source.text = "#version 450 core\n" + draw + "#line 1 0\n" +
                  withoutUnusedFunctions(withoutDeadBranches(source.text));
    if (glFault("program") == stage.name) source.text += "#error asked for by PATINA_GL_FAULT\n";
    return source;
}

GLuint compile(const GlStage& stage, const ShaderText& source, std::string& error) {
    const GLuint shader = gl.CreateShader(stage.type);
    const char* text = source.text.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint ok = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    error = stage.name + " does not compile:\n" +
            source.named(log(shader, gl.GetShaderiv, gl.GetShaderInfoLog));
    gl.DeleteShader(shader);
    return 0;
}

} // namespace

std::unique_ptr<GlProgram> GlProgram::make(const std::vector<GlStage>& stages, std::string& error) {
    error.clear();
    std::vector<ShaderText> sources;
    std::vector<std::string> keys;
    for (const GlStage& stage : stages) {
        sources.push_back(sourceOf(stage, error));
        if (!error.empty()) return nullptr;
        keys.push_back(std::to_string(stage.type) + sources.back().text);
    }
    const ProgramCache cache(keys);
    std::unique_ptr<GlProgram> stored(new GlProgram(gl.CreateProgram()));
    if (cache.load(stored->_id)) {
        stored->_fromCache = true;
        return stored;
    }
    std::unique_ptr<GlProgram> program(new GlProgram(gl.CreateProgram()));
    for (size_t i = 0; i < stages.size(); ++i) {
        const GLuint shader = compile(stages[i], sources[i], error);
        if (!shader) return nullptr;
        gl.AttachShader(program->_id, shader);
        gl.DeleteShader(shader); // lives as long as the program
    }
    cache.prepare(program->_id);
    gl.LinkProgram(program->_id);
    GLint ok = 0;
    gl.GetProgramiv(program->_id, GL_LINK_STATUS, &ok);
    if (ok) {
        cache.store(program->_id);
        return program;
    }
    error = (stages.empty() ? "program" : stages[0].name) + " does not link:\n" +
            log(program->_id, gl.GetProgramiv, gl.GetProgramInfoLog);
    return nullptr;
}

std::unique_ptr<GlProgram> GlProgram::own(const std::vector<GlStage>& stages) {
    std::string error;
    if (auto program = make(stages, error)) return program;
    throw DeviceError("the driver does not take the shaders: " + oneLine(error));
}

std::unique_ptr<GlProgram> GlProgram::own(const std::string& vertex, const std::string& fragment,
                                          const std::string& head) {
    const std::string begin = head + "#include \"shaders/raster/";
    return own({{GL_VERTEX_SHADER, vertex, begin + vertex + ".vert.glsl\"\n"},
                {GL_FRAGMENT_SHADER, fragment, begin + fragment + ".frag.glsl\"\n"}});
}

} // namespace patina
