#pragma once

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/scene/fieldGrid.h"
#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <cmath>
#include <functional>
#include <map>
#include <memory>

namespace patina {

/// The medium of a volume prim: fields, the material that reads them, and how dense it can get.
class VolumeMedium {
public:
    VolumeMedium(const Volume& prim, std::shared_ptr<const MaterialProgram> program,
                 Diagnostics& diagnostics);

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

/// All volume prims of a scene. Collisions are found by delta tracking with a majorant per cell,
/// transmittance by ratio tracking (Novak et al. 2014); colours follow Kutz et al. 2017, Spectral
/// and Decomposition Tracking. Volumes that overlap add up.
class VolumeScene {
public:
    using ProgramOf =
        std::function<std::shared_ptr<const MaterialProgram>(const Volume&, const Network&)>;
    using PlacesOf = std::function<std::vector<mat4>(const std::string& group)>;

    /// Takes over the volumes of a scene. What did not change is kept.
    /// @param open time of the shutter's opening; volumes stand still
    void update(const std::vector<std::shared_ptr<const Volume>>& prims, const ProgramOf& programOf,
                const PlacesOf& placesOf, float open, Diagnostics& diagnostics);

    bool empty() const { return _placed.empty(); }
    vec3 boundsMin() const { return _min; } ///< world
    vec3 boundsMax() const { return _max; }

    struct Collision {
        bool scattered = false, absorbed = false;
        float distance = 0.0f; ///< of the collision, or the end
        Medium medium;
        vec3 emitted{0.0f}; ///< radiance that reaches the origin, times the throughput there
    };
    /// Takes light along a ray up to where it scatters, or the end.
    /// @param throughput is multiplied by what remains
    Collision track(const vec3& origin, const vec3& direction, float end, bool camera,
                    vec3& throughput, Sampler& sampler) const;

    /// An estimate of the transmittance; its mean is exact.
    vec3 transmittance(const vec3& origin, const vec3& direction, float end, bool shadow,
                       Sampler& sampler) const;

private:
    struct Placed {
        std::shared_ptr<const VolumeMedium> medium;
        mat4 worldToObject{1.0f};
        Visibility visibility;
    };
    struct Cached {
        std::shared_ptr<const Volume> prim;
        std::shared_ptr<const MaterialProgram> program;
        std::shared_ptr<const VolumeMedium> medium;
    };
    class Tracker;
    std::vector<Placed> _placed;
    std::map<std::string, Cached> _cache;
    vec3 _min{INFINITY}, _max{-INFINITY};
};

} // namespace patina
