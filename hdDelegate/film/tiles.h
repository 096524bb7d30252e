// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace patina {

/// A rectangle of pixels, ends excluded.
struct Tile {
    int x0, y0, x1, y1;
};

/// Side of a tile in pixels; those at the right and lower edges may be smaller.
constexpr int tileSize = 16;

/// The tiles of an image, row by row from the top.
/// @param window xmin, ymin, xmax, ymax inclusive; xmax < xmin means all
std::vector<Tile> tilesOf(int width, int height, const std::array<int, 4>& window);

/// The tiles of one of several parts. Each part's tiles lie all over the image, so that the parts
/// take about equally long, and their numbers differ by one at most.
/// @param part from 0 to parts - 1
/// @throws std::invalid_argument where there is no such part
std::vector<Tile> tilesOfPart(const std::vector<Tile>& tiles, int part, int parts);

} // namespace patina
