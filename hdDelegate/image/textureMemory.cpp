// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/textureMemory.h"

#include <algorithm>
#include <fstream>
#include <unistd.h>

namespace patina {

namespace {

/// Of the machine, or of the container that the process is in.
uint64_t machineMemory() {
    static const uint64_t bytes = [] {
        const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
        uint64_t most =
            pages > 0 && size > 0 ? uint64_t(pages) * uint64_t(size) : uint64_t(4) << 30;
        uint64_t group = 0; // the file may say "max"
        if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) most = std::min(most, group);
        return most;
    }();
    return bytes;
}

} // namespace

TextureMemory::TextureMemory() : _bytes(machineMemory() / 2) {}

void TextureMemory::setBytes(uint64_t bytes) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _set = bytes > 0;
    const uint64_t before = std::exchange(_bytes, _set ? bytes : machineMemory() / 2);
    if (_bytes != before) resize();
}

bool TextureMemory::isSet() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _set;
}

void TextureMemory::opened(uint64_t bytes) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _opened += std::min(bytes, UINT64_MAX - _opened);
}

bool TextureMemory::takeWhole(uint64_t bytes) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const uint64_t most = _bytes / 4 * 3;
    if (_opened > most || bytes > most || _whole > most - bytes) return false;
    _whole += bytes;
    resize();
    return true;
}

void TextureMemory::correctWhole(uint64_t counted, uint64_t bytes) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _whole = _whole - counted + bytes;
    resize();
}

uint64_t TextureMemory::readBytes() const {
    return (_bytes - std::min(_bytes, _whole)) / 4;
}

uint64_t TextureMemory::tileBytes() const {
    return _bytes - std::min(_bytes, _whole) - readBytes();
}

void TextureMemory::resize() {
    if (!_store) return;
    _store->tiles.setCapacity(tileBytes());
    _store->read.setCapacity(readBytes());
}

std::shared_ptr<TileStore> TextureMemory::store() {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_store) _store = std::make_shared<TileStore>(tileBytes(), readBytes());
    return _store;
}

TextureMemory::Counts TextureMemory::counts() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    Counts counts;
    counts.whole = _whole;
    if (!_store) return counts;
    counts.tiles = _store->tiles.bytes();
    counts.tilesPeak = _store->tiles.peakBytes();
    counts.capacity = tileBytes();
    counts.read = _store->read.bytes();
    counts.tilesMade = _store->tiles.tilesMade();
    return counts;
}

void TextureMemory::addStatistics(std::map<std::string, double>& statistics) const {
    const Counts now = counts();
    statistics["textureBytes"] = double(now.whole + now.tiles + now.read);
    if (now.capacity == 0) return;
    statistics["textureTileBytes"] = double(now.tiles);
    statistics["textureTilePeakBytes"] = double(now.tilesPeak);
    statistics["textureTileCapacity"] = double(now.capacity);
    statistics["textureTilesMade"] = double(now.tilesMade);
}

} // namespace patina
