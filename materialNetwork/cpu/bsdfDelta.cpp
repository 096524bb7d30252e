// SPDX-License-Identifier: Apache-2.0
// Apart from bsdf.cpp, so that the compiler puts the lobes' samplers into Bsdf::sample() there.
#include "materialNetwork/cpu/bsdf.h"

#include "materialNetwork/cpu/lobeOps.h"

namespace patina {

BsdfEval Bsdf::evalDelta(const BsdfSample& drawn, const glm::vec3& u) const {
    BsdfEval result;
    // Where a lobe has both, u.z decides: its ends ask for the one and the other.
    const bool reflects = (drawn.event & sh::LOBE_REFLECT) != 0;
    const glm::vec3 ends(u.x, u.y, reflects ? 0.0f : 0x1.fffffep-1f);
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        if (l.stochastic || (_walks && l.kind == LobeKind::Subsurface)) continue;
        const BsdfFrame& f = _frames[l.frame];
        const sh::LobeSample s = lobeSample(l, f.wo, ends);
        if (s.event != drawn.event || !(s.pdf > 0.0f) || sh::toWorld(f, s.wi) != drawn.wi) continue;
        result.specular += l.weight * s.weight * s.pdf;
        result.pdf += l.probability * s.pdf;
    }
    return result;
}

} // namespace patina
