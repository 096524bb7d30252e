// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/volumeScene.h"

#include "hdDelegate/embree/surfaceSpace.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxCandidates = 1 << 16; ///< along one ray
constexpr int maxVolumes = 16;         ///< that one ray passes
constexpr float leastThroughput = 0.05f;

float mean(const vec3& v) {
    return (v.x + v.y + v.z) / 3.0f;
}

/// Makes a medium as thin as its majorant, where it is denser than that tells. What it reflects and
/// how bright it glows stay as they are where it is opaque.
void thin(Medium& medium, float majorant) {
    const vec3 extinction = medium.extinction();
    const float over = std::max({extinction.x, extinction.y, extinction.z}) / majorant;
    if (!(over > 1.0f)) return;
    medium.absorption /= over;
    medium.emission /= over;
    for (int i = 0; i < medium.phaseCount; ++i)
        medium.phases[i].scattering /= over;
}

} // namespace

/// Where a ray may collide with one volume: a walk over the cells of its majorants.
class VolumeScene::Tracker {
public:
    Tracker() = default;
    Tracker(const Placed& placed, const vec3& origin, const vec3& direction, float end)
        : light(placed.light), _medium(placed.medium.get()) {
        _origin = vec3(placed.worldToObject * vec4(origin, 1.0f));
        _direction = mat3(placed.worldToObject) * direction;
        const vec3 lower = _medium->boundsMin(), upper = _medium->boundsMax();
        float near = 0.0f, far = end;
        for (int a = 0; a < 3; ++a) {
            if (_direction[a] == 0.0f) {
                if (_origin[a] < lower[a] || _origin[a] > upper[a]) return;
                continue;
            }
            float t0 = (lower[a] - _origin[a]) / _direction[a];
            float t1 = (upper[a] - _origin[a]) / _direction[a];
            if (t0 > t1) std::swap(t0, t1);
            near = std::max(near, t0);
            far = std::min(far, t1);
        }
        if (!(near < far)) return;
        _t = near;
        _end = far;
        const vec3 size = (upper - lower) / vec3(_medium->cellCount());
        const vec3 p = (at(near) - lower) / size;
        for (int a = 0; a < 3; ++a) {
            _cell[a] = std::clamp(int(std::floor(p[a])), 0, _medium->cellCount()[a] - 1);
            _step[a] = _direction[a] > 0.0f ? 1 : -1;
            _delta[a] = _direction[a] == 0.0f ? INFINITY : size[a] / std::abs(_direction[a]);
            const float face = lower[a] + float(_cell[a] + (_step[a] > 0)) * size[a];
            _next[a] = _direction[a] == 0.0f ? INFINITY : (face - _origin[a]) / _direction[a];
        }
        _mostDense = opaque / std::max(std::min({_delta.x, _delta.y, _delta.z}), 1e-30f);
        _inside = true;
    }

    bool meets() const { return _inside; }
    vec3 at(float t) const { return _origin + _direction * t; }
    const VolumeMedium& medium() const { return *_medium; }

    /// Goes on to the next candidate. @returns false at the end
    bool advance(float u) {
        float depth = -std::log(std::max(1.0f - u, 1e-30f));
        while (_inside) {
            majorant = std::min(_medium->majorant(_cell), _mostDense);
            const int axis =
                _next.x < _next.y ? (_next.x < _next.z ? 0 : 2) : (_next.y < _next.z ? 1 : 2);
            const float leave = std::min(_next[axis], _end);
            const float length = std::max(leave - _t, 0.0f);
            if (depth < majorant * length) {
                _t += depth / majorant;
                distance = _t;
                return true;
            }
            depth -= majorant * length;
            _t = std::max(_t, leave);
            _cell[axis] += _step[axis];
            _next[axis] += _delta[axis];
            _inside = _t < _end && _cell[axis] >= 0 && _cell[axis] < _medium->cellCount()[axis];
        }
        distance = INFINITY;
        return false;
    }

    float distance = INFINITY, majorant = 0.0f; ///< of the candidate
    vec3 light{1.0f};

private:
    /// Optical depth of a cell beyond which rays would make candidates without end.
    static constexpr float opaque = 1024.0f;
    float _mostDense = 0.0f;
    const VolumeMedium* _medium = nullptr;
    vec3 _origin{0.0f}, _direction{0.0f}, _next{0.0f}, _delta{0.0f};
    ivec3 _cell{0}, _step{0};
    float _t = 0.0f, _end = 0.0f;
    bool _inside = false;
};

