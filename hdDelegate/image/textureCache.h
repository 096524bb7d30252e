// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/mipAverage.h"
#include "hdDelegate/image/texelFormat.h"

#include <OpenImageIO/imagecache.h>

#include <memory>
#include <shared_mutex>
#include <string>

namespace patina {

/// Parts of image files, read by OpenImageIO's ImageCache: it keeps files open and what it has
/// read, within a number of bytes. Thread safe.
class TextureCache {
public:
    /// @param bytes OpenImageIO takes ten million at least
    explicit TextureCache(size_t bytes);
    ~TextureCache();
    TextureCache(const TextureCache&) = delete;
    TextureCache& operator=(const TextureCache&) = delete;

    void setCapacity(size_t bytes);

    /// Texels as the file stores them, without padding.
    /// @param block in the file's own coordinates
    /// @param channels the first so many
    /// @returns false with a reason in one line where they cannot be read
    bool read(const std::string& file, int level, const TexelBlock& block, int channels,
              TexelType type, void* texels, std::string& error);

    size_t bytes() const; ///< of what it holds

private:
    std::shared_ptr<OIIO::ImageCache> _cache;
    std::shared_mutex _reading; ///< alone while a file is forgotten
};

} // namespace patina
