// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTextureLoad.h"
#include "hdDelegate/image/textureMemory.h"

#include <tbb/concurrent_vector.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>

namespace patina {

/// The textures of a scene. A file is looked at when it is opened and read when it is first
/// sampled (or by loadAll()); materials that ask for the same share it.
class TextureSystem : public TextureSource {
public:
    explicit TextureSystem(Diagnostics& diagnostics,
                           const ColorSpaces& colorSpaces = ColorSpaces::shared());
    ~TextureSystem() override;

    int open(const TextureRequest& request) override;
    bool valid(int handle) const override;
    /// Magenta for what cannot be read, and for the missing tiles of a UDIM texture. Within UDIM
    /// tiles the wrap modes are without meaning: filters stop at the edge of a tile.
    glm::vec4 sample(int handle, glm::vec2 uv, float footprint) const override;
    int channels(int handle) const override;
    TextureTiling tiling(int handle) const override;
    std::shared_ptr<const EmissionProfile> openProfile(const TextureRequest& request) override;

    /// How much memory textures take, for those that are read from now on (TextureMemory).
    /// @param bytes 0: half of the machine's
    void setMemory(uint64_t bytes);

    /// The space of colours, for textures that are opened from now on.
    void setRenderingSpace(const RenderingSpace& space) { _renderingSpace = &space; }

    /// For who looks at few places: filters get no width, for textures that are opened from now on.
    void sampleFinestOnly() { _finestOnly = true; }

    /// Reads what was opened and not yet read, with all threads.
    void loadAll() const;
    /// All texels of a handle, for back ends with samplers of their own; null for a missing one.
    /// Where they are not kept in memory they are read anew, and stay for as long as they are held.
    /// @param tile UDIM number; of a plain texture any
    std::shared_ptr<const ImageTexture> image(int handle, int tile = 1001) const;
    /// The request that a handle was opened with.
    const TextureRequest& request(int handle) const;
    size_t memoryBytes() const; ///< of the texels in memory
    const TextureMemory& memory() const { return _memory; }

private:
    struct Image;
    struct Entry;
    std::shared_ptr<Image> shareImage(const ImageSource& source);
    void openTiles(Entry& entry);
    const Image* tileAt(const Entry& entry, glm::vec2& uv) const;

    Diagnostics& _diagnostics;
    const ColorSpaces& _colorSpaces;
    mutable TextureMemory _memory;
    std::mutex _mutex; ///< of open()
    std::map<std::string, int> _handles;
    std::map<std::string, std::shared_ptr<Image>> _images;
    std::map<std::string, std::shared_ptr<const EmissionProfile>> _profiles;
    tbb::concurrent_vector<std::unique_ptr<Entry>> _entries; ///< grows while others read
    std::atomic<int> _count{0};                              ///< entries that are complete
    bool _finestOnly = false;
    std::atomic<const RenderingSpace*> _renderingSpace{&RenderingSpace::rec709()};
};

} // namespace patina
