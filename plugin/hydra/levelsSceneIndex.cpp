// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/levelsSceneIndex.h"

#if PATINA_HAS_LEVELS

#include "hdDelegate/hydra/instancerTransforms.h"
#include "plugin/hydra/overlays.h"

#include <pxr/base/gf/camera.h>
#include <pxr/imaging/hd/cameraSchema.h>
#include <pxr/imaging/hd/instancedBySchema.h>
#include <pxr/imaging/hd/instancerTopologySchema.h>
#include <pxr/imaging/hd/sceneGlobalsSchema.h>
#include <pxr/imaging/hd/sceneIndexPrimView.h>
#include <pxr/imaging/hd/tokens.h>
#include <pxr/imaging/hd/xformSchema.h>

#include <algorithm>
#include <limits>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

constexpr int maxNesting = 16; // of instancers

/// UsdImaging's name for the root of native instances' prototype.
const TfToken& prototypeName() {
    static const TfToken name("UsdNiPrototype");
    return name;
}

GfMatrix4d matrixOf(const HdSceneIndexPrim& prim) {
    return HdPatinaValueOf(HdXformSchema::GetFromParent(prim.dataSource).GetMatrix(),
                           GfMatrix4d(1.0));
}

GfFrustum frustumOf(const HdSceneIndexPrim& prim) {
    const HdCameraSchema camera = HdCameraSchema::GetFromParent(prim.dataSource);
    GfCamera out;
    if (!camera) return out.GetFrustum();
    // Hydra's lengths are those of the scene, GfCamera's are tenths of them.
    const auto length = [](const HdFloatDataSourceHandle& source, float fallback, double unit) {
        return source ? float(source->GetTypedValue(0.0f) / unit) : fallback;
    };
    out.SetTransform(matrixOf(prim));
    if (HdPatinaValueOf(camera.GetProjection(), TfToken()) == HdCameraSchemaTokens->orthographic)
        out.SetProjection(GfCamera::Orthographic);
    const double aperture = GfCamera::APERTURE_UNIT;
    out.SetHorizontalAperture(
        length(camera.GetHorizontalAperture(), out.GetHorizontalAperture(), aperture));
    out.SetVerticalAperture(
        length(camera.GetVerticalAperture(), out.GetVerticalAperture(), aperture));
    out.SetHorizontalApertureOffset(length(camera.GetHorizontalApertureOffset(), 0.0f, aperture));
    out.SetVerticalApertureOffset(length(camera.GetVerticalApertureOffset(), 0.0f, aperture));
    out.SetFocalLength(
        length(camera.GetFocalLength(), out.GetFocalLength(), GfCamera::FOCAL_LENGTH_UNIT));
    const GfVec2f clipping = HdPatinaValueOf(camera.GetClippingRange(), GfVec2f(1.0f, 1e6f));
    out.SetClippingRange(GfRange1f(clipping[0], clipping[1]));
    return out.GetFrustum();
}

} // namespace

HdPatinaLevelsSceneIndex::HdPatinaLevelsSceneIndex(const HdSceneIndexBaseRefPtr& input)
    : HdPatinaFilterSceneIndex(input) {
    readView();
    for (const SdfPath& path : HdSceneIndexPrimView(input))
        if (Root root = read(path); root.levels) _roots[path] = std::move(root);
}

HdSceneIndexPrim HdPatinaLevelsSceneIndex::GetPrim(const SdfPath& path) const {
    HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(path);
    if (_roots.empty() || !prim.dataSource || prim.primType.IsEmpty()) return prim;
    if (prim.primType == HdPrimTypeTokens->instancer)
        HdPatinaMaskInstances(prim, path, [&](const SdfPath& which) { return decided(which); });
    else if (const std::optional<bool> drawn = decided(path))
        HdPatinaShow(prim, *drawn);
    return prim;
}

