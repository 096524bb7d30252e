#include "hdDelegate/raster/scene/rasterInstances.h"

#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxDepth = 8;

bool contains(std::string root, const std::string& path) {
    while (!root.empty() && root.back() == '/')
        root.pop_back();
    return path.compare(0, root.size(), root) == 0 &&
           (path.size() == root.size() || path[root.size()] == '/');
}

bool anyContains(const std::vector<std::string>& roots, const std::string& path) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const std::string& root) { return contains(root, path); });
}

bool usable(const mat4& m) {
    const float volume = glm::determinant(mat3(m));
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i)
        sum += m[i].x + m[i].y + m[i].z + m[i].w;
    return std::isfinite(sum) && std::isfinite(volume) && volume != 0.0f;
}

} // namespace

bool isDrawnInRaster(const Geometry& prim, const RenderSettings& settings) {
    const std::string tag = prim.renderTag.empty() ? "geometry" : prim.renderTag;
    const auto& tags = settings.renderTags;
    if (!tags.empty() && std::find(tags.begin(), tags.end(), tag) == tags.end()) return false;
    if (!settings.rootPaths.empty() && !anyContains(settings.rootPaths, prim.path)) return false;
    return prim.visibility.camera && !anyContains(settings.excludePaths, prim.path);
}

RasterInstances::RasterInstances(const SceneState& state, const RenderSettings& settings,
                                 float timeCode, const vec3& origin)
    : _time(timeCode), _origin(origin) {
    for (const auto& item : state.instancers)
        if (item.second->visibility.camera && !anyContains(settings.excludePaths, item.first))
            _instancers.push_back(item.second);
    _places[""] = {RasterPlace()};
    _places[""][0].groupToWorld[3] -= glm::dvec4(origin, 0.0);
}

const std::vector<RasterPlace>& RasterInstances::places(const std::string& group) {
    const auto known = _places.find(group);
    if (known != _places.end()) return known->second;
    std::vector<RasterPlace> list;
    gather(group, RasterPlace(), 0, list);
    return _places[group] = std::move(list);
}

void RasterInstances::gather(const std::string& group, const RasterPlace& inner, int depth,
                             std::vector<RasterPlace>& out) const {
    if (group.empty()) {
        if (!usable(inner.groupToWorld)) return;
        out.push_back(inner);
        out.back().groupToWorld[3] -= glm::dvec4(_origin, 0.0);
        return;
    }
    if (depth > maxDepth) return;
    for (const auto& instancer : _instancers)
        for (size_t i = 0; i < instancer->transforms.size(); ++i) {
            const int p =
                i < instancer->prototypeIndices.size() ? instancer->prototypeIndices[i] : -1;
            if (p < 0 || size_t(p) >= instancer->prototypes.size() ||
                instancer->prototypes[size_t(p)] != group)
                continue;
            RasterPlace place = inner;
            place.groupToWorld =
                exactTransformAt(instancer->transforms[i], _time) * inner.groupToWorld;
            const int own = i < instancer->ids.size() ? instancer->ids[i] : int(i);
            if (depth == 0)
                place.id = own;
            else if (size_t(p) < instancer->idCounts.size())
                place.id += own * instancer->idCounts[size_t(p)];
            if (i < instancer->categories.size())
                place.categories.insert(place.categories.end(), instancer->categories[i].begin(),
                                        instancer->categories[i].end());
            gather(instancer->group, place, depth + 1, out);
        }
}

} // namespace patina
