// SPDX-License-Identifier: Apache-2.0
// Apart from bsdf.cpp, so that the compiler puts the lobes' samplers into Bsdf::sample() there.
#include "materialNetwork/cpu/bsdf.h"

#include "materialNetwork/cpu/lobeOps.h"

namespace patina {

namespace {

float iorOf(const BsdfLobe& l) {
    return l.kind == LobeKind::Dielectric ? l.dielectric.ior
           : l.kind == LobeKind::Schlick  ? l.schlick.ior
                                          : 1.0f;
}

} // namespace

BsdfEval Bsdf::evalDelta(const Bsdf& lobes, const BsdfSample& drawn, const glm::vec3& u) const {
    BsdfEval result;
    const BsdfLobe& theirs = lobes._lobes[drawn.lobe];
    const bool reflects = (drawn.event & sh::LOBE_REFLECT) != 0;
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        if (l.place != theirs.place || l.stochastic || (!reflects && iorOf(l) != iorOf(theirs)))
            continue;
        // Where a lobe has both, u.z decides: its ends ask for the one and the other.
        const glm::vec3 ends(u.x, u.y, reflects ? 0.0f : 0x1.fffffep-1f);
        const sh::LobeSample s = lobeSample(l, _frames[l.frame].wo, ends);
        if (s.event != drawn.event || !(s.pdf > 0.0f)) continue;
        result.specular = l.weight * s.weight * s.pdf;
        result.pdf = l.probability * s.pdf;
    }
    return result;
}

} // namespace patina