std::optional<bool> HdPatinaLevelsSceneIndex::decided(const SdfPath& path) const {
    bool shown = false;
    for (SdfPath item = path; item.GetPathElementCount() > 1; item = item.GetParentPath()) {
        const auto found = _roots.find(item.GetParentPath());
        if (found == _roots.end()) continue;
        const HdPatinaLevels& levels = *found->second.levels;
        const auto at = std::find(levels.items.begin(), levels.items.end(), item.GetNameToken());
        if (at == levels.items.end()) continue;
        if (found->second.item && at - levels.items.begin() != *found->second.item) return false;
        const SdfPath& root = found->first;
        if (!levels.invisible.count(item.MakeRelativePath(root))) continue;
        // A level that is chosen is drawn although it is invisible.
        for (SdfPath prim = path; prim != item; prim = prim.GetParentPath())
            if (levels.invisible.count(prim.MakeRelativePath(root))) return false;
        shown = true;
    }
    return shown ? std::optional(true) : std::nullopt;
}

HdPatinaLevelsSceneIndex::Root HdPatinaLevelsSceneIndex::read(const SdfPath& path) const {
    const HdSceneIndexBaseRefPtr& input = _GetInputSceneIndex();
    Root root{HdPatinaLevelsOf(input->GetPrim(path).dataSource), {}};
    const bool native = path.GetNameToken() == prototypeName(); // its instances have its levels
    if (!root.levels && !native) return root;
    const Place place = nearestPlace(path, 0);
    if (native && !place.instance.IsEmpty())
        root.levels = HdPatinaLevelsOf(input->GetPrim(place.instance).dataSource);
    if (root.levels) root.item = root.levels->chosen(_view, place.matrix);
    return root;
}

HdPatinaLevelsSceneIndex::Place HdPatinaLevelsSceneIndex::nearestPlace(const SdfPath& path,
                                                                       int depth) const {
    const HdSceneIndexBaseRefPtr& input = _GetInputSceneIndex();
    const HdSceneIndexPrim prim = input->GetPrim(path);
    const GfMatrix4d own = matrixOf(prim);
    const HdInstancedBySchema by = HdInstancedBySchema::GetFromParent(prim.dataSource);
    const auto instancers = HdPatinaValueOf(by.GetPaths(), VtArray<SdfPath>());
    const auto roots = HdPatinaValueOf(by.GetPrototypeRoots(), VtArray<SdfPath>());
    if (instancers.empty() || depth >= maxNesting) return {own, {}};
    const GfMatrix4d outer = nearestPlace(instancers[0], depth + 1).matrix;

    const HdContainerDataSourceHandle source = input->GetPrim(instancers[0]).dataSource;
    HdInstancerTopologySchema topology = HdInstancerTopologySchema::GetFromParent(source);
    const auto prototypes = HdPatinaValueOf(topology.GetPrototypes(), VtArray<SdfPath>());
    const auto locations = HdPatinaValueOf(topology.GetInstanceLocations(), VtArray<SdfPath>());
    const auto mask = HdPatinaValueOf(topology.GetMask(), VtBoolArray());
    const HdPrimvarsSchema primvars = HdPrimvarsSchema::GetFromParent(source);
    std::vector<std::vector<GfMatrix4d>> parts;
    for (const TfToken& name :
         {HdInstancerTokens->instanceTransforms, HdInstancerTokens->instanceScales,
          HdInstancerTokens->instanceRotations, HdInstancerTokens->instanceTranslations})
        if (const auto value = primvars.GetPrimvar(name).GetPrimvarValue())
            parts.push_back(patina::instanceMatrices(name, value->GetValue(0.0f)));

    Place nearest{own * outer, {}};
    double least = std::numeric_limits<double>::infinity();
    HdIntArrayVectorSchema indices = topology.GetInstanceIndices();
    for (size_t k = 0; k < std::min(prototypes.size(), indices.GetNumElements()); ++k) {
        if (prototypes[k] != (roots.empty() ? path : roots[0])) continue;
        for (const int index : indices.GetElement(k)->GetTypedValue(0.0f)) {
            const size_t i = size_t(index);
            if (index < 0 || (i < mask.size() && !mask[i])) continue;
            GfMatrix4d matrix = own;
            for (const auto& part : parts)
                if (i < part.size()) matrix *= part[i];
            matrix *= outer;
            const double away = (matrix.ExtractTranslation() - _view.GetPosition()).GetLengthSq();
            if (!(away < least)) continue;
            least = away;
            nearest = {matrix, i < locations.size() ? locations[i] : SdfPath()};
        }
    }
    return nearest;
}

