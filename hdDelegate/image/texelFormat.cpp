// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/texelFormat.h"

#include <algorithm>

namespace patina {

size_t bytesOf(TexelType type) {
    return type == TexelType::U8 ? 1 : type == TexelType::Float ? 4 : 2;
}

int channelCount(TexelLayout layout) {
    static const int counts[] = {1, 2, 2, 3, 4};
    return counts[int(layout)];
}

TexelFormat::TexelFormat(TexelLayout l, TexelType t) : layout(l), type(t) {
    for (size_t i = 0; i < 256; ++i)
        plain[i] = float(i) / 255.0f;
    decode = plain;
}

const std::array<float, 256>& TexelFormat::last() const {
    const bool alpha = layout == TexelLayout::GreyAlpha || layout == TexelLayout::Rgba;
    return alpha ? plain : decode;
}

std::vector<MipLevel> mipLevels(int width, int height) {
    std::vector<MipLevel> levels;
    size_t texels = 0;
    for (int w = width, h = height;; w = std::max(1, w / 2), h = std::max(1, h / 2)) {
        levels.push_back({w, h, texels});
        texels += size_t(w) * size_t(h);
        if (w == 1 && h == 1) return levels;
    }
}

} // namespace patina
