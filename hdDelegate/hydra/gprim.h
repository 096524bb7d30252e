// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/instancer.h"
#include "hdDelegate/hydra/linkedPrim.h"
#include "hdDelegate/hydra/marks.h"
#include "hdDelegate/hydra/primvars.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/hydra/materialBinding.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/rprim.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/tokens.h>

#include <memory>
#include <set>
#include <string>

namespace patina {

/// Reads what all gprims share and is dirty: transform, material, categories, sidedness, render
/// tag, instancing.
/// @param instancerId of the rprim, up to date
void readGprim(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
               const SdfPath& instancerId, HdDirtyBits dirtyBits, bool all, Geometry& prim);

/// The light and shadow links that a prim belongs to.
std::vector<std::string> categoriesOf(HdSceneDelegate& delegate, const SdfPath& id);

/// Empty for the tag that everything has by default.
std::string renderTagOf(HdSceneDelegate& delegate, const SdfPath& id);

/// A Hydra prim that becomes a prim of the scene. It keeps the last one, so that a sync fetches
/// only what is dirty.
/// @tparam Base HdMesh, HdBasisCurves, HdPoints...
/// @tparam Prim Mesh, Curves, Points...
template <class Base, class Prim> class HdPatinaGprim : public Base, public HdPatinaLinkedPrim {
public:
    explicit HdPatinaGprim(const SdfPath& id) : Base(id) {}

    HdDirtyBits GetInitialDirtyBitsMask() const override {
        return HdChangeTracker::AllSceneDirtyBits;
    }

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
              const TfToken& reprToken) override {
        auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
        const SdfPath& id = this->GetId();
        this->_UpdateVisibility(delegate, dirtyBits);
        this->_UpdateInstancer(delegate, dirtyBits);
        HdInstancer::_SyncInstancerAndParents(delegate->GetRenderIndex(), this->GetInstancerId());

        const bool all = !_prim;
        _repr = reprToken;
        if (all) _shutter = param.shutter();
        auto prim = all ? std::make_shared<Prim>() : std::make_shared<Prim>(*_prim);
        prim->path = id.GetString();
        prim->id = this->GetPrimId();
        if (all || (*dirtyBits & HdChangeTracker::DirtyMaterialId)) {
            this->SetMaterialId(materialOf(*delegate, id, delegate->GetMaterialId(id)));
            prim->material = this->GetMaterialId().GetString();
        }
        readGprim(*delegate, param, id, this->GetInstancerId(), *dirtyBits, all, *prim);
        if (all || HdChangeTracker::IsAnyPrimvarDirty(*dirtyBits, id) ||
            (*dirtyBits & HdChangeTracker::DirtyComputationPrimvarDesc)) {
            PrimvarUpdate update = updatePrimvars(*delegate, param, id, *dirtyBits, all, *prim);
            // Points that are listed no more are gone, though nothing marks them.
            if (update.pointsChanged || (_hasPoints && !update.pointsListed))
                setPoints(*prim, std::move(update.points));
            _hasPoints = update.pointsListed;
            readMarks(*delegate, param, id, *prim);
        }
        syncShape(*delegate, param, *dirtyBits, all, reprToken, *prim);
        _prim = prim;
        // An invisible prim is no part of the scene; it comes back as it was.
        if (this->IsVisible())
            param.set(shownAs(*delegate, param, _prim));
        else
            param.removeGeometry(prim->path);
        *dirtyBits &= ~HdChangeTracker::AllSceneDirtyBits;
    }

    void Finalize(HdRenderParam* renderParam) override {
        auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
        param.instances().leave(this->GetId());
        param.removeGeometry(this->GetId().GetString());
        _prim.reset();
    }

    void updateCategories(HdSceneDelegate& delegate, HdPatinaRenderParam& param) override {
        if (!_prim) return;
        std::vector<std::string> categories = categoriesOf(delegate, this->GetId());
        if (categories == _prim->categories) return;
        auto prim = std::make_shared<Prim>(*_prim);
        prim->categories = std::move(categories);
        _prim = prim;
        if (this->IsVisible()) param.set(shownAs(delegate, param, _prim));
    }

    void updateRenderTag(HdSceneDelegate& delegate, HdPatinaRenderParam& param) override {
        const std::string tag = renderTagOf(delegate, this->GetId());
        if (!_prim || tag == _prim->renderTag) return;
        auto prim = std::make_shared<Prim>(*_prim);
        prim->renderTag = tag;
        _prim = prim;
        if (this->IsVisible()) param.set(shownAs(delegate, param, _prim));
    }

    void updateBits(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                    HdDirtyBits bits) override {
        std::set<std::string> named; // forgotten: all that is dirty is read, named or not
        param.dirtiedPrimvars().take(this->GetId(), named);
        if (_prim) Sync(&delegate, &param, &bits, _repr);
    }

    void updateSamples(HdSceneDelegate& delegate, HdPatinaRenderParam& param) override {
        if (_shutter == param.shutter()) return;
        _shutter = param.shutter();
        updateBits(delegate, param,
                   HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyPoints |
                       HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyInstancer);
    }

protected:
    /// Reads what only this kind of prim has.
    virtual void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                           HdDirtyBits dirtyBits, bool all, const TfToken& repr, Prim& prim) = 0;
    virtual void setPoints(Prim& prim, Sampled<std::vector<vec3>> points) = 0;
    /// The prim that becomes part of the scene, where that is not the prim as Hydra has it.
    virtual std::shared_ptr<const Geometry> shownAs(HdSceneDelegate&, HdPatinaRenderParam&,
                                                    const std::shared_ptr<const Prim>& prim) const {
        return prim;
    }

    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override { return bits; }
    void _InitRepr(const TfToken&, HdDirtyBits*) override {}

private:
    std::shared_ptr<const Prim> _prim; ///< as Hydra has it
    TfToken _repr;                     ///< of the last sync
    GfVec2f _shutter{0.0f};            ///< over which it was sampled
    bool _hasPoints = false;           ///< Hydra lists points of it
};

} // namespace patina