void HdPatinaLevelsSceneIndex::readView() {
    const HdSceneIndexBaseRefPtr& input = _GetInputSceneIndex();
    _camera = HdPatinaValueOf(HdSceneGlobalsSchema::GetFromSceneIndex(input).GetPrimaryCameraPrim(),
                              SdfPath());
    _view = frustumOf(_camera.IsEmpty() ? HdSceneIndexPrim() : input->GetPrim(_camera));
}

void HdPatinaLevelsSceneIndex::update(bool all, const SdfPathVector& tops) {
    if (_roots.empty() || (!all && tops.empty())) return;
    static const HdDataSourceLocatorSet locators{HdVisibilitySchema::GetDefaultLocator(),
                                                 HdInstancerTopologySchema::GetDefaultLocator()};
    Dirtied dirtied;
    const auto tellBelow = [&](const SdfPath& top) {
        for (const SdfPath& path : HdSceneIndexPrimView(_GetInputSceneIndex(), top))
            dirtied.emplace_back(path, locators);
    };
    for (auto& [path, root] : _roots) {
        if (!all && std::none_of(tops.begin(), tops.end(),
                                 [&](const SdfPath& top) { return path.HasPrefix(top); }))
            continue;
        Root now = read(path);
        const bool same = now.levels && now.item == root.item &&
                          now.levels->items == root.levels->items &&
                          now.levels->invisible == root.levels->invisible;
        if (now.levels) root = std::move(now);
        if (!same) tellBelow(path);
    }
    if (dirtied.empty()) return;
    static const SdfPath native("/UsdNiPropagatedPrototypes");
    tellBelow(native); // instancers of what stands below the roots
    _SendPrimsDirtied(dirtied);
}

void HdPatinaLevelsSceneIndex::_PrimsAdded(const HdSceneIndexBase&, const Added& entries) {
    bool view = false, instancer = false;
    SdfPathVector tops;
    for (const auto& entry : entries) {
        view |= entry.primPath == _camera || entry.primPath.IsAbsoluteRootPath();
        SdfPath path = entry.primPath;
        if (entry.primType == HdPrimTypeTokens->instancer) {
            instancer = true;
            path = path.AppendChild(prototypeName()); // it may be there without one
        }
        if (Root root = read(path); root.levels) {
            tops.push_back(path);
            _roots[path] = std::move(root);
        }
    }
    _SendPrimsAdded(entries);
    if (view) readView();
    // Instancers come after what they place.
    update(view || instancer, tops);
}

void HdPatinaLevelsSceneIndex::_PrimsRemoved(const HdSceneIndexBase&, const Removed& entries) {
    for (const auto& entry : entries)
        for (auto it = _roots.lower_bound(entry.primPath);
             it != _roots.end() && it->first.HasPrefix(entry.primPath);)
            it = _roots.erase(it);
    _SendPrimsRemoved(entries);
}

void HdPatinaLevelsSceneIndex::_PrimsDirtied(const HdSceneIndexBase&, const Dirtied& entries) {
    _SendPrimsDirtied(entries);
    if (_roots.empty()) return;
    bool all = false;
    SdfPathVector tops;
    const HdSceneIndexBaseRefPtr& input = _GetInputSceneIndex();
    for (const auto& [path, locators] : entries) {
        const bool moved = locators.Intersects(HdXformSchema::GetDefaultLocator());
        if (locators.Intersects(HdSceneGlobalsSchema::GetPrimaryCameraPrimLocator()) ||
            (path == _camera &&
             (moved || locators.Intersects(HdCameraSchema::GetDefaultLocator())))) {
            all = true;
        } else if (moved || locators.Intersects(HdPatinaLevelsLocator()) ||
                   locators.Intersects(HdPatinaLevelsOverrideLocator())) {
            if (input->GetPrim(path).primType == HdPrimTypeTokens->instancer)
                all = true;
            else if (locators.Intersects(HdPatinaLevelsOverrideLocator()) || _roots.count(path))
                tops.push_back(path);
        } else if (locators.Intersects(HdInstancerTopologySchema::GetDefaultLocator()) ||
                   locators.Intersects(HdPrimvarsSchema::GetDefaultLocator())) {
            all |= input->GetPrim(path).primType == HdPrimTypeTokens->instancer;
        }
    }
    if (all) readView();
    update(all, tops);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
