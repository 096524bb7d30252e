#pragma once

#include <string>
#include <vector>

namespace patina {

/// One method of a choice point as it was measured on one subject. The data (methodTableData.cpp)
/// are written by `patina chart --lobes --table`.
struct MeasuredMethod {
    const char* point;
    const char* method;
    const char* subject; ///< `ior 1.5`, `gold, red`, ...
    const char* errorOf; ///< `albedo`, `reflectance`; `noise`: standard deviation of one sample's
                         ///< weight; `furnace`: light that white loses
    float ns;            ///< median time of an evaluation, one thread, where it was measured
    float cost;          ///< that over the time of the point's default method; carries over to
                         ///< other machines
    float mean, largest, rms; ///< absolute errors over cell centres of (cosine, root of alpha)
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
