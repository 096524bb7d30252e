// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/filmSource.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/gl/hostContext.h"

#include <mutex>

namespace patina {

/// How the pixels of a texture come into memory.
struct PixelTransfer {
    PixelTransfer(GLenum textureFormat, int components);
    GLenum format, type;
    size_t size; ///< bytes of a pixel
};

/// A texture that a render thread has drawn, for a host whose objects its context shares. The
/// commands of both wait for each other on the device, and no thread does.
class HostImage final : public DeviceImage {
public:
    /// With a context current that shares the host's objects.
    HostImage(std::shared_ptr<HostContext> host, GLenum format, int components, int width,
              int height);
    ~HostImage() override;

    bool isOf(GLenum format, int components) const {
        return format == _format && components == _components;
    }
    const GlTexture& texture() const { return _texture; }
    void waitForReaders(); ///< before it is drawn again; nobody has it then
    void setDrawn();       ///< after the commands that draw it

    bool copyTo(uint64_t texture) override;
    bool read(void* bytes) override;

private:
    std::shared_ptr<HostContext> _host;
    GLenum _format;
    int _components;
    GlTexture _texture;
    std::mutex _mutex;
    GLsync _drawn = nullptr, _read = nullptr; ///< after the last commands of either kind
    uint64_t _copiedTo = 0;
};

} // namespace patina
