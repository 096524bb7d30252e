// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/drawFilter.h"

#include <algorithm>

namespace patina {

namespace {

bool contains(const std::string& root, const std::string& path) {
    size_t length = root.size();
    while (length > 0 && root[length - 1] == '/')
        --length;
    return path.compare(0, length, root, 0, length) == 0 &&
           (path.size() == length || path[length] == '/');
}

bool anyContains(const std::vector<std::string>& roots, const std::string& path) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const std::string& root) { return contains(root, path); });
}

} // namespace

bool isDrawn(const Geometry& prim, const RenderSettings& settings) {
    const std::string tag = prim.renderTag.empty() ? "geometry" : prim.renderTag;
    const auto& tags = settings.renderTags;
    if (!tags.empty() && std::find(tags.begin(), tags.end(), tag) == tags.end()) return false;
    if (!settings.rootPaths.empty() && !anyContains(settings.rootPaths, prim.path)) return false;
    return !anyContains(settings.excludePaths, prim.path);
}

bool isDrawn(const Instancer& prim, const RenderSettings& settings) {
    return prim.visibility.sees(RayAny) && !anyContains(settings.excludePaths, prim.path);
}

} // namespace patina
