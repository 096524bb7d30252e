// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/backPlateLookSceneIndex.h"

#if PATINA_HAS_BACK_PLATES

#include "base/messages.h"
#include "hdDelegate/film/imageFile.h"
#include "plugin/hydra/overlays.h"

#include <pxr/imaging/hd/cameraSchema.h>
#include <pxr/imaging/hd/materialConnectionSchema.h>
#include <pxr/imaging/hd/materialNodeParameterSchema.h>
#include <pxr/imaging/hd/materialNodeSchema.h>
#include <pxr/imaging/hd/materialSchema.h>
#include <pxr/imaging/hd/sceneGlobalsSchema.h>
#include <pxr/imaging/hd/sceneIndexPrimView.h>
#include <pxr/imaging/hd/tokens.h>

#include <map>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

template <class T> HdDataSourceBaseHandle parameter(const T& value) {
    return HdMaterialNodeParameterSchema::Builder()
        .SetValue(HdRetainedTypedSampledDataSource<VtValue>::New(VtValue(value)))
        .Build();
}

HdDataSourceBaseHandle connection(const char* node, const char* output) {
    HdDataSourceBaseHandle one =
        HdMaterialConnectionSchema::Builder()
            .SetUpstreamNodePath(HdRetainedTypedSampledDataSource<TfToken>::New(TfToken(node)))
            .SetUpstreamNodeOutputName(
                HdRetainedTypedSampledDataSource<TfToken>::New(TfToken(output)))
            .Build();
    return HdRetainedSmallVectorDataSource::New(1, &one);
}

/// Names and what they hold.
using Members = std::map<std::string, HdDataSourceBaseHandle>;

HdContainerDataSourceHandle container(const Members& members) {
    std::vector<TfToken> names;
    std::vector<HdDataSourceBaseHandle> values;
    for (const auto& [name, value] : members) {
        names.emplace_back(name);
        values.push_back(value);
    }
    return HdRetainedContainerDataSource::New(names.size(), names.data(), values.data());
}

HdDataSourceBaseHandle node(const Members& parameters, const Members& inputs,
                            const char* id = nullptr) {
    HdMaterialNodeSchema::Builder builder;
    if (!parameters.empty()) builder.SetParameters(container(parameters));
    if (!inputs.empty()) builder.SetInputConnections(container(inputs));
    if (id) builder.SetNodeIdentifier(HdRetainedTypedSampledDataSource<TfToken>::New(TfToken(id)));
    return builder.Build();
}

void tell(const SdfPath& plate, const char* input, const std::string& text) {
    TF_WARN("%s backPlate:%s:%s: %s", plate.GetParentPath().GetText(), plate.GetName().c_str(),
            input, text.c_str());
}

/// The output of a UsdUVTexture that is the alpha of an image; null: it has none.
const char* alphaOutput(const SdfPath& plate, const std::string& file) {
    try {
        const size_t channels = patina::readImage(file).channels.size();
        if (channels == 1 || channels == 2 || channels == 4)
            return channels == 1 ? "r" : channels == 2 ? "g" : "a";
        tell(plate, "alpha:image", patina::messages::backPlateChannels(channels).text());
    } catch (const std::exception& error) {
        tell(plate, "alpha:image", error.what());
    }
    return nullptr;
}

/// What the material of a plate lacks: UsdPreviewSurface without its reflections, the picture
/// graded as (value (gain - lift) + lift)^(1 / gamma), and the picture of its alpha.
HdContainerDataSourceHandle look(const SdfPath& path, const HdBackPlateSchema& plate) {
    Members nodes;
    Members surface{{"diffuseColor", parameter(GfVec3f(0.0f))},
                    {"useSpecularWorkflow", parameter(1)},
                    {"specularColor", parameter(GfVec3f(0.0f))},
                    {"ior", parameter(1.0f)},
                    {"opacityMode", parameter(TfToken("presence"))}};
    Members inputs;
    const GfVec3f lift = HdPatinaValueOf(plate.GetLumaLift(), GfVec3f(0.0f));
    const GfVec3f scale = HdPatinaValueOf(plate.GetLumaGain(), GfVec3f(1.0f)) - lift;
    GfVec3f gamma = HdPatinaValueOf(plate.GetLumaGamma(), GfVec3f(1.0f));
    nodes["UsdUVTexture"] = node({{"scale", parameter(GfVec4f(scale[0], scale[1], scale[2], 1.0f))},
                                  {"bias", parameter(GfVec4f(lift[0], lift[1], lift[2], 0.0f))}},
                                 {});
    if (!(gamma[0] > 0.0f && gamma[1] > 0.0f && gamma[2] > 0.0f)) {
        tell(path, "luma:gamma", patina::Message(patina::messages::backPlateGamma).text());
        gamma = GfVec3f(1.0f);
    }
    if (gamma != GfVec3f(1.0f)) {
        nodes["graded"] =
            node({{"in2", parameter(GfVec3f(1.0f / gamma[0], 1.0f / gamma[1], 1.0f / gamma[2]))}},
                 {{"in1", connection("UsdUVTexture", "rgb")}}, "ND_power_color3");
        inputs["emissiveColor"] = connection("graded", "out");
    }
    const SdfAssetPath alpha = HdPatinaValueOf(plate.GetAlphaImage(), SdfAssetPath());
    if (!alpha.GetResolvedPath().empty())
        if (const char* output = alphaOutput(path, alpha.GetResolvedPath())) {
            nodes["alpha"] =
                node({{"file", parameter(alpha)},
                      {"wrapS", parameter(TfToken("clamp"))},
                      {"wrapT", parameter(TfToken("clamp"))},
                      {"sourceColorSpace", parameter(TfToken("raw"))}},
                     {{"st", connection("UsdPrimvarReader_float2", "result")}}, "UsdUVTexture");
            inputs["opacity"] = connection("alpha", output);
        }
    if (!HdPatinaValueOf(plate.GetDepthImage(), SdfAssetPath()).GetAssetPath().empty())
        tell(path, "depth:image", patina::Message(patina::messages::backPlateFlat).text());
    nodes["UsdPreviewSurface"] = node(surface, inputs);
    HdDataSourceBaseHandle nested = container(nodes);
    for (const char* name : {"nodes", "", "material"})
        nested = HdRetainedContainerDataSource::New(TfToken(name), nested);
    return HdContainerDataSource::Cast(nested);
}

