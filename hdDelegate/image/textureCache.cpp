// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/textureCache.h"

#include "hdDelegate/image/textureFile.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace patina {

namespace {

/// Caches that no TextureCache has now. None is ever destroyed: a thread finds what it keeps of a
/// cache by the cache's address, and keeps it when another thread destroys the cache. A new one at
/// that address would get tiles that are gone.
class IdleCaches {
public:
    std::shared_ptr<OIIO::ImageCache> take() {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (_caches.empty()) return make();
        auto cache = std::move(_caches.back());
        _caches.pop_back();
        return cache;
    }

    void give(std::shared_ptr<OIIO::ImageCache> cache) {
        cache->invalidate_all(true);
        const std::lock_guard<std::mutex> lock(_mutex);
        _caches.push_back(std::move(cache));
    }

private:
    static std::shared_ptr<OIIO::ImageCache> make() {
#if OIIO_VERSION_MAJOR >= 3
        return OIIO::ImageCache::create(false);
#else
        return {OIIO::ImageCache::create(false), [](OIIO::ImageCache*) {}};
#endif
    }

    std::mutex _mutex;
    std::vector<std::shared_ptr<OIIO::ImageCache>> _caches;
};

IdleCaches& idleCaches() {
    static IdleCaches& caches = *new IdleCaches; // outlives every thread
    return caches;
}

} // namespace

TextureCache::TextureCache(size_t bytes) : _cache(idleCaches().take()) {
    _cache->attribute("autotile", 64); // files without tiles are read by strips of so many rows
    _cache->attribute("automip", 0);
    _cache->attribute("forcefloat", 0);
    _cache->attribute("unassociatedalpha", 1);
    setCapacity(bytes);
}

TextureCache::~TextureCache() {
    idleCaches().give(std::move(_cache));
}

void TextureCache::setCapacity(size_t bytes) {
    _cache->attribute("max_memory_MB", float(double(bytes) / (1 << 20)));
}

bool TextureCache::read(const std::string& file, int level, const TexelBlock& block, int channels,
                        TexelType type, void* texels, std::string& error) {
    {
        const std::shared_lock<std::shared_mutex> lock(_reading);
        _cache->geterror(); // of this thread, of before
        const bool read =
            _cache->get_pixels(OIIO::ustring(file), 0, level, block.x0, block.x1, block.y0,
                               block.y1, 0, 1, 0, channels, typeOf(type), texels);
        error = oneLine(_cache->geterror());
        if (read && error.empty()) return true;
    }
    if (error.empty()) error = "it cannot be read";
    // ImageCache keeps a tile that it could not read, and gives it as a good one the next time. It
    // forgets what it knows of a file without asking who reads it.
    const std::unique_lock<std::shared_mutex> lock(_reading);
    _cache->invalidate(OIIO::ustring(file));
    return false;
}

size_t TextureCache::bytes() const {
    OIIO::imagesize_t bytes = 0;
    _cache->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
    return size_t(bytes);
}

} // namespace patina
