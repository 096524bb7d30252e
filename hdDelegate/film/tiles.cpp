// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/tiles.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace patina {

std::vector<Tile> tilesOf(int width, int height, const std::array<int, 4>& window) {
    int x0 = 0, y0 = 0, x1 = width, y1 = height;
    if (window[2] >= window[0] && window[3] >= window[1]) {
        x0 = std::clamp(window[0], 0, x1);
        y0 = std::clamp(window[1], 0, y1);
        x1 = std::clamp(window[2] + 1, x0, x1);
        y1 = std::clamp(window[3] + 1, y0, y1);
    }
    std::vector<Tile> tiles;
    for (int y = y0; y < y1; y += tileSize)
        for (int x = x0; x < x1; x += tileSize)
            tiles.push_back({x, y, std::min(x + tileSize, x1), std::min(y + tileSize, y1)});
    return tiles;
}

std::vector<Tile> tilesOfPart(const std::vector<Tile>& tiles, int part, int parts) {
    if (part < 0 || part >= parts) throw std::invalid_argument("there is no such part of a frame");
    // Multiples of the golden ratio, modulo 1, are spread evenly however many they are (Knuth 1973,
    // The Art of Computer Programming 3, 6.4): their order deals the tiles out.
    std::vector<uint32_t> order(tiles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [](uint32_t a, uint32_t b) { return a * 2654435769u < b * 2654435769u; });
    const size_t from = order.size() * size_t(part) / size_t(parts);
    const size_t to = order.size() * size_t(part + 1) / size_t(parts);
    std::sort(order.begin() + ptrdiff_t(from), order.begin() + ptrdiff_t(to));
    std::vector<Tile> found;
    for (size_t i = from; i < to; ++i)
        found.push_back(tiles[order[i]]);
    return found;
}

} // namespace patina
