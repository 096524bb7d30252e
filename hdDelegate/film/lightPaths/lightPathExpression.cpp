// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/lightPaths/lightPathExpression.h"

#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

constexpr int deepest = 64;                // groups within groups
constexpr int maxRepeats = 64;             // of {n,m}: paths are no longer
constexpr char typeLetters[] = "CRTVLBO";  // by EventType
constexpr char scatterLetters[] = "xDGSs"; // by EventScatter
constexpr char wantedTypes[] = "an event type (C R T V L B O or .)";
constexpr char wantedScatters[] = "how it scatters (D G S s x or .)";
constexpr char wantedLabel[] = "a label such as 'key', x or >";

unsigned typeBits(char letter) {
    const char* found = std::strchr(typeLetters, letter);
    if (!letter || !found) return 0;
    const unsigned bit = 1u << (found - typeLetters);
    // A dome is a light.
    return letter == 'L' ? bit | (1u << int(EventType::Background)) : bit;
}

unsigned scatterBits(char letter) {
    const char* found = std::strchr(scatterLetters, letter);
    return letter && found ? 1u << (found - scatterLetters) : 0;
}

using Node = std::unique_ptr<LightPathNode>;

Node makeNode(LightPathNode::Kind kind) {
    Node node = std::make_unique<LightPathNode>();
    node->kind = kind;
    return node;
}

Node makeEvent(EventPattern pattern) {
    Node node = makeNode(LightPathNode::Kind::Event);
    node->event = std::move(pattern);
    return node;
}

class Parser {
public:
    explicit Parser(const std::string& text) : _text(text) {}

    Node parse() {
        Node all = sequence(0);
        if (!ended()) fail("an event, not '" + std::string(1, _text[_at]) + "'");
        if (all->parts.empty()) fail("an event");
        return all;
    }

private:
    [[noreturn]] void failAt(size_t at, const std::string& expected) const {
        throw std::invalid_argument("light path expression '" + _text + "': column " +
                                    std::to_string(at + 1) + ": expected " + expected);
    }
    [[noreturn]] void fail(const std::string& expected) {
        skipBlanks();
        failAt(_at, expected);
    }

    void skipBlanks() {
        while (_at < _text.size() && (_text[_at] == ' ' || _text[_at] == '\t'))
            ++_at;
    }
    bool ended() {
        skipBlanks();
        return _at >= _text.size();
    }
    char head() { return ended() ? '\0' : _text[_at]; }
    bool take(char wanted) {
        if (head() != wanted) return false;
        ++_at;
        return true;
    }

    /// Elements up to the end, or to what closes a group or list.
    Node sequence(int depth) {
        Node all = makeNode(LightPathNode::Kind::Sequence);
        while (!ended() && !std::strchr(")]>", head())) {
            if (!take('|')) {
                all->parts.push_back(element(depth));
                continue;
            }
            if (all->parts.empty()) failAt(_at - 1, "an event before |");
            Node right = element(depth);
            Node& left = all->parts.back();
            if (left->kind != LightPathNode::Kind::Either) {
                Node either = makeNode(LightPathNode::Kind::Either);
                either->parts.push_back(std::move(left));
                left = std::move(either);
            }
            left->parts.push_back(std::move(right));
        }
        return all;
    }

    Node element(int depth) {
        if (depth > deepest) fail("fewer groups within each other");
        Node node;
        if (take('('))
            node = group(depth);
        else if (take('['))
            node = list(depth);
        else if (take('<'))
            node = makeEvent(event());
        else
            node = symbol();
        return repeated(std::move(node));
    }

    Node group(int depth) {
        Node node = sequence(depth + 1);
        if (!take(')')) fail(") to end the group");
        if (node->parts.empty()) failAt(_at - 1, "an event in the group");
        // Its own node, so that | after it joins the group, not what it holds.
        Node outer = makeNode(LightPathNode::Kind::Sequence);
        outer->parts.push_back(std::move(node));
        return outer;
    }

    Node symbol() {
        EventPattern pattern;
        const char c = head();
        if (c == '\'') {
            pattern.labels.push_back({{label()}, false, false});
            return makeEvent(pattern);
        }
        if (c == '.') {
        } else if (typeBits(c)) {
            pattern.types = typeBits(c);
        } else if (c != 'x' && scatterBits(c)) {
            pattern.scatters = scatterBits(c);
        } else {
            fail(c ? "an event (C R T V L B O D G S . < [ ( or a label), not '" +
                         std::string(1, c) + "'"
                   : "an event");
        }
        ++_at;
        return makeEvent(pattern);
    }

