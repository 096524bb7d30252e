// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterEmitters.h"

#include "hdDelegate/geometry/primvarEval.h"
#include "hdDelegate/parallel.h"
#include "materialNetwork/cpu/programCode.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {
constexpr size_t manyTriangles = 20000; ///< that are looked at in one place each

vec3 unitOr(const vec3& v, const vec3& fallback) {
    const float length = glm::length(v);
    return length > 1e-30f && std::isfinite(length) ? v / length : fallback;
}

/// Whether what a program emits may depend on where it is seen from.
bool dependsOnView(const ProgramCode& code) {
    return !code.emissionCode.empty() ||
           std::any_of(code.edf.begin(), code.edf.end(), [](const ClosureOp& op) {
               return op.kind == ClosureKind::ConicalEdf || op.kind == ClosureKind::SchlickEdf ||
                      op.kind == ClosureKind::MeasuredEdf;
           });
}

/// Own normals of the cones that a program emits by at a point.
std::vector<vec3> coneAxes(const ProgramCode& code, const ShadingPoint& point) {
    RegisterFile registers(code);
    registers.run(code, code.emissionCode, point);
    std::vector<vec3> out;
    for (const ClosureOp& op : code.edf)
        if (op.kind == ClosureKind::ConicalEdf)
            out.push_back(op.normal < 0 ? point.normal
                                        : unitOr(vec3(registers.data()[op.normal]), point.normal));
    return out;
}

} // namespace

/// A place on a triangle of a source, as the path tracer's computeSurfacePoint() has it.
class RasterEmitters::Place : public PrimvarReader {
public:
    Place(const Source& source, unsigned triangle, const vec2& uv)
        : _source(source), _triangle(triangle), _uv(uv) {
        const TriangleMesh& mesh = *source.mesh;
        const uvec3& t = mesh.triangles[triangle];
        const std::vector<vec3>& p = mesh.positions[0];
        ShadingPoint& s = shading;
        s.primvars = this;
        s.objectPosition = p[t.x] * (1.0f - uv.x - uv.y) + p[t.y] * uv.x + p[t.z] * uv.y;
        s.position = source.origin + vec3(source.toWorld * vec4(s.objectPosition, 1.0f));
        const vec3 flat = unitOr(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]), vec3(0, 0, 1));
        s.geometricNormal = unitOr(source.normalMatrix * flat, vec3(0, 0, 1));
        s.normal =
            unitOr(source.normalMatrix * evalNormal(mesh, triangle, uv.x, uv.y), s.geometricNormal);
        if (glm::dot(s.normal, s.geometricNormal) < 0.0f) s.normal = -s.normal;
        const TangentFrame frame = tangentFrame(mesh, source.tangents, triangle);
        const mat3 linear(source.toWorld);
        vec3 tangent = linear * frame.dpdu;
        tangent -= s.normal * glm::dot(s.normal, tangent);
        const float length = glm::length(tangent);
        if (frame.fromTexture && length > 1e-20f && std::isfinite(length)) {
            s.tangent = tangent / length;
            const vec3 across = glm::cross(s.normal, s.tangent);
            s.bitangent = glm::dot(across, linear * frame.dpdv) < 0.0f ? -across : across;
        } else {
            orthonormalBasis(s.normal, s.tangent, s.bitangent);
        }
        s.objectToWorldNormal = source.normalMatrix;
        if (frame.fromTexture)
            s.lengthPerUv =
                std::sqrt(glm::length(linear * frame.dpdu) * glm::length(linear * frame.dpdv));
        axis = s.normal;
        x = s.tangent;
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    bool read(int slot, float out[4]) const override {
        const MeshPrimvar& primvar = _source.primvars[size_t(slot)];
        if (primvar.attribute) return primvar.read(*_source.mesh, _triangle, _uv.x, _uv.y, out);
        return readInstances(_source.steps.data(), int(_source.steps.size()),
                             _source.program->primvars()[size_t(slot)].name, out);
    }

    /// Radiance towards a direction, as SceneLights::triangleRadiance() has it.
    vec3 towards(const vec3& direction) {
        const RasterMeshLight& light = _source.light;
        shading.viewDirection = direction;
        const bool front = glm::dot(shading.geometricNormal, direction) > 0.0f;
        const vec3 lit = front ? light.radiance : vec3(0.0f);
        float presence = 1.0f;
        if (!_source.program->isOpaque()) _source.program->opacity(shading, nullptr, &presence);
        vec3 sum = lit;
        if (_source.glows && light.mode != RasterMeshLight::NoMaterialResponse) {
            const vec3 glow = glm::max(_source.program->emission(shading, direction), vec3(0.0f));
            sum = light.mode == RasterMeshLight::NoLight          ? glow
                  : light.mode == RasterMeshLight::GlowTintsLight ? lit * glow
                                                                  : lit + glow;
        }
        sum *= presence;
        return std::isfinite(sum.x + sum.y + sum.z) ? sum : vec3(0.0f);
    }
    /// The same by angles about the axis.
    vec3 towards(float theta, float turn) {
        const float s = std::sin(theta);
        const vec3 d = axis * std::cos(theta) + x * (s * std::cos(turn)) +
                       glm::cross(axis, x) * (s * std::sin(turn));
        return towards(glm::normalize(d));
    }

    /// A narrow cone that is inclined shows itself about its own axis. @returns whether it has any
    bool aimAtCone() {
        if (!_source.glows || _source.light.mode == RasterMeshLight::NoMaterialResponse)
            return false;
        const std::vector<vec3> axes = coneAxes(_source.program->code(), shading);
        if (axes.empty()) return false;
        if (glm::dot(axes[0], axis) < 0.99999f) {
            vec3 across;
            axis = axes[0];
            orthonormalBasis(axis, x, across);
        }
        for (const vec3& other : axes)
            if (glm::dot(other, axis) < 0.99999f) otherAxes.push_back(other);
        return true;
    }

    /// Mean by solid angle over what a value of a table is interpolated for, so that all light of
    /// an edge is kept.
    /// @param steps between values of both angles; 0: of a table without turns
    /// @param parts of a step
    vec3 mean(float theta, float turn, const vec2& steps, int parts) {
        vec3 sum(0.0f);
        float weights = 0.0f;
        const int across = steps.y > 0.0f ? parts : 0;
        for (int k = -across; k < std::max(across, 1); ++k) {
            const float beside = across > 0 ? (float(k) + 0.5f) / float(across) : 0.0f;
            // Edges mostly run along turns: each looks at angles of its own (golden ratio).
            const float shift = glm::fract(0.5f + 0.618034f * float(k + across));
            for (int j = -parts; j < parts; ++j) {
                const float offset = (float(j) + shift) / float(parts);
                const float at = theta + steps.x * offset;
                if (at < 0.0f || at > pi) continue;
                const float weight =
                    (1.0f - std::fabs(beside)) * (1.0f - std::fabs(offset)) * std::sin(at);
                sum += weight * towards(at, turn + steps.y * beside);
                weights += weight;
            }
        }
        return sum / weights;
    }

    ShadingPoint shading;
    vec3 axis{0, 0, 1}, x{1, 0, 0}; ///< the shading normal and tangent, or those of a cone
    std::vector<vec3> otherAxes;    ///< of further cones

