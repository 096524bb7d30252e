// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/tilePool.h"

#include "base/tests/testTools.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <random>

namespace patina {

namespace {

constexpr size_t tileBytes = 4096;
constexpr int tileWords = int(tileBytes / sizeof(uint64_t));

uint64_t stampOf(const TilePlace& p) {
    return p.texture * 1000003 + uint64_t(p.level) * 65537 + uint64_t(p.row) * 257 +
           uint64_t(p.column);
}

/// Fills tiles with a stamp of their place; each level looks at a tile of the finer one.
struct Stamps : TilePool::Maker {
    explicit Stamps(TilePool& of) : pool(of) {}
    TilePool& pool;
    mutable std::atomic<int> made{0}, wrong{0};

    bool make(const TilePlace& p, const std::function<void*(size_t bytes)>& room) const override {
        ++made;
        if (p.level > 0 && !holds({p.texture, p.level - 1, p.column * 2, p.row * 2})) ++wrong;
        auto* words = static_cast<uint64_t*>(room(tileBytes));
        std::fill(words, words + tileWords, stampOf(p));
        return true;
    }
    int worth(const TilePlace& p) const override { return 1 + 2 * p.level; }
    bool holds(const TilePlace& p) const {
        const auto* words = static_cast<const uint64_t*>(pool.find(p, *this));
        return words && std::all_of(words, words + tileWords,
                                    [&](uint64_t word) { return word == stampOf(p); });
    }
};

} // namespace

TEST(TilePool, ThreadsFindTheirTilesWhileRoomIsMade) {
    constexpr size_t capacity = 64 * (tileBytes + 200);
    TilePool pool(capacity);
    const Stamps stamps(pool);
    std::atomic<int> wrong{0};
    onThreads(8, [&](int t) {
        std::mt19937 random{unsigned(t)};
        for (int i = 0; i < 4000; ++i)
            wrong += !stamps.holds(
                {random() % 5, int(random() % 4), int(random() % 8), int(random() % 8)});
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(stamps.wrong, 0);
    EXPECT_LE(pool.peakBytes(), capacity);
    EXPECT_GT(pool.peakBytes(), capacity / 2);
    EXPECT_GT(pool.tilesMade(), 5u * 256u) << "more than there are places: some were made again";
}

TEST(TilePool, ATileIsMadeOnceForAllThatWait) {
    struct Slow : Stamps {
        using Stamps::Stamps;
        bool make(const TilePlace& p,
                  const std::function<void*(size_t bytes)>& room) const override {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            return Stamps::make(p, room);
        }
    };
    TilePool pool(size_t(1) << 22);
    const Slow slow(pool);
    std::atomic<int> wrong{0};
    onThreads(8, [&](int) { wrong += !slow.holds({1, 0, 0, 0}); });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(slow.made, 1);
}

TEST(TilePool, LessCapacityMakesRoomAtOnce) {
    TilePool pool(size_t(1) << 22);
    const Stamps stamps(pool);
    for (int i = 0; i < 500; ++i)
        EXPECT_TRUE(stamps.holds({1, 0, i, 0}));
    EXPECT_GT(pool.bytes(), 500 * tileBytes);
    pool.setCapacity(200 * tileBytes);
    EXPECT_LE(pool.bytes(), 200 * tileBytes);
    for (int i = 0; i < 500; ++i)
        EXPECT_TRUE(stamps.holds({1, 0, i, 0}));
    EXPECT_LE(pool.bytes(), 200 * tileBytes);
}

TEST(TilePool, CostlyTilesStayLonger) {
    TilePool pool(100 * (tileBytes + 200));
    const Stamps stamps(pool);
    EXPECT_TRUE(stamps.holds({1, 3, 0, 0}));
    for (int i = 0; i < 200; ++i)
        EXPECT_TRUE(stamps.holds({2, 0, i, 0}));
    const int made = stamps.made;
    EXPECT_TRUE(stamps.holds({1, 3, 0, 0}));
    EXPECT_EQ(stamps.made, made) << "of the seven that a level of three is spared";
    EXPECT_TRUE(stamps.holds({2, 0, 0, 0}));
    EXPECT_EQ(stamps.made, made + 1);
}

TEST(TilePool, WhatCannotBeMadeIsEmpty) {
    struct Failing : TilePool::Maker {
        bool make(const TilePlace& p,
                  const std::function<void*(size_t bytes)>& room) const override {
            if (p.column == 0) return false;
            if (p.column == 1) throw std::bad_alloc();
            if (p.column == 2) throw std::runtime_error("no");
            return room(100) && p.column != 3;
        }
        int worth(const TilePlace&) const override { return 1; }
    } failing;
    TilePool pool(1 << 20);
    for (int column = 0; column < 4; ++column)
        for (int again = 0; again < 2; ++again)
            EXPECT_EQ(pool.find({1, 0, column, 0}, failing), nullptr);
    EXPECT_EQ(pool.tilesMade(), 4u);
    EXPECT_NE(pool.find({1, 0, 4, 0}, failing), nullptr);
}

TEST(TilePool, AThreadKnowsOnePoolFromTheNextInItsPlace) {
    std::optional<TilePool> pool;
    for (int i = 0; i < 3; ++i) {
        pool.emplace(size_t(1) << 20);
        const Stamps stamps(*pool);
        EXPECT_TRUE(stamps.holds({1, 1, 0, 0}));
        EXPECT_EQ(stamps.made, 2);
    }
}

} // namespace patina
