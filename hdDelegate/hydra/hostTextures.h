// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/renderer/hostDevice.h"

#include <pxr/imaging/hd/renderDelegate.h>
#include <pxr/imaging/hd/types.h>
#include <pxr/imaging/hgi/hgi.h>
#include <pxr/imaging/hgi/texture.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace patina {

/// A host's Hgi, where that is OpenGL, and the textures of it that hold images of our buffers. Ask
/// for the device and for textures on the thread of the host that draws.
class HdPatinaHostTextures {
public:
    void setDrivers(const HdDriverVector& drivers);
    /// The device of the host's context; null while images go by way of memory.
    /// @param make whether to look for it
    /// @param isCurrent receives whether that context is current on this thread
    std::shared_ptr<HostDevice> device(bool make, bool& isCurrent);

    std::string whyNot() const; ///< images go by way of memory; empty where they do not have to

    /// The form of textures that hold pixels, and HgiFormatInvalid where none does.
    static HgiFormat formatOf(HdFormat format);
    /// The texture of a buffer, made anew where its form is another.
    /// @param depth for a target of depths
    /// @returns an empty one where none can be made now
    HgiTextureHandle of(const void* buffer, unsigned width, unsigned height, HdFormat format,
                        bool depth);
    void forget(const void* buffer);
    void release(); ///< Hgi goes with the host

private:
    void destroy(HgiTextureHandle& texture);

    mutable std::mutex _mutex;
    Hgi* _hgi = nullptr;
    bool _refused = false; ///< the context cannot be shared
    std::string _why = "the host names no Hgi";
    std::shared_ptr<HostDevice> _device;
    std::map<const void*, HgiTextureHandle> _textures;
};

} // namespace patina
