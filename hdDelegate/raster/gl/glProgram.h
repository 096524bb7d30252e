// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// One stage of a program. Lines #include "shaders/..." are resolved from what is compiled in.
struct GlStage {
    GLenum type;      ///< GL_VERTEX_SHADER...
    std::string name; ///< in messages
    std::string text; ///< without #version: that is put in front
};

/// A linked program. Made, used and destroyed with the same context current, or with those that
/// share its objects.
class GlProgram {
public:
    /// Takes it from the ProgramCache where it is in there.
    /// @returns null with the driver's messages, files named, in `error`
    static std::unique_ptr<GlProgram> make(const std::vector<GlStage>& stages, std::string& error);
    /// One of Patina's own, which every driver should take.
    /// @throws DeviceError where it does not
    static std::unique_ptr<GlProgram> own(const std::vector<GlStage>& stages);
    /// The same of shaders/raster/VERTEX.vert.glsl and FRAGMENT.frag.glsl.
    /// @param head in front of both texts
    static std::unique_ptr<GlProgram> own(const std::string& vertex, const std::string& fragment,
                                          const std::string& head = "");
    ~GlProgram() { gl.DeleteProgram(_id); }

    void use() const { gl.UseProgram(_id); }
    GLuint id() const { return _id; }
    bool isFromCache() const { return _fromCache; }
    /// -1, which OpenGL ignores, when the program has no such uniform.
    GLint uniform(const char* name) const { return gl.GetUniformLocation(_id, name); }

    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

private:
    explicit GlProgram(GLuint id) : _id(id) {}
    GLuint _id;
    bool _fromCache = false;
};

} // namespace patina