HdBackPlateSchema plateOf(const HdSceneIndexBaseRefPtr& input, const SdfPath& plate) {
    if (plate.GetPathElementCount() < 2)
        return HdBackPlateSchema(nullptr); // it has no camera above
    const HdSceneIndexPrim camera = input->GetPrim(plate.GetParentPath());
    if (camera.primType != HdPrimTypeTokens->camera) return HdBackPlateSchema(nullptr);
    return HdCameraSchema::GetFromParent(camera.dataSource)
        .GetBackPlate()
        .Get(plate.GetNameToken());
}

} // namespace

bool HdPatinaBackPlateLookSceneIndex::isPart(const SdfPath& path) const {
    const TfToken& name = path.GetNameToken();
    return (name == HdPrimTypeTokens->mesh || name == HdPrimTypeTokens->material) &&
           bool(plateOf(_GetInputSceneIndex(), path.GetParentPath()));
}

bool HdPatinaBackPlateLookSceneIndex::isShown(const SdfPath& mesh) const {
    const SdfPath plate = mesh.GetParentPath();
    const auto visibility = plateOf(_GetInputSceneIndex(), plate).GetPlateVisibility();
    const TfToken shown = visibility ? visibility->GetTypedValue(0.0f) : TfToken("solo");
    if (shown != "solo") return shown == "all";
    const auto camera =
        HdSceneGlobalsSchema::GetFromSceneIndex(_GetInputSceneIndex()).GetPrimaryCameraPrim();
    return camera && camera->GetTypedValue(0.0f) == plate.GetParentPath();
}

HdSceneIndexPrim HdPatinaBackPlateLookSceneIndex::GetPrim(const SdfPath& path) const {
    HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(path);
    if (!prim.dataSource || path.IsAbsoluteRootPath() || !isPart(path)) return prim;
    if (prim.primType == HdPrimTypeTokens->material) {
        prim.dataSource = HdOverlayContainerDataSource::New(
            look(path.GetParentPath(), plateOf(_GetInputSceneIndex(), path.GetParentPath())),
            prim.dataSource);
        return prim;
    }
    if (!isShown(path)) HdPatinaShow(prim, false);
    const HdSampledDataSourceHandle no = HdRetainedTypedSampledDataSource<int>::New(0);
    HdPatinaOverlayPrimvars(prim, {{TfToken("patina:visibility:indirect"), no},
                                   {TfToken("patina:visibility:shadow"), no}});
    return prim;
}

void HdPatinaBackPlateLookSceneIndex::_PrimsDirtied(const HdSceneIndexBase&,
                                                    const Dirtied& entries) {
    Dirtied dirtied = entries;
    for (const auto& entry : entries) {
        const bool camera =
            entry.dirtyLocators.Intersects(HdSceneGlobalsSchema::GetPrimaryCameraPrimLocator());
        const SdfPath& top = entry.primPath; // of the camera, or of all
        if (!camera && !entry.dirtyLocators.Intersects(HdCameraSchema::GetBackPlateLocator()))
            continue;
        for (const SdfPath& path : HdSceneIndexPrimView(_GetInputSceneIndex(), top))
            if (isPart(path))
                dirtied.emplace_back(path, path.GetNameToken() == HdPrimTypeTokens->mesh
                                               ? HdVisibilitySchema::GetDefaultLocator()
                                               : HdMaterialSchema::GetDefaultLocator());
    }
    _SendPrimsDirtied(dirtied);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
