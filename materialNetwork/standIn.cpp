// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/material.h"

#include "base/maths.h"
#include "materialNetwork/planner/planProbes.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int side = 4;       ///< places in a row of the unit square of texture coordinates
constexpr int directions = 8; ///< drawn at each place

/// Has texture coordinates and no other primvars.
class UvPrimvars : public PrimvarReader {
public:
    explicit UvPrimvars(const MaterialProgram& program) : _primvars(program.primvars()) {}
    bool read(int slot, float out[4]) const override {
        if (_primvars[size_t(slot)].type != ValueType::Vec2) return false;
        out[0] = uv.x;
        out[1] = uv.y;
        return true;
    }
    glm::vec2 uv{0.0f};

private:
    const std::vector<MaterialPrimvar>& _primvars;
};

/// What a surface does with light that comes from straight ahead, as means.
struct Reflectance {
    glm::vec3 diffuse{0.0f}, specular{0.0f}, transmitted{0.0f};
    float alpha = 0.0f; ///< of the specular part, weighted by its luminance
    float presence = 0.0f;
};

bool isLight(const glm::vec3& c) {
    return std::isfinite(c.x + c.y + c.z) && std::min({c.x, c.y, c.z}) >= 0.0f;
}

Reflectance measured(const MaterialProgram& program) {
    Reflectance sum;
    UvPrimvars primvars(program);
    float glossy = 0.0f;
    constexpr int all = side * side * directions;
    const int count = program.constant() && program.isOpaque() ? 1 : side * side;
    for (int i = 0; i < count; ++i) {
        ShadingPoint point;
        primvars.uv = (glm::vec2(float(i % side), float(i / side)) + 0.5f) / float(side);
        point.primvars = &primvars;
        point.uvFootprint = 1.0f / float(side);
        sum.presence += program.opacity(point) / float(count);
        Bsdf bsdf;
        program.evaluate(point, bsdf);
        const int first = i * (all / count), last = first + all / count;
        for (int j = first; j < last; ++j) {
            const BsdfSample s =
                bsdf.sample({spread(j, 0), spread(j, 1), spread(j, 2)}, spread(j, 3));
            if (s.event == 0 || !isLight(s.weight)) continue;
            const glm::vec3 light = s.weight / float(all);
            if (s.diffuse || program.isFibre()) {
                sum.diffuse += light;
            } else if ((s.event & sh::LOBE_TRANSMIT) != 0) {
                sum.transmitted += light;
            } else {
                sum.specular += light;
                sum.alpha += luminance(light) * s.roughness;
                glossy += luminance(light);
            }
        }
    }
    sum.alpha = glossy > 0.0f ? sum.alpha / glossy : 1.0f;
    return sum;
}

} // namespace

bool hasStandIn(const MaterialProgram& program) {
    const auto& primvars = program.primvars();
    return !program.isVolumeOnly() &&
           std::all_of(primvars.begin(), primvars.end(), [](const MaterialPrimvar& primvar) {
               return primvar.type == ValueType::Vec2 || !setOfTangents(primvar.name).empty();
           });
}

Network makeStandInNetwork(const MaterialProgram& program) {
    const Reflectance seen = measured(program);
    // Values keep away from 0 and 1, where the text would be another.
    const auto inside = [](float x, float least) {
        return std::clamp(std::isfinite(x) ? x : 0.5f, least, 1.0f - least);
    };
    // With the colour c and a share q that is no metal, UsdPreviewSurface reflects (1 - q) c + q f0
    // and scatters q c (1 - f0). By luminances this is a quadratic equation for q.
    constexpr float mostOfPlastic = 0.05f;
    const glm::vec3 scattered = seen.diffuse + seen.transmitted;
    const float s = luminance(seen.specular);
    const float f0 = std::clamp(s, 1e-4f, mostOfPlastic);
    const float x = luminance(scattered) / (1.0f - f0);
    const float root = std::sqrt(std::max((x + s) * (x + s) - 4.0f * f0 * x, 0.0f));
    const float q = s > f0 ? 2.0f * x / (x + s + root) : 1.0f;
    const glm::vec3 color =
        scattered / (1.0f - f0) + glm::max(seen.specular - q * f0, glm::vec3(0.0f));
    const float clear = luminance(seen.transmitted) / std::max(x + s, 1e-6f);

    NetworkNode surface;
    surface.path = "/standIn/surface";
    surface.id = "UsdPreviewSurface";
    surface.inputs["diffuseColor"] =
        Value::makeColor3(inside(color.x, 1e-4f), inside(color.y, 1e-4f), inside(color.z, 1e-4f));
    surface.inputs["metallic"] = Value::makeFloat(inside(1.0f - q, 1e-4f));
    surface.inputs["roughness"] = Value::makeFloat(inside(std::sqrt(seen.alpha), 0.03f));
    surface.inputs["ior"] = Value::makeFloat((1.0f + std::sqrt(f0)) / (1.0f - std::sqrt(f0)));
    if (!program.isOpaque() || program.hasTransmission()) {
        surface.inputs["opacityMode"] = Value::makeString("presence");
        surface.inputs["opacity"] =
            Value::makeFloat(inside(seen.presence * (1.0f - 0.5f * clear), 1e-4f));
    }
    Network network;
    network.path = "/standIn";
    network.nodes = {surface};
    network.terminals["surface"] = {surface.path, "surface"};
    return network;
}

} // namespace patina
