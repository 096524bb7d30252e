// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/placements.h"

#include "hdDelegate/compiled/drawFilter.h"

namespace patina {

Placements::Placements(const SceneState& state, const RenderSettings& settings,
                       Diagnostics& diagnostics, const Placements* before) {
    for (const auto& item : state.instancers)
        if (isDrawn(*item.second, settings)) {
            _drawn.push_back(item.second);
            _in[item.second->group].push_back(item.second);
            auto values = before ? before->valuesOf(*item.second) : nullptr;
            if (!values) values = std::make_shared<InstanceValues>(*item.second, diagnostics);
            for (std::string& name : values->names())
                _valueNames.insert(std::move(name));
            _values[item.second.get()] = std::move(values);
        }
    for (const auto& group : _in)
        for (const auto& instancer : group.second) {
            std::map<std::string, std::vector<uint32_t>> instances;
            for (size_t i = 0; i < instancer->transforms.size(); ++i) {
                const int prototype =
                    i < instancer->prototypeIndices.size() ? instancer->prototypeIndices[i] : -1;
                if (prototype >= 0 && size_t(prototype) < instancer->prototypes.size())
                    instances[instancer->prototypes[size_t(prototype)]].push_back(uint32_t(i));
            }
            for (auto& [prototype, list] : instances)
                _of[prototype].push_back({instancer, std::move(list)});
        }
}

const std::vector<Placements::Use>& Placements::of(const std::string& prototype) const {
    static const std::vector<Use> none;
    const auto found = _of.find(prototype);
    return found == _of.end() ? none : found->second;
}

std::shared_ptr<const InstanceValues> Placements::valuesOf(const Instancer& instancer) const {
    const auto found = _values.find(&instancer);
    return found == _values.end() ? nullptr : found->second;
}

const Placements::Instancers& Placements::in(const std::string& group) const {
    static const Instancers none;
    const auto found = _in.find(group);
    return found == _in.end() ? none : found->second;
}

} // namespace patina
