// SPDX-License-Identifier: Apache-2.0
#include "shaders/deadBranches.h"

#include "shaders/glslText.h"

#include <algorithm>
#include <map>
#include <vector>

namespace patina {

namespace {

enum class Known { No, Maybe, Yes };

Known opposite(Known known) {
    return known == Known::Maybe ? known : known == Known::Yes ? Known::No : Known::Yes;
}

/// Of one #if, while its lines are read.
struct Condition {
    Known live;  ///< the branch that is read now, as far as this condition says
    Known taken; ///< whether a branch before it was
};

/// The words of a directive behind its #.
std::vector<std::string> wordsOf(const std::string& line) {
    std::vector<std::string> words;
    const auto isName = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
    };
    for (size_t i = line.find('#') + 1; i < line.size() && words.size() < 2;) {
        const size_t begin = i;
        while (i < line.size() && isName(line[i]))
            ++i;
        if (i > begin)
            words.push_back(line.substr(begin, i - begin));
        else if (line[i] == ' ' || line[i] == '\t')
            ++i;
        else
            break;
    }
    words.resize(2);
    return words;
}

class Branches {
public:
    /// Whether the line that is read now is part of the text.
    Known live() const {
        Known all = Known::Yes;
        for (const Condition& c : _conditions)
            all = std::min(all, c.live);
        return all;
    }

    void read(const std::string& line) {
        const std::vector<std::string> words = wordsOf(line);
        const std::string &what = words[0], &name = words[1];
        if (what == "ifdef") {
            begin(defined(name));
        } else if (what == "ifndef") {
            begin(opposite(defined(name)));
        } else if (what == "if") {
            begin(Known::Maybe);
        } else if (what == "elif") {
            next(Known::Maybe);
        } else if (what == "else") {
            next(Known::Yes);
        } else if (what == "endif") {
            if (!_conditions.empty()) _conditions.pop_back();
        } else if ((what == "define" || what == "undef") && live() != Known::No) {
            const Known now = what == "define" ? Known::Yes : Known::No;
            _macros[name] = live() == Known::Yes || defined(name) == now ? now : Known::Maybe;
        }
    }

private:
    Known defined(const std::string& name) const {
        const auto found = _macros.find(name);
        if (found != _macros.end()) return found->second;
        const bool drivers = name.compare(0, 3, "GL_") == 0 || name.compare(0, 2, "__") == 0;
        return drivers ? Known::Maybe : Known::No;
    }

    void begin(Known live) { _conditions.push_back({live, live}); }

    /// @param live of the next branch, if none before it is taken
    void next(Known live) {
        if (_conditions.empty()) return;
        Condition& c = _conditions.back();
        c.live = std::min(live, opposite(c.taken));
        c.taken = std::max(c.taken, c.live);
    }

    std::vector<Condition> _conditions;
    std::map<std::string, Known> _macros;
};

} // namespace

std::string withoutDeadBranches(const std::string& text) {
    std::string out = withoutComments(text);
    Branches branches;
    for (size_t at = 0, end; at < out.size(); at = end + 1) {
        end = endOfLine(out, at);
        const Known before = branches.live();
        const size_t first = out.find_first_not_of(" \t", at);
        if (first < end && out[first] == '#') branches.read(out.substr(first, end - first));
        if (before == Known::No && branches.live() == Known::No) blank(out, at, end);
    }
    return out;
}

} // namespace patina