void VolumeScene::update(const std::vector<std::shared_ptr<const Volume>>& prims,
                         const MediumOf& mediumOf, const PlacesOf& placesOf, float open,
                         const dvec3& origin, Diagnostics& diagnostics) {
    std::vector<std::shared_ptr<const VolumeMedium>> held;
    std::vector<Placed> placed;
    _min = vec3(INFINITY);
    _max = vec3(-INFINITY);
    for (const auto& prim : prims) {
        const auto medium = held.emplace_back(mediumOf(prim));
        if (medium->empty()) continue;
        for (const mat4& place : placesOf(prim->group)) {
            const dvec3 from = prim->group.empty() ? origin : dvec3(0.0);
            const mat4 toWorld = place * interpolate(prim->transform, open, from);
            const mat4 inverse = glm::inverse(toWorld);
            const vec3 lower = medium->boundsMin(), upper = medium->boundsMax();
            bool usable = true;
            for (int corner = 0; corner < 8; ++corner) {
                const vec3 p((corner & 1) ? upper.x : lower.x, (corner & 2) ? upper.y : lower.y,
                             (corner & 4) ? upper.z : lower.z);
                const vec3 w = vec3(toWorld * vec4(p, 1.0f));
                const vec3 back = vec3(inverse * vec4(w, 1.0f));
                usable &= std::isfinite(w.x + w.y + w.z + back.x + back.y + back.z);
                if (!usable) break;
                _min = glm::min(_min, w);
                _max = glm::max(_max, w);
            }
            if (usable)
                placed.push_back({medium, inverse, prim->visibility, prim->light});
            else
                diagnostics.warn(prim->path, "transform", messages::volumeWithoutInverse);
        }
    }
    _placed = std::move(placed);
    _held = std::move(held);
}

VolumeScene::Collision VolumeScene::track(const vec3& origin, const vec3& direction, float end,
                                          unsigned rays, vec3& throughput, Sampler& sampler) const {
    Collision result;
    result.distance = end;
    Tracker trackers[maxVolumes];
    int count = 0;
    for (const Placed& placed : _placed) {
        if (!placed.visibility.sees(rays)) continue;
        if (count == maxVolumes) break;
        trackers[count] = Tracker(placed, origin, direction, end);
        if (trackers[count].meets() && trackers[count].advance(sampler.random())) ++count;
    }
    for (int i = 0; i < maxCandidates && count > 0; ++i) {
        Tracker* nearest =
            std::min_element(trackers, trackers + count, [](const Tracker& a, const Tracker& b) {
                return a.distance < b.distance;
            });
        if (!(nearest->distance < end)) return result;
        Medium m = nearest->medium().at(nearest->at(nearest->distance));
        thin(m, nearest->majorant);
        const float inverse = 1.0f / nearest->majorant;
        if (m.emission != vec3(0.0f)) {
            const vec3 seen = (rays & (RayDiffuse | RayVolume)) ? nearest->light : vec3(1.0f);
            const vec3 glow = throughput * m.emission * seen * inverse;
            result.emitted += glow;
            result.emittedFrom += mean(glow) * nearest->distance;
        }
        const vec3 scatter = m.scattering() * inverse;
        const vec3 pass = glm::max(1.0f - m.extinction() * inverse, vec3(0.0f));
        const float toScatter = mean(throughput * scatter), toPass = mean(throughput * pass);
        const float sum = toScatter + toPass;
        if (!(sum > 0.0f)) {
            result.absorbed = true;
            throughput = vec3(0.0f);
            return result;
        }
        if (sampler.random() * sum < toScatter) {
            throughput *= scatter * (sum / toScatter);
            result.scattered = true;
            result.distance = nearest->distance;
            result.medium = m;
            return result;
        }
        throughput *= pass * (sum / toPass);
        nearest->advance(sampler.random());
    }
    return result;
}

vec3 VolumeScene::transmittance(const vec3& origin, const vec3& direction, float end, unsigned rays,
                                Sampler& sampler) const {
    vec3 through(1.0f);
    for (const Placed& placed : _placed) {
        if (!placed.visibility.sees(rays)) continue;
        Tracker tracker(placed, origin, direction, end);
        for (int i = 0; i < maxCandidates && tracker.meets() && tracker.advance(sampler.random());
             ++i) {
            const vec3 extinction = tracker.medium().at(tracker.at(tracker.distance)).extinction();
            through *= glm::max(1.0f - extinction / tracker.majorant, vec3(0.0f));
            const float maximum = std::max({through.x, through.y, through.z});
            if (maximum < leastThroughput) {
                const float survive = maximum / leastThroughput;
                if (!(sampler.random() < survive)) return vec3(0.0f);
                through /= survive;
            }
        }
    }
    return through;
}

} // namespace patina
