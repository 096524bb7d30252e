// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/lists.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace patina {

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) {
        const size_t first = part.find_first_not_of(" \t");
        const size_t last = part.find_last_not_of(" \t");
        parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
    }
    return parts;
}

bool readNumbers(std::string text, size_t components, std::vector<float>& out) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    for (float x; out.size() <= components && stream >> x;)
        out.push_back(x);
    if (!stream.eof() || (out.size() != components && out.size() != 1)) return false;
    out.resize(components, out[0]);
    return true;
}

} // namespace patina
