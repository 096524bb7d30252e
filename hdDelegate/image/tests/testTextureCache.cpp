// SPDX-License-Identifier: Apache-2.0
// Parts of files by OpenImageIO's cache, one cache after another.
#include "hdDelegate/image/tests/imageFixtures.h"
#include "hdDelegate/image/textureCache.h"

#include <atomic>

namespace patina {

namespace {

constexpr int side = 256, tile = 64;

/// A tiled file whose texels tell where they are.
void writeTiles(const std::string& file) {
    OIIO::ImageSpec spec(side, side, 1, OIIO::TypeUInt16);
    spec.tile_width = spec.tile_height = tile;
    std::vector<float> texels;
    for (int i = 0; i < side * side; ++i)
        texels.push_back(float(i) / 65535.0f);
    writeImage(file, spec, texels);
}

/// @returns whether all blocks have the texels that were written
bool readsAll(TextureCache& cache, const std::string& file) {
    for (int y = 0; y < side; y += tile)
        for (int x = 0; x < side; x += tile) {
            uint16_t texels[tile * tile];
            std::string error;
            if (!cache.read(file, 0, {x, y, x + tile, y + tile}, 1, TexelType::U16, texels, error))
                return false;
            for (int i = 0; i < tile * tile; ++i)
                if (texels[i] != uint16_t((y + i / tile) * side + x + i % tile)) return false;
        }
    return true;
}

} // namespace

TEST(TextureCache, OneAfterAnotherServesTheSameThreads) {
    constexpr int rounds = 40;
    TempFolder folder;
    const std::string file = folder.file("texture.tif");
    writeTiles(file);
    std::atomic<TextureCache*> cache{nullptr};
    std::atomic<int> round{0}, done{0}, wrong{0};
    // Threads that outlive each cache, as those of a pool do.
    std::vector<std::thread> threads;
    for (int t = 0; t < 2; ++t)
        threads.emplace_back([&] {
            for (int r = 1; r <= rounds; ++r) {
                while (round != r)
                    std::this_thread::yield();
                if (!readsAll(*cache, file)) ++wrong;
                ++done;
            }
        });
    for (int r = 1; r <= rounds; ++r) {
        TextureCache own(10 << 20);
        EXPECT_LT(own.bytes(), size_t(side * side * 2)); // it begins empty
        cache = &own;
        round = r;
        while (done != 2 * r)
            std::this_thread::yield();
        EXPECT_GT(own.bytes(), 0u);
    }
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(wrong, 0);
}

TEST(TextureCache, AFileThatChangesBetweenCachesIsReadAnew) {
    TempFolder folder;
    const std::string file = folder.file("texture.tif");
    for (const bool whole : {false, true, false}) {
        if (whole)
            writeTiles(file);
        else
            std::filesystem::remove(file);
        TextureCache cache(10 << 20);
        EXPECT_EQ(readsAll(cache, file), whole);
    }
}

} // namespace patina
