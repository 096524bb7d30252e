// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/tokens.h"

#include "base/limits.h"

namespace patina {

std::string replaceTokens(const std::string& text,
                          const std::function<const char*(const std::string&)>& valueOf) {
    std::string result;
    const size_t most = limitOf(Limit::textLength);
    size_t from = 0;
    for (size_t open; (open = text.find('[', from)) != std::string::npos;) {
        const size_t close = text.find(']', open);
        if (close == std::string::npos || result.size() > most) break;
        const char* value = valueOf(text.substr(open + 1, close - open - 1));
        result.append(text, from, (value ? open : close + 1) - from);
        if (value) result += value;
        from = close + 1;
    }
    return result.append(text, from, std::string::npos);
}

} // namespace patina
