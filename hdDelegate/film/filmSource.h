// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/aovTable.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>

namespace patina {

/// How somebody wants the pixels of an AOV: rows without gaps.
struct PixelForm {
    enum class Type { Half, Float, Int };
    Type type = Type::Float;
    int components = 1;         ///< 1 to 4; a colour's fourth is alpha
    bool bottomFirst = false;   ///< order of the rows
    glm::vec4 background{0.0f}; ///< seen through what a colour does not cover
    float nothing = 0.0f;       ///< value of pixels that show nothing; for ids the bits of an int
    bool depth = false;         ///< in a texture of depths; one float
};

/// An image of one AOV on a host's device. It does not change any more.
class DeviceImage {
public:
    virtual ~DeviceImage() = default;
    /// Copies it into a texture of its size and form, by commands of the host's context, which is
    /// current on this thread. @returns false where the driver refuses
    virtual bool copyTo(uint64_t texture) = 0;
    /// Waits for the device. On any thread.
    /// @param bytes room for all pixels
    /// @returns false where the device fails
    virtual bool read(void* bytes) = 0;
};

/// The image that a film would hold, where a device keeps it. Asked on the render thread alone,
/// while a listener hears of the film.
class FilmSource {
public:
    virtual ~FilmSource() = default;
    /// Whether it has an AOV; the film has the others.
    virtual bool has(AovId aov) const = 0;
    /// @param bytes room for all pixels
    /// @returns false, and leaves the bytes as they are, for forms that it cannot give
    /// @throws std::runtime_error where the device fails
    virtual bool read(AovId aov, const PixelForm& form, void* bytes) const = 0;
    /// @returns null for forms that it cannot give, and where it knows no device of the host
    /// @throws std::runtime_error where the device fails
    virtual std::shared_ptr<DeviceImage> draw(AovId, const PixelForm&) const { return nullptr; }
};

} // namespace patina
