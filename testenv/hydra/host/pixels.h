// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/renderBuffer.h>

#include <string>
#include <vector>

PXR_NAMESPACE_USING_DIRECTIVE

namespace patina {

/// The content of a render buffer, as floats. Row 0 is the top row.
struct HostImage {
    int width = 0, height = 0, components = 0;
    std::vector<float> values; ///< integers are kept exactly up to 2^24

    const float* pixel(int x, int y) const {
        return values.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(components);
    }
};

/// Maps a buffer and copies it. Formats are UNorm8, Float16, Float32 and Int32 with one to four
/// components. @throws std::runtime_error for others, and when Map() gives nothing for a buffer
/// with pixels
HostImage readBuffer(HdRenderBuffer& buffer);

/// @param name like "float32vec4", "float16vec4", "unorm8vec4", "int32"
/// @throws std::runtime_error for names that are none
HdFormat formatOf(const std::string& name);

/// A named image of an OpenEXR file.
struct HostLayer {
    std::string aov;
    HostImage image;
};

/// Writes float channels: color as R, G, B, A, others as NAME or NAME.x, NAME.y and so on.
/// All layers have one size. @throws std::runtime_error naming the file
void writeExr(const std::string& path, const std::vector<HostLayer>& layers);

} // namespace patina
