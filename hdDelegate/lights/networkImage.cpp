// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/networkImage.h"

#include "hdDelegate/image/textureSystem.h"
#include "base/maths.h"
#include "materialNetwork/material.h"

#include <algorithm>

namespace patina {

namespace {

constexpr int leastWidth = 512, largestWidth = 4096;

/// Texture coordinates as every primvar of two floats; there are no others.
class Coordinates : public PrimvarReader {
public:
    explicit Coordinates(const MaterialProgram& program) : _program(program) {}
    bool read(int slot, float out[4]) const override {
        if (_program.primvars()[size_t(slot)].type != ValueType::Vec2) return false;
        out[0] = uv.x;
        out[1] = uv.y;
        return true;
    }
    vec2 uv{0.0f};

private:
    const MaterialProgram& _program;
};

/// Of the largest texture that is read, each texel an odd number of times: then the middles of
/// texels are kept, between which images are linear.
glm::ivec2 sizeOf(const MaterialProgram& program, const TextureSystem& textures, bool dome) {
    glm::ivec2 size(dome ? 2 : 1, 1);
    for (const Instruction& i : program.ir().displacementCode)
        for (const int handle : i.data.textures) {
            const auto image = handle < 0 ? nullptr : textures.image(handle);
            if (image && image->width() > size.x) size = {image->width(), image->height()};
        }
    int times = 1;
    while (size.x * times < leastWidth)
        times += 2;
    return glm::clamp(size * times, glm::ivec2(1), glm::ivec2(largestWidth));
}

} // namespace

ImageRGB networkImage(const Light& light, const ImageRGB* texture, const RenderingSpace& space,
                      Diagnostics& diagnostics) {
    TextureSystem textures(diagnostics);
    textures.setRenderingSpace(space);
    textures.sampleFinestOnly();
    const auto program = compileMaterial(light.network, textures, diagnostics, {}, -1.0, space);
    const bool dome = light.type == LightType::Dome;
    const glm::ivec2 size =
        texture ? glm::ivec2(texture->width, texture->height) : sizeOf(*program, textures, dome);
    ImageRGB image;
    image.width = size.x;
    image.height = size.y;
    image.valid = true;
    Coordinates coordinates(*program);
    ShadingPoint point;
    point.primvars = &coordinates;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const float u = (float(x) + 0.5f) / float(size.x);
            const float v = (float(y) + 0.5f) / float(size.y);
            coordinates.uv = {u, 1.0f - v};
            const float longitude = (0.5f - u) * 2.0f * pi, sine = std::sin(v * pi);
            point.position = dome ? vec3(sine * std::sin(longitude), std::cos(v * pi),
                                         sine * std::cos(longitude))
                                  : vec3((0.5f - u) * light.width, (0.5f - v) * light.height, 0.0f);
            point.objectPosition = point.position;
            point.normal = dome ? point.position : vec3(0.0f, 0.0f, -1.0f);
            point.geometricNormal = point.viewDirection = point.normal;
            const vec3 color = program->displacement(point);
            image.pixels.push_back(texture ? color * texture->pixels[image.pixels.size()] : color);
        }
    return image;
}

} // namespace patina
