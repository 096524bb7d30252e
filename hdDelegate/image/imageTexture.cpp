// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/imageTexture.h"

#include "hdDelegate/parallel.h"

#include <OpenImageIO/half.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace patina {

namespace {

size_t bytesOf(TexelType type) {
    return type == TexelType::U8 ? 1 : type == TexelType::Float ? 4 : 2;
}

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

/// Which texels of a side of n, with which weights, make texel i of a side of half (rounded down).
struct Span {
    int first, count;
    float weights[4];
    Span(int i, int n, int half) : first(int(int64_t(i) * n / half)), count(0) {
        double ratio = double(n) / half, from = i * ratio, to = from + ratio;
        for (int j = first; j < n && j < to - 1e-9 && count < 4; ++j)
            weights[count++] = float((std::min(to, j + 1.0) - std::max(from, double(j))) / ratio);
    }
};

/// Finds the 8-bit code whose linear value is nearest.
class Encoder {
public:
    explicit Encoder(const std::array<float, 256>& decode) : _decode(decode) {
        int code = 0;
        for (int i = 0; i < cells; ++i) {
            while (code < 255 && middle(code) <= float(i) / cells)
                ++code;
            _guess[size_t(i)] = uint8_t(code);
        }
    }
    uint8_t operator()(float linear) const {
        int cell = int(std::min(std::max(linear, 0.0f), 1.0f) * cells);
        int code = _guess[size_t(std::min(cell, cells - 1))];
        while (code < 255 && middle(code) <= linear)
            ++code;
        return uint8_t(code);
    }

private:
    static constexpr int cells = 4096;
    float middle(int code) const {
        return 0.5f * (_decode[size_t(code)] + _decode[size_t(code) + 1]);
    }
    const std::array<float, 256>& _decode;
    std::array<uint8_t, cells> _guess;
};

inline float linearOf(uint8_t v, const float* table) {
    return table[v];
}
inline float linearOf(uint16_t v, const float*) {
    return v * (1.0f / 65535.0f);
}
inline float linearOf(half v, const float*) {
    return float(v);
}
inline float linearOf(float v, const float*) {
    return v;
}

inline void store(float v, const Encoder& encode, uint8_t& to) {
    to = encode(v);
}
inline void store(float v, const Encoder&, uint16_t& to) {
    to = uint16_t(std::min(std::max(v, 0.0f), 1.0f) * 65535.0f + 0.5f);
}
inline void store(float v, const Encoder&, half& to) {
    to = half(v);
}
inline void store(float v, const Encoder&, float& to) {
    to = v;
}

} // namespace

int channelCount(TexelLayout layout) {
    static const int counts[] = {1, 2, 2, 3, 4};
    return counts[int(layout)];
}

ImageTexture::ImageTexture(int width, int height, TexelLayout layout, TexelType type)
    : _channels(channelCount(layout)), _layout(layout), _type(type) {
    for (int w = width, h = height;; w = std::max(1, w / 2), h = std::max(1, h / 2)) {
        _levels.push_back({w, h, _texels});
        _texels += size_t(w) * size_t(h);
        if (w == 1 && h == 1) break;
    }
    _data.reset(
        new uint8_t[memoryBytes()]); // left as it is: pages are touched when they are filled
    for (size_t i = 0; i < 256; ++i)
        _plain[i] = float(i) / 255.0f;
    _decode = _plain;
    switch (_type) {
    case TexelType::U8: _functions = functionsOf<uint8_t>(_channels); break;
    case TexelType::U16: _functions = functionsOf<uint16_t>(_channels); break;
    case TexelType::Half: _functions = functionsOf<half>(_channels); break;
    case TexelType::Float: _functions = functionsOf<float>(_channels); break;
    }
}

size_t ImageTexture::memoryBytes() const {
    return _texels * size_t(_channels) * bytesOf(_type);
}

const void* ImageTexture::levelData(int level) const {
    return _data.get() + _levels[size_t(level)].offset * size_t(_channels) * bytesOf(_type);
}

void* ImageTexture::levelData(int level) {
    return const_cast<void*>(static_cast<const ImageTexture*>(this)->levelData(level));
}

void ImageTexture::setDecodeTable(const std::array<float, 256>& table) {
    _decode = table;
}

const float* ImageTexture::lastTable() const {
    bool alpha = _layout == TexelLayout::GreyAlpha || _layout == TexelLayout::Rgba;
    return alpha ? _plain.data() : _decode.data();
}

// The number of channels is a constant in what follows, so that the loops over them unroll.