private:
    const Source& _source;
    unsigned _triangle;
    vec2 _uv;
};

void RasterEmitters::clear() {
    _sources.clear();
    _glowing.clear();
    _sums.clear();
}

RasterEmitter RasterEmitters::emitterOf(const Source& source, unsigned triangle) {
    vec3 p[3];
    for (int k = 0; k < 3; ++k)
        p[k] = vec3(source.toWorld *
                    vec4(source.mesh->positions[0][source.mesh->triangles[triangle][k]], 1.0f));
    RasterEmitter e;
    e.corner = p[0];
    e.edge1 = p[1] - p[0];
    e.edge2 = p[2] - p[0];
    e.area = 0.5f * glm::length(glm::cross(e.edge1, e.edge2));
    e.twoSided = source.twoSided;
    e.mirrored = source.mirrored;
    e.category = source.category;
    e.triangle = triangle;
    return e;
}

/// Mean luminance over some places and directions, by which triangles are chosen.
float RasterEmitters::brightness(const Source& source, unsigned triangle, bool coarse) const {
    static const vec2 places[] = {vec2(1 / 3.0f), vec2(0.1f), vec2(0.8f, 0.1f), vec2(0.1f, 0.8f)};
    float sum = 0.0f;
    const int count = coarse ? 1 : 4;
    for (int i = 0; i < count; ++i) {
        Place place(source, triangle, places[i]);
        if (source.even && !source.sides) {
            sum += luminance(glm::abs(place.towards(0.0f, 0.0f)));
            continue;
        }
        place.aimAtCone();
        // Light that leaves at an angle counts by its cosine.
        float front = 0.0f, back = 0.0f, weights = 0.0f;
        for (const float theta : {0.05f, 0.5f, 0.9f, 1.3f}) {
            const float weight = std::cos(theta) * std::sin(theta);
            front += weight * luminance(glm::abs(place.towards(theta, 1.0f)));
            back += weight * luminance(glm::abs(place.towards(pi - theta, 1.0f)));
            weights += weight;
        }
        sum += 0.5f * (front + back) / weights;
    }
    return sum / float(count);
}

