// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/planner/planner.h"

#include "materialNetwork/planner/predictError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace patina {

namespace {

/// The cost of a sample of the image apart from its lobe: rays and the way
/// to them. Half a microsecond of a small scene on one thread.
constexpr double nsPerSample = 500.0;

/// A truth that the table has no time of is taken for so many times as slow as the default.
constexpr double unmeasuredTruth = 20.0;

/// Lobes with a smaller share of the light are not looked at for how smooth a material is.
constexpr float minShare = 0.02f;

struct Option {
    std::string method;
    Prediction prediction;
};

struct Point {
    std::string name;
    std::vector<Option> options; ///< fastest first
    bool forced = false;
};

class MethodPlanner {
public:
    MethodPlanner(const Plan& plan, const ProgramCode& code, const Planning& planning)
        : _plan(plan), _planning(planning),
          _probes(std::make_shared<std::vector<std::vector<DirectionProbe>>>(probeProgram(code))),
          _places(*_probes) {}

    MethodPlan run() {
        _result.tolerance = _planning.tolerance;
        _result.fallback = _plan.planned.fallback;
        _result.probes = _probes;
        _result.varies = _places.size() > 1;
        for (const auto& angles : _places)
            for (const DirectionProbe& probe : angles)
                _result.albedo = std::max(_result.albedo, double(std::min(probe.albedo, 1.0f)));
        findMicrofacets();
        _factor = bounceFactor(_result.albedo);
        for (const std::string& name : choicesThatMatter(_plan))
            consider(name);
        double budget = methodShare * std::max(_planning.tolerance, 0.0);
        for (const Point& p : _points)
            if (p.forced) budget -= p.options.front().prediction.error;
        _best.assign(_points.size(), 0);
        _chosen.assign(_points.size(), 0);
        for (size_t i = 0; i < _points.size(); ++i)
            _best[i] = int(_points[i].options.size()) - 1;
        search(0, std::max(budget, 0.0), 0.0, 0.0);
        for (size_t i = 0; i < _points.size(); ++i)
            keep(_points[i], _points[i].options[size_t(_best[i])]);
        return std::move(_result);
    }

private:
    /// Asked several times for defaults and truths.
    const Prediction& predictionOf(const std::string& point, const std::string& method) const {
        const auto known = _predictions.find({point, method});
        if (known != _predictions.end()) return known->second;
        return _predictions[{point, method}] = predictionFor(point, method);
    }

    Prediction predictionFor(const std::string& point, const std::string& method) const {
        Prediction p = predict(_plan, _places, point, method);
        if (method != truthMethod(point)) {
            p.error *= _factor;
            return p;
        }
        p.error = 0.0;
        if (!p.measured)
            p.ns = unmeasuredTruth * predict(_plan, _places, point, chosenMethod({}, point)).ns;
        return p;
    }

    void findMicrofacets() {
        for (const auto& angles : _places) {
            double share = 0.0;
            for (const DirectionProbe& probe : angles)
                for (const ClosureContribution& c : probe.closures) {
                    const std::string kind = c.kind;
                    if (kind != "dielectric" && kind != "conductor" && kind != "schlick") continue;
                    share += c.share / double(angles.size());
                    if (c.share > minShare)
                        _result.smoothest = std::min(_result.smoothest, double(c.roughness));
                }
            _result.microfacetShare = std::max(_result.microfacetShare, std::min(share, 1.0));
        }
    }

    /// Notes what may be chosen at a point.
    void consider(const std::string& name) {
        const std::string truth = truthMethod(name);
        const std::string standard = chosenMethod({}, name);
        const bool noise = predictionOf(name, standard).noise > 0.0;
        if (truth.empty() && !noise) return;
        Point point;
        point.name = name;
        point.forced = _planning.forced.count(name) > 0;
        const bool unknown = _planning.tolerance > 0.0 && !predictionOf(name, standard).measured;
        if (point.forced || _planning.tolerance < 0.0 || unknown) {
            const std::string method = chosenMethod(_planning.forced, name);
            point.options = {{method, predictionOf(name, method)}};
        } else if (noise) {
            point.options = {quietest(name)};
        } else if (_planning.tolerance == 0.0) {
            point.options = {{truth, predictionOf(name, truth)}};
        } else {
            point.options = front(name, truth);
        }
        _points.push_back(std::move(point));
    }

