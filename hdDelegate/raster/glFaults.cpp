#include "hdDelegate/raster/glFaults.h"

#include "hdDelegate/raster/deviceError.h"

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

std::string oneLine(const std::string& log) {
    std::string line;
    for (const char c : log)
        if (c != '\n')
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return line.size() > 300 ? line.substr(0, 297) + "..." : line;
}

} // namespace patina
