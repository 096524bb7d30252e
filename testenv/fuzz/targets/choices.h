// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace patina {

/// Decisions read from bytes: the same bytes decide the same in every build. After their end all
/// are 0.
class Choices {
public:
    Choices(const uint8_t* data, size_t size) : _at(data), _end(data + size) {}

    uint8_t byte() { return _at < _end ? *_at++ : uint8_t(0); }
    bool flag() { return (byte() & 1) != 0; }
    uint32_t bits() {
        uint32_t all = 0;
        for (int i = 0; i < 4; ++i)
            all = all << 8 | byte();
        return all;
    }
    /// @param count 1 to 65536
    int below(int count) {
        const int low = byte();
        return count <= 256 ? low % count : (low | byte() << 8) % count;
    }
    std::string text(int longest) {
        std::string s;
        for (int left = below(longest + 1); left > 0 && _at < _end; --left)
            s += char(byte());
        return s;
    }

private:
    const uint8_t *_at, *_end;
};

} // namespace patina
