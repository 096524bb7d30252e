// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/displace.h"

#include "hdDelegate/geometry/primvarEval.h"
#include "hdDelegate/geometry/tangentFrames.h"
#include "hdDelegate/parallel.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <unordered_map>

namespace patina {

namespace {

constexpr float sameNormal = 0.99f; ///< cosine, about 8 degrees
constexpr size_t manyCorners = 256; ///< at one place: then all share a normal

vec3 unitOr(const vec3& v, const vec3& fallback) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : fallback;
}

/// A hash that nobody can make points for which share a bucket: it differs from process to process.
struct PlaceHash {
    size_t operator()(const vec3& p) const {
        static const uint64_t seed =
            uint64_t(std::random_device()()) << 32 | std::random_device()();
        uint32_t bits[3];
        const vec3 q = p + 0.0f; // one zero only
        std::memcpy(bits, &q, sizeof bits);
        uint64_t h = seed;
        for (const uint32_t b : bits) { // the finalizer of splitmix64
            h = (h ^ b) + 0x9e3779b97f4a7c15u;
            h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
            h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
            h ^= h >> 31;
        }
        return size_t(h);
    }
};

/// The corners (3 * triangle + k) that meet at each place.
struct Places {
    std::vector<uint32_t> placeOf; ///< per corner
    std::vector<uint32_t> first;   ///< per place and one more: into corners
    std::vector<uint32_t> corners;

    explicit Places(const TriangleMesh& mesh) {
        std::unordered_map<vec3, uint32_t, PlaceHash> known;
        for (const uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k)
                placeOf.push_back(
                    known.emplace(mesh.positions[0][t[k]], uint32_t(known.size())).first->second);
        first.assign(known.size() + 1, 0);
        for (uint32_t place : placeOf)
            ++first[place + 1];
        for (size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        std::vector<uint32_t> next(first.begin(), first.end() - 1);
        corners.resize(placeOf.size());
        for (uint32_t c = 0; c < placeOf.size(); ++c)
            corners[next[placeOf[c]]++] = c;
    }
    size_t count() const { return first.size() - 1; }
    template <class F> void each(const F& f) const {
        parallelFor(size_t(0), count(), [&](size_t i) { f(i, first[i], first[i + 1]); });
    }
};

/// Normals of all corners times the angle of the corner.
std::vector<vec3> weightedNormals(const TriangleMesh& mesh, size_t step) {
    std::vector<vec3> result(mesh.triangles.size() * 3);
    const std::vector<vec3>& p = mesh.positions[step];
    parallelFor(size_t(0), mesh.triangles.size(), [&](size_t t) {
        const uvec3& v = mesh.triangles[t];
        const vec3 n = unitOr(glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]), vec3(0.0f));
        for (int k = 0; k < 3; ++k) {
            const vec3 a = unitOr(p[v[(k + 1) % 3]] - p[v[k]], vec3(0.0f));
            const vec3 b = unitOr(p[v[(k + 2) % 3]] - p[v[k]], vec3(0.0f));
            result[t * 3 + k] = n * std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
        }
    });
    return result;
}

class Reader : public PrimvarReader {
public:
    Reader(const TriangleMesh& mesh, const std::vector<MeshPrimvar>& primvars)
        : _mesh(mesh), _primvars(primvars) {}
    bool read(int slot, float out[4]) const override {
        return _primvars[size_t(slot)].read(_mesh, triangle, corner == 1 ? 1.0f : 0.0f,
                                            corner == 2 ? 1.0f : 0.0f, out);
    }
    unsigned triangle = 0;
    int corner = 0;

private:
    const TriangleMesh& _mesh;
    const std::vector<MeshPrimvar>& _primvars;
};

