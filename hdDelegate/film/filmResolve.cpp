// SPDX-License-Identifier: Apache-2.0
// What a film shows: the pixels of an AOV, made of samples, denoised, or asked of a source.

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/pixelSplat.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

constexpr char noisy[] = ".noisy";

/// @returns AOV of AOV.noisy; empty for another name
std::string noisyAovOf(const std::string& name) {
    const size_t length = sizeof noisy - 1, end = name.size();
    return end > length && name.compare(end - length, length, noisy) == 0
               ? name.substr(0, end - length)
               : "";
}

} // namespace

bool Film::findSpec(const std::string& name, AovSpec& spec) const {
    if (denoised(noisyAovOf(name)) && findSpec(noisyAovOf(name), spec)) {
        spec.name = name;
        return true;
    }
    int aov = aovIndex(name);
    if (aov < 0 && !isOfFilm(name)) return false;
    spec = aov >= 0 ? _aovs[size_t(aov)] : standardAov(name);
    return true;
}

/// @returns empty where the film itself has the AOV
std::vector<float> Film::fromSource(const AovSpec& spec) const {
    if (!_source || (!_source->has(spec.id) && !isOfFilm(spec.name))) return {};
    PixelForm form;
    form.type = spec.isInteger ? PixelForm::Type::Int : PixelForm::Type::Float;
    form.components = spec.components;
    form.nothing = spec.clearValue;
    std::vector<float> out(size_t(_width) * size_t(_height) * size_t(spec.components),
                           spec.clearValue);
    _source->read(spec.id, form, out.data());
    return out;
}

void Film::setDenoised(std::vector<float> pixels, const std::string& aov) {
    AovSpec spec;
    if (pixels.size() != 3 * _pixels.size() || !findSpec(aov, spec) || spec.components != 3)
        throw std::invalid_argument("the denoised " + aov + " has not the film's pixels");
    _denoised[aov] = std::move(pixels);
}

glm::ivec2 Film::shownAt(int x, int y) const {
    const glm::ivec4& w = _blockWindow;
    if (_blockSize < 2 || x < w.x || y < w.y || x >= w.z || y >= w.w || pixel(x, y).count)
        return {x, y};
    const int left = x - (x - w.x) % _blockSize, top = y - (y - w.y) % _blockSize;
    for (int up = 0; up < 2; ++up)
        for (int back = 0; back < 2; ++back) {
            const int i = left - back * _blockSize, k = top - up * _blockSize;
            if (i >= w.x && k >= w.y && pixel(i, k).count) return {i, k};
        }
    return {x, y};
}

std::vector<float> Film::resolve(const std::string& asked) const {
    AovSpec spec;
    if (!findSpec(asked, spec)) return {};
    if (const auto clean = _denoised.find(spec.name); clean != _denoised.end())
        return clean->second;
    const std::string base = noisyAovOf(asked), &name = denoised(base) ? base : asked;
    if (std::vector<float> made = fromSource(spec); !made.empty()) return made;
    size_t n = size_t(spec.components);
    std::vector<float> out(size_t(_width) * size_t(_height) * n);
    const bool ofSamples = name == "sampleCount" || name == "variance";
    auto eachPixel = [&](auto value) {
        parallelFor(0, _height, [&](int y) {
            for (int x = 0; x < _width; ++x) {
                const glm::ivec2 shown = ofSamples ? glm::ivec2(x, y) : shownAt(x, y);
                value(shown.x, shown.y, &out[index(x, y) * n]);
            }
        });
    };
    if ((name == "color" || name == "alpha") && splats()) {
        const PixelSplat splat(*this);
        const std::vector<float> made = name == "alpha" ? splat.alpha() : splat.color();
        eachPixel([&](int x, int y, float* to) { std::copy_n(&made[index(x, y) * n], n, to); });
    } else if (name == "color") {
        eachPixel([this](int x, int y, float* to) {
            glm::vec3 c = color(x, y);
            std::copy(&c.x, &c.x + 3, to);
        });
    } else if (name == "alpha") {
        eachPixel([this](int x, int y, float* to) { *to = alpha(x, y); });
    } else if (name == "sampleCount") {
        eachPixel([this](int x, int y, float* to) { *to = float(sampleCount(x, y)); });
    } else if (name == "variance") {
        eachPixel([this](int x, int y, float* to) { *to = varianceOfMean(x, y); });
    } else {
        const Plane& plane = _planes[size_t(aovIndex(name))];
        eachPixel([&](int x, int y, float* to) {
            if (spec.kind == AovKind::Coverage) {
                // Ids that were not kept are empty, or left out.
                const std::vector<CoverageCount> counts = plane.cells[index(x, y)].ranked();
                for (size_t i = 0; i < std::min(n / 2, counts.size()); ++i) {
                    std::memcpy(&to[2 * i], &counts[i].id, sizeof(float));
                    to[2 * i + 1] = float(double(counts[i].samples) / sampleCount(x, y));
                }
                return;
            }
            if (spec.kind == AovKind::First) {
                const float* values = &plane.nearest[index(x, y) * (n + 1)];
                std::copy(values, values + n, to);
                return;
            }
            const double* sums = &plane.sums[index(x, y) * (2 * n + 1)];
            const double count = sums[2 * n];
            for (size_t i = 0; i < n; ++i)
                to[i] = count > 0 ? float((sums[i] + sums[n + i]) / count) : spec.clearValue;
        });
    }
    return out;
}

} // namespace patina
