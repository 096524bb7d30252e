// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/fileTiles.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace patina {

/// How much memory the textures of a scene take, and which of them are whole in it. While all that
/// are opened fit into three quarters of it, they are; others are read by tiles, in the rest.
/// Thread safe.
class TextureMemory {
public:
    TextureMemory();

    /// @param bytes 0: half of the machine's memory
    void setBytes(uint64_t bytes);
    /// Whether a number was asked for: then a texture may be larger than what is read whole.
    bool isSet() const;

    void opened(uint64_t bytes);
    /// Whether a texture of so many bytes is to be whole; if so it is counted.
    bool takeWhole(uint64_t bytes);
    /// What a texture that was counted takes in truth; 0: nothing, it could not be read.
    void correctWhole(uint64_t counted, uint64_t bytes);

    std::shared_ptr<TileStore> store();

    struct Counts {
        size_t whole = 0;     ///< bytes of textures that are whole
        size_t tiles = 0;     ///< bytes of tiles
        size_t tilesPeak = 0; ///< the most that they were
        size_t capacity = 0;  ///< the most that they may be; 0: no texture is read by tiles
        size_t read = 0;      ///< bytes that OpenImageIO keeps
        uint64_t tilesMade = 0;
    };
    Counts counts() const;
    /// Adds them to the statistics of a render, under names that begin with "texture".
    void addStatistics(std::map<std::string, double>& statistics) const;

private:
    uint64_t tileBytes() const;
    uint64_t readBytes() const;
    void resize();

    mutable std::mutex _mutex;
    bool _set = false;
    uint64_t _bytes, _opened = 0, _whole = 0;
    std::shared_ptr<TileStore> _store;
};

} // namespace patina