template <class T, int N> void ImageTexture::buildLevel(int number) {
    const Level from = _levels[size_t(number) - 1], to = _levels[size_t(number)];
    const T* source = static_cast<const T*>(levelData(number - 1));
    T* target = static_cast<T*>(levelData(number));
    const float *color = _decode.data(), *last = lastTable();
    const Encoder encodeColor(_decode), encodeLast(last == color ? _decode : _plain);
    std::vector<Span> columns;
    for (int x = 0; x < to.width; ++x)
        columns.emplace_back(x, from.width, to.width);
    parallelRanges(0, to.height, [&](int begin, int end) {
        std::vector<float> row(size_t(from.width) * N);
        for (int y = begin; y < end; ++y) {
            Span rows(y, from.height, to.height);
            std::fill(row.begin(), row.end(), 0.0f);
            for (int j = 0; j < rows.count; ++j) {
                const T* p = source + size_t(rows.first + j) * size_t(from.width) * N;
                for (size_t i = 0; i < row.size(); i += N)
                    for (size_t c = 0; c < N; ++c)
                        row[i + c] +=
                            rows.weights[j] * linearOf(p[i + c], c == N - 1 ? last : color);
            }
            T* p = target + size_t(y) * size_t(to.width) * N;
            for (int x = 0; x < to.width; ++x, p += N) {
                const Span& span = columns[size_t(x)];
                for (int c = 0; c < N; ++c) {
                    float sum = 0;
                    for (int i = 0; i < span.count; ++i)
                        sum += span.weights[i] * row[size_t(span.first + i) * N + size_t(c)];
                    store(sum, c == N - 1 ? encodeLast : encodeColor, p[c]);
                }
            }
        }
    });
}

void ImageTexture::buildPyramid() {
    for (int level = 1; level < int(_levels.size()); ++level)
        (this->*_functions.buildLevel)(level);
}

template <class T> bool ImageTexture::takeGrey(const ImageTexture& colored) {
    const size_t from = size_t(colored._channels), to = size_t(_channels);
    const size_t row = size_t(width());
    const T* source = static_cast<const T*>(colored.levelData(0));
    T* target = static_cast<T*>(levelData(0));
    std::atomic<bool> grey{true};
    parallelRanges(0, height(), [&](int begin, int end) {
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

std::shared_ptr<ImageTexture> ImageTexture::asGrey() const {
    if (_channels < 3) return nullptr;
    auto grey = std::make_shared<ImageTexture>(
        width(), height(), _channels == 4 ? TexelLayout::GreyAlpha : TexelLayout::Grey, _type);
    grey->setDecodeTable(_decode);
    const size_t bytes = bytesOf(_type); // texels are compared by their bits
    const bool all = bytes == 1   ? grey->takeGrey<uint8_t>(*this)
                     : bytes == 2 ? grey->takeGrey<uint16_t>(*this)
                                  : grey->takeGrey<uint32_t>(*this);
    return all ? grey : nullptr;
}

glm::vec4 ImageTexture::expand(const float* c) const {
    switch (_layout) {
    case TexelLayout::Grey: return {c[0], c[0], c[0], 1.0f};
    case TexelLayout::GreyAlpha: return {c[0], c[0], c[0], c[1]};
    case TexelLayout::RedGreen: return {c[0], c[1], 0.0f, 1.0f};
    case TexelLayout::Rgb: return {c[0], c[1], c[2], 1.0f};
    case TexelLayout::Rgba: break;
    }
    return {c[0], c[1], c[2], c[3]};
}

template <class T, int N> void ImageTexture::addFour(const Level& level, const int* x, const int* y,
                                                     const float* weights, float* sum) const {
    const T* texels = reinterpret_cast<const T*>(_data.get()) + level.offset * N;
    const float *color = _decode.data(), *last = lastTable();
    const T* rows[2] = {texels + size_t(y[0]) * size_t(level.width) * N,
                        texels + size_t(y[1]) * size_t(level.width) * N};
    for (int i = 0; i < 4; ++i) {
        const T* p = rows[i >> 1] + size_t(x[i & 1]) * N;
        for (int c = 0; c < N; ++c)
            sum[c] += weights[i] * linearOf(p[c], c == N - 1 ? last : color);
    }
}

template <class T> ImageTexture::Functions ImageTexture::functionsOf(int channels) {
    static const Functions functions[] = {
        {&ImageTexture::addFour<T, 1>, &ImageTexture::buildLevel<T, 1>},
        {&ImageTexture::addFour<T, 2>, &ImageTexture::buildLevel<T, 2>},
        {&ImageTexture::addFour<T, 3>, &ImageTexture::buildLevel<T, 3>},
        {&ImageTexture::addFour<T, 4>, &ImageTexture::buildLevel<T, 4>}};
    return functions[channels - 1];
}

glm::vec4 ImageTexture::texel(int level, int x, int y) const {
    const int xs[2] = {x, x}, ys[2] = {y, y};
    const float weights[4] = {1, 0, 0, 0};
    float sum[4] = {0, 0, 0, 0};
    (this->*_functions.addFour)(_levels[size_t(level)], xs, ys, weights, sum);
    return expand(sum);
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
    (this->*_functions.addFour)(level, x, y, weights, sum);
    return expand(sum);
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
