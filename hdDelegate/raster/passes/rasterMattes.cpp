// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterMattes.h"

#include "hdDelegate/compiled/matteNames.h"
#include "hdDelegate/parallel.h"

#include <algorithm>

namespace patina {

RasterMattes::RasterMattes(const RasterScene& scene, float timeCode,
                           const std::vector<AovSpec>& aovs) {
    for (size_t i = 0; i < aovs.size(); ++i)
        if (aovs[i].kind == AovKind::Coverage) _aovs.emplace_back(int(i), aovs[i].id);
    if (_aovs.empty()) return;
    _places = std::make_unique<RasterInstances>(scene.parts().placements, timeCode, scene.origin());
    for (const RasterDraw& d : scene.draws()) {
        Prim& prim = _prims[d.primId];
        if (prim.prim) continue;
        prim = {d.prim, nullptr, slotsOf(*d.prim)};
    }
    for (auto& item : _prims)
        item.second.places = &_places->places(item.second.prim->group);
}

/// The first subset of several keeps an element, as in tessellation.
std::vector<size_t> RasterMattes::slotsOf(const Geometry& prim) {
    std::vector<size_t> slots;
    for (size_t s = prim.subsets.size(); s-- > 0;)
        for (const int element : prim.subsets[s].faces) {
            if (element < 0) continue;
            if (size_t(element) >= slots.size()) slots.resize(size_t(element) + 1, 0);
            slots[size_t(element)] = s + 1;
        }
    return slots;
}

std::string RasterMattes::nameOf(AovId id, const Prim& prim, int place, int element) {
    if (id == AovId::cryptoMaterial) {
        const bool known = element >= 0 && size_t(element) < prim.slots.size();
        return materialMatte(*prim.prim, known ? prim.slots[size_t(element)] : 0);
    }
    const bool placed = place >= 0 && size_t(place) < prim.places->size();
    const InstanceStep* steps = placed ? (*prim.places)[size_t(place)].steps.data() : nullptr;
    const int count = placed ? int((*prim.places)[size_t(place)].steps.size()) : 0;
    return id == AovId::cryptoAsset ? assetMatte(*prim.prim, steps, count)
                                    : objectMatte(*prim.prim, steps, count);
}

void RasterMattes::count(const std::vector<int>& ids, int width, int height, const int window[4],
                         Film& film) const {
    parallelFor(window[1], window[3] + 1, [&](int y) {
        for (int x = window[0]; x <= window[2]; ++x) {
            const int* id = &ids[4 * (size_t(height - 1 - y) * size_t(width) + size_t(x))];
            const auto prim = _prims.find(id[0]);
            if (prim == _prims.end()) continue;
            for (const auto& [aov, kind] : _aovs)
                film.addCoverage(aov, x, y, nameOf(kind, prim->second, id[3], id[2]));
        }
    });
}

} // namespace patina
