// SPDX-License-Identifier: Apache-2.0
// The data with which a page shows a material in WebGL2: its text, its textures, and the text that
// all share.

#include "hdDelegate/image/textureSystem.h"
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/glsl/glslLobes.h"
#include "materialNetwork/glsl/glslWeb.h"
#include "materialNetwork/material.h"
#include "plugin/python/warningList.h"
#include "shaders/shaderText.h"
#include "shaders/shaders.h"
#include "shaders/unusedFunctions.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace py = pybind11;

namespace patina {

namespace {

const char* wrapName(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::Black: return "black";
    case TextureWrap::Clamp: return "clamp";
    case TextureWrap::Mirror: return "mirror";
    case TextureWrap::Repeat: break;
    }
    return "repeat";
}

/// Linear texels of the first level that fits, four floats each, top row first.
py::dict textureOf(const TextureSystem& textures, int handle, int largest) {
    py::dict dict;
    const std::shared_ptr<const ImageTexture> image = textures.image(handle);
    const TextureRequest& request = textures.request(handle);
    dict["wrap"] = py::make_tuple(wrapName(request.wrapS), wrapName(request.wrapT));
    dict["nearest"] = request.nearest;
    dict["file"] = request.file;
    int width = 1, height = 1, level = 0;
    if (image) {
        const auto& levels = image->levels();
        while (level + 1 < int(levels.size()) &&
               std::max(levels[size_t(level)].width, levels[size_t(level)].height) > largest)
            ++level;
        width = levels[size_t(level)].width;
        height = levels[size_t(level)].height;
    }
    dict["fullSize"] = py::make_tuple(image ? image->width() : 0, image ? image->height() : 0);
    py::array_t<float> texels(std::vector<size_t>{size_t(height), size_t(width), 4});
    float* to = texels.mutable_data();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            // Magenta, as TextureSystem::sample() shows what cannot be read.
            const glm::vec4 texel =
                image ? image->texel(level, x, y) : glm::vec4(1.0f, 0.0f, 1.0f, 1.0f);
            for (int c = 0; c < 4; ++c)
                *to++ = texel[c];
        }
    dict["texels"] = texels;
    return dict;
}

/// The traits that decide which functions a program calls: equal lists cost a driver the same.
std::vector<std::string> lobesOf(const MaterialProgram& program) {
    std::vector<std::string> list;
    for (const LobeTemplate& lobe : program.code().lobes)
        list.push_back(lobeRow(lobe.kind).prefix + std::string(" ") + std::to_string(lobe.mode) +
                       " " + std::to_string(lobe.variant) + " " + std::to_string(lobe.ndf) +
                       (lobe.film ? " film" : "") + (lobe.passThrough ? " passThrough" : ""));
    return list;
}

/// The text with the functions of its nodes, of whose files it needs few.
std::string withNodeFunctions(const std::string& text) {
    std::string includes, own, error;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        (line.compare(0, 10, "#include \"") == 0 ? includes : own) += line + "\n";
    const std::string functions = flattenShader("nodes", includes, error).text;
    if (!error.empty()) throw std::runtime_error(error);
    return withoutUnusedFunctions(functions, own) + own;
}

py::dict webMaterial(const Network& network, const MethodChoices& methods, int largestTexture) {
    Diagnostics diagnostics;
    TextureSystem textures(diagnostics);
    std::shared_ptr<const MaterialProgram> program;
    GlslWebMaterial glsl;
    {
        py::gil_scoped_release release;
        program = compileMaterial(network, textures, diagnostics, methods);
        glsl = makeGlslWebMaterial(program->ir());
    }
    py::dict dict;
    dict["text"] = withNodeFunctions(glsl.text);
    py::list parameters;
    for (const glm::vec4& p : glsl.parameters)
        for (int c = 0; c < 4; ++c)
            parameters.append(p[c]);
    dict["parameters"] = parameters;
    py::list leftOut;
    for (const Message& what : glsl.leftOut)
        leftOut.append(py::make_tuple(nameOf(what.id), what.text()));
    dict["leftOut"] = leftOut;
    dict["presence"] = glsl.presence;
    dict["emission"] = glsl.emission;
    dict["lobes"] = lobesOf(*program);
    dict["subsurface"] = program->hasSubsurface();
    dict["interior"] = program->hasInterior();
    dict["volumeOnly"] = program->isVolumeOnly();
    dict["displacement"] = program->hasDisplacement();
    py::list primvars, images;
    for (const MaterialPrimvar& primvar : program->primvars())
        primvars.append(py::make_tuple(primvar.name, valueTypeName(primvar.type)));
    for (const int handle : glsl.textures)
        images.append(textureOf(textures, handle, largestTexture));
    dict["primvars"] = primvars;
    dict["textures"] = images;
    dict["warnings"] = warningList(diagnostics);
    return dict;
}

std::string shaderText(const std::string& path) {
    std::string error;
    const ShaderText text = flattenShader("page", "#include \"" + path + "\"\n", error);
    if (!error.empty()) throw py::value_error(error);
    return text.text;
}

py::array_t<float> albedoTableArray() {
    return py::array_t<float>(std::vector<size_t>{size_t(sh::ALBEDO_TABLE_SIZE)},
                              patinaAlbedoTable);
}

} // namespace

void bindWeb(py::module_& m) {
    m.def("web_material", &webMaterial, py::arg("network"), py::arg("methods") = MethodChoices(),
          py::arg("largest_texture") = 1024,
          "A material as GLSL ES 3.00 with what it reads: text, primvars (name, type), textures as "
          "arrays of linear texels no larger than largest_texture, lobes, warnings, what was left "
          "out.");
    m.def("shader_text", &shaderText, py::arg("path"),
          "Text of a shader that is compiled in, with its includes; ValueError for others.");
    m.def("albedo_table", &albedoTableArray,
          "The baked directional albedos, in the layout of shaders/lib/albedoTable.glsl.");
    m.attr("ALBEDO_MICROFACET_SIZE") = int(sh::MICROFACET_SIZE);
    m.attr("ALBEDO_WARD_TABLE") = int(sh::WARD_TABLE);
}

} // namespace patina
