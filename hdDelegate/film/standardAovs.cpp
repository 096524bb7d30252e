#include "hdDelegate/film/film.h"

#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

float intBits(int32_t value) {
    float bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

bool startsWith(const std::string& text, const char* start) {
    return text.compare(0, std::strlen(start), start) == 0;
}

int primvarComponents(const std::string& primvar) {
    if (startsWith(primvar, "st") || startsWith(primvar, "uv") || startsWith(primvar, "UV"))
        return 2;
    return primvar == "displayOpacity" || primvar == "widths" ? 1 : 3;
}

} // namespace

AovSpec standardAov(const std::string& name) {
    static const AovSpec table[] = {
        {"color", 3, AovKind::Mean, 0.0f, false},
        {"alpha", 1, AovKind::Mean, 0.0f, false},
        {"sampleCount", 1, AovKind::Mean, 0.0f, false},
        {"variance", 1, AovKind::Mean, 0.0f, false},
        {"albedo", 3, AovKind::Mean, 0.0f, false},
        {"denoisingAlbedo", 3, AovKind::Mean, 0.0f, false},
        {"denoisingNormal", 3, AovKind::Mean, 0.0f, false},
        {"depth", 1, AovKind::First, 1e10f, false},
        {"cameraDepth", 1, AovKind::First, 1e10f, false},
        {"deviceDepth", 1, AovKind::First, 1.0f, false},
        {"normal", 3, AovKind::First, 0.0f, false},
        {"Neye", 3, AovKind::First, 0.0f, false},
        {"position", 3, AovKind::First, 0.0f, false},
        {"primId", 1, AovKind::First, intBits(-1), true},
        {"instanceId", 1, AovKind::First, intBits(-1), true},
        {"elementId", 1, AovKind::First, intBits(-1), true},
    };
    for (const AovSpec& spec : table)
        if (spec.name == name) return spec;
    const std::string prefix = "primvars:";
    if (startsWith(name, prefix.c_str()) && name.size() > prefix.size())
        return {name, primvarComponents(name.substr(prefix.size())), AovKind::First, 0.0f, false};
    throw std::invalid_argument(
        "unknown AOV '" + name +
        "'; known are color, alpha, depth, cameraDepth, deviceDepth, "
        "normal, Neye, position, albedo, denoisingAlbedo, denoisingNormal, primId, "
        "instanceId, elementId, sampleCount, variance and primvars:NAME");
}

} // namespace patina
