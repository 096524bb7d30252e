// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/lightPaths/eventPattern.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// A part of a light path expression.
struct LightPathNode {
    enum class Kind { Event, Sequence, Either, Repeat };
    static constexpr int endless = -1;

    Kind kind = Kind::Sequence;
    EventPattern event;                                ///< of Event
    std::vector<std::unique_ptr<LightPathNode>> parts; ///< of Repeat one
    int least = 1, most = 1;                           ///< of Repeat; most may be endless
};

/// Reads a light path expression. Regular expressions over the events of light paths are Heckbert's
/// (1990, Adaptive Radiosity Textures for Bidirectional Ray Tracing); the grammar is that of the
/// Open Shading Language (light path expressions, in its language specification and `lpeparse`):
///
///   C R T V L B O    an event of this type      <RD> <RD'key'>  type, scattering, label
///   D G S s          one that scatters so       'key'           one with this label
///   .                any; `x` in <> is none     [ab] [^DG]      one of these; none of these
///   e* e+ e? e{2} e{1,3} e{2,}   repetitions    a|b  (ab)       either; a group
///
/// As there, `|` joins the two elements beside it alone: CD|GL is C(D|G)L. Beyond it are `?`,
/// blanks between elements, and `[^'key']`, which an event without a label fits too.
/// @throws std::invalid_argument naming expression, column (from 1) and what was expected
std::unique_ptr<LightPathNode> parseLightPath(const std::string& expression);

/// Adds all labels that an expression names. @param labels has none twice
void collectLabels(const LightPathNode& node, std::vector<std::string>& labels);

} // namespace patina
