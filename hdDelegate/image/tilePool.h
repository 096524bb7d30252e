// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace patina {

/// Where a tile lies.
struct TilePlace {
    uint64_t texture; ///< a number that no other texture of the process has had
    int level, column, row;
    bool operator==(const TilePlace& o) const {
        return texture == o.texture && level == o.level && column == o.column && row == o.row;
    }
};

/// Tiles of texels of many textures, as many as a number of bytes holds. Tiles are made when they
/// are asked for; those that were asked for least lately make room, the cheap ones first. Thread
/// safe; a tile that a thread uses stays.
class TilePool {
public:
    explicit TilePool(size_t capacity);
    ~TilePool();

    /// Fills a tile. Runs once for all threads that wait for it; may itself find() tiles, of finer
    /// levels alone, before it asks for room.
    class Maker {
    public:
        virtual ~Maker() = default;
        /// @param room gives memory for texels; @throws std::bad_alloc
        /// @returns false where there are none to be had: the tile stays empty
        virtual bool make(const TilePlace& place,
                          const std::function<void*(size_t bytes)>& room) const = 0;
        /// How often a tile is spared when room is made, 1 to 15: by the time it takes to make.
        virtual int worth(const TilePlace& place) const = 0;
    };

    /// @returns the texels, which stay until the same thread's next call; null: there are none
    const void* find(const TilePlace& place, const Maker& maker);

    /// Makes room at once where it is less than before.
    void setCapacity(size_t bytes);

    size_t bytes() const { return _bytes; }
    size_t peakBytes() const { return _peak; }
    uint64_t tilesMade() const { return _made; }

private:
    struct Tile;
    struct Shard;
    struct ThreadTiles;

    ThreadTiles& threadTiles();
    Tile* take(const TilePlace& place, const Maker& maker);
    void fill(Tile& tile, const Maker& maker);
    static void release(Tile* tile);
    void reserve(size_t bytes);
    bool evictOne();
    bool evictFrom(Shard& shard);

    const uint64_t _number; ///< of this pool, never that of another
    std::atomic<size_t> _capacity, _bytes{0}, _peak{0};
    std::atomic<size_t> _slots{1}; ///< tiles that a thread keeps in use, a power of two
    std::atomic<uint64_t> _made{0};
    std::atomic<size_t> _nextShard{0};
    std::vector<Shard> _shards;
    std::mutex _threadsMutex;
    std::map<std::thread::id, std::unique_ptr<ThreadTiles>> _threads;
};

} // namespace patina
