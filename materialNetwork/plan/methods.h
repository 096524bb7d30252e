#pragma once

#include <map>
#include <string>
#include <vector>

namespace patina {

/// One way to do what a choice point leaves open.
struct Method {
    std::string name;
    std::string description; ///< what it costs and where it errs
};

/// A place where something can be computed in several ways, or where the field leaves a meaning
/// open. The first method is the default. Those of light
/// and geometry (domeLight and what follows it) are chosen with the scene in view.
struct ChoicePoint {
    std::string name;
    std::vector<Method> methods;
    std::string truth = {}; ///< what the others are measured against; empty: a choice of meaning,
                            ///< one that makes noise alone, or (subsurface) one whose error
                            ///< depends on the object. The planner only looks for less noise there.
};

/// Choice point -> method, as the user forces it.
using MethodChoices = std::map<std::string, std::string>;

const std::vector<ChoicePoint>& choicePoints();

/// @returns the method in force at a choice point
std::string chosenMethod(const MethodChoices& choices, const std::string& point);

/// @returns what a choice point has for truth; empty where there is none
std::string truthMethod(const std::string& point);

/// @returns its place among the point's methods; for directionalAlbedo, sampling and fresnel these
/// are the constants of shaders/lib/methods
int chosenIndex(const MethodChoices& choices, const std::string& point);

/// @returns empty when every point and method exists, else a sentence that names what does not
std::string checkMethods(const MethodChoices& choices);

} // namespace patina
