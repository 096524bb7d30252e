// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/gprim.h"

#include "hdDelegate/hydra/coordSys.h"
#include "hdDelegate/hydra/instancer.h"
#include "hdDelegate/hydra/instances.h"
#include "hdDelegate/hydra/sampling.h"

#include <pxr/imaging/hd/renderIndex.h>

namespace patina {

std::vector<std::string> categoriesOf(HdSceneDelegate& delegate, const SdfPath& id) {
    std::vector<std::string> categories;
    for (const TfToken& category : delegate.GetCategories(id))
        categories.push_back(category.GetString());
    return categories;
}

std::string renderTagOf(HdSceneDelegate& delegate, const SdfPath& id) {
    const TfToken tag = delegate.GetRenderTag(id);
    return tag == HdRenderTagTokens->geometry ? std::string() : tag.GetString();
}

void readGprim(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
               const SdfPath& instancerId, HdDirtyBits dirtyBits, bool all, Geometry& prim) {
    if (all || HdChangeTracker::IsTransformDirty(dirtyBits, id))
        prim.transform = transformOf(delegate, param, id);
    if (all || (dirtyBits & HdChangeTracker::DirtyCategories))
        prim.categories = categoriesOf(delegate, id);
    if (all || (dirtyBits & (HdChangeTracker::DirtyCategories | HdChangeTracker::DirtyPrimvar)))
        readCoordSystems(delegate, param, id, prim);
    if (all || HdChangeTracker::IsDoubleSidedDirty(dirtyBits, id))
        prim.doubleSided = delegate.GetDoubleSided(id);
    if (all || (dirtyBits & HdChangeTracker::DirtyRenderTag))
        prim.renderTag = renderTagOf(delegate, id);
    if (all || HdChangeTracker::IsInstancerDirty(dirtyBits, id) ||
        HdChangeTracker::IsInstanceIndexDirty(dirtyBits, id)) {
        if (instancerId.IsEmpty()) {
            param.instances().leave(id);
            prim.group.clear();
        } else {
            prim.group = param.instances().place(id, instancerId,
                                                 delegate.GetInstanceIndices(instancerId, id));
            HdRenderIndex& index = delegate.GetRenderIndex();
            SdfPath path = instancerId;
            while (HdInstancer* instancer = index.GetInstancer(path)) {
                static_cast<HdPatinaInstancer*>(instancer)->place(param);
                path = instancer->GetParentId();
            }
            if (!path.IsEmpty())
                param.warn(id, "instancer", messages::instancerMissing(path.GetString()));
        }
    }
}

} // namespace patina
