// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/texelConversion.h"

#include <OpenImageIO/half.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace patina {

namespace {

/// Fills the table of an 8-bit decode. @returns false when the transform mixes channels or falls.
bool decodeTable(const ColorTransform& transform, std::array<float, 256>& table) {
    auto apply = [&](int r, int g, int b) {
        glm::vec3 c = glm::vec3(r, g, b) / 255.0f;
        transform.apply(&c.x, 1, 3);
        return c;
    };
    auto close = [](float a, float b) {
        return std::abs(a - b) <= 2e-6f * std::max(1.0f, std::abs(b));
    };
    for (int i = 0; i < 256; ++i) {
        glm::vec3 c = apply(i, i, i);
        if (!close(c.r, c.g) || !close(c.b, c.g)) return false;
        table[size_t(i)] = c.g;
        if (i && !(table[size_t(i)] >= table[size_t(i) - 1])) return false;
    }
    for (int i = 0; i < 256; i += 5) {
        int r = i, g = (i * 7 + 60) & 255, b = 255 - i;
        glm::vec3 c = apply(r, g, b);
        if (!close(c.r, table[size_t(r)]) || !close(c.g, table[size_t(g)]) ||
            !close(c.b, table[size_t(b)]))
            return false;
    }
    return true;
}

float toFloat(uint8_t v) {
    return float(v) * (1.0f / 255.0f);
}
float toFloat(uint16_t v) {
    return float(v) * (1.0f / 65535.0f);
}
float toFloat(half v) {
    return float(v);
}
float toFloat(float v) {
    return v;
}

// Interpolation adds texels and weights them: the largest leave room for that.
constexpr float largestTexel = 1e30f;

void assign(float v, half& to) {
    to = half(std::min(std::max(v, -largestHalf), largestHalf));
}
void assign(float v, float& to) {
    to = std::min(std::max(v, -largestTexel), largestTexel);
}

/// Converts one row; source and target may be the same memory when their types are.
template <class From, class To> void convertRow(const From* from, To* to, int width,
                                                TexelLayout layout, const ColorTransform& transform,
                                                size_t& bad) {
    const size_t n = size_t(channelCount(layout));
    const bool grey = layout == TexelLayout::Grey || layout == TexelLayout::GreyAlpha;
    const size_t colors = grey ? 1 : std::min<size_t>(n, 3);
    std::vector<float> row(size_t(width) * 4, 0.0f);
    for (size_t x = 0; x < size_t(width); ++x)
        for (size_t c = 0; c < n; ++c) {
            float v = toFloat(from[x * n + c]);
            if (!std::isfinite(v)) v = 0.0f, ++bad;
            if (grey && c == 0)
                row[x * 4] = row[x * 4 + 1] = row[x * 4 + 2] = v;
            else
                row[x * 4 + (c < colors ? c : 3)] = v;
        }
    transform.apply(row.data(), size_t(width), 4);
    for (size_t x = 0; x < size_t(width); ++x)
        for (size_t c = 0; c < n; ++c) {
            // of a grey image green, which every transform that keeps white carries through
            float v = row[x * 4 + (c < colors ? (grey ? 1 : c) : 3)];
            if (!std::isfinite(v)) v = 0.0f, ++bad; // the transform overflowed
            assign(v, to[x * n + c]);
        }
}

template <class To> size_t convertTo(TexelType type, const void* from, void* target, int width,
                                     TexelLayout layout, const ColorTransform& transform) {
    To* to = static_cast<To*>(target);
    size_t bad = 0;
    const auto convert = [&](auto typed) {
        convertRow(static_cast<const decltype(typed)*>(from), to, width, layout, transform, bad);
    };
    switch (type) {
    case TexelType::U8: convert(uint8_t()); break;
    case TexelType::U16: convert(uint16_t()); break;
    case TexelType::Half: convert(half()); break;
    case TexelType::Float: convert(float()); break;
    }
    return bad;
}

} // namespace

TexelConversion::TexelConversion(TexelLayout layout, TexelType file, ColorTransformPtr transform)
    : _format(layout, file), _file(file), _transform(std::move(transform)) {
    const bool identity = _transform->isIdentity();
    _asRead = identity && (file == TexelType::U8 || file == TexelType::U16);
    if (file == TexelType::U8 && !identity) {
        std::array<float, 256> table;
        _asRead = decodeTable(*_transform, table);
        if (_asRead)
            _format.decode = table;
        else
            _format.type = TexelType::Half;
    }
    if (file == TexelType::U16 && !_asRead) _format.type = TexelType::Float;
}

size_t TexelConversion::row(const void* from, void* to, int width) const {
    if (_asRead) {
        if (from != to) std::memcpy(to, from, size_t(width) * _format.texelBytes());
        return 0;
    }
    return (_format.type == TexelType::Half
                ? convertTo<half>
                : convertTo<float>)(_file, from, to, width, _format.layout, *_transform);
}

} // namespace patina
