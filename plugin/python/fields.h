// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "hdDelegate/scene/light.h"
#include "hdDelegate/scene/primMarks.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <set>
#include <string>
#include <vector>

namespace patina {

// From Python to the scene's own types; each throws py::value_error for a wrong shape.
void convert(pybind11::handle from, vec3& to);
void convert(pybind11::handle from, std::vector<int>& to);
void convert(pybind11::handle from, std::vector<float>& to);
void convert(pybind11::handle from, std::vector<double>& to);
void convert(pybind11::handle from, std::vector<vec3>& to);
void convert(pybind11::handle from, std::vector<vec4>& to);
void convert(pybind11::handle from, MotionTransform& to);
void convert(pybind11::handle from, std::vector<MotionTransform>& to);
void convert(pybind11::handle from, Sampled<std::vector<vec3>>& to);
void convert(pybind11::handle from, std::vector<Primvar>& to);
void convert(pybind11::handle from, std::vector<GeomSubset>& to);
void convert(pybind11::handle from, Visibility& to);
void convert(pybind11::handle from, Catching& to);
void convert(pybind11::handle from, Marks& to);
void convert(pybind11::handle from, SubdivisionScheme& to);
void convert(pybind11::handle from, SplatShape& to);
void convert(pybind11::handle from, CurveBasis& to);
void convert(pybind11::handle from, CurveWrap& to);
void convert(pybind11::handle from, ImplicitShape& to);
void convert(pybind11::handle from, LightType& to);
void convert(pybind11::handle from, LightFilterType& to);
void convert(pybind11::handle from, std::vector<LightFilter>& to);
void convert(pybind11::handle from, std::vector<LightPortal>& to);

template <class T> void convert(pybind11::handle from, T& to) {
    to = from.cast<T>();
}

/// Reads the keyword arguments of one function into fields, and knows which were not asked for.
class Fields {
public:
    Fields(const char* function, std::string prim, const pybind11::kwargs& values)
        : _function(function), _prim(std::move(prim)), _values(values) {}

    /// Leaves the field alone when the argument is not there or None.
    template <class T> Fields& read(const char* name, T& field) {
        _known.insert(name);
        if (!_values.contains(name)) return *this;
        const pybind11::object value = _values[name];
        if (value.is_none()) return *this;
        try {
            convert(value, field);
        } catch (const pybind11::cast_error&) {
            fail(name, "has a value of the wrong type");
        } catch (const pybind11::value_error& error) {
            fail(name, error.what());
        }
        return *this;
    }

    /// TypeError when there is an argument that nobody read.
    void finish() const;

private:
    [[noreturn]] void fail(const char* name, const std::string& why) const;

    const char* _function;
    std::string _prim;
    const pybind11::kwargs& _values;
    std::set<std::string> _known;
};

} // namespace patina
