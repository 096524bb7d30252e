// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/caustics/photonMap.h"

#include <algorithm>
#include <utility>

namespace patina {

PhotonMap::PhotonMap(std::vector<Photon> photons) : _photons(std::move(photons)) {
    const auto lost = [](const Photon& p) { return p.flux == vec3(0.0f); };
    _photons.erase(std::remove_if(_photons.begin(), _photons.end(), lost), _photons.end());
    split(0, _photons.size());
}

void PhotonMap::split(size_t begin, size_t end) {
    if (end - begin < 2) return;
    vec3 low(INFINITY), high(-INFINITY);
    for (size_t i = begin; i < end; ++i) {
        low = glm::min(low, _photons[i].position);
        high = glm::max(high, _photons[i].position);
    }
    const vec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const size_t middle = (begin + end) / 2;
    std::nth_element(_photons.begin() + long(begin), _photons.begin() + long(middle),
                     _photons.begin() + long(end), [axis](const Photon& a, const Photon& b) {
                         return a.position[axis] < b.position[axis];
                     });
    _photons[middle].axis = axis;
    split(begin, middle);
    split(middle + 1, end);
}

} // namespace patina
