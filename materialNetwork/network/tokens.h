// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace patina {

/// Replaces "[name]" in a text by what valueOf() gives; null leaves it as it is. Nothing more is
/// replaced where the text grows beyond Limit::textLength.
std::string replaceTokens(const std::string& text,
                          const std::function<const char*(const std::string& name)>& valueOf);

} // namespace patina
