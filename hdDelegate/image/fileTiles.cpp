// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/fileTiles.h"

#include "hdDelegate/image/textureFile.h"

#include <algorithm>
#include <cstring>

namespace patina {

namespace {

std::atomic<uint64_t> textureNumbers{0};

} // namespace

FileTiles::FileTiles(const ImageSource& source, const TextureFile& file,
                     const TexelConversion& conversion, std::shared_ptr<TileStore> store,
                     Diagnostics& diagnostics)
    : _source(source), _conversion(conversion), _average(conversion.format()),
      _levels(mipLevels(file.spec.width, file.spec.height)), _origins(file.origins),
      _store(std::move(store)), _diagnostics(diagnostics), _number(++textureNumbers) {}

TexelBlock FileTiles::blockOf(int level, int column, int row) const {
    const MipLevel& size = _levels[size_t(level)];
    const int x = column * side, y = row * side;
    return {x, y, std::min(x + side, size.width), std::min(y + side, size.height)};
}

TexelTiles::Tile FileTiles::tile(int level, int column, int row) const {
    const int left = _levels[size_t(level)].width - column * side;
    return {_store->tiles.find({_number, level, column, row}, *this), std::min(left, int(side))};
}

int FileTiles::worth(const TilePlace& place) const {
    return 1 + 2 * std::max(0, place.level - int(_origins.size()) + 1);
}

bool FileTiles::make(const TilePlace& place, const std::function<void*(size_t bytes)>& room) const {
    const TexelBlock block = blockOf(place.level, place.column, place.row);
    const size_t texelBytes = _conversion.format().texelBytes();
    const size_t bytes = size_t(block.width()) * size_t(block.height()) * texelBytes;
    if (place.level < int(_origins.size())) return readTile(place.level, block, room(bytes));
    const MipLevel &from = _levels[size_t(place.level) - 1], &to = _levels[size_t(place.level)];
    const TexelBlock held = MipAverage::sources(from, to, block);
    const std::unique_ptr<uint8_t[]> source(
        new uint8_t[size_t(held.width()) * size_t(held.height()) * texelBytes]);
    if (!copyFiner(place.level - 1, held, source.get())) return false;
    _average.make(from, to, source.get(), held, room(bytes), block);
    return true;
}

bool FileTiles::readTile(int level, const TexelBlock& block, void* texels) const {
    const TexelFormat file(_conversion.format().layout, _conversion.fileType());
    const size_t width = size_t(block.width()), fileRow = width * file.texelBytes();
    const size_t row = width * _conversion.format().texelBytes();
    std::unique_ptr<uint8_t[]> buffer;
    uint8_t *read = static_cast<uint8_t*>(texels), *to = read;
    if (_conversion.format().type != _conversion.fileType()) {
        buffer.reset(new uint8_t[fileRow * size_t(block.height())]);
        read = buffer.get();
    }
    const std::array<int, 2> origin = _origins[size_t(level)];
    const TexelBlock inFile{block.x0 + origin[0], block.y0 + origin[1], block.x1 + origin[0],
                            block.y1 + origin[1]};
    std::string error;
    if (!_store->read.read(_source.file, level, inFile, channelCount(file.layout), file.type, read,
                           error)) {
        if (!_toldUnreadable.exchange(true))
            _diagnostics.warn(_source.prim, _source.input,
                              messages::textureTilesUnreadable(_source.file, error));
        return false;
    }
    if (_conversion.isAsRead()) return true;
    size_t bad = 0;
    for (size_t y = 0; y < size_t(block.height()); ++y)
        bad += _conversion.row(read + y * fileRow, to + y * row, block.width());
    if (bad && !_toldBad.exchange(true))
        _diagnostics.warn(_source.prim, _source.input, messages::someTexelsNotFinite(_source.file));
    return true;
}

bool FileTiles::copyFiner(int level, const TexelBlock& block, uint8_t* texels) const {
    const size_t texelBytes = _conversion.format().texelBytes();
    for (int row = block.y0 / side; row * side < block.y1; ++row)
        for (int column = block.x0 / side; column * side < block.x1; ++column) {
            const Tile from = tile(level, column, row);
            if (!from.texels) return false;
            const TexelBlock all = blockOf(level, column, row);
            const int x0 = std::max(all.x0, block.x0), x1 = std::min(all.x1, block.x1);
            const int y0 = std::max(all.y0, block.y0), y1 = std::min(all.y1, block.y1);
            for (int y = y0; y < y1; ++y)
                std::memcpy(texels + (size_t(y - block.y0) * size_t(block.width()) +
                                      size_t(x0 - block.x0)) *
                                         texelBytes,
                            static_cast<const uint8_t*>(from.texels) +
                                (size_t(y - all.y0) * size_t(from.width) + size_t(x0 - all.x0)) *
                                    texelBytes,
                            size_t(x1 - x0) * texelBytes);
        }
    return true;
}

} // namespace patina
