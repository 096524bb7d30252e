// SPDX-License-Identifier: Apache-2.0
#include "base/exrClaims.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include <sys/stat.h>
#include <unistd.h>

namespace patina {

namespace {

constexpr uint64_t packing = 4096;                 ///< values for each byte of a file, at most
constexpr uint64_t fewValues = uint64_t(1) << 20;  ///< that any file may claim for a row
constexpr uint64_t fewInATile = uint64_t(1) << 24; ///< and for a tile
constexpr int mostAttributes = 10000;              ///< that are looked at
constexpr uint32_t longestList = 1 << 20;          ///< bytes of a list of channels

/// Of these OpenEXR reads so many bytes, whatever size a header says: what follows would lie
/// elsewhere than it seems.
constexpr std::pair<const char*, uint32_t> fixedSizes[] = {{"box2f", 16},
                                                           {"box2i", 16},
                                                           {"chromaticities", 32},
                                                           {"compression", 1},
                                                           {"deepImageState", 1},
                                                           {"double", 8},
                                                           {"envmap", 1},
                                                           {"float", 4},
                                                           {"int", 4},
                                                           {"keycode", 28},
                                                           {"lineOrder", 1},
                                                           {"m33d", 72},
                                                           {"m33f", 36},
                                                           {"m44d", 128},
                                                           {"m44f", 64},
                                                           {"rational", 8},
                                                           {"tiledesc", 9},
                                                           {"timecode", 8},
                                                           {"v2d", 16},
                                                           {"v2f", 8},
                                                           {"v2i", 8},
                                                           {"v3d", 24},
                                                           {"v3f", 12},
                                                           {"v3i", 12}};

/// @returns how many channels a list holds; 0 where it does not end with its bytes
uint64_t channelsOf(const std::string& list) {
    constexpr size_t each = 16; // behind a name and its zero
    uint64_t count = 0;
    for (size_t at = 0; at < list.size(); ++count) {
        const size_t end = list.find('\0', at);
        if (end == at) return end + 1 == list.size() ? count + !count : 0;
        if (end == std::string::npos) return 0;
        at = end + 1 + each;
    }
    return 0;
}

/// Looks through the header of a file.
class Claims {
public:
    Claims(int file, uint64_t size) : _file(file), _size(size) {}

    bool areMore(bool manyParts) {
        bool wasEnd = !manyParts; // of many parts an empty header is the end
        uint64_t at = 8;
        for (int i = 0; i < mostAttributes; ++i) {
            const std::string entry = read(at, 516); // two names and a size, at most
            if (entry.empty() || (!entry[0] && wasEnd)) break;
            wasEnd = !entry[0] || !manyParts;
            if (!entry[0]) {
                if (isMore()) return true;
                _channels = _width = 1;
                _tileTexels = 0;
                ++at;
                continue;
            }
            const size_t middle = entry.find('\0');
            const size_t last = entry.find('\0', std::min(middle, entry.size() - 1) + 1);
            if (last == std::string::npos || entry.size() - last < 5) break; // its reader says so
            uint32_t size;
            std::memcpy(&size, &entry[last + 1], sizeof size);
            at += last + 5;
            if (size > _size - std::min(at, _size)) return true;
            if (!add(entry.c_str(), entry.c_str() + middle + 1, at, size)) return true;
            at += size;
        }
        return isMore();
    }

private:
    bool isMore() const {
        const uint64_t all = _size > UINT64_MAX / packing ? UINT64_MAX : _size * packing;
        if (_tileTexels > 0) return _tileTexels > std::max(fewInATile, all) / _channels;
        return _width > std::max(fewValues, all) / _channels;
    }

    std::string read(uint64_t at, size_t size) const {
        std::string bytes(size, '\0');
        const ssize_t got = ::pread(_file, &bytes[0], size, off_t(at));
        bytes.resize(size_t(std::max<ssize_t>(got, 0)));
        return bytes;
    }

    /// @returns false where an attribute is of another size than it says
    bool add(const char* name, const std::string& type, uint64_t at, uint32_t size) {
        for (const auto& fixed : fixedSizes)
            if (type == fixed.first && size != fixed.second) return false;
        uint32_t value[4] = {};
        const std::string begin = read(at, std::min<size_t>(size, sizeof value));
        std::memcpy(value, begin.data(), begin.size());
        const uint64_t product = uint64_t(value[0]) * value[1];
        if (type == "preview") return size >= 8 && product == (size - 8) / 4;
        if (type == "tiledesc") _tileTexels = std::max(_tileTexels, product);
        if (std::strcmp(name, "dataWindow") == 0)
            _width = std::max(_width, uint64_t(value[2] - value[0]) + 1);
        if (type != "chlist") return true;
        const uint64_t channels = size <= longestList ? channelsOf(read(at, size)) : 0;
        _channels = std::max(_channels, channels);
        return channels > 0;
    }

    const int _file;
    const uint64_t _size;
    uint64_t _channels = 1, _width = 1, _tileTexels = 0; ///< of a part; no tile: it has rows
};

} // namespace

bool exrClaimsMore(int file) {
    struct stat found;
    unsigned char start[8];
    if (::fstat(file, &found) != 0 || ::pread(file, start, sizeof start, 0) != sizeof start ||
        std::memcmp(start, "\x76\x2f\x31\x01", 4) != 0)
        return false;
    return Claims(file, uint64_t(found.st_size)).areMore(start[5] & 0x10);
}

} // namespace patina