void RasterEmitters::add(const std::shared_ptr<const TriangleMesh>& mesh, size_t subset,
                         const std::shared_ptr<const MaterialProgram>& program,
                         const RasterMeshLight& light, const mat4& toWorld, int category,
                         bool closed, const vec3& origin, const std::vector<InstanceStep>& steps,
                         size_t place) {
    Source source;
    source.glows = program->hasEmission();
    if (source.glows && light.mode == RasterMeshLight::Independent && !light.filtered.empty()) {
        // Filters change the light, and not the glow beside it.
        RasterMeshLight part = light;
        part.mode = RasterMeshLight::NoMaterialResponse;
        add(mesh, subset, program, part, toWorld, category, closed, origin, steps, place);
        part = RasterMeshLight();
        add(mesh, subset, program, part, toWorld, category, closed, origin, steps, place);
        return;
    }
    if (!source.glows && light.mode == RasterMeshLight::NoLight) return;
    const bool usesGlow = source.glows && light.mode != RasterMeshLight::NoMaterialResponse;
    const bool constant = !usesGlow || program->code().emissionCode.empty();
    source.mesh = mesh;
    source.program = program;
    source.light = light;
    source.toWorld = toWorld;
    source.normalMatrix = glm::transpose(glm::inverse(mat3(toWorld)));
    source.origin = origin;
    source.steps = steps;
    source.tangents = tangentSet(*mesh, program->tangentSet());
    source.even = (!usesGlow || !dependsOnView(program->code())) && program->isOpaque();
    source.sides = light.mode == RasterMeshLight::Independent || !source.even;
    for (const MaterialPrimvar& primvar : program->primvars())
        source.primvars.emplace_back(*mesh, primvar.name);
    source.mirrored = glm::determinant(mat3(toWorld)) < 0.0f;
    source.twoSided =
        source.glows && !closed &&
        (light.mode == RasterMeshLight::NoLight || light.mode == RasterMeshLight::Independent);
    source.category = category;
    source.place = place;
    // Their areas, too.
    std::vector<std::pair<unsigned, float>> candidates;
    for (size_t t = 0; t < mesh->triangles.size(); ++t) {
        if (_glowing.size() + candidates.size() >= maxTriangles) break;
        const size_t own = t < mesh->triangleSubset.size() ? mesh->triangleSubset[t] : 0;
        if (own != subset) continue;
        const float area = emitterOf(source, unsigned(t)).area;
        if (area > 0.0f && std::isfinite(area)) candidates.emplace_back(unsigned(t), area);
    }
    std::vector<float> bright(candidates.size(), 1.0f);
    if (constant && !bright.empty()) {
        std::fill(bright.begin(), bright.end(), brightness(source, candidates[0].first, true));
    } else {
        const bool coarse = bright.size() > manyTriangles;
        parallelFor(size_t(0), bright.size(),
                    [&](size_t i) { bright[i] = brightness(source, candidates[i].first, coarse); });
    }
    // A triangle that was not found bright may be bright elsewhere.
    double mean = 0.0;
    for (const float b : bright)
        mean += double(b) / double(bright.size());
    const double minimum = constant && source.even ? 0.0 : std::max(0.02 * mean, 1e-6);
    const size_t first = _glowing.size(), most = first + candidates.size();
    if (most > _glowing.capacity()) { // meshes are few and large, or many and small
        _glowing.reserve(std::max(most, std::min(2 * first, maxTriangles)));
        _sums.reserve(_glowing.capacity());
    }
    for (size_t i = 0; i < bright.size(); ++i) {
        const auto [triangle, area] = candidates[i];
        const double power = double(area) * (double(bright[i]) + minimum);
        if (!(power > 0.0) || !std::isfinite(power)) continue;
        _sums.push_back((_sums.empty() ? 0.0 : _sums.back()) + power);
        _glowing.push_back({triangle, int(_sources.size())});
    }
    if (_glowing.size() > first) _sources.push_back(std::move(source));
}

