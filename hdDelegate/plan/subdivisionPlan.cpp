// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/plan/subdivisionPlan.h"

#include "materialNetwork/plan/methodTable.h"
#include "materialNetwork/plan/methods.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace patina {

namespace {

const std::string point = "subdivision";

/// The columns of a row: pixels across. plugin/patina/chart/measureSubdivision.py measures them.
constexpr double sizes[methodCosines] = {10.0, 20.0, 40.0, 80.0};

/// Outlines are seen once more in shadows and before brighter things than those of the rows.
constexpr double outlines = 2.0;

double pixelsOf(const std::string& method) {
    return std::strtod(method.c_str(), nullptr); // "0.5px"
}

/// The point's methods, longest edges first.
std::vector<std::string> methodsByLength() {
    std::vector<std::string> names;
    for (const ChoicePoint& choice : choicePoints())
        if (choice.name == point)
            for (const Method& m : choice.methods)
                names.push_back(m.name);
    std::sort(names.begin(), names.end(),
              [](const std::string& a, const std::string& b) { return pixelsOf(a) > pixelsOf(b); });
    return names;
}

/// Rows of a method. The table is long, and asked for each surface.
const std::vector<const MeasuredMethod*>& rowsOf(const std::string& method, const char* kind) {
    using Rows = std::map<std::pair<std::string, std::string>, std::vector<const MeasuredMethod*>>;
    static const Rows rows = [] {
        Rows found;
        for (const MeasuredMethod& row : methodTable())
            if (point == row.point) found[{row.method, row.kind}].push_back(&row);
        return found;
    }();
    static const std::vector<const MeasuredMethod*> none;
    const auto at = rows.find({method, kind});
    return at == rows.end() ? none : at->second;
}

/// Error of a method on the worst of the measured shapes.
/// @param size pixels across
double rowError(const std::string& method, const char* kind, double roughness, double size) {
    const double s = std::clamp(std::log2(size / sizes[0]), 0.0, double(methodCosines - 1));
    const int column = std::min(int(s), methodCosines - 2);
    const double x = std::clamp(roughness * methodBins - 0.5, 0.0, double(methodBins - 1));
    const int bin = std::min(int(x), methodBins - 2);
    const double across = s - column, along = x - bin;
    const double largest = sizes[methodCosines - 1];
    // Small ones are measured no further down: from edges of 2 to 4 pixels errors grow eightfold.
    const double beyond = size > largest    ? std::pow(largest / size, 2.0)
                          : size < sizes[0] ? std::pow(sizes[0] / std::max(size, 0.1), 3.0)
                                            : 1.0;
    double worst = 0.0;
    for (const MeasuredMethod* found : rowsOf(method, kind)) {
        const MeasuredMethod& row = *found;
        const auto cell = [&](int b, int c) { return double(row.errors[b * methodCosines + c]); };
        const auto at = [&](int b) {
            return cell(b, column) * (1.0 - across) + cell(b, column + 1) * across;
        };
        worst = std::max(worst, at(bin) * (1.0 - along) + at(bin + 1) * along);
    }
    return std::min(outlines * worst * beyond, 1.0);
}

} // namespace

SubdivisionPlan::SubdivisionPlan(const RenderSettings& settings, const ScreenScale& screen)
    : _settings(settings), _screen(screen),
      _active(settings.tolerance >= 0.0 && settings.edgeLength < 0.0f) {}

void SubdivisionPlan::add(const PrimExtent& cage, const std::vector<mat4>& places,
                          const MethodPlan& material, double each) {
    if (places.empty() || !(cage.across > 0.0f)) return;
    _any = true;
    // Sizes of many places are told apart by an eighth of an octave.
    constexpr size_t many = 1000;
    std::map<int, double> shares;
    const vec3 center = cage.center();
    for (const mat4& m : places) {
        const double scale = largestScale(m);
        const float away = glm::length(vec3(m * vec4(center, 1.0f)) - _screen.eye);
        const double radius = 0.5 * std::sqrt(3.0) * cage.across * scale;
        const double distance =
            _screen.perspective ? std::max(double(_screen.nearest), away - radius) : 1.0;
        const double unit = _screen.pixelSpread * distance / scale; // object units of a pixel
        if (!std::isfinite(unit) || !(unit > 0.0)) continue;
        // A closed surface shows a quarter of its area, a sheet half at most.
        const double pixels = std::min(0.5 * double(cage.area) / (unit * unit),
                                       0.7854 * std::pow(cage.across / unit, 2.0));
        const double share = each * std::min(pixels / _screen.pixels, 1.0);
        const double size = double(cage.round) / unit;
        if (places.size() <= many)
            _seen.push_back({share, size, material.microfacetShare, material.smoothest});
        else
            shares[int(std::lround(8.0 * std::clamp(std::log2(size), -100.0, 100.0)))] += share;
    }
    for (const auto& [octave, share] : shares)
        _seen.push_back(
            {share, std::exp2(octave / 8.0), material.microfacetShare, material.smoothest});
}

double SubdivisionPlan::error(const std::string& method) const {
    if (method == truthMethod(point)) return 0.0;
    double sum = 0.0, shares = 0.0;
    for (const Seen& s : _seen) {
        sum += s.share * ((1.0 - s.microfacetShare) * rowError(method, "diffuse", 0.0, s.size) +
                          s.microfacetShare * rowError(method, "facets", s.roughness, s.size));
        shares += s.share;
    }
    return sum / std::max(shares, 1.0);
}

std::string SubdivisionPlan::choose() const {
    const auto forced = _settings.methods.find(point);
    if (forced != _settings.methods.end()) return forced->second;
    if (_settings.tolerance == 0.0) return truthMethod(point);
    if (_settings.tolerance < 0.0) return chosenMethod({}, point);
    for (const std::string& method : methodsByLength())
        if (error(method) <= subdivisionShare * _settings.tolerance) return method;
    return truthMethod(point);
}

PlannedMethod SubdivisionPlan::chosen() const {
    PlannedMethod result;
    if (!_any || !_active) return result;
    result.point = point;
    result.method = choose();
    result.forced = _settings.methods.count(point) > 0;
    result.measured = true;
    result.error = error(result.method);
    result.errorDefault = error(chosenMethod({}, point));
    const auto costOf = [](const std::string& method) {
        return double(methodFigures(point, method).cost);
    };
    result.ns = costOf(result.method);
    result.nsDefault = 1.0;
    result.nsTruth = costOf(truthMethod(point));
    return result;
}

float SubdivisionPlan::edgeLength() const {
    if (_settings.edgeLength >= 0.0f) return _settings.edgeLength;
    if (_settings.tolerance < 0.0 && _settings.methods.count(point) == 0) return standardEdge;
    return float(pixelsOf(choose()));
}

} // namespace patina
