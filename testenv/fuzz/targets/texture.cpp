// SPDX-License-Identifier: Apache-2.0
// Any bytes as a texture: its header, its colour space, and its texels, read whole and by tiles.
// Both need not be the same: of a packed strip that holds too little, readers of formats give
// memory as it is.
#include "hdDelegate/image/fileTiles.h"
#include "hdDelegate/image/imageTextureLoad.h"
#include "testenv/fuzz/targets/imageInput.h"
#include "testenv/fuzz/targets/targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

void must(bool holds, const char* promise) {
    if (holds) return;
    std::fprintf(stderr, "promise broken: %s\n", promise);
    std::abort();
}

void look(const patina::ImageTexture& texture) {
    for (size_t level = 0; level < texture.levels().size(); ++level) {
        const patina::MipLevel size = texture.levels()[level];
        const int stepX = std::max(1, size.width / 16), stepY = std::max(1, size.height / 16);
        for (int y = 0; y < size.height; y += stepY)
            for (int x = 0; x < size.width; x += stepX) {
                const glm::vec4 texel = texture.texel(int(level), x, y);
                for (int i = 0; i < 4; ++i)
                    must(std::isfinite(texel[i]), "texels are finite");
            }
    }
}

} // namespace

bool fuzzTexture(const uint8_t* data, size_t size) {
    using namespace patina;
    const ImageSource source{imageInput(data, size), "auto", "/prim", "file", false};
    if (source.file.empty()) return false;
    const ImageHeader header = probeImage(source.file);
    Diagnostics diagnostics;
    const auto whole = loadImageTexture(source, ColorSpaces::shared(), diagnostics);
    for (const Diagnostic& warning : diagnostics.all())
        must(warning.message.find('\n') == std::string::npos, "warnings are one line");
    must(whole || diagnostics.count() > 0, "what cannot be read is warned of");
    if (!whole) return false;
    must(header.problem.empty() && header.tooLarge.empty(), "what a header refuses is not read");
    look(*whole);
    const auto tiled = openTiledTexture(
        source, ColorSpaces::shared(),
        std::make_shared<TileStore>(size_t(1) << 24, size_t(1) << 24), diagnostics);
    must(tiled && tiled->levels().size() == whole->levels().size(),
         "what is read whole is read by tiles");
    look(*tiled);
    return true;
}
