// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include "base/utf8.h"

#include <algorithm>
#include <utility>

namespace patina {

void Diagnostics::warn(const std::string& primBytes, const std::string& inputBytes,
                       const Message& given) {
    const std::string prim = validUtf8(primBytes), input = validUtf8(inputBytes);
    Message what = given;
    for (std::string& field : what.fields)
        field = validUtf8(field);
    const std::string message = what.text();
    std::string key = prim;
    for (const std::string* part : {&input, &message}) {
        key += '\0';
        key += *part;
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto place = _places.find(key);
    if (place != _places.end()) {
        ++_list[place->second].count;
        return;
    }
    _list.push_back({prim, input, std::move(what), message}); // first: memory may end in between
    _places.emplace(std::move(key), _list.size() - 1);
}

std::vector<Diagnostic> Diagnostics::all() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _list;
}

std::vector<Diagnostic> Diagnostics::news(size_t& read, size_t most) {
    const std::lock_guard<std::mutex> lock(_mutex);
    std::vector<Diagnostic> found(_list.begin() + ptrdiff_t(std::min(read, _list.size())),
                                  _list.end());
    read = _list.size();
    if (read > most) {
        _forgotten += read;
        _list.clear();
        _places.clear();
        read = 0;
    }
    return found;
}

int Diagnostics::count() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return int(_forgotten + _list.size());
}

void Diagnostics::clear() {
    const std::lock_guard<std::mutex> lock(_mutex);
    _list.clear();
    _places.clear();
    _forgotten = 0;
}

} // namespace patina