    std::string label() {
        const size_t start = _at++;
        const size_t end = _text.find('\'', _at);
        if (end == std::string::npos) failAt(_text.size(), "' to end the label");
        if (end == _at) failAt(start, "a label between quotes");
        const std::string name = _text.substr(_at, end - _at);
        _at = end + 1;
        return name;
    }

    Node repeated(Node node) {
        while (true) {
            int least = 0, most = LightPathNode::endless;
            if (take('*')) {
            } else if (take('+')) {
                least = 1;
            } else if (take('?')) {
                most = 1;
            } else if (take('{')) {
                range(least, most);
            } else {
                return node;
            }
            Node outer = makeNode(LightPathNode::Kind::Repeat);
            outer->least = least;
            outer->most = most;
            outer->parts.push_back(std::move(node));
            node = std::move(outer);
        }
    }

    int number(const char* expected) {
        if (head() < '0' || head() > '9') fail(expected);
        const size_t start = _at;
        int value = 0;
        for (; _at < _text.size() && _text[_at] >= '0' && _text[_at] <= '9'; ++_at) {
            value = 10 * value + (_text[_at] - '0');
            if (value > maxRepeats)
                failAt(start, "at most " + std::to_string(maxRepeats) + " repetitions");
        }
        return value;
    }

    void range(int& least, int& most) {
        least = most = number("a number of repetitions");
        if (take(',')) {
            const size_t at = _at;
            most = head() == '}' ? LightPathNode::endless : number("a number or }");
            if (most != LightPathNode::endless && most < least)
                failAt(at, "a number that is not below " + std::to_string(least));
        }
        if (!take('}')) fail("} to end the repetitions");
    }

    /// [...] outside of <>: elements, any of which fits; or [^...], symbols none of which does.
    Node list(int depth) {
        if (take('^')) return makeEvent(outerExclusion());
        Node either = makeNode(LightPathNode::Kind::Either);
        while (!ended() && !std::strchr(")]>|", head()))
            either->parts.push_back(element(depth + 1));
        if (!take(']')) fail("an event or ] to end the list");
        if (either->parts.empty()) failAt(_at - 1, "an event in the list");
        Node outer = makeNode(LightPathNode::Kind::Sequence);
        outer->parts.push_back(std::move(either));
        return outer;
    }

    EventPattern outerExclusion() {
        EventPattern pattern;
        const char c = head();
        if (c == '\'')
            pattern.labels.push_back(labels(true));
        else if (typeBits(c))
            pattern.types = letters(typeBits, wantedTypes, true);
        else if (scatterBits(c))
            pattern.scatters = letters(scatterBits, wantedScatters, true);
        else
            fail("types, kinds of scattering, or labels after ^");
        return pattern;
    }

    /// The text after [ or [^ up to ].
    unsigned letters(unsigned (*bitsOf)(char), const char* expected, bool negated) {
        unsigned bits = 0;
        do {
            const unsigned more = bitsOf(head());
            if (!more) fail(expected);
            bits |= more;
            ++_at;
        } while (!take(']'));
        return negated ? ~bits : bits;
    }
    EventPattern::Labels labels(bool negated) {
        EventPattern::Labels result;
        result.negated = negated;
        do {
            if (head() == '\'')
                result.names.push_back(label());
            else if (take('x'))
                result.none = true;
            else
                fail("a label such as 'key'");
        } while (!take(']'));
        return result;
    }

    /// One place of <>.
    unsigned place(unsigned (*bitsOf)(char), const char* expected) {
        if (take('.')) return EventPattern::any;
        if (take('[')) return letters(bitsOf, expected, take('^'));
        const unsigned bits = bitsOf(head());
        if (!bits) fail(expected);
        ++_at;
        return bits;
    }

    EventPattern event() {
        EventPattern pattern;
        pattern.types = place(typeBits, wantedTypes);
        if (head() != '>') pattern.scatters = place(scatterBits, wantedScatters);
        while (!take('>')) {
            if (take('.')) continue; // any label, or none
            if (take('[')) {
                pattern.labels.push_back(labels(take('^')));
            } else if (take('x')) {
                pattern.labels.push_back({{}, true, false});
            } else if (head() == '\'') {
                pattern.labels.push_back({{label()}, false, false});
            } else {
                fail(wantedLabel);
            }
        }
        return pattern;
    }

    const std::string& _text;
    size_t _at = 0;
};

} // namespace

std::unique_ptr<LightPathNode> parseLightPath(const std::string& expression) {
    return Parser(expression).parse();
}

void collectLabels(const LightPathNode& node, std::vector<std::string>& labels) {
    for (const EventPattern::Labels& place : node.event.labels)
        for (const std::string& name : place.names)
            if (std::find(labels.begin(), labels.end(), name) == labels.end())
                labels.push_back(name);
    for (const auto& part : node.parts)
        collectLabels(*part, labels);
}

} // namespace patina
