// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/fieldGrids.h"
#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// A grey medium of density 1 that scatters 0.8 of the light that it meets: what volumes without a
/// material show.
Network plainVolume();

/// The medium of a volume prim: fields, the material that reads them, and how dense it can get.
class VolumeMedium {
public:
    /// @param grids of the scene; null: the fields are read for this medium alone
    VolumeMedium(const Volume& prim, std::shared_ptr<const MaterialProgram> program,
                 Diagnostics& diagnostics, FieldGrids* grids = nullptr);

    bool empty() const { return _cells.empty(); }
    Medium at(const vec3& objectPosition) const;
    vec3 boundsMin() const { return _min; }
    vec3 boundsMax() const { return _max; }
    ivec3 cellCount() const { return _count; }
    /// The largest extinction of any channel in a cell.
    float majorant(const ivec3& cell) const {
        return _cells[(size_t(cell.x) * _count.y + cell.y) * _count.z + cell.z];
    }

private:
    class Reader;
    Medium evaluate(const vec3& objectPosition, const std::vector<vec3>& values) const;
    void measure();

    struct Field {
        std::string name;
        std::shared_ptr<const FieldGrid> grid;
    };
    std::vector<Field> _fields;
    std::shared_ptr<const MaterialProgram> _program;
    std::vector<int> _slots; ///< per primvar of the program: the field, or -1
    int _density = -1;       ///< field that scales everything; -1: the material reads fields itself
    vec3 _min{0.0f}, _max{0.0f};
    ivec3 _count{0};
    std::vector<float> _cells;
};

} // namespace patina
