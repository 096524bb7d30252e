// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/volumeMedium.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxCells = 64;  ///< along an axis
constexpr int maxCorners = 6; ///< fields whose extremes are combined for a majorant

float largest(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

} // namespace

Network plainVolume() {
    Network network;
    network.path = "<volume>";
    NetworkNode volume, vdf;
    volume.path = "<volume>/volume";
    volume.id = "ND_volume";
    volume.connections["vdf"] = {"<volume>/vdf", ""};
    vdf.path = "<volume>/vdf";
    vdf.id = "ND_anisotropic_vdf";
    // White would scatter light for as long as the path may get.
    constexpr float albedo = 0.8f;
    vdf.inputs["scattering"] = Value::makeVec3(albedo, albedo, albedo);
    vdf.inputs["absorption"] = Value::makeVec3(1 - albedo, 1 - albedo, 1 - albedo);
    network.terminals["volume"] = {volume.path, ""};
    network.nodes = {volume, vdf};
    return network;
}

class VolumeMedium::Reader : public PrimvarReader {
public:
    Reader(const VolumeMedium& medium, const std::vector<vec3>& values)
        : _medium(medium), _values(values) {}
    bool read(int slot, float out[4]) const override {
        const int field = _medium._slots[size_t(slot)];
        if (field < 0) return false;
        for (int c = 0; c < 3; ++c)
            out[c] = _values[size_t(field)][c];
        out[3] = 1.0f;
        return true;
    }

private:
    const VolumeMedium& _medium;
    const std::vector<vec3>& _values;
};

VolumeMedium::VolumeMedium(const Volume& prim, std::shared_ptr<const MaterialProgram> program,
                           Diagnostics& diagnostics, FieldGrids* grids)
    : _program(std::move(program)) {
    for (const VolumeField& f : prim.fields) {
        auto grid = f.grid  ? f.grid
                    : grids ? grids->read(f.file, f.field, prim.path, diagnostics)
                            : readFieldGrid(f.file, f.field, prim.path, diagnostics);
        if (grid) _fields.push_back({f.name, std::move(grid)});
    }
    const auto find = [&](const std::string& name) {
        for (size_t i = 0; i < _fields.size(); ++i)
            if (_fields[i].name == name) return int(i);
        return -1;
    };
    bool reads = false;
    for (const MaterialPrimvar& primvar : _program->primvars()) {
        _slots.push_back(find(primvar.name));
        reads |= _slots.back() >= 0;
    }
    if (!reads) {
        _density = find("density");
        if (_density < 0 && !_fields.empty()) _density = 0;
    }
    if (_fields.empty())
        diagnostics.warn(prim.path, "field", messages::volumeWithoutField);
    else
        measure();
}

Medium VolumeMedium::evaluate(const vec3& objectPosition, const std::vector<vec3>& values) const {
    const Reader reader(*this, values);
    ShadingPoint point;
    point.position = point.objectPosition = objectPosition;
    point.primvars = &reader;
    Medium medium = _program->interior(point);
    if (_density < 0) return medium;
    constexpr float largest = 1e15f; // as of the coefficients of materials
    const vec3 scale = glm::max(values[size_t(_density)], vec3(0.0f));
    const auto scaled = [&](const vec3& v) { return glm::min(v * scale, vec3(largest)); };
    medium.absorption = scaled(medium.absorption);
    medium.emission = scaled(medium.emission);
    for (int i = 0; i < medium.phaseCount; ++i)
        medium.phases[i].scattering = scaled(medium.phases[i].scattering);
    return medium;
}

Medium VolumeMedium::at(const vec3& objectPosition) const {
    thread_local std::vector<vec3> values;
    values.resize(_fields.size());
    for (size_t i = 0; i < _fields.size(); ++i)
        values[i] = _fields[i].grid->sample(objectPosition);
    return evaluate(objectPosition, values);
}

/// The majorant of a cell is the extinction at all combinations of the least and largest values of
/// the fields there: right for materials that rise or fall with each field. Where a material
/// differs from place to place as well, it is asked at 27 places. What lies between them, and
/// fields beyond the sixth, may be denser: VolumeScene takes it as thin as the majorant.
void VolumeMedium::measure() {
    _min = vec3(INFINITY);
    _max = vec3(-INFINITY);
    ivec3 bricks(1);
    for (const Field& f : _fields) {
        _min = glm::min(_min, f.grid->boundsMin());
        _max = glm::max(_max, f.grid->boundsMax());
        bricks = glm::max(bricks, f.grid->brickCount());
    }
    if (!std::isfinite(_min.x + _min.y + _min.z + _max.x + _max.y + _max.z)) return;
    _count = glm::min(bricks, ivec3(maxCells));
    const vec3 size = (_max - _min) / vec3(_count);
    std::vector<float> cells(size_t(_count.x) * _count.y * _count.z);
    parallelFor(size_t(0), cells.size(), [&](size_t i) {
        const vec3 cell(float(i / (size_t(_count.y) * _count.z)),
                        float(i / size_t(_count.z) % size_t(_count.y)),
                        float(i % size_t(_count.z)));
        const vec3 lower = _min + cell * size, upper = lower + size;
        std::vector<vec3> minimum, maximum, values(_fields.size());
        for (const Field& f : _fields) {
            minimum.push_back(vec3(INFINITY));
            maximum.push_back(vec3(-INFINITY));
            f.grid->range(lower, upper, minimum.back(), maximum.back());
        }
        const int combined = std::min(int(_fields.size()), maxCorners);
        float majorant = 0.0f;
        for (int corner = 0; corner < 1 << combined; ++corner) {
            for (size_t f = 0; f < _fields.size(); ++f)
                values[f] = int(f) >= combined || (corner >> f & 1) ? maximum[f] : minimum[f];
            const auto ask = [&](const vec3& place) {
                const Medium m = evaluate(lower + place * size, values);
                // A medium that only glows needs points along the ray, too.
                const float glow = m.emission == vec3(0.0f) ? 0.0f : 2.0f / glm::length(size);
                majorant = std::max({majorant, largest(m.extinction()), glow});
                return m.extinction();
            };
            const vec3 middle = ask(vec3(0.5f));
            if (ask(vec3(0.1f, 0.35f, 0.8f)) == middle && ask(vec3(0.7f, 0.9f, 0.2f)) == middle)
                continue;
            for (int place = 0; place < 27; ++place)
                ask(vec3(float(place % 3), float(place / 3 % 3), float(place / 9)) * 0.5f);
        }
        cells[i] = majorant;
    });
    _cells = std::move(cells);
}

} // namespace patina
