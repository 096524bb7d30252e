// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/hostTextures.h"
#include "hdDelegate/hydra/imageForm.h"

#include <pxr/imaging/hd/renderBuffer.h>

#include <atomic>
#include <mutex>
#include <vector>

namespace patina {

/// Pixels that a host reads. Row 0 is the bottom row. Only the render pass writes, on the host's
/// thread, so that no renderer ever holds a buffer that goes away.
class HdPatinaRenderBuffer final : public HdRenderBuffer {
public:
    HdPatinaRenderBuffer(const SdfPath& id, std::shared_ptr<HdPatinaHostTextures> textures);
    ~HdPatinaRenderBuffer() override;

    /// The buffer that a host names; null where it is of another renderer or was destroyed.
    /// Bindings may be older than the buffers that they point to.
    static HdPatinaRenderBuffer* known(const HdRenderBuffer* buffer);

    /// Lets go of the images that buffers of a delegate have on the host's device.
    static void leaveDevice(const HdPatinaHostTextures& textures);

    /// Zero sizes are allowed. @returns false, with a warning, for depths other than 1, for sizes
    /// that no film has or that there is no memory for, and for formats that cannot be written; the
    /// buffer is empty then.
    bool Allocate(const GfVec3i& dimensions, HdFormat format, bool multiSampled) override;

    unsigned int GetWidth() const override { return _width; }
    unsigned int GetHeight() const override { return _height; }
    unsigned int GetDepth() const override { return 1; }
    HdFormat GetFormat() const override { return _format; }
    bool IsMultiSampled() const override { return false; }

    /// Brings the pixels into memory, where they are on the host's device.
    void* Map() override;
    /// Ends the oldest map. Pixels that were allocated anew while they were mapped stay until no
    /// map is left.
    void Unmap() override;
    bool IsMapped() const override { return _mappers > 0; }
    /// Copies an image on the host's device into a texture of the host's, which its tasks may draw
    /// over.
    void Resolve() override;
    /// That texture; empty where the pixels are in memory.
    VtValue GetResource(bool multiSampled) const override;
    bool IsConverged() const override { return _converged; }
    void setConverged(bool converged) { _converged = converged; }

    /// Shows an image, and gives back the one before. Images of another size, which
    /// were made before a host allocated anew, are left alone, and so are those that are empty.
    /// @returns false, and does nothing, while a host has the pixels mapped
    bool take(HdPatinaPixels& image);
    /// Whether an image may come without a way through memory: the host can show it, or nobody has
    /// looked at the last ones.
    bool staysOnDevice() const;
    /// Fills every pixel with an AOV's clear value, unless a host has them mapped.
    void clear(const VtValue& value);

    /// Another number after each Allocate, different from that of every other buffer: what was
    /// written before is gone.
    unsigned int allocation() const { return _allocation; }

private:
    void _Deallocate() override;
    void forgetImage();

    std::atomic<unsigned int> _width{0}, _height{0};
    HdFormat _format = HdFormatInvalid;
    std::shared_ptr<HdPatinaHostTextures> _textures;
    std::vector<uint8_t> _bytes;
    std::shared_ptr<DeviceImage> _image; ///< on the host's device, or null
    int _mappedInRow = 0;              ///< images on the device that were mapped, one after another
    bool _isDepth = false;             ///< the image, in a texture of depths
    bool _bytesAreOld = false;         ///< of an image before that on the device
    HgiTextureHandle _resource;        ///< of the last Resolve()
    std::vector<uint8_t> _mappedBytes; ///< of before, and perhaps read by a host still
    int _mappersBefore = 0;            ///< maps of these that were not ended
    mutable std::mutex _mutex;
    std::atomic<int> _mappers{0};
    std::atomic<bool> _converged{false};
    std::atomic<unsigned int> _allocation{0};
};

} // namespace patina
