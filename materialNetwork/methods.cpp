#include "materialNetwork/methods.h"

namespace patina {

const std::vector<ChoicePoint>& choicePoints() {
    static const std::vector<ChoicePoint> points = {
        {"energyCompensation",
         {{"turquin", "rough microfacet lobes are scaled by what single scattering loses (Turquin "
                      "2019); white ones keep all energy; not reciprocal"},
          {"none", "single scattering only, as most renderers have it; a white metal of alpha 1 "
                   "loses about half of the light"}}},
        {"layerTransmittance",
         {{"largest", "a layer lets through 1 - E in all channels, E the largest channel of its "
                      "top's directional albedo without tint; no channel gains energy, and a tint "
                      "colours the top alone"},
          {"average", "1 - the mean of the channels, as in MaterialX's shaders; a coloured top may "
                      "give a channel more light than came"},
          {"tinted", "each channel on its own, with the tint: what the top does not reflect in a "
                     "channel is the base's, so that a red sheen lets blue through"}}},
        {"reflectionOverTransmission",
         {{"fused", "a reflection lobe layered over a transmission lobe is one interface: what the "
                    "top reflects is taken once, by the layer"},
          {"literal", "each node as it is defined: the layer takes the reflection, and the "
                      "transmission lobe leaves it out once more; glass darkens by 1 - F"}}},
        {"thinWalled",
         {{"slab", "a thin wall has two faces between which light bounces: it reflects 2 r / (1 + "
                   "r), passes (1 - r) / (1 + r) straight on, and absorbs nothing"},
          {"sheet", "a single face: it reflects r and passes 1 - r straight on"},
          {"solid", "thin_walled is ignored, as in MaterialX's shaders: the surface refracts and "
                    "bounds a medium"}}}};
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
