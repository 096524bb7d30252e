// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"

#include <pybind11/pybind11.h>

namespace patina {

/// Warnings as Python sees them: a list of dicts with prim, input, message and count.
inline pybind11::list warningList(const Diagnostics& diagnostics) {
    pybind11::list list;
    for (const Diagnostic& d : diagnostics.all()) {
        pybind11::dict warning;
        warning["prim"] = d.prim;
        warning["input"] = d.input;
        warning["message"] = d.message;
        warning["count"] = d.count;
        list.append(warning);
    }
    return list;
}

} // namespace patina
