// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/surface.h"

#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/primvarEval.h"
#include "hdDelegate/geometry/tangentFrames.h"
#include "base/hashedNumbers.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

vec3 safeNormalize(const vec3& v, const vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-30f && std::isfinite(length) ? v / length : fallback;
}

template <class T> struct StepPair {
    const std::vector<T>* a;
    const std::vector<T>* b;
    float f;
    T at(size_t i) const { return f == 0.0f ? (*a)[i] : (*a)[i] * (1.0f - f) + (*b)[i] * f; }
};

template <class T> StepPair<T> stepsAt(const std::vector<std::vector<T>>& steps, float time) {
    if (steps.size() == 1) return {&steps[0], &steps[0], 0.0f};
    const float x = std::clamp(time, 0.0f, 1.0f) * float(steps.size() - 1);
    const size_t i = std::min(size_t(x), steps.size() - 2);
    return {&steps[i], &steps[i + 1], x - float(i)};
}

/// Local geometry of a hit, in group space.
struct Local {
    vec3 position, geometricNormal, normal, dPdu{0.0f}, dPdv{0.0f};
    float uvPerLength = 0.0f;
    float radius = 0.0f; ///< of a curve
    vec3 across{0.0f};   ///< from a curve's middle line, in radii
};

/// Corners of the triangle that is hit, in group space.
struct Corners {
    vec3 p[3];
    explicit Corners(const Hit& hit) {
        const uvec3& t = hit.surface->topology().triangles[hit.primitive];
        const auto positions = stepsAt(hit.surface->positions(), hit.time);
        for (int k = 0; k < 3; ++k)
            p[k] = positions.at(t[k]);
    }
    const vec3& operator[](int k) const { return p[k]; }
};

/// Of a uv set over the triangle that is hit, in group space.
TangentFrame frameOf(const Hit& hit, int set) {
    vec2 at[3];
    for (int k = 0; k < 3; ++k) {
        float value[4];
        if (!readAttribute(*hit.surface, set, hit.primitive, float(k == 1), float(k == 2), value))
            return {};
        at[k] = vec2(value[0], value[1]);
    }
    return tangentFrame(Corners(hit).p, at);
}

Local triangleLocal(const Hit& hit) {
    const Surface& surface = *hit.surface;
    const TriangleMesh& mesh = surface.topology();
    const uvec3 tri = mesh.triangles[hit.primitive];
    const Corners p(hit);
    const float w = 1.0f - hit.u - hit.v;
    Local local;
    local.position = p[0] * w + p[1] * hit.u + p[2] * hit.v;
    vec3 ng = glm::cross(p[1] - p[0], p[2] - p[0]);
    if (surface.flipNormals) ng = -ng;
    local.geometricNormal = safeNormalize(ng, vec3(0, 0, 1));
    local.normal = local.geometricNormal;
    if (!surface.normals().empty()) {
        const auto normals = stepsAt(surface.normals(), hit.time);
        vec3 n;
        if (mesh.normalRate == MeshAttribute::Rate::PerCorner) {
            const size_t c = size_t(hit.primitive) * 3;
            n = normals.at(c) * w + normals.at(c + 1) * hit.u + normals.at(c + 2) * hit.v;
        } else if (mesh.normalRate == MeshAttribute::Rate::PerFace) {
            n = normals.at(mesh.triangleFace[hit.primitive]);
        } else {
            n = normals.at(tri.x) * w + normals.at(tri.y) * hit.u + normals.at(tri.z) * hit.v;
        }
        local.normal = safeNormalize(n, local.geometricNormal);
    }
    const int set = surface.material(hit.primitive).tangentSet;
    if (set < 0) return local;
    const TangentFrame frame = frameOf(hit, set);
    if (!frame.fromTexture) return local;
    local.dPdu = frame.dpdu;
    local.dPdv = frame.dpdv;
    local.uvPerLength = frame.uvPerLength;
    return local;
}

/// dPdu is along the curve.
Local curveLocal(const Hit& hit, const vec3& position) {
    Local local;
    local.position = position;
    local.geometricNormal = local.normal = safeNormalize(hit.groupNormal, vec3(0, 0, 1));
    if (hit.surface->shape != Surface::Shape::Curves) return local;
    const CurveSet& curves = hit.surface->rest->curves;
    const auto points = stepsAt(hit.surface->placed.points, hit.time);
    const size_t first = curves.segments[hit.primitive];
    const int count = curves.basis == CurveBasis::Linear ? 2 : 4;
    const vec4 slopes = basisSlopes(curves.basis, hit.u),
               weights = basisWeights(curves.basis, hit.u);
    vec4 middle(0.0f);
    for (int i = 0; i < count; ++i) {
        const vec4 p = points.at(first + size_t(i));
        local.dPdu += slopes[i] * vec3(p);
        middle += weights[i] * p;
    }
    local.radius = middle.w;
    local.across = (position - vec3(middle)) / std::max(middle.w, 1e-20f);
    return local;
}

