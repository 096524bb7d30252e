// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTexture.h"
#include "hdDelegate/image/imageTextureLoad.h"
#include "hdDelegate/image/mipAverage.h"
#include "hdDelegate/image/texelConversion.h"
#include "hdDelegate/image/textureCache.h"
#include "hdDelegate/image/tilePool.h"

#include <array>
#include <atomic>

namespace patina {

struct TextureFile;

/// Where textures that are not whole in memory have their tiles.
struct TileStore {
    TilePool tiles;    ///< converted texels, of all levels
    TextureCache read; ///< texels as files have them
    TileStore(size_t poolBytes, size_t cacheBytes) : tiles(poolBytes), read(cacheBytes) {}
};

/// The tiles of a texture's file. Levels that the file has are converted as when it is read whole;
/// further ones are made from the finer level's tiles.
class FileTiles : public TexelTiles, private TilePool::Maker {
public:
    FileTiles(const ImageSource& source, const TextureFile& file, const TexelConversion& conversion,
              std::shared_ptr<TileStore> store, Diagnostics& diagnostics);

    Tile tile(int level, int column, int row) const override;

private:
    bool make(const TilePlace& place,
              const std::function<void*(size_t bytes)>& room) const override;
    int worth(const TilePlace& place) const override;
    TexelBlock blockOf(int level, int column, int row) const;
    bool readTile(int level, const TexelBlock& block, void* texels) const;
    bool copyFiner(int level, const TexelBlock& block, uint8_t* texels) const;

    const ImageSource _source;
    const TexelConversion _conversion;
    const MipAverage _average;
    const std::vector<MipLevel> _levels;
    const std::vector<std::array<int, 2>> _origins; ///< of the file's own levels
    const std::shared_ptr<TileStore> _store;
    Diagnostics& _diagnostics;
    const uint64_t _number;
    mutable std::atomic<bool> _toldUnreadable{false}, _toldBad{false};
};

} // namespace patina
