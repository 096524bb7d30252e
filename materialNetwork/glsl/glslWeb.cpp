// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslWeb.h"

#include "materialNetwork/glsl/glslMaterial.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace patina {

namespace {

/// As a GLSL literal; what is not finite has none.
std::string literal(float x) {
    if (std::isnan(x)) x = 0.0f;
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", double(std::clamp(x, -3e38f, 3e38f)));
    std::string text = buffer;
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string literal(const glm::vec4& v) {
    return "vec4(" + literal(v.x) + ", " + literal(v.y) + ", " + literal(v.z) + ", " +
           literal(v.w) + ")";
}

bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Whether `word` begins at i; not in the middle of another.
bool wordAt(const std::string& text, size_t i, const std::string& word) {
    return text.compare(i, word.size(), word) == 0 && (i == 0 || !isWord(text[i - 1]));
}

size_t digitsFrom(const std::string& text, size_t i) {
    while (i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])))
        ++i;
    return i;
}

/// One line in the words of ES: parameters[3] -> vec4(...), parameters[i] -> parameterAt(i),
/// primvar(2, x) -> primvar2(x).
std::string rewritten(const std::string& line, const std::vector<glm::vec4>& parameters,
                      bool& readsTables) {
    static const std::string parameter = "parameters[", primvar = "primvar(";
    std::string out;
    for (size_t i = 0; i < line.size();) {
        const bool isParameter = wordAt(line, i, parameter);
        if (!isParameter && !wordAt(line, i, primvar)) {
            out += line[i++];
            continue;
        }
        const size_t from = i + (isParameter ? parameter : primvar).size();
        const size_t to = digitsFrom(line, from);
        const std::string digits = line.substr(from, to - from);
        if (!isParameter) {
            out += "primvar" + digits + "(";
            i = to + 2;
        } else if (to > from && line[to] == ']') {
            out += literal(parameters[std::stoul(digits)]);
            i = to + 1;
        } else {
            const size_t end = line.find(']', from);
            out += "parameterAt(" + line.substr(from, end - from) + ")";
            i = end + 1;
            readsTables = true;
        }
    }
    return out;
}

} // namespace

GlslWebMaterial makeGlslWebMaterial(const MaterialIr& ir) {
    const GlslMaterial desktop = makeGlslMaterial(ir, {false, false});
    GlslWebMaterial out;
    for (const GlslTexture& t : desktop.textures)
        out.textures.push_back(t.handle);
    out.leftOut = desktop.leftOut;
    const auto isNumber = [](const glm::vec4& v) { return !glm::any(glm::isnan(v)); };
    if (!std::all_of(desktop.parameters.begin(), desktop.parameters.end(), isNumber))
        out.leftOut.push_back(messages::notANumberIsZero);
    out.presence = desktop.presence;
    out.emission = desktop.emission;
    // Every text defines it for what stands before; without curves and tiles nobody asks for a
    // value.
    static const std::string lookUp = "materialParameter(";
    const bool calls =
        desktop.text.find(lookUp, desktop.text.find(lookUp) + 1) != std::string::npos;
    bool readsTables = false;
    for (size_t from = 0; from < desktop.text.size();) {
        size_t to = desktop.text.find('\n', from);
        if (to == std::string::npos) to = desktop.text.size();
        std::string line = desktop.text.substr(from, to - from);
        from = to + 1;
        if (!calls && line.compare(0, 5 + lookUp.size(), "vec4 " + lookUp) == 0)
            line = "vec4 " + lookUp + "int i) { return vec4(0.0); }";
        if (line.compare(0, 7, "layout(") == 0) {
            if (line.find(" uniform Parameters ") != std::string::npos) continue;
            line = line.substr(line.find(") ") + 2);
        }
        out.text += rewritten(line, desktop.parameters, readsTables) + "\n";
    }
    if (readsTables) {
        out.parameters = desktop.parameters;
        out.text =
            "uniform sampler2D parameterTable;\n"
            "vec4 parameterAt(int i) { return texelFetch(parameterTable, ivec2(i, 0), 0); }\n" +
            out.text;
    }
    return out;
}

} // namespace patina
