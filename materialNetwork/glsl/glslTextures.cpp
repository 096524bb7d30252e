// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslTextures.h"

#include <algorithm>

namespace patina {

namespace {

constexpr int firstTile = 1001;
constexpr int maxTile = 1400; ///< 40 rows of 10; a table of more would not be worth its room

/// Four tiles to a vector, in the order of their numbers: the layer, or -1.
/// @returns the place of the table; before the layers x says how many places there are
int addTable(const GlslTexture& texture, std::vector<glm::vec4>& parameters) {
    const int places = texture.tiles.back() - firstTile + 1;
    const size_t table = parameters.size();
    parameters.resize(table + 1 + size_t(places + 3) / 4, glm::vec4(-1.0f));
    parameters[table].x = float(places);
    for (size_t i = 0; i < texture.tiles.size(); ++i) {
        const int place = texture.tiles[i] - firstTile;
        parameters[table + 1 + size_t(place / 4)][place % 4] = float(texture.firstLayer + int(i));
    }
    return int(table);
}

} // namespace

std::string glslTextureText(const std::vector<int>& handles, const TextureSource* source,
                            bool arrays, std::vector<GlslTexture>& textures,
                            std::vector<glm::vec4>& parameters, std::vector<Message>& leftOut) {
    const bool many = arrays && int(handles.size()) > glslTextureUnits;
    const int last = glslTextureUnits - 1;
    if (many) leftOut.push_back(messages::texturesShareSize(glslTextureUnits, last));
    std::string samplers, functions, reads;
    int layers = 0;
    bool used = false;
    for (size_t i = 0; i < handles.size(); ++i) {
        TextureTiling tiling = source ? source->tiling(handles[i]) : TextureTiling();
        if (!arrays && !tiling.tiles.empty()) {
            leftOut.push_back(messages::firstTileShown);
            tiling.tiles.clear();
        }
        GlslTexture t;
        t.handle = handles[i];
        t.shared = many && int(i) >= last;
        t.unit = t.shared ? last : int(i);
        t.array = t.shared || !tiling.tiles.empty();
        t.firstLayer = t.shared ? layers : 0;
        while (!tiling.tiles.empty() && tiling.tiles.back() > maxTile)
            tiling.tiles.pop_back();
        t.tiles = tiling.tiles;
        if (t.shared) layers += std::max<int>(1, int(t.tiles.size()));
        used |= t.array;
        const std::string sampler = "sampler" + std::to_string(t.unit);
        if (!t.shared || int(i) == last)
            samplers += "layout(binding = " + std::to_string(t.unit) + ") uniform " +
                        (t.array ? "sampler2DArray " : "sampler2D ") + sampler + ";\n";
        std::string call = "nodeTexture(" + sampler + ", uv, footprint)";
        if (!t.tiles.empty())
            call = "nodeTiles(" + sampler + ", uv, footprint, " +
                   std::to_string(addTable(t, parameters)) + ")";
        else if (t.array)
            call = "nodeLayer(" + sampler + ", uv, footprint, " + std::to_string(t.firstLayer) +
                   ", " + std::to_string(int(tiling.wrapS)) + ", " +
                   std::to_string(int(tiling.wrapT)) + ")";
        functions += "vec4 texture" + std::to_string(i) + "(vec2 uv, float footprint) { return " +
                     call + "; }\n";
        reads += "    if (map == " + std::to_string(i) + ") return texture" + std::to_string(i) +
                 "(uv, footprint);\n";
        textures.push_back(std::move(t));
    }
    functions +=
        "vec4 texel(int map, vec2 uv, float footprint) {\n" + reads + "    return vec4(0.0);\n}\n";
    return (used ? "#include \"shaders/raster/textureArrays.glsl\"\n" : "") + samplers + functions;
}

} // namespace patina
