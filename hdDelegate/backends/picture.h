// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <vector>

namespace patina {

/// Colour and alpha of a film, row 0 on top; pixels without samples are 0.
struct Picture {
    int width = 0, height = 0;
    std::vector<glm::vec4> pixels;

    bool empty() const { return pixels.empty(); }
};

Picture pictureOf(const Film& film);
/// Makes the means of a film those of a picture of its size.
void writePicture(const Picture& picture, Film& film);

/// Mean over a square of 2 radius + 1 pixels, cut off at the borders.
Picture boxBlur(const Picture& picture, int radius);

/// Where in the range that eyes see a linear value lies: its square root up to 1, and above that
/// 1.5 - 0.5 / x, which is as steep there and stays below 1.5. Differences of it are what is meant
/// by differences of brightness here.
float toEye(float linear);
float fromEye(float seen);

/// The largest difference between two pictures of one size of the means of toEye() (alpha as it is)
/// over any 16x16 block and any of the four channels; blocks begin at the top left.
float largestStep(const Picture& a, const Picture& b);

/// Moves a picture towards another one, by at most `bound` as largestStep() measures it, and at
/// most by a share of the way, so that noise comes little by little too.
/// @param maxFraction 0..1
/// @returns whether it is equal now, to the bit
bool approach(Picture& shown, const Picture& target, float bound, float maxFraction = 1.0f);

} // namespace patina
