// SPDX-License-Identifier: Apache-2.0
#include "shaders/unusedFunctions.h"

#include "shaders/glslText.h"

#include <cctype>
#include <map>
#include <set>
#include <vector>

namespace patina {

namespace {

bool isNamePart(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

struct Function {
    std::string name;
    size_t begin, end; ///< in the text, from its return type to its closing brace
};

/// Moves lines that begin with # from `code` to `directives`, in their places.
void partDirectives(std::string& code, std::string& directives) {
    directives.assign(code.size(), ' ');
    for (size_t at = 0, end; at < code.size(); at = end + 1) {
        end = code.find('\n', at);
        if (end == std::string::npos) end = code.size();
        const size_t first = code.find_first_not_of(" \t", at);
        if (first < end && code[first] == '#') {
            end = endOfLine(code, at);
            directives.replace(at, end - at, code, at, end - at);
            blank(code, at, end);
        }
    }
}

/// Where the parenthesis opens that closes at `close`; npos where none does.
size_t openingOf(const std::string& code, size_t close) {
    int depth = 0;
    for (size_t i = close + 1; i-- > 0;) {
        if (code[i] == ')') ++depth;
        if (code[i] == '(' && --depth == 0) return i;
    }
    return std::string::npos;
}

/// The name that ends before `end`, spaces apart.
std::string nameBefore(const std::string& code, size_t end) {
    while (end > 0 && std::isspace(static_cast<unsigned char>(code[end - 1])))
        --end;
    size_t begin = end;
    while (begin > 0 && isNamePart(code[begin - 1]))
        --begin;
    return code.substr(begin, end - begin);
}

/// Finds the functions of a text, and blanks its prototypes in `outside`.
/// @returns false where braces do not match
bool findFunctions(const std::string& code, std::vector<Function>& functions,
                   std::string& outside) {
    outside = code;
    int depth = 0;
    size_t begin = 0; // of what stands outside of braces: a declaration or a function
    bool inFunction = false;
    for (size_t i = 0; i < code.size(); ++i) {
        const char c = code[i];
        if (c == '{' && depth++ == 0) {
            const size_t last = code.find_last_not_of(" \t\n", i - (i > 0));
            const size_t open =
                last != std::string::npos && code[last] == ')' ? openingOf(code, last) : last;
            inFunction =
                last != std::string::npos && code[last] == ')' && open != std::string::npos;
            if (inFunction) functions.push_back({nameBefore(code, open), begin, 0});
        } else if (c == '}') {
            if (--depth < 0) return false;
            if (depth > 0 || !inFunction) continue;
            functions.back().end = begin = i + 1;
            blank(outside, functions.back().begin, i + 1);
            inFunction = false;
        } else if (c == ';' && depth == 0) {
            const size_t last = code.find_last_not_of(" \t\n", i - (i > 0));
            const bool prototype = last != std::string::npos && last >= begin &&
                                   code[last] == ')' &&
                                   code.substr(begin, i - begin).find('=') == std::string::npos;
            if (prototype) blank(outside, begin, i);
            begin = i + 1;
        }
    }
    return depth == 0;
}

/// Adds the names in a part of a text that are no members of a value.
/// @param calls only those that a parenthesis follows: a structure may declare any name
void addNames(const std::string& text, size_t begin, size_t end, bool calls,
              std::set<std::string>& names) {
    for (size_t i = begin; i < end;) {
        if (!isNamePart(text[i])) {
            ++i;
            continue;
        }
        size_t stop = i;
        while (stop < end && isNamePart(text[stop]))
            ++stop;
        const size_t next = text.find_first_not_of(" \t\n", stop);
        if ((i == 0 || text[i - 1] != '.') && (!calls || (next < end && text[next] == '(')))
            names.insert(text.substr(i, stop - i));
        i = stop;
    }
}

/// Whether a part of the directives says what text around it relies on.
bool reachesOut(const std::string& directives, size_t begin, size_t end) {
    int depth = 0;
    for (size_t i = begin; i < end; ++i) {
        if (directives[i] != '#') continue;
        const size_t word = directives.find_first_not_of(" \t", i + 1);
        const auto is = [&](const char* what) {
            return directives.compare(word, std::string(what).size(), what) == 0;
        };
        if (is("if"))
            ++depth;
        else if (is("endif"))
            --depth;
        else if (!is("el") || depth == 0)
            return true; // #define, #line, or half of an #if
        if (depth < 0) return true;
    }
    return depth != 0;
}

} // namespace

std::string withoutUnusedFunctions(const std::string& text, const std::string& callers) {
    std::string kept = withoutComments(text);
    std::string code = kept, directives, outside;
    partDirectives(code, directives);
    std::vector<Function> functions;
    if (!findFunctions(code, functions, outside)) return text;
    std::multimap<std::string, const Function*> named;
    std::set<std::string> wanted = {"main"};
    for (const Function& f : functions) {
        named.emplace(f.name, &f);
        if (reachesOut(directives, f.begin, f.end)) wanted.insert(f.name);
    }
    addNames(outside, 0, outside.size(), true, wanted);
    addNames(callers, 0, callers.size(), true, wanted);
    addNames(directives, 0, directives.size(), false, wanted);
    std::set<std::string> reached;
    while (!wanted.empty()) {
        const std::string name = *wanted.begin();
        wanted.erase(wanted.begin());
        if (!reached.insert(name).second) continue;
        const auto range = named.equal_range(name);
        std::set<std::string> next;
        for (auto f = range.first; f != range.second; ++f)
            addNames(code, f->second->begin, f->second->end, false, next);
        for (const std::string& n : next)
            if (named.count(n) && !reached.count(n)) wanted.insert(n);
    }
    std::string out;
    size_t at = 0;
    for (const Function& f : functions) {
        if (reached.count(f.name)) continue;
        out.append(kept, at, f.begin - at);
        for (size_t i = f.begin; i < f.end; ++i)
            if (kept[i] == '\n') out += '\n';
        at = f.end;
    }
    return out.append(kept, at, std::string::npos);
}

} // namespace patina