    /// Measured methods of which none is both slower and worse than another; the truth is among
    /// them.
    std::vector<Option> front(const std::string& name, const std::string& truth) const {
        std::vector<Option> all;
        for (const Method& m : findChoicePoint(name)->methods) {
            const Option o{m.name, predictionOf(name, m.name)};
            if (o.prediction.measured || m.name == truth) all.push_back(o);
        }
        std::stable_sort(all.begin(), all.end(), [](const Option& a, const Option& b) {
            return a.prediction.ns < b.prediction.ns;
        });
        std::vector<Option> result;
        double minimum = std::numeric_limits<double>::infinity();
        for (const Option& o : all)
            if (o.prediction.error < minimum) {
                minimum = o.prediction.error;
                result.push_back(o);
            }
        return result;
    }

    Option quietest(const std::string& name) const {
        Option best;
        double minimum = std::numeric_limits<double>::infinity();
        for (const Method& m : findChoicePoint(name)->methods) {
            const Option o{m.name, predictionOf(name, m.name)};
            if (!o.prediction.measured) continue;
            const double effort =
                (1.0 + o.prediction.noise * o.prediction.noise) * (nsPerSample + o.prediction.ns);
            if (effort < minimum) {
                minimum = effort;
                best = o;
            }
        }
        return best;
    }

    /// Time of an image relative to others: that of a sample, over the noise allowed squared. Here
    /// errors are subtracted, which keeps them small: no samples take them away, and what is left
    /// of their share is for methods of lights.
    double effort(double ns, double error) const {
        if (!(_planning.tolerance > 0.0)) return ns;
        const double used = std::min(error / _planning.tolerance, methodShare);
        const double noise = 1.0 - depthShare - used;
        return (nsPerSample + ns) / (noise * noise);
    }

    /// The combination within the budget that takes the least effort. Points are few and fronts
    /// short.
    void search(size_t i, double budget, double ns, double error) {
        const double soFar = effort(ns, error);
        if (soFar >= _minimum) return;
        if (i == _points.size()) {
            _minimum = soFar;
            _best = _chosen;
            return;
        }
        const Point& p = _points[i];
        for (size_t k = 0; k < p.options.size(); ++k) {
            const Prediction& q = p.options[k].prediction;
            if (!p.forced && q.error > budget && p.options.size() > 1) continue;
            _chosen[i] = int(k);
            search(i + 1, p.forced ? budget : budget - q.error, ns + q.ns, error + q.error);
        }
    }

    void keep(const Point& point, const Option& option) {
        PlannedMethod m;
        m.point = point.name;
        m.method = option.method;
        m.forced = point.forced;
        m.measured = option.prediction.measured || option.method == truthMethod(point.name);
        m.error = option.prediction.error;
        m.ns = option.prediction.ns;
        const Prediction standard = predictionOf(point.name, chosenMethod({}, point.name));
        m.nsDefault = standard.ns;
        m.errorDefault = standard.error;
        const std::string truth = truthMethod(point.name);
        m.nsTruth = truth.empty() ? m.nsDefault : predictionOf(point.name, truth).ns;
        _result.error += m.error;
        _result.choices.push_back(m);
    }

    const Plan& _plan;
    const Planning& _planning;
    std::shared_ptr<const std::vector<std::vector<DirectionProbe>>> _probes;
    const std::vector<std::vector<DirectionProbe>>& _places;
    std::vector<Point> _points;
    std::vector<int> _chosen, _best;
    mutable std::map<std::pair<std::string, std::string>, Prediction> _predictions;
    double _factor = 1.0;
    double _minimum = std::numeric_limits<double>::infinity();
    MethodPlan _result;
};

} // namespace

double noiseBeside(double bias, double tolerance) {
    return std::sqrt(std::max(tolerance * tolerance - bias * bias, 0.0));
}

double bounceFactor(double albedo) {
    return 1.0 / (1.0 - 0.75 * std::clamp(albedo, 0.0, 1.0));
}

MethodPlan planMethods(const Plan& plan, const ProgramCode& code, const Planning& planning) {
    return MethodPlanner(plan, code, planning).run();
}

MethodPlan withoutWalks(MethodPlan plan) {
    for (PlannedMethod& m : plan.choices) {
        const Method* method = findChoicePoint(m.point)->find(m.method);
        if (!method || !method->walks) continue; // hosts may force what is no method
        plan.error += m.errorDefault - m.error;
        m.method = chosenMethod({}, m.point);
        m.error = m.errorDefault;
        m.ns = m.nsDefault;
    }
    return plan;
}

MethodChoices methodsOf(const MethodPlan& plan, MethodChoices others) {
    for (const PlannedMethod& m : plan.choices)
        others[m.point] = m.method;
    return others;
}

} // namespace patina
