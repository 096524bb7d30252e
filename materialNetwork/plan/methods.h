// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace patina {

/// A row of choicePoints.inc.
enum class Choice : uint8_t {
#define PATINA_CHOICE(Type, name, truth, matters) Type,
#include "materialNetwork/plan/choicePoints.inc"
    Count
};

/// The methods of each choice point: method::Sampling::Vndf...
namespace method {
#define PATINA_CHOICE(Type, name, truth, matters) enum class Type : uint8_t {
#define PATINA_METHOD(Type, Id, name, description) Id,
#define PATINA_CHOICE_END(Type)                                                                    \
    }                                                                                              \
    ;
#include "materialNetwork/plan/choicePoints.inc"
} // namespace method

template <class Type> struct ChoiceOf;
#define PATINA_CHOICE(Type, name, truth, matters)                                                  \
    template <> struct ChoiceOf<method::Type> { static constexpr Choice value = Choice::Type; };
#include "materialNetwork/plan/choicePoints.inc"

/// One way to do what a choice point leaves open.
struct Method {
    std::string name;
    std::string description; ///< what it costs and where it errs
    bool walks = false;      ///< of the path tracer alone
};

/// A place where something can be computed in several ways, or where the field leaves a meaning
/// open. The first method is the default. Those of light
/// and geometry (domeLight and what follows it) are chosen with the scene in view.
struct ChoicePoint {
    std::string name;
    std::string truth; ///< what the others are measured against; empty: a choice of meaning,
                       ///< one that makes noise alone, or (subsurface) one whose error
                       ///< depends on the object. The planner only looks for less noise there.
    std::vector<Method> methods;

    /// @returns the method of a name, or of one that it had before; null when there is none
    const Method* find(const std::string& method) const;
};

/// Choice point -> method, as the user forces it.
using MethodChoices = std::map<std::string, std::string>;

/// A method at every choice point, as programs and lobes read it.
class MethodSet {
public:
    MethodSet() = default; ///< the defaults
    explicit MethodSet(const MethodChoices& choices);

    /// @returns the place of the method; of lobes these are the constants of the dialect
    int at(Choice point) const { return _places[size_t(point)]; }
    template <class Type> Type get() const { return Type(at(ChoiceOf<Type>::value)); }
    bool operator==(const MethodSet& other) const { return _places == other._places; }
    bool operator!=(const MethodSet& other) const { return !(*this == other); }

private:
    std::array<uint8_t, size_t(Choice::Count)> _places{};
};

/// In the order of Choice.
const std::vector<ChoicePoint>& choicePoints();

/// @returns the point of a name; null when there is none
const ChoicePoint* findChoicePoint(const std::string& name);

/// @returns the method in force at a choice point
std::string chosenMethod(const MethodChoices& choices, const std::string& point);

/// @returns what a choice point has for truth; empty where there is none
std::string truthMethod(const std::string& point);

/// @returns its place among the point's methods; of lobes these are the constants of the dialect
int chosenIndex(const MethodChoices& choices, const std::string& point);

/// @returns empty when every point and method exists, else a sentence that names what does not
std::string checkMethods(const MethodChoices& choices);

} // namespace patina
