// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/madeOnce.h"
#include "hdDelegate/plan/primExtent.h"

namespace patina {

/// The extents of a scene's prims, measured once for all who hold them. Thread safe.
class Extents {
public:
    std::shared_ptr<const PrimExtent> of(const std::shared_ptr<const Geometry>& prim) {
        return _extents.get(prim.get(), prim,
                            [&] { return std::make_shared<const PrimExtent>(*prim); });
    }
    size_t measured() const { return _extents.count(); } ///< since this was made

private:
    struct Key {
        Reference<const Geometry> prim;
        Key(const std::shared_ptr<const Geometry>& of) : prim(of) {}
        bool isOf(const std::shared_ptr<const Geometry>& other) const { return prim.is(other); }
    };
    MadeOnce<std::shared_ptr<const Geometry>, Key, PrimExtent> _extents;
};

} // namespace patina
