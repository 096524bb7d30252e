// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslPatterns.h"

#include <cctype>
#include <map>

namespace patina {

namespace {

/// Fills a pattern's text in for one instruction.
class Filler {
public:
    Filler(const PatternData& data, const GlslPatternNames& names) : _data(data), _names(names) {}

    std::string fill(const char* c) {
        std::string out;
        while (*c)
            if (*c != '$')
                out += *c++;
            else
                placeholder(++c, out);
        return out;
    }

    /// A register that is read twice is one and the same constant.
    const std::string& input(int i, int row = 0) {
        const auto found = _known.find({i, row});
        return found != _known.end() ? found->second : _known[{i, row}] = _names.input(i, row);
    }

private:
    void placeholder(const char*& c, std::string& out) {
        const char kind = *c++;
        if (std::isdigit(static_cast<unsigned char>(kind))) {
            out += input(kind - '0');
        } else if (kind == '{') {
            char* end;
            out += input(int(std::strtol(c, &end, 10)));
            c = end + 1;
        } else if (kind == 'A' || kind == 'B') {
            const int n = kind == 'A' ? 3 : 4, i = *c++ - '0';
            out += n == 3 ? "mat3(" : "mat4(";
            for (int k = 0; k < n; ++k)
                out += (k ? ", " : "") + input(i, k) + (n == 3 ? ".xyz" : "");
            out += ")";
        } else if (kind == 's') {
            out += std::to_string(_data.size);
        } else if (kind == 'm') {
            out += std::to_string(_data.mode);
        } else if (kind == 'p') {
            out += std::to_string(_data.slot);
        } else {
            const bool plain = kind == 't';
            const int handle = plain ? _data.handle : int(_data.value[kind - 'X']);
            if (handle >= 0) {
                out += _names.texture(handle);
            } else {
                out += input(plain ? 1 : 3);
                int depth = 0;
                do
                    depth += *c == '(' ? 1 : *c == ')' ? -1 : 0;
                while (*c++ && depth > 0);
            }
        }
    }

    const PatternData& _data;
    const GlslPatternNames& _names;
    std::map<std::pair<int, int>, std::string> _known;
};

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    size_t from = 0;
    while (from <= text.size()) {
        size_t to = text.find(';', from);
        if (to == std::string::npos) to = text.size();
        if (text[from] == ' ') ++from;
        parts.push_back(text.substr(from, to - from));
        from = to + 1;
    }
    return parts;
}

} // namespace

GlslPattern glslPattern(const Instruction& instruction, const GlslPatternNames& names) {
    GlslPattern out;
    const PatternData& data = instruction.data;
    Filler filler(data, names);
    const Pattern& pattern = *instruction.pattern;
    if (!pattern.glsl) return out;
    out.rare = pattern.rare;
    const char* text = pattern.glslWithout && data.handle < 0 ? pattern.glslWithout : pattern.glsl;
    if (text[1] == '|') {
        const int n = text[0] - '0';
        const std::string matrix = "(" + filler.fill(text + 2) + ")[";
        for (int i = 0; i < n; ++i) {
            const std::string column = matrix + std::to_string(i) + "]";
            out.outputs.push_back(n == 3 ? "vec4(" + column + ", 0.0)" : column);
        }
        return out;
    }
    out.outputs = split(filler.fill(text));
    return out;
}

} // namespace patina
