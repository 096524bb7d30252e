// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/textureCache.h"

#include "hdDelegate/image/textureFile.h"

#include <algorithm>

namespace patina {

namespace {

std::shared_ptr<OIIO::ImageCache> ownCache() {
#if OIIO_VERSION_MAJOR >= 3
    return OIIO::ImageCache::create(false);
#else
    return {OIIO::ImageCache::create(false),
            [](OIIO::ImageCache* c) { OIIO::ImageCache::destroy(c); }};
#endif
}

} // namespace

TextureCache::TextureCache(size_t bytes) : _cache(ownCache()) {
    _cache->attribute("autotile", 64); // files without tiles are read by strips of so many rows
    _cache->attribute("automip", 0);
    _cache->attribute("forcefloat", 0);
    _cache->attribute("unassociatedalpha", 1);
    setCapacity(bytes);
}

TextureCache::~TextureCache() = default;

void TextureCache::setCapacity(size_t bytes) {
    _cache->attribute("max_memory_MB", float(double(bytes) / (1 << 20)));
}

bool TextureCache::read(const std::string& file, int level, const TexelBlock& block, int channels,
                        TexelType type, void* texels, std::string& error) {
    _cache->geterror(); // of this thread, of before
    const bool read =
        _cache->get_pixels(OIIO::ustring(file), 0, level, block.x0, block.x1, block.y0, block.y1, 0,
                           1, 0, channels, typeOf(type), texels);
    error = oneLine(_cache->geterror());
    if (read && error.empty()) return true;
    if (error.empty()) error = "it cannot be read";
    // ImageCache keeps a tile that it could not read, and gives it as a good one the next time.
    _cache->invalidate(OIIO::ustring(file));
    return false;
}

size_t TextureCache::bytes() const {
    OIIO::imagesize_t bytes = 0;
    _cache->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
    return size_t(bytes);
}

} // namespace patina
