// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/splats.h"

#include "hdDelegate/hydra/values.h"

#include <algorithm>
#include <cstring>

namespace patina {

namespace {

constexpr char degreeName[] = "radiance:sphericalHarmonicsDegree";
constexpr int noDegree = -1;

/// Puts numbers into elements of as many components.
template <class T> void takeNumbers(const VtValue& value, int components,
                                    HdPatinaRenderParam& param, const SdfPath& id,
                                    const TfToken& name, std::vector<T>& out) {
    int found = 0;
    const std::vector<float> numbers = floatsOf(value, found);
    if (found != components) {
        if (!value.IsEmpty() && !(value.IsArrayValued() && value.GetArraySize() == 0))
            param.warn(id, name.GetString(), messages::typeNotRead(value.GetTypeName()));
        return;
    }
    out.resize(numbers.size() / size_t(components));
    std::memcpy(out.data(), numbers.data(), out.size() * sizeof(T));
}

} // namespace

const TfToken& splatsType() {
    static const TfToken type("particleField");
    return type;
}

const TfTokenVector& HdPatinaSplats::GetBuiltinPrimvarNames() const {
    static const TfTokenVector none;
    return none;
}

void HdPatinaSplats::syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                               HdDirtyBits dirtyBits, bool all, const TfToken&, Splats& splats) {
    const SdfPath& id = GetId();
    if (!all && !HdChangeTracker::IsAnyPrimvarDirty(dirtyBits, id) &&
        !(dirtyBits & HdChangeTracker::DirtyMaterialId))
        return;
    SplatCloud cloud;
    for (const HdInterpolation interpolation : {HdInterpolationConstant, HdInterpolationVertex})
        for (const auto& descriptor : delegate.GetPrimvarDescriptors(id, interpolation)) {
            const TfToken& name = descriptor.name;
            if (!isSplatPrimvar(name.GetString())) continue;
            const VtValue value = delegate.Get(id, name);
            double degree = noDegree;
            if (name == degreeName)
                cloud.degree = numberOf(value, degree) && degree >= 0.0 && degree < 1000.0
                                   ? int(degree)
                                   : noDegree;
            else if (name == "positions")
                takeNumbers(value, 3, param, id, name, cloud.positions);
            else if (name == "orientations")
                takeNumbers(value, 4, param, id, name, cloud.orientations);
            else if (name == "scales")
                takeNumbers(value, 3, param, id, name, cloud.scales);
            else if (name == "opacities")
                takeNumbers(value, 1, param, id, name, cloud.opacities);
            else
                takeNumbers(value, 3, param, id, name, cloud.harmonics);
        }
    setCloud(splats, std::move(cloud), param.scene()->diagnostics());
}

} // namespace patina
