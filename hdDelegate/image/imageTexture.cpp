// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/imageTexture.h"

#include "hdDelegate/image/mipAverage.h"
#include "hdDelegate/image/texelMath.h"
#include "hdDelegate/parallel.h"

#include <atomic>
#include <cmath>
#include <cstring>

namespace patina {

namespace {

constexpr int outside = -1; ///< of a black border

int positiveModulo(int a, int n) {
    int m = a % n;
    return m < 0 ? m + n : m;
}

int wrapped(int i, int n, TextureWrap wrap) {
    if (i >= 0 && i < n) return i;
    switch (wrap) {
    case TextureWrap::Black: return outside;
    case TextureWrap::Clamp: return i < 0 ? 0 : n - 1;
    case TextureWrap::Mirror: i = positiveModulo(i, 2 * n); return i < n ? i : 2 * n - 1 - i;
    case TextureWrap::Repeat: break;
    }
    return positiveModulo(i, n);
}

/// Brings a coordinate near [0,1] without changing what it shows, so that it fits an int later.
float reduced(float s, TextureWrap wrap) {
    if (!std::isfinite(s)) return 0.0f;
    switch (wrap) {
    case TextureWrap::Repeat: return s - std::floor(s);
    case TextureWrap::Mirror: return s - 2.0f * std::floor(0.5f * s);
    case TextureWrap::Clamp: return std::min(std::max(s, 0.0f), 1.0f);
    case TextureWrap::Black: break;
    }
    return std::min(std::max(s, -1.0f), 2.0f);
}

/// The number of channels is a constant, so that the loop over them unrolls.
template <class T, int N> void addFourTexels(const void* texels, int width, const int* x,
                                             const int* y, const float* weights,
                                             const TexelFormat& format, float* sum) {
    const float *color = format.decode.data(), *last = format.last().data();
    const T* rows[2] = {static_cast<const T*>(texels) + size_t(y[0]) * size_t(width) * N,
                        static_cast<const T*>(texels) + size_t(y[1]) * size_t(width) * N};
    for (int i = 0; i < 4; ++i) {
        const T* p = rows[i >> 1] + size_t(x[i & 1]) * N;
        for (int c = 0; c < N; ++c)
            sum[c] += weights[i] * linearOf(p[c], c == N - 1 ? last : color);
    }
}

const glm::vec4 magenta(1, 0, 1, 1);

} // namespace

template <class T> ImageTexture::AddFour ImageTexture::addFourOf(int channels) {
    static const AddFour functions[] = {addFourTexels<T, 1>, addFourTexels<T, 2>,
                                        addFourTexels<T, 3>, addFourTexels<T, 4>};
    return functions[channels - 1];
}

ImageTexture::ImageTexture(int width, int height, const TexelFormat& format,
                           std::unique_ptr<const TexelTiles> tiles)
    : _format(format), _levels(mipLevels(width, height)), _tiles(std::move(tiles)) {
    _texels = _levels.back().offset + 1;
    switch (format.type) {
    case TexelType::U8: _addFour = addFourOf<uint8_t>(channels()); break;
    case TexelType::U16: _addFour = addFourOf<uint16_t>(channels()); break;
    case TexelType::Half: _addFour = addFourOf<half>(channels()); break;
    case TexelType::Float: _addFour = addFourOf<float>(channels()); break;
    }
}

ImageTexture::ImageTexture(int width, int height, TexelLayout layout, TexelType type)
    : ImageTexture(width, height, TexelFormat(layout, type), nullptr) {
    // Left as it is: pages are touched when they are filled.
    _data.reset(new uint8_t[memoryBytes()]);
}

size_t ImageTexture::memoryBytes() const {
    return _tiles ? 0 : _texels * _format.texelBytes();
}

const void* ImageTexture::levelData(int level) const {
    return _data.get() + _levels[size_t(level)].offset * _format.texelBytes();
}

void* ImageTexture::levelData(int level) {
    return const_cast<void*>(static_cast<const ImageTexture*>(this)->levelData(level));
}

void ImageTexture::setDecodeTable(const std::array<float, 256>& table) {
    _format.decode = table;
}

void ImageTexture::buildPyramid(int first) {
    const MipAverage average(_format);
    for (int number = std::max(first, 1); number < int(_levels.size()); ++number) {
        const Level from = _levels[size_t(number) - 1], to = _levels[size_t(number)];
        const size_t row = size_t(to.width) * _format.texelBytes();
        uint8_t* target = static_cast<uint8_t*>(levelData(number));
        parallelRanges(0, to.height, [&](int begin, int end) {
            average.make(from, to, levelData(number - 1), {0, 0, from.width, from.height},
                         target + size_t(begin) * row, {0, begin, to.width, end});
        });
    }
}

template <class T> bool ImageTexture::takeGrey(const ImageTexture& colored, int level) {
    const size_t from = size_t(colored.channels()), to = size_t(channels());
    const size_t row = size_t(_levels[size_t(level)].width);
    const T* source = static_cast<const T*>(colored.levelData(level));
    T* target = static_cast<T*>(levelData(level));
    std::atomic<bool> grey{true};
    parallelRanges(0, _levels[size_t(level)].height, [&](int begin, int end) {
        for (int y = begin; y < end && grey; ++y) {
            const T* p = source + size_t(y) * row * from;
            T* q = target + size_t(y) * row * to;
            bool same = true;
            for (size_t x = 0; x < row && same; ++x, p += from, q += to) {
                same = p[0] == p[1] && p[1] == p[2];
                q[0] = p[0];
                q[to - 1] = p[to == 1 ? 0 : 3];
            }
            if (!same) grey = false;
        }
    });
    return grey;
}

std::shared_ptr<ImageTexture> ImageTexture::asGrey(int filled) const {
    if (channels() < 3) return nullptr;
    auto grey = std::make_shared<ImageTexture>(
        width(), height(), channels() == 4 ? TexelLayout::GreyAlpha : TexelLayout::Grey, type());
    grey->setDecodeTable(_format.decode);
    const size_t bytes = bytesOf(type()); // texels are compared by their bits
    for (int level = 0; level < filled; ++level)
        if (!(bytes == 1   ? grey->takeGrey<uint8_t>(*this, level)
              : bytes == 2 ? grey->takeGrey<uint16_t>(*this, level)
                           : grey->takeGrey<uint32_t>(*this, level)))
            return nullptr;
    return grey;
}

glm::vec4 ImageTexture::expand(const float* c) const {
    switch (_format.layout) {
    case TexelLayout::Grey: return {c[0], c[0], c[0], 1.0f};
    case TexelLayout::GreyAlpha: return {c[0], c[0], c[0], c[1]};
    case TexelLayout::RedGreen: return {c[0], c[1], 0.0f, 1.0f};
    case TexelLayout::Rgb: return {c[0], c[1], c[2], 1.0f};
    case TexelLayout::Rgba: break;
    }
    return {c[0], c[1], c[2], c[3]};
}

bool ImageTexture::addFour(int number, const int* x, const int* y, const float* weights,
                           float* sum) const {
    if (_tiles) return addFourOfTiles(number, x, y, weights, sum);
    _addFour(levelData(number), _levels[size_t(number)].width, x, y, weights, _format, sum);
    return true;
}

bool ImageTexture::addFourOfTiles(int number, const int* x, const int* y, const float* weights,
                                  float* sum) const {
    constexpr int side = TexelTiles::side;
    const int columns[2] = {x[0] / side, x[1] / side}, rows[2] = {y[0] / side, y[1] / side};
    if (columns[0] == columns[1] && rows[0] == rows[1]) {
        const TexelTiles::Tile tile = _tiles->tile(number, columns[0], rows[0]);
        if (!tile.texels) return false;
        const int inX[2] = {x[0] % side, x[1] % side}, inY[2] = {y[0] % side, y[1] % side};
        _addFour(tile.texels, tile.width, inX, inY, weights, _format, sum);
        return true;
    }
    // Copies: a tile stays only until the next.
    const size_t bytes = _format.texelBytes();
    alignas(16) uint8_t block[4 * 4 * sizeof(float)];
    for (int i = 0; i < 4; ++i) {
        const TexelTiles::Tile tile = _tiles->tile(number, columns[i & 1], rows[i >> 1]);
        if (!tile.texels) return false;
        const size_t at = size_t(y[i >> 1] % side) * size_t(tile.width) + size_t(x[i & 1] % side);
        std::memcpy(block + size_t(i) * bytes,
                    static_cast<const uint8_t*>(tile.texels) + at * bytes, bytes);
    }
    static constexpr int both[2] = {0, 1};
    _addFour(block, 2, both, both, weights, _format, sum);
    return true;
}

glm::vec4 ImageTexture::texel(int level, int x, int y) const {
    const int xs[2] = {x, x}, ys[2] = {y, y};
    const float weights[4] = {1, 0, 0, 0};
    float sum[4] = {0, 0, 0, 0};
    return addFour(level, xs, ys, weights, sum) ? expand(sum) : magenta;
}

glm::vec4 ImageTexture::bilinear(int number, glm::vec2 st, TextureWrap wrapS,
                                 TextureWrap wrapT) const {
    const Level& level = _levels[size_t(number)];
    float fx = st.x * float(level.width) - 0.5f, fy = st.y * float(level.height) - 0.5f;
    int x0 = int(std::floor(fx)), y0 = int(std::floor(fy));
    float ax = fx - float(x0), ay = fy - float(y0);
    int x[2] = {wrapped(x0, level.width, wrapS), wrapped(x0 + 1, level.width, wrapS)};
    int y[2] = {wrapped(y0, level.height, wrapT), wrapped(y0 + 1, level.height, wrapT)};
    float weights[4] = {(1 - ax) * (1 - ay), ax * (1 - ay), (1 - ax) * ay, ax * ay};
    if (x[0] == outside || x[1] == outside || y[0] == outside || y[1] == outside) {
        glm::vec4 result(0.0f); // a border texel is transparent black, whatever the layout
        for (int i = 0; i < 4; ++i)
            if (x[i & 1] != outside && y[i >> 1] != outside)
                result += weights[i] * texel(number, x[i & 1], y[i >> 1]);
        return result;
    }
    float sum[4] = {0, 0, 0, 0};
    return addFour(number, x, y, weights, sum) ? expand(sum) : magenta;
}

glm::vec4 ImageTexture::sample(glm::vec2 uv, float footprint, TextureWrap wrapS,
                               TextureWrap wrapT) const {
    // Rows count from the top, v from the bottom; v is turned before it is wrapped, which every
    // wrap mode allows.
    glm::vec2 st(reduced(uv.x, wrapS), reduced(1.0f - uv.y, wrapT));
    float texels = footprint * float(std::max(width(), height()));
    if (!(texels > 1.0f)) return bilinear(0, st, wrapS, wrapT);
    int last = int(_levels.size()) - 1;
    float lambda = std::log2(texels);
    if (lambda >= float(last)) return bilinear(last, st, wrapS, wrapT);
    int fine = int(lambda);
    float blend = lambda - float(fine);
    glm::vec4 a = bilinear(fine, st, wrapS, wrapT);
    return blend == 0.0f ? a : glm::mix(a, bilinear(fine + 1, st, wrapS, wrapT), blend);
}

glm::vec4 ImageTexture::sampleNearest(glm::vec2 uv, TextureWrap wrapS, TextureWrap wrapT) const {
    // v is turned after it is wrapped and scaled: at the edge between two texels the upper one
    // wins, as on a GPU.
    float s = reduced(uv.x, wrapS) * float(width()), t = reduced(uv.y, wrapT) * float(height());
    int x = wrapped(int(std::floor(s)), width(), wrapS);
    int y = wrapped(int(std::floor(t)), height(), wrapT);
    if (x == outside || y == outside) return glm::vec4(0.0f);
    return texel(0, x, height() - 1 - y);
}

} // namespace patina
