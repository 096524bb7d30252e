// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/implicit.h"

#include "hdDelegate/hydra/sourceForms.h"
#include "hdDelegate/hydra/values.h"

#include <cmath>

namespace patina {

namespace {

ImplicitShape shapeOf(const TfToken& type) {
    if (type == HdPrimTypeTokens->cube) return ImplicitShape::Cube;
    if (type == HdPrimTypeTokens->cone) return ImplicitShape::Cone;
    if (type == HdPrimTypeTokens->cylinder) return ImplicitShape::Cylinder;
    if (type == HdPrimTypeTokens->capsule) return ImplicitShape::Capsule;
    if (type == HdPrimTypeTokens->sphere) return ImplicitShape::Sphere;
    return ImplicitShape::Plane;
}

} // namespace

HdPatinaImplicit::HdPatinaImplicit(const TfToken& type, const SdfPath& id)
    : HdPatinaGprim(id), _type(type) {}

const TfTokenVector& HdPatinaImplicit::GetBuiltinPrimvarNames() const {
    static const TfTokenVector none;
    return none;
}

void HdPatinaImplicit::syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                 HdDirtyBits dirtyBits, bool all, const TfToken&, Implicit& shape) {
    // Sizes arrive as parameters without a dirty bit of their own.
    if (!all && !(dirtyBits & (HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyTopology |
                               HdChangeTracker::DirtyPoints)))
        return;
    const SdfPath& id = GetId();
    shape.shape = shapeOf(_type);
    const Implicit fallback;
    const auto size = [&](const char* name, float initial) {
        double value = initial;
        const VtValue given = sourceOf(delegate, id, name);
        if (!given.IsEmpty() && (!numberOf(given, value) || !std::isfinite(value))) {
            param.warn(id, name, messages::noNumber);
            value = initial;
        }
        return float(value);
    };
    const bool capsule = shape.shape == ImplicitShape::Capsule;
    shape.size = size("size", fallback.size);
    shape.width = size("width", fallback.width);
    shape.length = size("length", fallback.length);
    shape.height = size("height", capsule ? 1.0f : fallback.height);
    shape.radius = size("radius", capsule ? 0.5f : fallback.radius);
    if (!delegate.Get(id, TfToken("radiusTop")).IsEmpty()) {
        shape.radius = size("radiusBottom", shape.radius);
        shape.radiusTop = size("radiusTop", shape.radius);
    }
    const std::string axis = textOf(sourceOf(delegate, id, "axis"));
    shape.axis = axis == "X" ? 0 : axis == "Y" ? 1 : 2;
}

} // namespace patina
