// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/tilePool.h"

#include <algorithm>
#include <new>

namespace patina {

namespace {

constexpr size_t shardCount = 64, largestSlots = 256;
constexpr int largestWorth = 15;
/// Of a tile besides its texels: itself, and its places in the shard's tables.
constexpr size_t overhead = 160;
/// What a thread's tiles are counted with when their number is chosen.
constexpr size_t typicalTile = size_t(32) << 10;

struct PlaceHash {
    size_t operator()(const TilePlace& p) const {
        uint64_t h = p.texture * 0x9e3779b97f4a7c15ull;
        h ^= (uint64_t(uint32_t(p.column)) << 32 | uint32_t(p.row)) + uint64_t(p.level) * 0x51ull;
        h *= 0xbf58476d1ce4e5b9ull;
        h ^= h >> 29;
        h *= 0x94d049bb133111ebull;
        return size_t(h ^ (h >> 32));
    }
};

/// Neighbours, two levels, and a few textures beside each other keep out of each other's slots.
size_t slotOf(const TilePlace& p) {
    return size_t(p.column & 1) | size_t(p.row & 1) << 1 | size_t(p.level & 1) << 2 |
           size_t(p.texture & 3) << 3 | size_t(p.column >> 1 & 1) << 5 |
           size_t(p.row >> 1 & 1) << 6 | size_t(p.level >> 1 & 1) << 7;
}

std::atomic<uint64_t> poolNumbers{0};

} // namespace

struct TilePool::Tile {
    TilePlace place;
    std::atomic<int> users{0}; ///< raised under the shard's lock only
    std::atomic<int> spared{0};
    int worth = 0;
    bool ready = false; ///< under the shard's lock
    size_t bytes = 0;
    std::unique_ptr<uint8_t[]> texels;
    Shard* shard = nullptr;

    explicit Tile(const TilePlace& p) : place(p) {}
};

struct TilePool::Shard {
    std::mutex mutex;
    std::condition_variable made;
    std::unordered_map<TilePlace, std::unique_ptr<Tile>, PlaceHash> tiles;
    std::vector<Tile*> ring; ///< of those that are ready
    size_t hand = 0;
};

/// Tiles that one thread holds, so that it finds them again without a lock.
struct TilePool::ThreadTiles {
    std::vector<Tile*> slots;
};

TilePool::TilePool(size_t capacity) : _number(++poolNumbers), _shards(shardCount) {
    setCapacity(capacity);
}

TilePool::~TilePool() = default;

TilePool::ThreadTiles& TilePool::threadTiles() {
    // A pool's number is checked before the pointer is used: it may be that of a former pool.
    thread_local uint64_t number = 0;
    thread_local ThreadTiles* tiles = nullptr;
    if (number != _number) {
        const std::lock_guard<std::mutex> lock(_threadsMutex);
        std::unique_ptr<ThreadTiles>& mine = _threads[std::this_thread::get_id()];
        if (!mine) mine = std::make_unique<ThreadTiles>();
        tiles = mine.get();
        number = _number;
    }
    return *tiles;
}

const void* TilePool::find(const TilePlace& place, const Maker& maker) {
    ThreadTiles& mine = threadTiles();
    const size_t known = mine.slots.size();
    if (known) {
        const Tile* tile = mine.slots[slotOf(place) & (known - 1)];
        if (tile && tile->place == place) return tile->texels.get();
    }
    Tile* tile = take(place, maker);
    const size_t slots = _slots.load(std::memory_order_relaxed);
    if (mine.slots.size() != slots) {
        for (Tile* old : mine.slots)
            release(old);
        mine.slots.assign(slots, nullptr);
    }
    Tile*& slot = mine.slots[slotOf(place) & (slots - 1)];
    release(slot);
    slot = tile;
    return tile->texels.get();
}

void TilePool::release(Tile* tile) {
    if (!tile) return;
    tile->spared.store(0, std::memory_order_relaxed);
    tile->users.fetch_sub(1, std::memory_order_release); // it may be gone now
}

TilePool::Tile* TilePool::take(const TilePlace& place, const Maker& maker) {
    Shard& shard = _shards[PlaceHash()(place) % shardCount];
    std::unique_lock<std::mutex> lock(shard.mutex);
    std::unique_ptr<Tile>& entry = shard.tiles[place];
    if (entry) {
        Tile* tile = entry.get();
        ++tile->users;
        tile->spared = 0;
        shard.made.wait(lock, [&] { return tile->ready; });
        return tile;
    }
    Tile* tile = (entry = std::make_unique<Tile>(place)).get();
    ++tile->users;
    lock.unlock();
    fill(*tile, maker);
    lock.lock();
    tile->ready = true;
    shard.ring.push_back(tile);
    shard.made.notify_all();
    return tile;
}

void TilePool::fill(Tile& tile, const Maker& maker) {
    tile.worth = std::clamp(maker.worth(tile.place), 1, largestWorth);
    bool made = false;
    try {
        made = maker.make(tile.place, [&](size_t bytes) -> void* {
            tile.bytes = bytes + overhead;
            reserve(tile.bytes);
            tile.texels.reset(new uint8_t[bytes]);
            return tile.texels.get();
        });
    } catch (...) { // no memory; others would wait for ever
        made = false;
    }
    if (!made) tile.texels.reset();
    if (tile.bytes == 0) reserve(tile.bytes = overhead);
    ++_made;
}

void TilePool::reserve(size_t bytes) {
    for (size_t now = _bytes;;) {
        if (now + bytes > _capacity && evictOne()) {
            now = _bytes;
            continue;
        }
        // Where all is in use there is no other way than beyond the capacity.
        if (!_bytes.compare_exchange_weak(now, now + bytes)) continue;
        for (size_t peak = _peak; peak < now + bytes;)
            if (_peak.compare_exchange_weak(peak, now + bytes)) break;
        return;
    }
}

/// @returns false where every tile is in use
bool TilePool::evictOne() {
    for (int round = 0; round <= largestWorth + 1; ++round)
        for (size_t i = 0; i < shardCount; ++i)
            if (evictFrom(_shards[_nextShard++ % shardCount])) return true;
    return false;
}

/// Goes round once at most, as a clock's hand: a tile that was spared as often as it is worth goes.
bool TilePool::evictFrom(Shard& shard) {
    const std::lock_guard<std::mutex> lock(shard.mutex);
    for (size_t i = shard.ring.size(); i > 0; --i) {
        if (shard.hand >= shard.ring.size()) shard.hand = 0;
        Tile* tile = shard.ring[shard.hand];
        if (tile->users.load(std::memory_order_acquire) > 0 || tile->spared++ < tile->worth) {
            ++shard.hand;
            continue;
        }
        _bytes -= tile->bytes;
        shard.ring[shard.hand] = shard.ring.back();
        shard.ring.pop_back();
        const TilePlace place = tile->place;
        shard.tiles.erase(place);
        return true;
    }
    return false;
}

void TilePool::setCapacity(size_t bytes) {
    _capacity = bytes;
    // All threads together hold an eighth of it at most.
    const size_t threads = std::max(1u, std::thread::hardware_concurrency());
    const size_t each = bytes / 8 / threads / typicalTile;
    size_t slots = 1;
    while (slots * 2 <= std::min(each, largestSlots))
        slots *= 2;
    _slots = slots;
    while (_bytes > _capacity && evictOne()) {
    }
}

} // namespace patina
