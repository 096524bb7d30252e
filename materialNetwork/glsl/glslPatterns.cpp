// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslPatterns.h"

namespace patina {

namespace {

const char* typeName(PatternType type) {
    switch (type) {
    case PatternType::Int: return "int";
    case PatternType::Bool: return "bool";
    case PatternType::Vec2: return "vec2";
    case PatternType::Vec3: return "vec3";
    case PatternType::Vec4: return "vec4";
    case PatternType::Mat3: return "mat3";
    case PatternType::Mat4: return "mat4";
    default: return "float";
    }
}

/// Writes the call of one instruction.
class CallWriter {
public:
    CallWriter(const Instruction& instruction, const GlslPatternNames& names)
        : _data(instruction.data), _names(names) {}

    std::string statement(const Pattern& pattern) {
        std::string call = pattern.name + std::string("(");
        int row = patternRows(pattern.result);
        for (int i = 0; i < pattern.parameterCount; ++i) {
            const PatternParameter& parameter = pattern.parameters[i];
            call += i > 0 ? ", " : "";
            call += parameter.output ? further(parameter.type, row) : argument(parameter.type);
        }
        call += ")";
        if (pattern.result == PatternType::None) return "{ " + _before + call + ";" + _after + " }";
        if (patternRows(pattern.result) > 1) {
            _before += typeName(pattern.result) + std::string(" m = ") + call + ";";
            store(pattern.result, "m", 0);
            return "{ " + _before + _after + " }";
        }
        const std::string first = _names.output(0) + " = " + stored(pattern.result, call) + ";";
        return _after.empty() ? first : "{ " + _before + first + _after + " }";
    }

private:
    std::string argument(PatternType type) {
        switch (type) {
        case PatternType::Size: return std::to_string(_data.size);
        case PatternType::Mode: return std::to_string(_data.mode);
        case PatternType::Wavelength: return "0.0";
        case PatternType::Point: return "point";
        case PatternType::Texture: {
            const int handle = _data.textures[_textures++];
            return std::to_string(handle < 0 ? -1 : _names.texture(handle));
        }
        case PatternType::PrimvarOrZero: return primvar("vec4(0.0)");
        case PatternType::PrimvarOrBlack: return primvar("vec4(0.0, 0.0, 0.0, 1.0)");
        default: return input(type, _inputs++);
        }
    }

    std::string input(PatternType type, int i) const {
        switch (type) {
        case PatternType::Float: return _names.input(i, 0) + ".x";
        case PatternType::Int: return "patternWhole(" + _names.input(i, 0) + ".x)";
        case PatternType::Bool: return _names.input(i, 0) + ".x != 0.0";
        case PatternType::Vec2: return _names.input(i, 0) + ".xy";
        case PatternType::Vec3: return _names.input(i, 0) + ".xyz";
        case PatternType::Mat3:
        case PatternType::Mat4: {
            const int n = patternRows(type);
            std::string text = typeName(type) + std::string("(");
            for (int row = 0; row < n; ++row)
                text += (row > 0 ? ", " : "") + _names.input(i, row) + (n == 3 ? ".xyz" : "");
            return text + ")";
        }
        case PatternType::Primvar: return primvar(_names.input(i, 0));
        default: return _names.input(i, 0);
        }
    }

    std::string primvar(const std::string& fallback) const {
        if (_data.slot < 0) return fallback;
        return "primvar(" + std::to_string(_data.slot) + ", " + fallback + ")";
    }

    /// A variable for a further output, which fills a register only after the call.
    std::string further(PatternType type, int& row) {
        const std::string name = "o" + std::to_string(row);
        _before += typeName(type) + (" " + name) + "; ";
        store(type, name, row);
        row += patternRows(type);
        return name;
    }

    void store(PatternType type, const std::string& name, int row) {
        const int n = patternRows(type);
        for (int i = 0; i < n; ++i) {
            const std::string value = n == 1 ? stored(type, name)
                                      : n == 3
                                          ? "vec4(" + name + "[" + std::to_string(i) + "], 0.0)"
                                          : name + "[" + std::to_string(i) + "]";
            _after += " " + _names.output(row + i) + " = " + value + ";";
        }
    }

    /// A value as a register holds it.
    static std::string stored(PatternType type, const std::string& value) {
        switch (type) {
        case PatternType::Vec2: return "vec4(" + value + ", 0.0, 0.0)";
        case PatternType::Vec3: return "vec4(" + value + ", 0.0)";
        case PatternType::Vec4: return value;
        default: return "vec4(" + value + ")";
        }
    }

    const PatternData& _data;
    const GlslPatternNames& _names;
    int _inputs = 0, _textures = 0;
    std::string _before, _after;
};

} // namespace

std::string glslPattern(const Instruction& instruction, const GlslPatternNames& names) {
    return CallWriter(instruction, names).statement(*instruction.pattern);
}

} // namespace patina
