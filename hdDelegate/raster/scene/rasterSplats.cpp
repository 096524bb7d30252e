// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterSplats.h"

#include "hdDelegate/scene/instancerCheck.h"
#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>

namespace patina {

namespace {

struct GpuSplatPlace {
    mat4 toLocal;
    glm::ivec4 harmonics; ///< first float, coefficients of a particle, first row of colours, matte
    glm::ivec4 ids;       ///< primId
};

// As shaders/raster/splats.frag.glsl reads a table of colours.
constexpr int tableRows = 4096;
constexpr float tableEnd = 16.0f;

size_t mostBytes() {
    GLint64 limit = 0;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
    return size_t(std::clamp<GLint64>(limit, 1 << 24, INT32_MAX));
}

} // namespace

size_t RasterSplats::mostEntries() {
    constexpr size_t most = size_t(1) << 28; // bytes that a pass may write for its list
    return std::min(mostBytes(), most) / (2 * sizeof(uint32_t));
}

/// Three rows of numbers that add up to the colour in the rendering space: of red, green and blue.
/// Exact for a curve before a matrix, which is what colour spaces are.
void RasterSplats::addTable(Prim& prim, std::vector<vec4>& rows) const {
    if (!prim.toRendering) return;
    prim.table = int(rows.size());
    vec4 black(0.0f);
    prim.toRendering->apply(&black.x, 1, 4);
    for (int channel = 0; channel < 3; ++channel)
        for (int i = 0; i < tableRows; ++i) {
            const float x = float(i) / float(tableRows - 1);
            vec4 row(0.0f);
            row[channel] = tableEnd * x * x;
            prim.toRendering->apply(&row.x, 1, 4);
            rows.push_back(channel == 0 ? row : row - black);
        }
}

void RasterSplats::end() {
    const size_t limit = mostBytes();
    std::vector<SplatKernel> kernels;
    std::vector<vec3> harmonics;
    std::vector<vec4> tables;
    std::map<std::shared_ptr<const SplatCloud>, Cloud> clouds;
    bool same = true;
    for (Prim& prim : _prims) {
        const auto known = _clouds.find(prim.prim->cloud);
        same &= known != _clouds.end();
        clouds[prim.prim->cloud];
        addTable(prim, tables);
    }
    if (!same || clouds.size() != _clouds.size()) {
        for (auto& [source, cloud] : clouds) {
            cloud.kernels = _compiled.kernels(source);
            const auto& list = cloud.kernels->list();
            const size_t stride = std::min(source->stride(), size_t(shSplats::SPLAT_BASIS));
            const size_t coefficients =
                source->harmonics.empty() ? 0 : source->positions.size() * stride;
            if ((kernels.size() + list.size()) * sizeof(SplatKernel) > limit ||
                (harmonics.size() + coefficients) * sizeof(vec3) > limit) {
                cloud.kernels = nullptr;
                continue;
            }
            cloud.firstKernel = uint32_t(kernels.size());
            kernels.insert(kernels.end(), list.begin(), list.end());
            if (coefficients == 0) continue;
            cloud.firstCoefficient = int(3 * harmonics.size());
            cloud.coefficients = int(stride);
            for (size_t i = 0; i < source->positions.size(); ++i) {
                const auto first = source->harmonics.begin() + std::ptrdiff_t(i * source->stride());
                harmonics.insert(harmonics.end(), first, first + std::ptrdiff_t(stride));
            }
        }
        _clouds = std::move(clouds);
        _kernelBuffer = GlBuffer(kernels);
        _harmonicBuffer = GlBuffer(harmonics);
    }
    for (Prim& prim : _prims) {
        prim.cloud = _clouds.at(prim.prim->cloud);
        if (!prim.cloud.kernels) _diagnostics.warn(prim.prim->path, "", messages::notInRaster);
    }
    _tableBuffer = GlBuffer(tables);
}

void RasterSplats::moveTo(RasterInstances& places, float timeCode) {
    std::vector<GpuSplatPlace> rows;
    _placed.clear();
    _min = vec3(INFINITY);
    _max = vec3(-INFINITY);
    size_t entries = 0;
    const size_t most = mostEntries();
    for (const Prim& prim : _prims) {
        const Cloud& cloud = prim.cloud;
        if (!cloud.kernels || cloud.kernels->list().empty()) continue;
        dmat4 toGroup = exactTransformAt(prim.prim->transform, timeCode);
        toGroup[3] = toGroup * glm::dvec4(cloud.kernels->middle(), 1.0);
        bool unusable = false, tooMany = false;
        for (const RasterPlace& place : places.places(prim.prim->group)) {
            RasterSplatPlace here{cloud.kernels, mat4(place.groupToWorld * toGroup), mat4(1.0f),
                                  cloud.firstKernel};
            unusable |= !hasInverse(here.toWorld);
            tooMany |= entries + cloud.kernels->list().size() > most;
            if (!hasInverse(here.toWorld) || tooMany) continue;
            entries += cloud.kernels->list().size();
            here.toLocal = glm::inverse(here.toWorld);
            for (int corner = 0; corner < 8; ++corner) {
                const vec3 low = cloud.kernels->boundsMin(), high = cloud.kernels->boundsMax();
                const vec3 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                             corner & 4 ? high.z : low.z);
                const vec3 world = vec3(here.toWorld * vec4(p, 1.0f));
                _min = glm::min(_min, world);
                _max = glm::max(_max, world);
            }
            const bool matte = prim.prim->catching.matte || place.matte;
            rows.push_back({here.toLocal,
                            {cloud.firstCoefficient, cloud.coefficients, prim.table, matte},
                            {prim.id, 0, 0, 0}});
            _placed.push_back(std::move(here));
        }
        if (unusable)
            _diagnostics.warn(prim.prim->path, "transform", messages::splatsWithoutInverse);
        if (tooMany) _diagnostics.warn(prim.prim->path, "", messages::notInRaster);
    }
    if (!rows.empty()) _placeBuffer = GlBuffer(rows);
}

void RasterSplats::bind() const {
    _kernelBuffer.bindStorage(0);
    _harmonicBuffer.bindStorage(1);
    _placeBuffer.bindStorage(2);
    _tableBuffer.bindStorage(12);
}

} // namespace patina
