// SPDX-License-Identifier: Apache-2.0
// Hermite curves for scene indices: UsdImaging's own adapter is for UsdImagingDelegate alone. The
// adapter asks for no schema, so it stands beside UsdImaging's.

#if __has_include(<pxr/usdImaging/usdImaging/apiSchemaAdapter.h>) // OpenUSD may be built without

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/sourceForms.h"

#include <pxr/imaging/hd/overlayContainerDataSource.h>
#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/usdImaging/usdImaging/adapterRegistry.h>
#include <pxr/usdImaging/usdImaging/apiSchemaAdapter.h>
#include <pxr/usdImaging/usdImaging/dataSourceAttribute.h>
#include <pxr/usdImaging/usdImaging/primAdapter.h>

#include <algorithm>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

const TfToken tangents("tangents"), hermite("HermiteCurves"), hermiteType(patina::hermitePrimType);

/// Holds the tangents, looked up when they are asked for.
class Tangents final : public HdContainerDataSource {
public:
    HD_DECLARE_DATASOURCE(Tangents);

    TfTokenVector GetNames() override { return {tangents}; }
    HdDataSourceBaseHandle Get(const TfToken& name) override {
        const UsdAttribute attribute = name == tangents ? _prim.GetAttribute(name) : UsdAttribute();
        if (!attribute) return nullptr;
        return UsdImagingDataSourceAttributeNew(attribute, _globals, _prim.GetPath(),
                                                HdDataSourceLocator(hermiteType, tangents));
    }

private:
    Tangents(const UsdPrim& prim, const UsdImagingDataSourceStageGlobals& globals)
        : _prim(prim), _globals(globals) {}

    const UsdPrim _prim;
    const UsdImagingDataSourceStageGlobals& _globals;
};

} // namespace

/// Their data are those of NURBS curves and their tangents. Their type is one that other renderers
/// do not know.
class HdPatinaHermiteAdapter final : public UsdImagingAPISchemaAdapter {
public:
    TfToken GetImagingSubprimType(const UsdPrim& prim, const TfToken& subprim,
                                  const TfToken&) override {
        return isHermite(prim, subprim) ? hermiteType : TfToken();
    }

    HdContainerDataSourceHandle
    GetImagingSubprimData(const UsdPrim& prim, const TfToken& subprim, const TfToken&,
                          const UsdImagingDataSourceStageGlobals& globals) override {
        if (!isHermite(prim, subprim)) return nullptr;
        return HdOverlayContainerDataSource::New(
            HdRetainedContainerDataSource::New(hermiteType, Tangents::New(prim, globals)),
            _curves->GetImagingSubprimData(prim, subprim, globals));
    }

    HdDataSourceLocatorSet
    InvalidateImagingSubprim(const UsdPrim& prim, const TfToken& subprim, const TfToken&,
                             const TfTokenVector& properties,
                             UsdImagingPropertyInvalidationType type) override {
        if (!isHermite(prim, subprim)) return HdDataSourceLocatorSet();
        HdDataSourceLocatorSet dirty =
            _curves->InvalidateImagingSubprim(prim, subprim, properties, type);
        if (std::count(properties.begin(), properties.end(), tangents))
            dirty.insert(HdDataSourceLocator(hermiteType, tangents));
        return dirty;
    }

private:
    bool isHermite(const UsdPrim& prim, const TfToken& subprim) const {
        return subprim.IsEmpty() && prim.GetTypeName() == hermite && _curves;
    }

    const UsdImagingPrimAdapterSharedPtr _curves =
        UsdImagingAdapterRegistry::GetInstance().ConstructAdapter(TfToken("NurbsCurves"));
};

TF_REGISTRY_FUNCTION(TfType) {
    TfType::Define<HdPatinaHermiteAdapter, TfType::Bases<UsdImagingAPISchemaAdapter>>()
        .SetFactory<UsdImagingAPISchemaAdapterFactory<HdPatinaHermiteAdapter>>();
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