/// Data shared by all corners while a mesh is displaced.
struct Displacement {
    TriangleMesh& mesh;
    const std::vector<std::shared_ptr<const MaterialProgram>>& materials;
    const mat4& objectToWorld;
    Places places;
    std::vector<std::vector<MeshPrimvar>> primvars; ///< per material
    std::vector<const MeshAttribute*> sets; ///< that tangents follow, per material; may be null
    std::vector<vec3> before;               ///< normal of every corner, undisplaced, first step

    Displacement(TriangleMesh& m, const std::vector<std::shared_ptr<const MaterialProgram>>& list,
                 const mat4& toWorld)
        : mesh(m), materials(list), objectToWorld(toWorld), places(m) {
        for (const auto& program : materials) {
            primvars.emplace_back();
            if (program)
                for (const MaterialPrimvar& primvar : program->primvars())
                    primvars.back().emplace_back(mesh, primvar.name);
            sets.push_back(tangentSet(mesh, program ? program->displacementSet() : std::string()));
        }
        before.resize(mesh.triangles.size() * 3);
        parallelFor(size_t(0), mesh.triangles.size(), [&](size_t t) {
            for (int k = 0; k < 3; ++k)
                before[t * 3 + k] = evalNormal(mesh, unsigned(t), k == 1, k == 2);
        });
    }

    size_t materialOf(size_t triangle) const {
        const size_t subset = mesh.triangleSubset.empty() ? 0 : mesh.triangleSubset[triangle];
        return subset < materials.size() ? subset : 0;
    }

    /// @returns along tangent, bitangent and the mean normal of the place
    std::vector<vec3> amounts(const std::vector<vec3>& normals) const {
        const mat3 normalMatrix = glm::transpose(glm::inverse(mat3(objectToWorld)));
        std::vector<vec3> result(mesh.triangles.size() * 3, vec3(0.0f));
        parallelFor(size_t(0), mesh.triangles.size(), [&](size_t t) {
            const size_t material = materialOf(t);
            const MaterialProgram* program = materials[material].get();
            if (!program || !program->hasDisplacement()) return;
            Reader reader(mesh, primvars[material]);
            reader.triangle = unsigned(t);
            ShadingPoint s;
            s.primvars = &reader;
            s.objectToWorldNormal = normalMatrix;
            s.uvFootprint = footprint(t);
            const TangentFrame frame = tangentFrame(mesh, sets[material], unsigned(t));
            for (int k = 0; k < 3; ++k) {
                reader.corner = k;
                s.objectPosition = mesh.positions[0][mesh.triangles[t][k]];
                s.position = vec3(objectToWorld * vec4(s.objectPosition, 1.0f));
                const vec3& n = normals[places.placeOf[t * 3 + k]];
                s.normal = s.geometricNormal = s.viewDirection =
                    unitOr(normalMatrix * n, vec3(0, 0, 1));
                vec3 x, y;
                orthonormalBasis(s.normal, x, y);
                const vec3 along = mat3(objectToWorld) * frame.dpdu;
                s.tangent = unitOr(along - s.normal * glm::dot(s.normal, along), x);
                s.bitangent = glm::cross(s.normal, s.tangent);
                if (glm::dot(s.bitangent, mat3(objectToWorld) * frame.dpdv) < 0.0f)
                    s.bitangent = -s.bitangent;
                result[t * 3 + k] = program->displacement(s);
            }
        });
        return result;
    }