/// A ribbon that stands for a fibre is shaded as round: its normal leans over as that of a tube
/// does across the width.
vec3 roundNormal(const vec3& normal, const vec3& tangent, const vec3& across) {
    const vec3 side = glm::cross(normal, tangent);
    const float h = std::clamp(glm::dot(across, side), -0.999f, 0.999f);
    return normal * std::sqrt(1.0f - h * h) + side * h;
}

} // namespace

int Surface::findAttribute(const std::string& name) const {
    const auto& list = attributes();
    for (size_t i = 0; i < list.size(); ++i)
        if (list[i].name == name) return int(i);
    if (shared)
        for (size_t i = 0; i < shared->mesh.attributes.size(); ++i)
            if (shared->mesh.attributes[i].name == name) return int(list.size() + i);
    return -1;
}

int Surface::findTangentSet(const std::string& wanted) const {
    if (!shared) return tangentSet(attributes(), wanted);
    const int set = tangentSet(shared->mesh.attributes, wanted);
    return set < 0 ? set : set + int(own.size());
}

const MeshAttribute& Surface::attribute(int index) const {
    const auto& list = attributes();
    return size_t(index) < list.size() ? list[size_t(index)]
                                       : shared->mesh.attributes[size_t(index) - list.size()];
}

mat4 Surface::placeAt(float time) const {
    const float x = std::clamp(time, 0.0f, 1.0f) * float(places.size() - 1);
    const size_t i = std::min(size_t(x), places.size() - 1);
    const float f = x - float(i);
    return f == 0.0f ? places[i] : places[i] * (1.0f - f) + places[i + 1] * f;
}

const MaterialSlot& Surface::material(unsigned primitive) const {
    const auto& subsets = shape == Shape::Triangles ? topology().triangleSubset
                          : shape == Shape::Curves  ? rest->curves.segmentSubset
                                                    : rest->points.pointSubset;
    const size_t subset = primitive < subsets.size() ? subsets[primitive] : 0;
    return materials[subset < materials.size() ? subset : 0];
}

int Surface::element(unsigned primitive) const {
    if (shape == Shape::Triangles) return topology().triangleFace[primitive];
    return shape == Shape::Curves ? rest->curves.segmentCurve[primitive]
                                  : rest->points.pointIndex[primitive];
}

bool readAttribute(const Surface& surface, int attribute, unsigned primitive, float u, float v,
                   float out[4]) {
    const MeshAttribute& a = surface.attribute(attribute);
    switch (surface.shape) {
    case Surface::Shape::Curves: return evalAttribute(surface.rest->curves, a, primitive, u, out);
    case Surface::Shape::Points: return evalAttribute(surface.rest->points, a, primitive, out);
    default: return evalAttribute(surface.topology(), a, primitive, u, v, out);
    }
}

Catching catchingOf(const Hit& hit) {
    Catching catching = hit.surface->prim->catching;
    for (int i = 0; i < hit.stepCount; ++i)
        if (const Marked* marks = hit.steps[i].marks()) {
            catching.matte |= marks->catching.matte;
            catching.shadows |= marks->catching.shadows;
            catching.reflections |= marks->catching.reflections;
        }
    return catching;
}

int dielectricPriorityOf(const Hit& hit) {
    int priority = hit.surface->prim->dielectricPriority;
    for (int i = hit.stepCount - 1; i >= 0 && priority == 0; --i)
        if (const Marked* marks = hit.steps[i].marks()) priority = marks->dielectricPriority;
    return priority;
}

bool readPrimvar(const Hit& hit, const std::string& name, float out[4]) {
    const int attribute = hit.surface->findAttribute(name);
    return attribute >= 0 ? readAttribute(*hit.surface, attribute, hit.primitive, hit.u, hit.v, out)
                          : readInstances(hit.steps, hit.stepCount, name, out);
}

bool SurfacePoint::read(int slotIndex, float out[4]) const {
    const int attribute = slot->attributes[slotIndex];
    if (attribute >= 0)
        return readAttribute(*hit->surface, attribute, hit->primitive, hit->u, hit->v, out);
    if (!slot->tangents.empty() && slot->tangents[size_t(slotIndex)] >= 0) {
        vec4 value = frameOf(*hit, slot->tangents[size_t(slotIndex)]).value();
        value = vec4(mat3(hit->surface->groupToObject) * vec3(value), value.w);
        std::copy_n(&value.x, 4, out);
        return true;
    }
    return hit->stepCount > 0 &&
           readInstances(hit->steps, hit->stepCount,
                         slot->program->primvars()[size_t(slotIndex)].name, out);
}