/// Replaces values beside an edge, and those about the axes of cones that may lie between values,
/// by means.
void RasterEmitters::softenEdges(Place& place, const vec2& steps, RasterEmission& out) {
    const int thetas = out.stepsOfTheta, turns = out.stepsOfTurn - 1;
    const std::vector<vec3> plain = out.values;
    std::vector<bool> soft(plain.size(), false);
    const auto at = [&](int theta, int turn) {
        return size_t((turn + turns) % turns * thetas + std::clamp(theta, 0, thetas - 1));
    };
    for (int k = 0; k < turns; ++k)
        for (int i = 0; i < thetas; ++i)
            for (const vec2& to : {vec2(1, 0), vec2(0, 1), vec2(1, 1), vec2(1, -1)}) {
                const size_t other = at(i + int(to.x), k + int(to.y));
                const vec3 &a = plain[at(i, k)], &b = plain[other];
                if (glm::length(a - b) > 0.02f * std::max(glm::length(a), glm::length(b)))
                    soft[at(i, k)] = soft[other] = true;
            }
    const vec3 y = glm::cross(place.axis, place.x);
    for (const vec3& other : place.otherAxes) {
        const float theta = std::acos(std::clamp(glm::dot(other, place.axis), -1.0f, 1.0f));
        const float turn = std::atan2(glm::dot(other, y), glm::dot(other, place.x)) + 2.0f * pi;
        for (int k = -1; k <= 2; ++k)
            for (int i = -1; i <= 2; ++i)
                soft[at(int(theta / steps.x) + i, int(turn / steps.y) + k)] = true;
    }
    for (int k = 0; k < turns; ++k)
        for (int i = 0; i < thetas; ++i)
            if (soft[at(i, k)])
                out.values[at(i, k)] = place.mean(steps.x * float(i), steps.y * float(k), steps, 4);
    std::copy_n(out.values.begin(), thetas, out.values.end() - thetas);
}

RasterEmission RasterEmitters::emission(const RasterEmitter& e, const vec2& uv) const {
    const Source& source = _sources[size_t(e.source)];
    RasterEmission out;
    Place place(source, e.triangle, uv);
    if (source.even && !source.sides) {
        out.radiance = place.towards(0.0f, 0.0f);
        return out;
    }
    const bool cones = place.aimAtCone();
    out.axis = place.axis;
    out.x = place.x;
    out.y = glm::cross(out.axis, out.x);
    // Angles to the axis alone, unless other cones or some directions tell otherwise.
    bool round = place.otherAxes.empty(), flat = !cones;
    const vec3 along = place.towards(0.0f, 0.0f);
    for (const float theta : {0.05f, 0.2f, 0.4f, 0.9f, 1.3f, 1.8f, 2.5f}) {
        const vec3 first = place.towards(theta, 0.7f);
        const float scale = 1e-4f * std::fabs(luminance(first)) + 1e-20f;
        flat &= glm::length(first - along) <= scale;
        for (const float turn : {1.3f, 2.9f, 3.8f, 5.1f})
            round &= glm::length(place.towards(theta, turn) - first) <= scale;
    }
    if (round && flat && source.program->code().emissionCode.empty()) {
        out.radiance = along;
        return out;
    }
    const bool several = !place.otherAxes.empty();
    out.stepsOfTheta = round || several ? RasterEmission::thetas : RasterEmission::turnThetas;
    out.stepsOfTurn = round ? 1 : several ? RasterEmission::coneTurns : RasterEmission::turns;
    const vec2 steps(pi / float(out.stepsOfTheta - 1),
                     round ? 0.0f : 2.0f * pi / float(out.stepsOfTurn - 1));
    for (int k = 0; k < out.stepsOfTurn; ++k)
        for (int i = 0; i < out.stepsOfTheta; ++i) {
            const float theta = steps.x * float(i), turn = steps.y * float(k);
            out.values.push_back(cones && round ? place.mean(theta, turn, steps, 8)
                                                : place.towards(theta, turn));
        }
    if (several) softenEdges(place, steps, out);
    return out;
}

RasterEmitter RasterEmitters::choose(float u, float& within, float& chance) const {
    const double at = double(u) * _sums.back();
    const size_t i = std::min(
        size_t(std::upper_bound(_sums.begin(), _sums.end(), at) - _sums.begin()), _sums.size() - 1);
    const double before = i > 0 ? _sums[i - 1] : 0.0, own = _sums[i] - before;
    within = std::clamp(float((at - before) / own), 0.0f, 0.9999999f);
    chance = float(own / _sums.back());
    RasterEmitter out = emitterOf(_sources[size_t(_glowing[i].source)], _glowing[i].triangle);
    out.source = _glowing[i].source;
    const Source& source = _sources[size_t(out.source)];
    if (!source.light.filtered.empty()) out.filtered = &source.light.filtered;
    out.place = source.place;
    return out;
}

} // namespace patina