    /// Texture coordinates that one triangle covers across.
    float footprint(size_t t) const {
        const MeshAttribute* st = sets[materialOf(t)];
        if (!st) return 0.0f;
        float a[4], b[4], c[4];
        if (!evalAttribute(mesh, *st, unsigned(t), 0, 0, a) ||
            !evalAttribute(mesh, *st, unsigned(t), 1, 0, b) ||
            !evalAttribute(mesh, *st, unsigned(t), 0, 1, c))
            return 0.0f;
        return std::sqrt(std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
    }

    /// The mean normal of each place.
    std::vector<vec3> placeNormals(size_t step) const {
        const std::vector<vec3> faces = weightedNormals(mesh, step);
        std::vector<vec3> result(places.count());
        places.each([&](size_t place, uint32_t from, uint32_t to) {
            vec3 sum(0.0f);
            for (uint32_t i = from; i < to; ++i) {
                const uint32_t c = places.corners[i];
                // Smooth normals know the surface better than its faces.
                const float angle = glm::length(faces[c]);
                sum += step == 0 ? before[c] * angle : faces[c];
            }
            result[place] = unitOr(sum, before[places.corners[from]]);
        });
        return result;
    }

    void move(size_t step, const std::vector<vec3>& amount, const std::vector<vec3>& normals) {
        std::vector<vec3> shift(places.count());
        places.each([&](size_t place, uint32_t from, uint32_t to) {
            vec3 sum(0.0f);
            for (uint32_t i = from; i < to; ++i) {
                const uint32_t c = places.corners[i];
                sum += normals[place] * amount[c].z;
                if (amount[c].x == 0.0f && amount[c].y == 0.0f) continue;
                const TangentFrame frame = tangentFrame(mesh, sets[materialOf(c / 3)], c / 3, step);
                vec3 x, y;
                orthonormalBasis(normals[place], x, y);
                const vec3& n = normals[place];
                const vec3 tangent = unitOr(frame.dpdu - n * glm::dot(n, frame.dpdu), x);
                vec3 bitangent = glm::cross(n, tangent);
                if (glm::dot(bitangent, frame.dpdv) < 0.0f) bitangent = -bitangent;
                sum += tangent * amount[c].x + bitangent * amount[c].y;
            }
            shift[place] = sum / float(to - from);
        });
        std::vector<char> done(mesh.positions[step].size(), 0);
        for (size_t c = 0; c < places.placeOf.size(); ++c) {
            const uint32_t vertex = mesh.triangles[c / 3][c % 3];
            if (!done[vertex]) mesh.positions[step][vertex] += shift[places.placeOf[c]];
            done[vertex] = 1;
        }
    }

    std::vector<vec3> after(size_t step) const {
        const std::vector<vec3> faces = weightedNormals(mesh, step);
        std::vector<vec3> result(faces.size());
        places.each([&](size_t, uint32_t from, uint32_t to) {
            const bool all = to - from > manyCorners;
            vec3 whole(0.0f);
            for (uint32_t i = from; all && i < to; ++i)
                whole += faces[places.corners[i]];
            for (uint32_t i = from; i < to; ++i) {
                const uint32_t c = places.corners[i];
                vec3 sum = whole;
                for (uint32_t j = from; !all && j < to; ++j) {
                    const uint32_t other = places.corners[j];
                    if (glm::dot(before[c], before[other]) > sameNormal) sum += faces[other];
                }
                result[c] = unitOr(sum, before[c]);
            }
        });
        return result;
    }
};

} // namespace

void displace(TriangleMesh& mesh,
              const std::vector<std::shared_ptr<const MaterialProgram>>& materials,
              const mat4& objectToWorld) {
    if (mesh.triangles.empty() || materials.empty()) return;
    Displacement d(mesh, materials, objectToWorld);
    std::vector<vec3> amount;
    std::vector<std::vector<vec3>> normals;
    for (size_t step = 0; step < mesh.positions.size(); ++step) {
        const std::vector<vec3> along = d.placeNormals(step);
        if (step == 0) amount = d.amounts(along);
        d.move(step, amount, along);
    }
    mesh.boundsMin = vec3(INFINITY);
    mesh.boundsMax = vec3(-INFINITY);
    for (size_t step = 0; step < mesh.positions.size(); ++step) {
        normals.push_back(d.after(step));
        for (const vec3& p : mesh.positions[step]) {
            mesh.boundsMin = glm::min(mesh.boundsMin, p);
            mesh.boundsMax = glm::max(mesh.boundsMax, p);
        }
    }
    mesh.normals = std::move(normals);
    mesh.normalRate = MeshAttribute::Rate::PerCorner;
}

} // namespace patina
