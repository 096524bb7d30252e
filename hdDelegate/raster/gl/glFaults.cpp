// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glFaults.h"

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/gl/glFunctions.h"

#include <cstdlib>
#include <sstream>

namespace patina {

std::string glFault(const std::string& kind) {
    const char* asked = std::getenv("PATINA_GL_FAULT");
    if (!asked) return std::string();
    std::istringstream all(asked);
    for (std::string fault; std::getline(all, fault, ',');)
        if (fault.compare(0, kind.size() + 1, kind + ":") == 0)
            return fault.substr(kind.size() + 1);
    return std::string();
}

void throwIfLost() {
    if (gl.GetGraphicsResetStatus() != GL_NO_ERROR)
        throw DeviceError("the driver has reset the OpenGL context");
}

std::string oneLine(const std::string& log) {
    // Drivers warn of many things before they say what is wrong.
    const bool fails = log.find("error") != std::string::npos;
    std::istringstream lines(log);
    std::string line, out;
    while (std::getline(lines, line)) {
        if (line.empty() || (fails && line.find(": warning:") != std::string::npos)) continue;
        if (!out.empty() && out.back() != ' ') out += ' ';
        out += line;
    }
    while (!out.empty() && out.back() == ' ')
        out.pop_back();
    return out.size() > 300 ? out.substr(0, 297) + "..." : out;
}

} // namespace patina
