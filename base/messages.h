// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>
#include <vector>

namespace patina {

/// What there is to warn of, see messages.def.
enum class MessageId {
#define MESSAGE(id, ...) id,
#include "base/messages.def"
#undef MESSAGE
};

/// A message, with what its fields stand for.
struct Message {
    MessageId id;
    std::vector<std::string> fields;

    std::string text() const;
};

/// By names, as Python gives them.
/// @throws std::invalid_argument for an id that no row has, and for another number of fields
Message messageOf(const std::string& id, const std::vector<std::string>& fields);
const char* nameOf(MessageId id);
std::vector<std::string> fieldNames(MessageId id);

inline std::string fieldText(const std::string& text) {
    return text;
}
template <class T, class = std::enable_if_t<std::is_integral_v<T>>>
std::string fieldText(T number) {
    return std::to_string(number);
}

/// Makes messages of one id: `messages::gridUnreadable(grid, file, why)`. One without fields is a
/// message as it stands.
template <int count> struct MessageMaker {
    MessageId id;

    template <class... T> Message operator()(const T&... fields) const {
        static_assert(sizeof...(T) == count, "a field for each that the row in messages.def has");
        return {id, {fieldText(fields)...}};
    }
    operator Message() const { return (*this)(); }
};

/// @param list of names, in parentheses
constexpr int countOfFields(const char* list) {
    int count = list[1] == ')' ? 0 : 1;
    for (; *list; ++list)
        count += *list == ',';
    return count;
}

namespace messages {
#define MESSAGE(id, fields, ...)                                                                   \
    inline constexpr MessageMaker<countOfFields(#fields)> id{MessageId::id};
#include "base/messages.def"
#undef MESSAGE
} // namespace messages

} // namespace patina
