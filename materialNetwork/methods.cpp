#include "materialNetwork/methods.h"

namespace patina {

const std::vector<ChoicePoint>& choicePoints() {
    static const std::vector<ChoicePoint> points = {
        {"energyCompensation",
         {{"turquin", "rough microfacet lobes are scaled by what single scattering loses (Turquin "
                      "2019); white ones keep all energy; not reciprocal"},
          {"none", "single scattering only, as most renderers have it; a white metal of alpha 1 "
                   "loses about half of the light"}}}};
    return points;
}

std::string chosenMethod(const MethodChoices& choices, const std::string& point) {
    const auto found = choices.find(point);
    if (found != choices.end()) return found->second;
    for (const ChoicePoint& choice : choicePoints())
        if (choice.name == point) return choice.methods.front().name;
    return "";
}

std::string checkMethods(const MethodChoices& choices) {
    for (const auto& item : choices) {
        const ChoicePoint* point = nullptr;
        std::string known;
        for (const ChoicePoint& candidate : choicePoints()) {
            known += (known.empty() ? "" : ", ") + candidate.name;
            if (candidate.name == item.first) point = &candidate;
        }
        if (!point)
            return "there is no choice point '" + item.first + "' (there are: " + known + ")";
        known.clear();
        bool found = false;
        for (const Method& method : point->methods) {
            known += (known.empty() ? "" : ", ") + method.name;
            found |= method.name == item.second;
        }
        if (!found)
            return "the choice point '" + item.first + "' has no method '" + item.second +
                   "' (it has: " + known + ")";
    }
    return "";
}

} // namespace patina
