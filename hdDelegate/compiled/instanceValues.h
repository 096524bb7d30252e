// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

#include <string>
#include <vector>

namespace patina {

/// Primvars of the instances of one instancer, ready to be read. They stand in for primvars that
/// prims of its prototypes lack, as primvars of ancestors do. Immutable.
class InstanceValues {
public:
    /// The primvar that every instancer has unless it is authored: the ids of its instances.
    static constexpr const char* idName = "instanceId";

    /// Reports values whose number does not fit and values that are no numbers.
    /// @param instancer outlives this
    InstanceValues(const Instancer& instancer, Diagnostics& diagnostics);

    const Instancer& instancer() const { return _instancer; }
    std::vector<std::string> names() const;
    /// @param out up to four components; those that the primvar does not have are 0
    /// @returns false, and leaves out as it was, where there is no such primvar or instance
    bool read(const std::string& name, int instance, float out[4]) const;

private:
    struct Value {
        std::string name;
        size_t components = 1;
        std::vector<float> data; ///< an element per instance, or one for all
    };
    const Value* find(const std::string& name) const;

    const Instancer& _instancer;
    std::vector<Value> _values;
};

/// One of the instances that a prim is drawn inside of.
struct InstanceStep {
    const InstanceValues* values = nullptr;
    int instance = 0;

    /// @returns those of this instance, or nothing where it has none
    const Marked* marks() const {
        if (!values) return nullptr;
        const std::vector<Marked>& all = values->instancer().marks;
        return size_t(instance) < all.size() ? &all[size_t(instance)] : nullptr;
    }
};

/// Reads a primvar of the innermost instance that has it, as Storm does.
/// @param steps from the outermost to the innermost
bool readInstances(const InstanceStep* steps, int count, const std::string& name, float out[4]);

} // namespace patina
