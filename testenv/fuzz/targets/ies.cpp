// SPDX-License-Identifier: Apache-2.0
// Any bytes as an IES profile; where it is one, its values are finite and not negative.
#include "hdDelegate/image/iesProfile.h"
#include "testenv/fuzz/targets/targets.h"

#include <cmath>
#include <cstdlib>

bool fuzzIes(const uint8_t* data, size_t size) {
    patina::IesProfile profile;
    std::string error;
    if (!profile.parse(std::string(reinterpret_cast<const char*>(data), size), error)) {
        if (error.empty() || error.find('\n') != std::string::npos)
            std::abort(); // one line, always
        return false;
    }
    if (!std::isfinite(profile.mean()) || !std::isfinite(profile.peak())) std::abort();
    for (float theta : {0.0f, 0.7f, 1.5707964f, 3.1415927f, -1.0f, 1e30f})
        for (float phi : {0.0f, 1.0f, -7.0f, 6.2831855f, 1e30f}) {
            const float value = profile.candela(theta, phi), factor = profile.factor(theta, phi);
            if (!(value >= 0.0f) || !std::isfinite(value) || !(factor >= 0.0f)) std::abort();
        }
    return true;
}
