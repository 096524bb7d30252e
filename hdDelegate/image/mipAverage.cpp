// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/mipAverage.h"

#include "hdDelegate/image/texelMath.h"

namespace patina {

namespace {

/// Which texels of a side of n, with which weights, make texel i of a side of half (rounded down).
struct Span {
    int first, count;
    float weights[4];
    Span(int i, int n, int half) : first(int(int64_t(i) * n / half)), count(0) {
        double ratio = double(n) / half, from = i * ratio, to = from + ratio;
        for (int j = first; j < n && j < to - 1e-9 && count < 4; ++j)
            weights[count++] = float((std::min(to, j + 1.0) - std::max(from, double(j))) / ratio);
    }
    int end() const { return first + count; }
};

} // namespace

template <class T> MipAverage::Function MipAverage::functionOf(int channels) {
    static const Function functions[] = {&MipAverage::makeBlock<T, 1>, &MipAverage::makeBlock<T, 2>,
                                         &MipAverage::makeBlock<T, 3>,
                                         &MipAverage::makeBlock<T, 4>};
    return functions[channels - 1];
}

MipAverage::MipAverage(const TexelFormat& format) : _format(format) {
    const int channels = channelCount(format.layout);
    switch (format.type) {
    case TexelType::U8:
        _function = functionOf<uint8_t>(channels);
        _encodeColor = std::make_unique<TexelEncoder>(_format.decode);
        _encodeLast = std::make_unique<TexelEncoder>(_format.last());
        break;
    case TexelType::U16: _function = functionOf<uint16_t>(channels); break;
    case TexelType::Half: _function = functionOf<half>(channels); break;
    case TexelType::Float: _function = functionOf<float>(channels); break;
    }
}

MipAverage::~MipAverage() = default;

TexelBlock MipAverage::sources(const MipLevel& from, const MipLevel& to, const TexelBlock& block) {
    return {Span(block.x0, from.width, to.width).first,
            Span(block.y0, from.height, to.height).first,
            Span(block.x1 - 1, from.width, to.width).end(),
            Span(block.y1 - 1, from.height, to.height).end()};
}

void MipAverage::make(const MipLevel& from, const MipLevel& to, const void* source,
                      const TexelBlock& held, void* target, const TexelBlock& block) const {
    (this->*_function)(from, to, source, held, target, block);
}

// The number of channels is a constant, so that the loops over them unroll.
template <class T, int N> void MipAverage::makeBlock(const MipLevel& from, const MipLevel& to,
                                                     const void* source, const TexelBlock& held,
                                                     void* target, const TexelBlock& block) const {
    const float *color = _format.decode.data(), *last = _format.last().data();
    std::vector<Span> columns;
    for (int x = block.x0; x < block.x1; ++x)
        columns.emplace_back(x, from.width, to.width);
    const int first = columns.front().first, end = columns.back().end();
    std::vector<float> row(size_t(end - first) * N);
    T* p = static_cast<T*>(target);
    for (int y = block.y0; y < block.y1; ++y) {
        const Span rows(y, from.height, to.height);
        std::fill(row.begin(), row.end(), 0.0f);
        for (int j = 0; j < rows.count; ++j) {
            const T* q = static_cast<const T*>(source) +
                         (size_t(rows.first + j - held.y0) * size_t(held.width()) +
                          size_t(first - held.x0)) *
                             N;
            for (size_t i = 0; i < row.size(); i += N)
                for (size_t c = 0; c < N; ++c)
                    row[i + c] += rows.weights[j] * linearOf(q[i + c], c == N - 1 ? last : color);
        }
        for (const Span& span : columns)
            for (int c = 0; c < N; ++c) {
                float sum = 0;
                for (int i = 0; i < span.count; ++i)
                    sum += span.weights[i] * row[size_t(span.first - first + i) * N + size_t(c)];
                storeLinear(sum, c == N - 1 ? _encodeLast.get() : _encodeColor.get(), *p++);
            }
    }
}

} // namespace patina
