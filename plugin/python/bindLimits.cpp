// SPDX-License-Identifier: Apache-2.0
// The most that input may ask for.
#include "base/limits.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace patina {

void bindLimits(py::module_& m) {
    m.def(
        "set_limits", &setLimits, py::arg("values"),
        "Gives limits of this process values, by their names in base/limits.def; all "
        "others have their defaults again, or what the variable PATINA_LIMITS says. Input that was "
        "read before stays. Returns an empty text, or why nothing was changed.");
    m.def(
        "limits",
        [] {
            std::map<std::string, uint64_t> values;
#define LIMIT(name, ...) values[#name] = limitOf(Limit::name);
#include "base/limits.def"
#undef LIMIT
            return values;
        },
        "The limits that hold in this process, by name.");
}

} // namespace patina
