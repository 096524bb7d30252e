// SPDX-License-Identifier: Apache-2.0
#include "shaders/shaderText.h"

#include <cctype>
#include <cstring>

namespace patina {

namespace {

const char* findShader(const std::string& path) {
    for (const EmbeddedShader* s = embeddedShaders; s->path; ++s)
        if (path == s->path) return s->text;
    return nullptr;
}

class Flattener {
public:
    Flattener(ShaderText& out, std::string& error) : _out(out), _error(error) {}

    void add(const std::string& name, const char* text) {
        const std::string file = std::to_string(_out.files.size());
        _out.files.push_back(name);
        ++_depth;
        // #line must not come before #version, and a new file starts at line 1 anyway.
        if (_out.files.size() > 1) _out.text += "#line 1 " + file + "\n";
        int line = 0;
        while (*text) {
            const char* end = std::strchr(text, '\n');
            const size_t length = end ? size_t(end - text) : std::strlen(text);
            const std::string content(text, length);
            text += length + (end ? 1 : 0);
            ++line;
            static const std::string directive = "#include \"";
            if (content.compare(0, directive.size(), directive) != 0) {
                _out.text += content + "\n";
                continue;
            }
            const std::string path =
                content.substr(directive.size(), content.rfind('"') - directive.size());
            const char* included = findShader(path);
            if (!included || _depth > 16) {
                _error += name + " line " + std::to_string(line) + ": no shader \"" + path + "\"\n";
                continue;
            }
            add(path, included);
            _out.text += "#line " + std::to_string(line + 1) + " " + file + "\n";
        }
        --_depth;
    }

private:
    ShaderText& _out;
    std::string& _error;
    int _depth = 0;
};

} // namespace

std::string ShaderText::named(const std::string& log) const {
    std::string out;
    bool lineStart = true;
    for (size_t i = 0; i < log.size();) {
        size_t end = i;
        while (lineStart && end < log.size() && std::isdigit(static_cast<unsigned char>(log[end])))
            ++end;
        // Mesa writes "file:line(column)", NVIDIA "file(line)".
        if (end > i && end - i < 6 && end < log.size() && (log[end] == ':' || log[end] == '(')) {
            const size_t file = size_t(std::stoi(log.substr(i, end - i)));
            out += file < files.size() ? files[file] : log.substr(i, end - i);
            i = end;
        }
        lineStart = log[i] == '\n';
        out += log[i++];
    }
    return out;
}

ShaderText flattenShader(const std::string& name, const std::string& text, std::string& error) {
    ShaderText out;
    Flattener(out, error).add(name, text.c_str());
    return out;
}

} // namespace patina
