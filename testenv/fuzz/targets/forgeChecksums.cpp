// SPDX-License-Identifier: Apache-2.0
#include "testenv/fuzz/targets/forgeChecksums.h"

#include "hdDelegate/film/filmFile.h"
#include "hdDelegate/film/filmStream.h"

#include <algorithm>
#include <cstring>

namespace patina {

namespace {

/// Goes along a file as FilmFileReader does, in the same pieces, which its checksum depends on.
/// After the end nothing is taken.
class Walk {
public:
    explicit Walk(std::string& bytes) : _bytes(bytes) {}

    bool skip(uint64_t size) {
        _good = _good && size <= _bytes.size() - _at;
        if (!_good) return false;
        _sum.add(&_bytes[_at], size_t(size));
        _at += size_t(size);
        return true;
    }
    template <class T> T value() {
        T v{};
        if (skip(sizeof v)) std::memcpy(&v, &_bytes[_at - sizeof v], sizeof v);
        return v;
    }
    std::string text() {
        const uint32_t size = value<uint32_t>();
        return skip(size) ? _bytes.substr(_at - size, size) : std::string();
    }
    void seal(bool counts) {
        const uint64_t sum = _sum.value();
        if (!_good || sizeof sum > _bytes.size() - _at) return;
        std::memcpy(&_bytes[_at], &sum, sizeof sum);
        if (counts) skip(sizeof sum);
    }
    bool good() const { return _good; }

private:
    std::string& _bytes;
    size_t _at = 0;
    bool _good = true;
    StreamChecksum _sum;
};

FilmStream::Header headerOf(Walk& walk) {
    FilmStream::Header header;
    header.width = walk.value<int32_t>();
    header.height = walk.value<int32_t>();
    walk.value<uint64_t>();
    walk.value<uint32_t>();
    walk.text();
    const uint32_t count = walk.value<uint32_t>();
    for (uint32_t i = 0; i < count && walk.good(); ++i) {
        AovSpec spec;
        spec.name = walk.text();
        spec.components = std::clamp(walk.value<int32_t>(), 1, 16);
        spec.kind = AovKind(std::clamp(walk.value<int32_t>(), 0, int(AovKind::Coverage)));
        walk.value<float>();
        walk.value<uint32_t>();
        if (spec.kind == AovKind::Coverage)
            for (uint32_t left = walk.value<uint32_t>(); left > 0 && walk.good(); --left)
                walk.text();
        header.aovs.push_back(spec);
    }
    walk.seal(true);
    return header;
}

void pixels(Walk& walk, const std::vector<AovSpec>& aovs, int64_t width, int64_t height) {
    const uint64_t bare = FilmStream::bytesOfPixel({});
    for (int64_t y = 0; width > 0 && y < height && walk.good(); ++y) {
        walk.skip(bare * uint64_t(width));
        for (const AovSpec& spec : aovs)
            if (const uint64_t more = FilmStream::bytesOfPixel({spec}) - bare;
                more && spec.kind != AovKind::Coverage)
                walk.skip(more * uint64_t(width));
    }
    for (const AovSpec& spec : aovs)
        for (int64_t cell = spec.kind == AovKind::Coverage ? width * height : 0;
             cell > 0 && walk.good(); --cell)
            for (uint32_t left = walk.value<uint32_t>(); left > 0 && walk.good(); --left)
                walk.value<CoverageCount>();
}

} // namespace

void forgeChecksums(std::string& bytes, bool part) {
    const uint32_t version = part ? 2 : 3, order = 0x01020304;
    std::memcpy(&bytes[0], part ? "PatinaPT" : "PatinaCP", 8);
    std::memcpy(&bytes[8], &version, sizeof version);
    std::memcpy(&bytes[12], &order, sizeof order);
    Walk walk(bytes);
    walk.skip(8);
    walk.value<uint32_t>();
    walk.value<uint32_t>();
    if (!part) {
        const FilmStream::Header header = headerOf(walk);
        pixels(walk, header.aovs, std::max(0, header.width), std::max(0, header.height));
        walk.seal(false);
        return;
    }
    walk.text();
    const uint32_t count = walk.value<uint32_t>();
    std::vector<Tile> tiles;
    while (tiles.size() < count && walk.good())
        tiles.push_back(walk.value<Tile>());
    walk.seal(true);
    while (walk.good() && walk.value<uint32_t>() != 0) {
        const FilmStream::Header header = headerOf(walk);
        std::vector<uint32_t> written;
        for (uint32_t left = walk.value<uint32_t>(); left > 0 && walk.good(); --left)
            written.push_back(walk.value<uint32_t>());
        for (const uint32_t index : written) {
            if (index >= tiles.size()) return; // its reader ends here
            const Tile& tile = tiles[index];
            pixels(walk, header.aovs,
                   std::clamp(int64_t(tile.x1) - tile.x0, int64_t(0), int64_t(tileSize)),
                   std::clamp(int64_t(tile.y1) - tile.y0, int64_t(0), int64_t(tileSize)));
        }
    }
    walk.text();
    walk.seal(false);
}

} // namespace patina
