// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/primvars.h"

#include "hdDelegate/hydra/computations.h"
#include "hdDelegate/hydra/sampling.h"
#include "hdDelegate/hydra/sourceForms.h"
#include "hdDelegate/hydra/values.h"
#include "materialNetwork/color/colorSpaces.h"
#include "materialNetwork/material.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/primvarsSchema.h>
#include <pxr/imaging/hd/sceneIndex.h>
#include <pxr/imaging/hd/tokens.h>
#include <pxr/usd/sdf/assetPath.h>

#include <algorithm>
#include <set>

namespace patina {

namespace {

Interpolation interpolationOf(HdInterpolation interpolation) {
    switch (interpolation) {
    case HdInterpolationUniform: return Interpolation::Uniform;
    case HdInterpolationVarying: return Interpolation::Varying;
    case HdInterpolationVertex: return Interpolation::Vertex;
    case HdInterpolationFaceVarying: return Interpolation::FaceVarying;
    default: return Interpolation::Constant;
    }
}

constexpr HdInterpolation interpolations[] = {HdInterpolationConstant, HdInterpolationUniform,
                                              HdInterpolationVarying, HdInterpolationVertex,
                                              HdInterpolationFaceVarying};

void erase(Geometry& prim, const std::string& name) {
    auto& list = prim.primvars;
    list.erase(
        std::remove_if(list.begin(), list.end(), [&](const Primvar& p) { return p.name == name; }),
        list.end());
}

/// Empty where the host tells none.
std::string colorSpaceOf(HdSceneDelegate& delegate, const SdfPath& id,
                         const HdPrimvarDescriptor& primvar) {
#if PATINA_HAS_PRIMVAR_COLOR_SPACES
    const HdSceneIndexBaseRefPtr scene = delegate.GetRenderIndex().GetTerminalSceneIndex();
    if (scene && primvar.role == HdPrimvarRoleTokens->color) {
        HdPrimvarsSchema primvars = HdPrimvarsSchema::GetFromParent(scene->GetPrim(id).dataSource);
        if (const HdTokenDataSourceHandle space = primvars.GetPrimvar(primvar.name).GetColorSpace())
            return space->GetTypedValue(0.0f).GetString();
    }
#else
    (void)delegate, (void)id, (void)primvar;
#endif
    return {};
}

/// @param descriptor of what is authored; null for what was computed
void setPrimvar(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                const TfToken& name, HdInterpolation interpolation, const VtValue& value,
                const VtIntArray& indices, const HdPrimvarDescriptor* descriptor, Geometry& prim) {
    Primvar primvar;
    primvar.name = name.GetString();
    primvar.interpolation = interpolationOf(interpolation);
    primvar.values = floatsOf(value, primvar.components);
    if (primvar.components == 0 || primvar.components > 16) {
        warnOfType(param, id, primvar.name, value);
        erase(prim, primvar.name);
        return;
    }
    if (descriptor) toRenderingSpace(delegate, param, id, *descriptor, primvar);
    primvar.indices = toVector(indices);
    const int count = int(primvar.values.size()) / primvar.components;
    for (int& index : primvar.indices)
        if (index < 0 || index >= count) {
            param.warn(id, "primvars:" + primvar.name + ":indices", messages::firstValueUsed);
            index = 0;
        }
    replacePrimvar(prim, std::move(primvar));
}

template <unsigned int CAPACITY>
Sampled<std::vector<vec3>> pointsFrom(const HdTimeSampleArray<VtValue, CAPACITY>& samples,
                                      HdPatinaRenderParam& param, const SdfPath& id) {
    std::vector<float> times;
    std::vector<std::vector<vec3>> values;
    for (size_t i = 0; i < samples.count; ++i) {
        std::vector<vec3> points;
        if (!pointsOf(samples.values[i], points)) {
            if (!samples.values[i].IsEmpty())
                param.warn(id, "points", messages::pointsOfType(samples.values[i].GetTypeName()));
            continue;
        }
        times.push_back(samples.times[i]);
        values.push_back(std::move(points));
    }
    goOn(param, times, values);
    return inOrder(std::move(times), std::move(values), param, id, "points");
}

constexpr char lightGroup[] = "lightGroup"; // a label in light path expressions

std::string labelOf(const VtValue& value, HdPatinaRenderParam& param, const SdfPath& id) {
    std::string text = textOf(value);
    if (value.IsHolding<VtStringArray>() && value.UncheckedGet<VtStringArray>().size() == 1)
        text = value.UncheckedGet<VtStringArray>()[0];
    if (value.IsHolding<VtTokenArray>() && value.UncheckedGet<VtTokenArray>().size() == 1)
        text = value.UncheckedGet<VtTokenArray>()[0].GetString();
    const bool isText = value.IsHolding<std::string>() || value.IsHolding<TfToken>() ||
                        !text.empty() || value.IsEmpty();
    if (!isText) param.warn(id, "primvars:lightGroup", messages::notString);
    return text;
}

bool isLeftOut(const std::string& name, GeometryKind kind) {
    return (kind == GeometryKind::Splats && isSplatPrimvar(name)) ||
           TfStringStartsWith(name, "skel:") || TfStringStartsWith(name, sourcePrefix) ||
           name == "pointWeights" || name == "points" || name == "velocities" ||
           name == "accelerations";
}

/// Whether a primvar is there already.
bool has(const Geometry& prim, const std::string& name) {
    return std::any_of(prim.primvars.begin(), prim.primvars.end(),
                       [&](const Primvar& primvar) { return primvar.name == name; });
}

bool isText(const VtValue& value) {
    return value.IsHolding<std::string>() || value.IsHolding<TfToken>() ||
           value.IsHolding<SdfAssetPath>() || value.IsHolding<VtStringArray>() ||
           value.IsHolding<VtTokenArray>() || value.IsHolding<VtArray<SdfAssetPath>>();
}

} // namespace

void replacePrimvar(Geometry& prim, Primvar primvar) {
    auto& list = prim.primvars;
    const auto place =
        std::lower_bound(list.begin(), list.end(), primvar,
                         [](const Primvar& a, const Primvar& b) { return a.name < b.name; });
    if (place != list.end() && place->name == primvar.name)
        *place = std::move(primvar);
    else
        list.insert(place, std::move(primvar));
}

bool isSplatPrimvar(const std::string& name) {
    return name == "positions" || name == "orientations" || name == "scales" ||
           name == "opacities" || TfStringStartsWith(name, "radiance:");
}

void warnOfType(HdPatinaRenderParam& param, const SdfPath& id, const std::string& primvar,
                const VtValue& value) {
    if (value.IsEmpty() || isText(value) || (value.IsArrayValued() && value.GetArraySize() == 0))
        return;
    param.warn(id, "primvars:" + primvar, messages::typeWithoutNumbers(value.GetTypeName()));
}

void toRenderingSpace(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                      const HdPrimvarDescriptor& descriptor, Primvar& primvar) {
    if (primvar.components != 3 && primvar.components != 4) return;
    const std::string space = colorSpaceOf(delegate, id, descriptor);
    if (space.empty() && descriptor.role != HdPrimvarRoleTokens->color) return;
    if (!ColorSpaces::shared().valueToRendering(
            space, param.renderingSpace(), primvar.values.data(),
            primvar.values.size() / size_t(primvar.components), primvar.components))
        param.warn(id, "primvars:" + primvar.name, messages::valuesSpaceUnknown(space));
}

PrimvarUpdate updatePrimvars(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                             const SdfPath& id, HdDirtyBits dirtyBits, bool all, Geometry& prim) {
    PrimvarUpdate update;
    std::set<std::string> listed, named;
    const bool areNamed = param.dirtiedPrimvars().take(id, named) && !all;
    HdExtComputationPrimvarDescriptorVector computed;
    for (const HdInterpolation interpolation : interpolations) {
        for (const auto& descriptor :
             delegate.GetExtComputationPrimvarDescriptors(id, interpolation)) {
            listed.insert(descriptor.name.GetString());
            if (all || HdChangeTracker::IsPrimvarDirty(dirtyBits, id, descriptor.name) ||
                (dirtyBits & HdChangeTracker::DirtyComputationPrimvarDesc))
                computed.push_back(descriptor);
        }
    }
    const std::set<std::string> fromComputations = listed;
    for (const HdInterpolation interpolation : interpolations)
        for (const auto& descriptor : delegate.GetPrimvarDescriptors(id, interpolation)) {
            const TfToken& name = descriptor.name;
            if (fromComputations.count(name.GetString())) continue;
            listed.insert(name.GetString());
            if (!all && !HdChangeTracker::IsPrimvarDirty(dirtyBits, id, name)) continue;
            if (areNamed && !named.count(name.GetString()) && has(prim, name.GetString())) continue;
            if (name == HdTokens->points) {
                ValueSamples samples;
                samplePrimvar(delegate, param, id, name, samples);
                update.points = pointsFrom(samples, param, id);
                update.pointsChanged = true;
            } else if (name == lightGroup) {
                prim.lightGroup = labelOf(delegate.Get(id, name), param, id);
            } else if (!isLeftOut(name.GetString(), prim.kind)) {
                VtIntArray indices;
                const VtValue value = descriptor.indexed
                                          ? delegate.GetIndexedPrimvar(id, name, &indices)
                                          : delegate.Get(id, name);
                setPrimvar(delegate, param, id, name, interpolation, value, indices, &descriptor,
                           prim);
            }
        }
    if (!computed.empty()) {
        ComputedValues values = computedValues(computed, delegate, param);
        for (const auto& descriptor : computed) {
            ValueSamples& samples = values[descriptor.name];
            if (samples.count == 0) {
                param.warn(id, descriptor.name.GetString(), messages::computationFails);
                samplePrimvar(delegate, param, id, descriptor.name, samples);
            }
            if (descriptor.name == HdTokens->points) {
                update.points = pointsFrom(samples, param, id);
                update.pointsChanged = true;
            } else {
                setPrimvar(delegate, param, id, descriptor.name, descriptor.interpolation,
                           samples.count > 0 ? samples.values[0] : VtValue(), VtIntArray(), nullptr,
                           prim);
            }
        }
    }
    update.pointsListed = listed.count(HdTokens->points.GetString()) != 0;
    if (!listed.count(lightGroup)) prim.lightGroup.clear();
    prim.primvars.erase(std::remove_if(prim.primvars.begin(), prim.primvars.end(),
                                       [&](const Primvar& p) {
                                           return !listed.count(p.name) &&
                                                  spaceOfPrimvar(p.name).empty();
                                       }),
                        prim.primvars.end());
    return update;
}

} // namespace patina
