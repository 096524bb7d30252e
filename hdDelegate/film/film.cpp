// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/film.h"

#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/cryptomatteHash.h"
#include "hdDelegate/film/pixelFilter.h"
#include "hdDelegate/film/pixelSplat.h"
#include "hdDelegate/film/spans.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace patina {

namespace {

constexpr int maxSide = 1 << 20;
constexpr int64_t maxPixels = int64_t(1) << 28; // some 100 bytes each; as of --imageWidth
constexpr float farAway = std::numeric_limits<float>::infinity();

double luminanceOf(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

double luminanceOf(const double color[3]) {
    return luminanceOf(color[0], color[1], color[2]);
}

bool isUsable(float v) {
    return v >= 0.0f && v <= std::numeric_limits<float>::max();
}

// Compared as bits, because the clear value of an id is a NaN when seen as a float.
bool sameSpec(const AovSpec& a, const AovSpec& b) {
    return a.name == b.name && a.components == b.components && a.kind == b.kind &&
           a.isInteger == b.isInteger &&
           std::memcmp(&a.clearValue, &b.clearValue, sizeof(float)) == 0;
}

constexpr char noisyColor[] = "color.noisy";
constexpr size_t splatStride = 2 * PixelSplat::Sample::shareCount + 1; // as of any mean

/// As assign(), but a vector of that size keeps its memory and is filled on all threads.
template <class Value> void fill(std::vector<Value>& values, size_t count, const Value& value) {
    if (values.size() != count) return values.assign(count, value);
    constexpr size_t part = 1 << 16;
    parallelFor(size_t(0), (count + part - 1) / part, [&](size_t i) {
        std::fill(values.begin() + ptrdiff_t(i * part),
                  values.begin() + ptrdiff_t(std::min(count, (i + 1) * part)), value);
    });
}

} // namespace

void checkAovSpec(const AovSpec& spec) {
    const std::string aov = "AOV " + spec.name + " has ";
    const int most = spec.kind == AovKind::Coverage ? cryptomatteComponents(16) : 16;
    if (spec.components < 1 || spec.components > most)
        throw std::invalid_argument(aov + std::to_string(spec.components) +
                                    " components, not 1 to " + std::to_string(most));
    if (spec.name == noisyColor) throw std::invalid_argument(aov + "a name that films keep");
    const AovId id = aovIdOf(spec.name);
    if (id == AovId::unknown) return;
    if (id == AovId::lpe) { // resolve() also finds it by the name of its channels
        const std::string channels = channelsOfAov(spec.name);
        if (aovIdOf(channels) != AovId::unknown || channels == noisyColor)
            throw std::invalid_argument(aov + "the name of another one");
    }
    const AovRow& row = aovRows()[size_t(id)];
    if (spec.kind != row.kind) throw std::invalid_argument(aov + "values of another kind");
    if (row.kind == AovKind::Coverage) return;
    const int least = id == AovId::primvars ? 1 : row.components;
    if (spec.components < least || spec.components > row.components)
        throw std::invalid_argument(aov + std::to_string(spec.components) + " components, not " +
                                    std::to_string(row.components));
}

/// @param plane of such an AOV, whose memory is used again, or an empty one
void Film::clearPlane(const AovSpec& spec, size_t pixels, Plane& plane) {
    if (isOfFilm(spec.name)) return;
    if (spec.kind == AovKind::Mean)
        return fill(plane.sums, (2 * size_t(spec.components) + 1) * pixels, 0.0);
    if (spec.kind == AovKind::Coverage) {
        plane.names = CoverageNames();
        plane.room = CoverageRoom();
        return plane.cells.assign(pixels, CoverageCell());
    }
    const size_t stride = size_t(spec.components) + 1;
    fill(plane.nearest, stride * pixels, spec.clearValue);
    for (size_t i = stride - 1; i < plane.nearest.size(); i += stride)
        plane.nearest[i] = farAway;
}

/// Clears all that belongs to samples, and the planes of AOVs that no source has.
void Film::clear(int width, int height, const std::vector<AovSpec>& aovs) {
    if (width < 0 || height < 0 || width > maxSide || height > maxSide ||
        int64_t(width) * height > maxPixels)
        throw std::invalid_argument("film size " + std::to_string(width) + "x" +
                                    std::to_string(height) + " is not possible");
    for (const AovSpec& spec : aovs)
        checkAovSpec(spec);
    const size_t pixels = size_t(width) * size_t(height);
    const bool same = width == _width && height == _height &&
                      std::equal(aovs.begin(), aovs.end(), _aovs.begin(), _aovs.end(), sameSpec);
    _denoised.clear();
    _deep.reset();
    _blockSize = 1;
    _firstSample = 0;
    _allowsNegative = false;
    _width = width;
    _height = height;
    _aovs = aovs;
    if (!same) _planes.clear();
    _planes.resize(_aovs.size());
    for (size_t i = 0; i < _aovs.size(); ++i)
        if (!_source || !_source->has(_aovs[i].id)) clearPlane(_aovs[i], pixels, _planes[i]);
    _dropped = 0;
}

void Film::reset(int width, int height, const std::vector<AovSpec>& aovs, bool keep) {
    if (keep && !_source && width == _width && height == _height &&
        std::equal(aovs.begin(), aovs.end(), _aovs.begin(), _aovs.end(), sameSpec)) {
        _denoised.clear();
        _blockSize = 1;
        return;
    }
    _source = nullptr;
    clear(width, height, aovs);
    fill(_pixels, size_t(width) * size_t(height), Pixel());
}

void Film::resetTo(const FilmSource* source, int width, int height,
                   const std::vector<AovSpec>& aovs) {
    _source = source;
    std::vector<Pixel>().swap(_pixels);
    clear(width, height, aovs);
}

int Film::aovIndex(const std::string& name) const {
    for (size_t i = 0; i < _aovs.size(); ++i)
        if (_aovs[i].name == name) return int(i);
    for (size_t i = 0; i < _aovs.size(); ++i)
        if (_aovs[i].id == AovId::lpe && channelsOfAov(_aovs[i].name) == name) return int(i);
    return -1;
}

bool Film::usable(const glm::vec3& radiance, float alpha) const {
    const glm::vec3 r = _allowsNegative ? glm::abs(radiance) : radiance;
    return isUsable(alpha) && isUsable(r.r) && isUsable(r.g) && isUsable(r.b);
}

bool Film::addColor(int x, int y, glm::vec3 radiance, float alpha) {
    Pixel& p = _pixels[index(x, y)];
    recordMean(p);
    ++p.count;
    const bool goodAlpha = isUsable(alpha);
    const bool good = usable(radiance, alpha);
    if (goodAlpha) p.open.alpha += alpha;
    if (good) {
        for (int i = 0; i < 3; ++i)
            p.open.color[i] += radiance[i];
        const double l = luminanceOf(radiance.r, radiance.g, radiance.b);
        p.open.luminanceSquared += l * l;
    } else {
        drop();
    }
    if (isSpanEnd(_firstSample + p.count)) closeSpan(index(x, y));
    return good;
}

Film::Sums Film::Sums::operator+(const Sums& other) const {
    Sums sum = *this;
    for (int i = 0; i < 3; ++i)
        sum.color[i] += other.color[i];
    sum.alpha += other.alpha;
    sum.luminanceSquared += other.luminanceSquared;
    return sum;
}

/// Before a pixel's next sample: keeps the mean after each power of two.
void Film::recordMean(Pixel& p) {
    if (!p.count || (p.count & (p.count - 1))) return;
    p.deviationEarlier = p.deviationBefore;
    p.deviationBefore = deviationOfMean(p);
    p.meanBefore = float(luminanceOf(p.total().color) / p.count);
}

void Film::closeSpan(size_t index) {
    Pixel& p = _pixels[index];
    p.closed = p.total();
    p.open = Sums();
    for (size_t a = 0; a < _planes.size(); ++a) {
        if (_planes[a].sums.empty()) continue;
        const size_t n = size_t(_aovs[a].components);
        double* closed = &_planes[a].sums[index * (2 * n + 1)];
        for (size_t i = 0; i < n; ++i) {
            closed[i] += closed[n + i];
            closed[n + i] = 0.0;
        }
    }
}

void Film::addAov(int aov, int x, int y, const float* values, float distance) {
    const AovSpec& spec = _aovs[size_t(aov)];
    Plane& plane = _planes[size_t(aov)];
    const bool first = spec.kind == AovKind::First;
    const size_t n = size_t(spec.components), at = index(x, y) * (first ? n + 1 : 2 * n + 1);
    if (first ? plane.nearest.empty() || !(distance < plane.nearest[at + n]) : plane.sums.empty())
        return;
    if (!spec.isInteger)
        for (size_t i = 0; i < n; ++i)
            if (!std::isfinite(values[i])) return drop();
    if (first) {
        std::copy(values, values + n, &plane.nearest[at]);
        plane.nearest[at + n] = distance;
    } else {
        for (size_t i = 0; i < n; ++i)
            plane.sums[at + n + i] += values[i];
        plane.sums[at + 2 * n] += 1.0;
    }
}

void Film::addQuarter(int colors, int shares, int x, int y, int quarter, const glm::vec3& radiance,
                      float alpha, float radius) {
    const PixelSplat::Sample sample(quarter, usable(radiance, alpha) ? radiance : glm::vec3(0.0f),
                                    isUsable(alpha) ? alpha : 0.0f, radius);
    addAov(colors, x, y, sample.colors.data(), 0.0f);
    addAov(shares, x, y, sample.shares.data(), 0.0f);
}

void Film::addCoverage(int aov, int x, int y, const std::string& name) {
    Plane& plane = _planes[size_t(aov)];
    const uint32_t id = cryptomatteId(name);
    if (plane.cells[index(x, y)].add(id, 1, plane.room)) plane.names.add(id, name);
}

bool Film::leftOutCoverage() const {
    return std::any_of(_planes.begin(), _planes.end(),
                       [](const Plane& plane) { return plane.room.leftOut(); });
}

void Film::limitCoverage(uint64_t most) {
    for (Plane& plane : _planes)
        plane.room.limit(most);
}

CoverageNames::Map Film::coverageNames(const std::string& aov) const {
    const int found = aovIndex(aov);
    CoverageNames::Map names;
    if (found < 0) return names;
    const Plane& plane = _planes[size_t(found)];
    const CoverageNames::Map all = plane.names.all(); // parts may have had samples of others
    for (const CoverageCell& cell : plane.cells)
        for (size_t i = 0; i < cell.size(); ++i)
            if (const auto name = all.find(cell[i].id); name != all.end()) names.insert(*name);
    return names;
}

void Film::forgetQuarters() {
    for (size_t i = 0; i < _aovs.size(); ++i)
        if (isOfQuarters(_aovs[i].id)) clearPlane(_aovs[i], _pixels.size(), _planes[i]);
}

void Film::setMean(int x, int y, glm::vec3 color, float alpha) {
    Pixel& p = _pixels[index(x, y)];
    if (!p.count) return;
    const Sums total = p.total();
    const double n = p.count, before = luminanceOf(total.color);
    p.open = Sums();
    // n has 32 bits and a float 24, so that sum / n is the very float again.
    for (int i = 0; i < 3; ++i)
        p.closed.color[i] = n * double(color[i]);
    p.closed.alpha = n * double(alpha);
    const double after = luminanceOf(p.closed.color);
    p.closed.luminanceSquared = total.luminanceSquared + (after * after - before * before) / n;
    p.meanBefore += float((after - before) / n);
}

void Film::copyFrom(const Film& other) {
    if (other._source) {
        reset(other._width, other._height, other._aovs);
        _allowsNegative = other._allowsNegative;
        _planes = other._planes;
        const std::vector<float> color = other.resolve("color"), alpha = other.resolve("alpha");
        const auto everyPixel = [&](auto take) {
            parallelFor(0, _height, [&](int y) {
                for (int x = 0; x < _width; ++x)
                    take(x, y, index(x, y));
            });
        };
        everyPixel([&](int x, int y, size_t i) {
            addColor(x, y, {color[3 * i], color[3 * i + 1], color[3 * i + 2]}, alpha[i]);
        });
        for (size_t a = 0; a < _aovs.size(); ++a) {
            const std::vector<float> values = other.fromSource(_aovs[a]);
            if (values.empty()) continue;
            clearPlane(_aovs[a], _pixels.size(), _planes[a]);
            everyPixel([&](int x, int y, size_t i) {
                addAov(int(a), x, y, &values[i * size_t(_aovs[a].components)], 0.0f);
            });
        }
        return;
    }
    _source = nullptr;
    _width = other._width;
    _height = other._height;
    _aovs = other._aovs;
    _pixels = other._pixels;
    _planes = other._planes;
    _denoised = other._denoised;
    _firstSample = other._firstSample;
    _allowsNegative = other._allowsNegative;
    _blockSize = other._blockSize;
    _blockWindow = other._blockWindow;
    _dropped.store(other._dropped.load(std::memory_order_relaxed), std::memory_order_relaxed);
    resumeToken = other.resumeToken;
}

glm::vec3 Film::color(int x, int y) const {
    const Pixel& p = pixel(x, y);
    const double scale = p.count ? 1.0 / p.count : 0.0;
    const Sums sum = p.total();
    return {float(sum.color[0] * scale), float(sum.color[1] * scale), float(sum.color[2] * scale)};
}

float Film::alpha(int x, int y) const {
    const Pixel& p = pixel(x, y);
    return p.count ? float((p.closed.alpha + p.open.alpha) / p.count) : 0.0f;
}

float Film::luminance(int x, int y) const {
    const Pixel& p = pixel(x, y);
    return p.count ? float(luminanceOf(p.total().color) / p.count) : 0.0f;
}

float Film::changeOfMean(int x, int y) const {
    const Pixel& p = pixel(x, y);
    return p.count < 2 ? 0.0f : luminance(x, y) - p.meanBefore;
}

/// @returns those of the AOV quarterShares, of all pixels; null where the film has none
const double* Film::splatSums() const {
    const int shares = aovIndex("quarterShares");
    const bool there = shares >= 0 && aovIndex("quarterColors") >= 0;
    return there && !_planes[size_t(shares)].sums.empty() ? _planes[size_t(shares)].sums.data()
                                                          : nullptr;
}

/// @param sums of a pixel, whose last component is the filter's radius
float Film::splatRadius(const double* sums) {
    constexpr size_t n = PixelSplat::Sample::shareCount;
    const double radius = sums[2 * n] > 0.0 ? (sums[n - 1] + sums[2 * n - 1]) / sums[2 * n] : 0.0;
    return float(std::min(radius, double(PixelFilter::largestReach))); // in files of others any
}

float Film::splatRadius(int x, int y) const {
    const double* sums = splatSums();
    return sums ? splatRadius(sums + index(x, y) * splatStride) : 0.0f;
}

bool Film::splats() const {
    const double* sums = splatSums();
    for (size_t i = 0; sums && i < _pixels.size(); ++i)
        if (splatRadius(sums + i * splatStride) > 0.0f) return true;
    return false;
}

float Film::varianceOfMean(int x, int y) const {
    const Pixel& p = pixel(x, y);
    if (p.count < 2) return 0.0f;
    const Sums sum = p.total();
    const double n = p.count, l = luminanceOf(sum.color);
    return float(std::max(0.0, (sum.luminanceSquared - l * l / n) / (n - 1.0)) / n);
}

float Film::deviationOfMean(const Pixel& p) {
    if (p.count < 2) return 0.0f;
    uint32_t first = 1; // samples that the part before is the mean of
    while (first < p.count - first)
        first *= 2;
    const double n = p.count, part = first;
    const double change = luminanceOf(p.total().color) / n - double(p.meanBefore);
    const double latest = std::abs(change) * std::sqrt(part / (n - part));
    if (first == 1) return float(latest);
    // Few samples behind the power of two tell little.
    const double weight = 0.5 * (n - part) / part;
    const double earlier = double(p.deviationBefore) * std::sqrt(part / n);
    return float(weight * latest + (1.0 - weight) * earlier);
}

} // namespace patina
