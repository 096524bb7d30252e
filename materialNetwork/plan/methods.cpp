// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/plan/methods.h"

namespace patina {

const std::vector<ChoicePoint>& choicePoints() {
    static const std::vector<ChoicePoint> points = {
#define PATINA_CHOICE(Type, name, truth, matters) {name, truth, {
#define PATINA_METHOD(Type, Id, name, description) {name, description, false},
#define PATINA_WALK(Type, Id, name, description) {name, description, true},
#define PATINA_CHOICE_END(Type)                                                                    \
    }                                                                                              \
    }                                                                                              \
    ,
#include "materialNetwork/plan/choicePoints.inc"
    };
    return points;
}

namespace {

struct MethodAlias {
    Choice point;
    size_t place; ///< of the method
    const char* name;
};

constexpr MethodAlias methodAliases[] = {
#define PATINA_METHOD_ALIAS(Type, Id, name) {Choice::Type, size_t(method::Type::Id), name},
#include "materialNetwork/plan/choicePoints.inc"
};

} // namespace

const Method* ChoicePoint::find(const std::string& method) const {
    for (const Method& m : methods)
        if (m.name == method) return &m;
    for (const MethodAlias& alias : methodAliases)
        if (choicePoints()[size_t(alias.point)].name == name && alias.name == method)
            return &methods[alias.place];
    return nullptr;
}

const ChoicePoint* findChoicePoint(const std::string& name) {
    for (const ChoicePoint& point : choicePoints())
        if (point.name == name) return &point;
    return nullptr;
}

MethodSet::MethodSet(const MethodChoices& choices) {
    const std::vector<ChoicePoint>& points = choicePoints();
    for (size_t i = 0; i < points.size(); ++i)
        _places[i] = uint8_t(chosenIndex(choices, points[i].name));
}

std::string chosenMethod(const MethodChoices& choices, const std::string& point) {
    const auto found = choices.find(point);
    const ChoicePoint* known = findChoicePoint(point);
    if (found == choices.end()) return known ? known->methods.front().name : "";
    const Method* method = known ? known->find(found->second) : nullptr;
    return method ? method->name : found->second;
}

std::string truthMethod(const std::string& point) {
    const ChoicePoint* known = findChoicePoint(point);
    return known ? known->truth : "";
}

int chosenIndex(const MethodChoices& choices, const std::string& point) {
    const auto chosen = choices.find(point);
    const ChoicePoint* known = findChoicePoint(point);
    const Method* method = known && chosen != choices.end() ? known->find(chosen->second) : nullptr;
    return method ? int(method - known->methods.data()) : 0;
}

std::string checkMethods(const MethodChoices& choices) {
    const auto listed = [](const auto& named) {
        std::string text;
        for (const auto& item : named)
            text += (text.empty() ? "" : ", ") + item.name;
        return text;
    };
    for (const auto& item : choices) {
        const ChoicePoint* point = findChoicePoint(item.first);
        if (!point)
            return "there is no choice point '" + item.first +
                   "' (there are: " + listed(choicePoints()) + ")";
        if (!point->find(item.second))
            return "the choice point '" + item.first + "' has no method '" + item.second +
                   "' (it has: " + listed(point->methods) + ")";
    }
    return "";
}

} // namespace patina
