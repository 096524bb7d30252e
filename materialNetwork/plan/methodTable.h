// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace patina {

/// Cells of a row.
constexpr int methodBins = 8;
constexpr int methodCosines = 4;
using MethodCells = float[methodBins * methodCosines];

/// One method of a choice point as it was measured on one subject. The data (methodTableData.cpp)
/// are written by `patina chart --lobes --table`.
struct MeasuredMethod {
    const char* point;
    const char* method;
    const char* subject; ///< `ior 1.5`, `gold, red`, ...
    const char* errorOf; ///< `albedo`, `reflectance`; `noise`: standard deviation of one sample's
                         ///< weight; `furnace`: light that white loses; `picture`: mean relative
                         ///< luminance; `effort`: time x variance over the default's
    float ns;            ///< median time of an evaluation, one thread, where it was measured
    float cost;          ///< that over the time of the point's default method; carries over to
                         ///< other machines
    float mean, largest, rms; ///< absolute errors over cell centres of (cosine, root of alpha)
    const char* kind;         ///< of lobe: `dielectric`, `conductor`, `schlick`; empty: any
    float reflectance;        ///< of the subject at normal incidence; -1: it is no matter
    /// The quantity of the bins: `roughness` (root of alpha), `thickness` (nm) or `albedo`. They
    /// are evenly spaced from 0 to axisEnd; beyond nothing is known.
    const char* axis;
    float axisEnd;
    /// Mean absolute error, and mean of the quantity that it is an error of, for each bin and each
    /// quarter of the cosine of the view, grazing first. Rows about scenes have other columns:
    /// sizes on screen for `subdivision`, depths for `roulette`; for `pathDepth` all columns are
    /// equal.
    MethodCells errors;
    const MethodCells& truths; ///< methods of a subject share them
};

/// All rows, in the order of choicePoints() and their methods.
const std::vector<MeasuredMethod>& methodTable();

/// A method over all its subjects.
struct MethodFigures {
    bool measured = false; ///< false: a choice of meaning, or of no measured method
    std::string errorOf;
    float cost = 1.0f;    ///< geometric mean
    float mean = 0.0f;    ///< largest of the subjects
    float largest = 0.0f; ///< the same
};

MethodFigures methodFigures(const std::string& point, const std::string& method);

} // namespace patina
