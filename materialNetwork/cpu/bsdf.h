#pragma once

#include "shaders/shaders.h"

#include <glm/glm.hpp>

namespace patina {

/// Value of a whole material for two directions, and the density with which sample() finds wi.
struct BsdfEval {
    glm::vec3 diffuse{0.0f};  ///< f * |cos|, part of the diffuse lobes (light input `diffuse` scales it)
    glm::vec3 specular{0.0f}; ///< f * |cos|, part of all other lobes
    float pdf = 0.0f;         ///< solid angle
};

struct BsdfSample {
    glm::vec3 wi{0.0f};
    glm::vec3 weight{0.0f}; ///< f |cos| / pdf over all lobes (of the delta lobe alone when delta)
    float pdf = 0.0f;       ///< solid angle over all lobes; probability when delta
    int event = 0;          ///< LOBE_REFLECT, LOBE_TRANSMIT, LOBE_DELTA bits; 0: no sample
    bool diffuse = false;   ///< which kind of lobe was drawn
    float eta = 1.0f;       ///< ior ratio crossed
    float roughness = 0.0f; ///< of the lobe drawn, 0..1, to widen the ray cone
};

/// The lobes of a material at one shading point: built by MaterialProgram, then asked many times.
/// Lives on the stack; no allocation. At most maxLobes; what does not fit is merged with a warning
/// when the program is compiled.
class Bsdf;

} // namespace patina