void computeSurfacePoint(const Hit& hit, const vec3& origin, const vec3& direction, float coneWidth,
                         SurfacePoint& out) {
    const Surface& surface = *hit.surface;
    const vec3 worldHit = origin + direction * hit.distance;
    Local local;
    vec3 position = worldHit;
    mat3 normalMatrix(1.0f), tangentMatrix(1.0f);
    if (hit.instanced) {
        tangentMatrix = mat3(hit.groupToWorld);
        normalMatrix = glm::transpose(glm::inverse(tangentMatrix));
    }
    if (surface.shape == Surface::Shape::Triangles) {
        local = triangleLocal(hit);
        position =
            hit.instanced ? vec3(hit.groupToWorld * vec4(local.position, 1.0f)) : local.position;
    } else {
        const vec3 groupPosition =
            hit.instanced ? vec3(glm::inverse(hit.groupToWorld) * vec4(worldHit, 1.0f)) : worldHit;
        local = curveLocal(hit, groupPosition);
    }

    ShadingPoint& s = out.shading;
    out.hit = &hit;
    out.slot = &surface.material(hit.primitive);
    s.primvars = &out;
    s.position = position;
    s.worldOrigin = surface.worldOrigin;
    s.objectPosition = vec3(surface.groupToObject * vec4(local.position, 1.0f));
    s.geometricNormal = local.geometricNormal;
    s.normal = local.normal;
    if (hit.instanced) {
        s.geometricNormal = safeNormalize(normalMatrix * local.geometricNormal, vec3(0, 0, 1));
        s.normal = safeNormalize(normalMatrix * local.normal, s.geometricNormal);
    }
    s.viewDirection = -direction;
    // Ribbons and disks are seen from both sides alike.
    const bool flat = surface.shape != Surface::Shape::Triangles && !surface.placed.normals.empty();
    if (flat && glm::dot(s.geometricNormal, s.viewDirection) < 0.0f) {
        s.geometricNormal = -s.geometricNormal;
        s.normal = -s.normal;
    }
    if (glm::dot(s.normal, s.geometricNormal) < 0.0f) s.normal = -s.normal;

    vec3 t = tangentMatrix * local.dPdu, b = tangentMatrix * local.dPdv;
    t -= s.normal * glm::dot(s.normal, t);
    const float length = glm::length(t);
    if (length > 1e-20f && std::isfinite(length)) {
        s.tangent = t / length;
        const vec3 across = glm::cross(s.normal, s.tangent);
        s.bitangent = glm::dot(across, b) < 0.0f ? -across : across;
    } else {
        orthonormalBasis(s.normal, s.tangent, s.bitangent);
    }
    out.fibre = surface.shape == Surface::Shape::Curves && out.slot->program->isFibre();
    if (out.fibre && flat) {
        s.normal = s.geometricNormal =
            roundNormal(s.normal, s.tangent, tangentMatrix * local.across);
        s.bitangent = glm::cross(s.normal, s.tangent);
    }
    s.objectToWorldNormal = normalMatrix * glm::transpose(mat3(surface.groupToObject));
    const float scale = hit.instanced ? std::cbrt(std::abs(glm::determinant(tangentMatrix))) : 1.0f;
    s.lengthPerUv = scale / std::max(local.uvPerLength, 1e-20f);
    const float cosine = std::max(0.1f, std::abs(glm::dot(s.geometricNormal, s.viewDirection)));
    // Who has numbers of its own sets another.
    s.seed = out.slot->program->jitters() ? HashedNumbers(1).mix(origin).mix(direction).bits() : 0;
    s.uvFootprint = local.uvPerLength * coneWidth / (std::max(scale, 1e-20f) * std::sqrt(cosine));

    const vec3 magnitude = glm::abs(s.position);
    float largest = std::max({magnitude.x, magnitude.y, magnitude.z, hit.distance * 0.25f});
    if (hit.instanced) {
        // Rounding in the space of the group, where a prototype may be far from its origin.
        const vec3 inGroup = glm::abs(local.position);
        largest = std::max(largest, 0.25f * scale * std::max({inGroup.x, inGroup.y, inGroup.z}));
    }
    const bool analytic = surface.shape != Surface::Shape::Triangles;
    out.offset = largest * (analytic ? 1e-4f : 4e-6f);
    out.fibreRadius = out.fibre && !flat ? local.radius * scale : 0.0f;
}

vec3 SurfacePoint::departure(const vec3& direction) const {
    const vec3& n = shading.geometricNormal;
    const float cosine = glm::dot(direction, n);
    const bool tube = fibreRadius > 0.0f;
    if (!fibre || (tube && cosine >= 0.0f))
        return shading.position + n * (cosine < 0.0f ? -offset : offset);
    // The chord of a straight tube, no longer than a few radii for directions along it.
    float inside = 0.0f;
    if (tube) {
        const float along = glm::dot(direction, shading.tangent);
        inside = 2.0f * fibreRadius * -cosine / std::max(1.0f - along * along, 0.01f);
    }
    return shading.position + direction * (inside * 1.01f + offset);
}

} // namespace patina
