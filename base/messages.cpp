// SPDX-License-Identifier: Apache-2.0
#include "base/messages.h"

#include <algorithm>
#include <stdexcept>

namespace patina {

namespace {

struct Row {
    const char *name, *fields, *text;
};

constexpr Row rows[] = {
#define MESSAGE(id, fields, severity, advice, text) {#id, #fields, text},
#include "base/messages.def"
#undef MESSAGE
};

} // namespace

const char* nameOf(MessageId id) {
    return rows[size_t(id)].name;
}

std::vector<std::string> fieldNames(MessageId id) {
    std::vector<std::string> names;
    for (const char* c = rows[size_t(id)].fields; *c; ++c) {
        if (*c == '(' || *c == ',')
            names.emplace_back();
        else if (*c != ' ' && *c != ')')
            names.back() += *c;
    }
    if (names.back().empty()) names.pop_back();
    return names;
}

std::string Message::text() const {
    const std::vector<std::string> names = fieldNames(id);
    std::string out;
    for (const char* c = rows[size_t(id)].text; *c; ++c) {
        if (*c != '{') {
            out += *c;
            continue;
        }
        std::string name;
        while (*++c != '}')
            name += *c;
        out += fields[size_t(std::find(names.begin(), names.end(), name) - names.begin())];
    }
    return out;
}

Message messageOf(const std::string& id, const std::vector<std::string>& fields) {
    const auto row =
        std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return id == r.name; });
    if (row == std::end(rows)) throw std::invalid_argument("there is no message '" + id + "'");
    const Message message{MessageId(row - std::begin(rows)), fields};
    if (fields.size() != fieldNames(message.id).size())
        throw std::invalid_argument("the message " + id + " has other fields: " + row->fields);
    return message;
}

} // namespace patina
