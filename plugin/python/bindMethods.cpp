// SPDX-License-Identifier: Apache-2.0
// Choice points as they were measured, and measuring them.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/raster/measure/measureDome.h"
#include "materialNetwork/material.h"
#include "materialNetwork/plan/methodTable.h"
#include "plugin/python/plans.h"
#include "shaders/measure/measure.h"

namespace py = pybind11;

namespace patina {

py::dict planDict(const MethodPlan& plan) {
    py::dict dict;
    dict["tolerance"] = plan.tolerance;
    dict["error"] = plan.error;
    dict["albedo"] = plan.albedo;
    dict["varies"] = plan.varies;
    dict["fallback"] = plan.fallback;
    dict["choices"] = choiceList(plan.choices);
    return dict;
}

py::list choiceList(const std::vector<PlannedMethod>& planned) {
    py::list choices;
    for (const PlannedMethod& m : planned) {
        py::dict choice;
        choice["point"] = m.point;
        choice["method"] = m.method;
        choice["forced"] = m.forced;
        choice["measured"] = m.measured;
        choice["error"] = m.error;
        choice["errorDefault"] = m.errorDefault;
        choice["ns"] = m.ns;
        choice["nsDefault"] = m.nsDefault;
        choice["nsTruth"] = m.nsTruth;
        choices.append(choice);
    }
    return choices;
}

namespace {

/// The columns that a row of the table and one measured now have in common.
template <class Row> py::dict shared(const Row& r) {
    py::dict row;
    row["point"] = r.point;
    row["method"] = r.method;
    row["subject"] = r.subject;
    row["mean"] = r.mean;
    row["largest"] = r.largest;
    row["rms"] = r.rms;
    row["kind"] = r.kind;
    row["reflectance"] = r.reflectance;
    row["axis"] = r.axis;
    row["axisEnd"] = r.axisEnd;
    row["errors"] = std::vector<float>(std::begin(r.errors), std::end(r.errors));
    row["truths"] = std::vector<float>(std::begin(r.truths), std::end(r.truths));
    return row;
}

py::list table() {
    py::list rows;
    for (const MeasuredMethod& r : methodTable()) {
        py::dict row = shared(r);
        row["errorOf"] = r.errorOf;
        row["ns"] = r.ns;
        row["cost"] = r.cost;
        rows.append(row);
    }
    return rows;
}

py::object figures(const std::string& point, const std::string& method) {
    const MethodFigures f = methodFigures(point, method);
    if (!f.measured) return py::none();
    py::dict row;
    row["errorOf"] = f.errorOf;
    row["cost"] = f.cost;
    row["mean"] = f.mean;
    row["largest"] = f.largest;
    return row;
}

py::dict planned(const Network& network, const MethodChoices& methods, double tolerance) {
    MethodPlan plan;
    {
        py::gil_scoped_release release;
        Diagnostics silent;
        TextureSystem textures(silent);
        textures.sampleFinestOnly();
        plan = planMaterialMethods(network, textures, silent, methods, tolerance);
    }
    return planDict(plan);
}

py::list measured(const std::string& point, bool timed) {
    std::vector<measure::Row> found;
    {
        py::gil_scoped_release release;
        found = measure::measureMethods(point, timed);
        const auto add = [&](const char* name, std::vector<measure::Row> (*rows)(bool)) {
            if (!point.empty() && point != name) return;
            for (measure::Row& row : rows(timed))
                found.push_back(std::move(row));
        };
        add("domeLight", measure::domeLight);
    }
    py::list rows;
    for (const measure::Row& r : found) {
        py::dict row = shared(r);
        row["errorOf"] = r.error;
        row["ns"] = r.ns;
        row["nsLow"] = r.nsLow;
        row["nsHigh"] = r.nsHigh;
        rows.append(row);
    }
    return rows;
}

} // namespace

void bindMethods(py::module_& m) {
    m.def("method_table", &table,
          "The measured methods as the program was built with them: list of dicts (point, method, "
          "subject, errorOf, ns, cost, mean, largest, rms, and errors over cells with kind, "
          "reflectance, axis, axisEnd and truths as in materialNetwork/plan/methodTable.h).");
    m.def("method_figures", &figures, py::arg("point"), py::arg("method"),
          "dict of errorOf, cost (over the default method), mean and largest error over all "
          "subjects; None where nothing is measured.");
    m.def("plan_material", &planned, py::arg("network"), py::arg("methods") = MethodChoices(),
          py::arg("tolerance") = -1.0,
          "How the methods of a material are chosen for a tolerance (0: truths, negative: "
          "defaults): dict of tolerance, error (relative luminance), albedo, varies, fallback (of "
          "displayColor, which is shown in place of the material), and choices.");
    m.def("measure_methods", &measured, py::arg("point") = "", py::arg("timed") = true,
          "Measures the methods of a choice point, or of all, here and now, on one thread.");
}

} // namespace patina
