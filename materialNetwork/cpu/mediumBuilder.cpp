// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/mediumBuilder.h"

#include "materialNetwork/ir/closureTree.h"

namespace patina {

namespace {

class MediumNumbers : public ClosureNumbers {
public:
    using ClosureNumbers::ClosureNumbers;

    Medium medium;
    void addAbsorption(const glm::vec3& weight, const glm::vec3& absorption) {
        sh::addAbsorption(medium, weight, absorption);
    }
    void addAnisotropic(const glm::vec3& weight, const glm::vec3& absorption,
                        const glm::vec3& scattering, float anisotropy) {
        sh::addAnisotropic(medium, weight, absorption, scattering, anisotropy);
    }
};

} // namespace

Medium buildMedium(const std::vector<ClosureOp>& vdf, const glm::vec4* registers) {
    MediumNumbers numbers(registers);
    addMedia(vdf, numbers);
    return numbers.medium;
}

} // namespace patina
