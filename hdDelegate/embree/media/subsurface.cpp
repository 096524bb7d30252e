// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/subsurface.h"

#include "hdDelegate/embree/media/randomWalk.h"

#include "shaders/closure.h"

#include <algorithm>

namespace patina {

bool scatterBeneath(const EmbreeScene& scene, const LightSampling& lights, Path& path,
                    const SurfacePoint& point, const Hit& hit, const SubsurfaceEntry& entry,
                    TraceCounters& counters) {
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    const vec3 outside = back ? -s.geometricNormal : s.geometricNormal;
    WalkExit exit;
    // A walk that is too short to be told from staying where it is ends as on an open mesh:
    // diffuse.
    const vec3& radius = entry.radius;
    exit.open = !(std::max({radius.x, radius.y, radius.z}) > 4.0f * point.offset);
    if (!exit.open) {
        const bool flat = hit.surface->shape == Surface::Shape::Triangles;
        const vec3 start = flat ? s.position : s.position - outside * point.offset;
        const WalkMedium medium = walkMedium(entry, point.offset);
        // About the geometric normal: beneath the surface there is no shading normal.
        const vec2 u = path.sampler.next2();
        const WalkStart first = startWalk(medium, u, path.sampler.random());
        const vec3& w = first.direction;
        vec3 x, y;
        sh::completeBasis(-outside, x, y);
        const vec3 inwards = x * w.x + y * w.y - outside * w.z;
        exit = walkBeneath(scene, medium, hit, back, outside, start, inwards, path.sampler,
                           counters.rays);
        exit.weight *= first.weight;
    }
    path.throughput *= exit.open ? entry.color * exit.weight : exit.weight;
    if (!(luminance(path.throughput) > 0.0f)) return false;

    // Light leaves as from a white diffuse surface, wherever that is.
    SurfacePoint leaving = point;
    leaving.hit = &hit;
    if (exit.found)
        computeSurfacePoint(exit.hit, exit.origin, exit.direction, path.coneWidth, leaving);
    ShadingPoint& there = leaving.shading;
    const vec3 up = back ? -there.geometricNormal : there.geometricNormal;
    there.viewDirection = up;
    Bsdf bsdf;
    bsdf.makeDiffuse(back ? -there.normal : there.normal, up);
    const Hit& exitHit = exit.found ? exit.hit : hit;
    const vec4 uLight = path.sampler.next4();
    path.lightSamples = path.branches = 1;
    path.seen = false;
    if (path.lightPaths) path.lightPaths->beneath = true;
    if (!lights.empty())
        path.add(lights.atSurface(path, leaving, bsdf, exitHit,
                                  lights.begin(path, leaving, bsdf.transmits(), vec3(uLight)),
                                  counters));
    const BsdfSample next = bsdf.sample(vec3(path.sampler.next2(), 0.0f), 0.0f);
    if (next.event == 0) return false;
    path.throughput *= next.weight;
    path.depart(leaving, exitHit, bsdf, next, lights.lights().splitsLobes());
    if (path.lightPaths) path.lightPaths->beneath = false;
    return true;
}

} // namespace patina
