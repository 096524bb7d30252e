// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/primMarks.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace patina {

namespace {

enum class MarkKind {
    Rays,
    Matte,
    Shadows,
    Reflections,
    ArnoldMask,
    KarmaRays,
    KarmaHoldout,
    MatteName,
    AssetName,
    Priority,
    DiffuseTransmission
};

struct MarkRow {
    const char* name;
    MarkKind kind;
    unsigned number = 0; ///< of the kinds that have one
};

const std::vector<MarkRow>& rows() {
    struct Kind {
        MarkKind kind;
        unsigned number = 0;
    };
    static const std::vector<MarkRow> made = [] {
        constexpr auto Rays = [](unsigned bits) { return Kind{MarkKind::Rays, bits}; };
        constexpr Kind Matte{MarkKind::Matte}, Shadows{MarkKind::Shadows},
            Reflections{MarkKind::Reflections}, ArnoldMask{MarkKind::ArnoldMask},
            KarmaRays{MarkKind::KarmaRays}, KarmaHoldout{MarkKind::KarmaHoldout},
            MatteName{MarkKind::MatteName}, AssetName{MarkKind::AssetName},
            Priority{MarkKind::Priority}, DiffuseTransmission{MarkKind::DiffuseTransmission};
        std::vector<MarkRow> list;
        const auto add = [&](const char* name, Kind kind) {
            list.push_back({name, kind.kind, kind.number});
        };
#define MARK(name, kind, ...) add(name, kind);
#include "hdDelegate/scene/primMarks.def"
#undef MARK
        return list;
    }();
    return made;
}

void show(Visibility& v, unsigned rays, bool seen) {
    if (rays & RayCamera) v.camera = seen;
    if (rays & RayDiffuse) v.diffuse = seen;
    if (rays & RayShadow) v.shadow = seen;
    if (rays & RaySpecular) v.specular = seen;
    if (rays & RayTransmission) v.transmission = seen;
    if (rays & RayVolume) v.volume = seen;
}

/// Arnold's bits, from ai_ray.h as it is public.
unsigned raysOfArnold(unsigned bits) {
    return (bits & 1u ? RayCamera : 0u) | (bits & 2u ? RayShadow : 0u) |
           (bits & 8u ? RayTransmission : 0u) | (bits & 16u ? RayVolume : 0u) |
           (bits & 32u ? RayDiffuse : 0u) | (bits & 64u ? RaySpecular : 0u);
}

bool raysOfKarmaWord(const std::string& word, unsigned& rays) {
    static const std::map<std::string, unsigned> words = {
        {"*", RayAny},           {"primary", RayCamera},   {"camera", RayCamera},
        {"diffuse", RayDiffuse}, {"reflect", RaySpecular}, {"refract", RayTransmission},
        {"shadow", RayShadow},   {"volume", RayVolume}};
    const auto found = words.find(word);
    if (found == words.end()) return false;
    rays = found->second;
    return true;
}

/// Words after - or ^ are taken away from those without, or from all where there are no such.
bool raysOfKarma(const std::string& text, unsigned& rays) {
    unsigned shown = 0, hidden = 0;
    bool anyShown = false, anyHidden = false;
    for (size_t i = 0; i < text.size();) {
        const bool minus = text[i] == '-' || text[i] == '^';
        size_t end = i + minus;
        while (end < text.size() &&
               (std::isalpha(static_cast<unsigned char>(text[end])) || text[end] == '*'))
            ++end;
        if (end == i + minus) {
            if (minus || std::string(" \t&|,").find(text[i]) == std::string::npos) return false;
            ++i;
            continue;
        }
        unsigned word = 0;
        if (!raysOfKarmaWord(text.substr(i + minus, end - i - minus), word)) return false;
        (minus ? hidden : shown) |= word;
        (minus ? anyHidden : anyShown) = true;
        i = end;
    }
    rays = (anyShown ? shown : anyHidden ? unsigned(RayAny) : 0u) & ~hidden;
    return true;
}

bool takeNumber(const MarkRow& row, double value, Marked& prim) {
    if (!std::isfinite(value)) return false;
    switch (row.kind) {
    case MarkKind::Rays: show(prim.visibility, row.number, value != 0.0); return true;
    case MarkKind::Matte: prim.catching.matte = value != 0.0; return true;
    case MarkKind::Shadows: prim.catching.shadows = value != 0.0; return true;
    case MarkKind::Reflections: prim.catching.reflections = value != 0.0; return true;
    case MarkKind::ArnoldMask:
        if (value < 0.0 || value > 255.0) return false;
        show(prim.visibility, RayAny, false);
        show(prim.visibility, raysOfArnold(unsigned(value)), true);
        return true;
    case MarkKind::KarmaHoldout:
        if (value != 0.0 && value != 1.0 && value != 2.0) return false;
        prim.catching = {value == 1.0, value == 2.0, value == 2.0};
        return true;
    case MarkKind::Priority:
        if (value < 0.0 || value > 1e6 || value != std::floor(value)) return false;
        prim.dielectricPriority = int(value);
        return true;
    case MarkKind::DiffuseTransmission: return (value != 0.0) == prim.visibility.transmission;
    default: return false;
    }
}

bool takeText(const MarkRow& row, const std::string& value, Marked& prim) {
    unsigned rays = 0;
    switch (row.kind) {
    case MarkKind::KarmaRays:
        if (!raysOfKarma(value, rays)) return false;
        show(prim.visibility, RayAny, false);
        show(prim.visibility, rays, true);
        return true;
    case MarkKind::MatteName: prim.matteName = value; return true;
    case MarkKind::AssetName: prim.assetName = value; return true;
    default: return false;
    }
}

} // namespace

std::vector<std::string> markNames() {
    std::vector<std::string> names;
    for (const MarkRow& row : rows())
        names.push_back(row.name);
    return names;
}

bool isMark(const std::string& name) {
    return std::any_of(rows().begin(), rows().end(),
                       [&](const MarkRow& row) { return name == row.name; });
}

void applyMarks(const Marks& marks, Marked& prim, const std::string& path,
                Diagnostics& diagnostics) {
    if (marks.empty()) return;
    for (const MarkRow& row : rows()) {
        const auto found = marks.find(row.name);
        if (found == marks.end()) continue;
        const auto* text = std::get_if<std::string>(&found->second);
        if (text ? takeText(row, *text, prim)
                 : takeNumber(row, std::get<double>(found->second), prim))
            continue;
        diagnostics.warn(path, "primvars:" + found->first,
                         row.kind == MarkKind::DiffuseTransmission ? messages::markNotRead
                                                                   : messages::markUnknown);
    }
}

} // namespace patina
