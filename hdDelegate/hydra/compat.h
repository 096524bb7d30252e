// SPDX-License-Identifier: Apache-2.0
#pragma once

// The one place that knows what differs between OpenUSD releases. The oldest one is 23.11.

#include <pxr/pxr.h>

#include <pxr/imaging/hd/version.h>

#if PXR_VERSION < 2311
#error "hdPatina needs OpenUSD 23.11 or later"
#endif

/// HdRenderDelegate::IsParallelSyncEnabled.
#define PATINA_HAS_PARALLEL_SPRIM_SYNC (HD_API_VERSION >= 71)
/// HdRenderSettings::RenderProduct::disableDepthOfField.
#define PATINA_HAS_PRODUCT_DEPTH_OF_FIELD (PXR_VERSION >= 2403)
/// HdRendererPlugin::IsSupported(HdRendererCreateArgs const&, std::string*) is pure.
#define PATINA_HAS_CREATE_ARGS (HD_API_VERSION >= 83)
/// Only the container form of IsSupported is left.
#define PATINA_HAS_CREATE_ARGS_SCHEMA (HD_API_VERSION >= 103)
/// HdRendererPlugin::GetSceneIndexCreateArgs.
#define PATINA_HAS_SCENE_INDEX_CREATE_ARGS (HD_API_VERSION >= 101)
/// HdSceneDelegate::SampleTransform and others take the interval.
#define PATINA_HAS_SAMPLE_INTERVAL (HD_API_VERSION >= 68)
/// HdExtComputationUtils::SampleComputedPrimvarValues takes it too.
#define PATINA_HAS_COMPUTED_INTERVAL (HD_API_VERSION >= 73)
/// Hydra's own scene indices that came later.
#define PATINA_HAS_LIGHT_LINKING __has_include(<pxr/imaging/hdsi/lightLinkingSceneIndex.h>)
#define PATINA_HAS_BACK_PLATES __has_include(<pxr/imaging/hdsi/backPlateSceneIndex.h>)
#define PATINA_HAS_TET_MESHES __has_include(<pxr/imaging/hdsi/tetMeshConversionSceneIndex.h>)
/// HdsiVelocityMotionResolvingSceneIndex knows the stage's time codes per second.
#define PATINA_HAS_VELOCITY_MOTION (PXR_VERSION >= 2508)
/// Scene indices tell a mesh that its subsets changed.
#define PATINA_HAS_SUBSET_NOTICES (PXR_VERSION >= 2411)
/// Scene indices tell the active render pass and the collections of prims.
#define PATINA_HAS_RENDER_PASSES (PXR_VERSION >= 2411)
/// UsdLod, whose levels UsdImaging does not hand on.
#define PATINA_HAS_LEVELS __has_include(<pxr/usd/usdLod/rootAPI.h>)
/// Ndr was merged into Sdr.
#define PATINA_HAS_SDR_ONLY (PXR_VERSION >= 2508)
/// HdsiLegacyDisplayStyleOverrideSceneIndex::SetRefineLevelFallback replaces SetRefineLevel.
#define PATINA_HAS_REFINE_FALLBACK (PXR_VERSION >= 2605)
/// HdxPrimOriginInfo::ComputeInstancerContext.
#define PATINA_HAS_INSTANCER_CONTEXT (PXR_VERSION >= 2408)
/// Scene indices give a texture's sourceColorSpace as the colour space of its file.
#define PATINA_HAS_FILE_COLOR_SPACES (PXR_VERSION >= 2603)
/// Scene indices tell the colour space of a primvar: HdPrimvarSchema::GetColorSpace.
#define PATINA_HAS_PRIMVAR_COLOR_SPACES (PXR_VERSION >= 2603)
/// Scene indices tell light and prims of a collection that is authored late.
#define PATINA_HAS_LATE_COLLECTIONS (PXR_VERSION >= 2411)

namespace patina {
PXR_NAMESPACE_USING_DIRECTIVE
}
