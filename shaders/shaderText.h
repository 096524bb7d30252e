// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace patina {

/// A GLSL file of shaders/, compiled in, so that an installed library needs none.
struct EmbeddedShader {
    const char* path; ///< from the repository root, "shaders/lobes.glsl"
    const char* text;
};

/// Every GLSL file; the last entry has a null path.
extern const EmbeddedShader embeddedShaders[];

/// Text of a shader with its #include lines replaced by what they name.
struct ShaderText {
    std::string text;
    /// Names of the source strings that the #line directives in the text number: a driver's "3:12"
    /// is line 12 of files[3].
    std::vector<std::string> files;

    /// @returns a driver's log with the numbers of source strings replaced by file names
    std::string named(const std::string& log) const;
};

/// Flattens #include "path" lines (paths from the repository root). `text` counts as file `name`.
/// Comments and blank lines of included files are kept, so that line numbers hold.
/// @param error gets one line for each include that names no embedded shader
ShaderText flattenShader(const std::string& name, const std::string& text, std::string& error);

} // namespace patina
