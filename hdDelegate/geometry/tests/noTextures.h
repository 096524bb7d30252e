// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/material.h"

namespace patina {

/// For materials that read none.
class NoTextures : public TextureSource {
public:
    int open(const TextureRequest&) override { return 0; }
    bool valid(int) const override { return false; }
    glm::vec4 sample(int, glm::vec2, float) const override { return glm::vec4(0.0f); }
    int channels(int) const override { return 4; }
};

} // namespace patina
