// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include "base/utf8.h"

namespace patina {

void Diagnostics::warn(const std::string& primBytes, const std::string& inputBytes,
                       const std::string& messageBytes) {
    const std::string prim = validUtf8(primBytes), input = validUtf8(inputBytes),
                      message = validUtf8(messageBytes);
    const std::lock_guard<std::mutex> lock(_mutex);
    for (Diagnostic& d : _list)
        if (d.prim == prim && d.input == input && d.message == message) {
            ++d.count;
            return;
        }
    _list.push_back({prim, input, message});
}

std::vector<Diagnostic> Diagnostics::all() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _list;
}

int Diagnostics::count() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return int(_list.size());
}

void Diagnostics::clear() {
    const std::lock_guard<std::mutex> lock(_mutex);
    _list.clear();
}

} // namespace patina
