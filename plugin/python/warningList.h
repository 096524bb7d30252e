// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"

#include <pybind11/pybind11.h>

namespace patina {

/// @param fields numbers and texts, in the order of the message's row
inline Message messageOf(const std::string& id, const pybind11::args& fields) {
    std::vector<std::string> texts;
    for (const auto& field : fields)
        texts.push_back(pybind11::str(field));
    return messageOf(id, texts);
}

/// Warnings as Python sees them: a list of dicts with prim, input, id, message, fields by name and
/// count.
inline pybind11::list warningList(const Diagnostics& diagnostics) {
    pybind11::list list;
    for (const Diagnostic& d : diagnostics.all()) {
        pybind11::dict warning;
        warning["prim"] = d.prim;
        warning["input"] = d.input;
        warning["id"] = nameOf(d.what.id);
        warning["message"] = d.message;
        pybind11::dict fields;
        const std::vector<std::string> names = fieldNames(d.what.id);
        for (size_t i = 0; i < names.size(); ++i)
            fields[names[i].c_str()] = d.what.fields[i];
        warning["fields"] = fields;
        warning["count"] = d.count;
        list.append(warning);
    }
    return list;
}

} // namespace patina
