// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/placements.h"

#include "hdDelegate/compiled/drawFilter.h"
#include "base/limits.h"

#include <algorithm>

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
    keepWithinLimits(diagnostics);
    countLevels();
}

void Placements::countLevels() {
    std::map<std::string, std::vector<std::string>>
        inside; // group -> groups that it has instances of
    for (const auto& [prototype, uses] : _of)
        for (const Use& use : uses)
            inside[use.instancer->group].push_back(prototype);
    std::vector<std::string> level = {""};
    for (int number = 1; !level.empty(); ++number) {
        std::vector<std::string> next;
        for (const std::string& group : level)
            for (const std::string& prototype : inside[group])
                if (_levels.emplace(prototype, number).second) next.push_back(prototype);
        level = std::move(next);
    }
}

namespace {

/// How often groups are placed in the world, as Placements::forPlaces() visits them. As a double:
/// a few levels of a thousand instances each come to more than integers hold.
class PlaceCount {
public:
    explicit PlaceCount(const Placements& placements) : _placements(placements) {}

    double of(const std::string& group, int depth = 0) {
        if (group.empty()) return 1.0;
        if (depth > Placements::maxDepth) return 0.0;
        const auto key = std::make_pair(group, depth);
        const auto known = _known.find(key);
        if (known != _known.end()) return known->second;
        double sum = 0.0;
        for (const Placements::Use& use : _placements.of(group))
            sum += double(use.instances.size()) * of(use.instancer->group, depth + 1);
        return _known[key] = sum;
    }

private:
    const Placements& _placements;
    std::map<std::pair<std::string, int>, double> _known;
};

} // namespace

double Placements::count(const std::string& group) const {
    return PlaceCount(*this).of(group);
}

void Placements::keepWithinLimits(Diagnostics& diagnostics) {
    const double most = double(limitOf(Limit::instances));
    PlaceCount places(*this);
    std::map<const Instancer*, double> counts;
    double sum = 0.0;
    for (const auto& item : _of)
        for (const Use& use : item.second) {
            const double count = double(use.instances.size()) * places.of(use.instancer->group, 1);
            counts[use.instancer.get()] += count;
            sum += count;
        }
    if (sum <= most) return;
    // Those of few stay: of instancers in each other the innermost goes first.
    Instancers order = _drawn;
    std::stable_sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
        return counts[a.get()] < counts[b.get()];
    });
    std::set<const Instancer*> left;
    double kept = 0.0;
    for (const auto& instancer : order)
        if ((kept += counts[instancer.get()]) > most) left.insert(instancer.get());
    diagnostics.warn(order.back()->path, "",
                     messages::instancesTooMany(limitText(Limit::instances), left.size() - 1));
    const auto gone = [&](const auto& instancer) { return left.count(instancer.get()) > 0; };
    const auto remove = [&](Instancers& list) {
        list.erase(std::remove_if(list.begin(), list.end(), gone), list.end());
    };
    remove(_drawn);
    for (auto& group : _in)
        remove(group.second);
    for (auto& item : _of) {
        auto& uses = item.second;
        uses.erase(std::remove_if(uses.begin(), uses.end(),
                                  [&](const Use& use) { return gone(use.instancer); }),
                   uses.end());
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
