// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/instanceValues.h"

#include "hdDelegate/geometry/primvarExpand.h"

#include <algorithm>

namespace patina {

InstanceValues::InstanceValues(const Instancer& instancer, Diagnostics& diagnostics)
    : _instancer(instancer) {
    const size_t n = instancer.transforms.size();
    const ElementCounts counts{n, n, n, n};
    for (const Primvar& primvar : instancer.primvars) {
        Value value;
        if (!expandPrimvar(primvar, counts, instancer.path, diagnostics, value.data)) continue;
        value.name = primvar.name;
        value.components = size_t(primvar.components);
        _values.push_back(std::move(value));
    }
}

std::vector<std::string> InstanceValues::names() const {
    std::vector<std::string> result = {idName};
    for (const Value& value : _values)
        result.push_back(value.name);
    return result;
}

const InstanceValues::Value* InstanceValues::find(const std::string& name) const {
    const auto found = std::find_if(_values.begin(), _values.end(),
                                    [&](const Value& value) { return value.name == name; });
    return found == _values.end() ? nullptr : &*found;
}

bool InstanceValues::read(const std::string& name, int instance, float out[4]) const {
    if (instance < 0 || size_t(instance) >= _instancer.transforms.size()) return false;
    const Value* value = find(name);
    if (!value) {
        if (name != idName) return false;
        const auto& ids = _instancer.ids;
        out[0] = float(size_t(instance) < ids.size() ? ids[size_t(instance)] : instance);
        out[1] = out[2] = out[3] = 0.0f;
        return true;
    }
    const size_t element = value->data.size() == value->components ? 0 : size_t(instance);
    const size_t first = element * value->components;
    if (first + value->components > value->data.size()) return false;
    for (size_t c = 0; c < 4; ++c)
        out[c] = c < value->components ? value->data[first + c] : 0.0f;
    return true;
}

bool readInstances(const InstanceStep* steps, int count, const std::string& name, float out[4]) {
    for (int i = count - 1; i >= 0; --i)
        if (steps[i].values && steps[i].values->read(name, steps[i].instance, out)) return true;
    return false;
}

} // namespace patina
