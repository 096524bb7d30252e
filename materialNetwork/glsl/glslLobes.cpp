#include "materialNetwork/glsl/glslLobes.h"

#include <vector>

namespace patina {

std::string glslLobePrefix(LobeKind kind) {
    switch (kind) {
    case LobeKind::OrenNayar:
    case LobeKind::Subsurface: return "orenNayar";
    case LobeKind::Burley: return "burley";
    case LobeKind::Translucent: return "translucent";
    case LobeKind::Dielectric: return "dielectric";
    case LobeKind::Conductor: return "conductor";
    case LobeKind::Schlick: return "schlick";
    case LobeKind::Sheen: return "sheen";
    case LobeKind::Phong: return "phong";
    case LobeKind::BlinnPhong: return "blinnPhong";
    case LobeKind::Ward: return "ward";
    case LobeKind::CookTorrance: return "cookTorrance";
    case LobeKind::ChiangHair: return "chiangHair";
    case LobeKind::Layered: break; // is never among the lobes of a program
    }
    return "orenNayar";
}

std::string glslLobeType(LobeKind kind) {
    std::string name = glslLobePrefix(kind);
    name[0] = char(name[0] - 'a' + 'A');
    return name + "Lobe";
}

std::string glslLobeSetup(const LobeTemplate& t,
                          const std::function<std::string(Register)>& registers) {
    // In the order of the inputs, whatever order the compiler evaluates operands in.
    std::vector<std::string> known;
    const auto at = [&](int i) {
        while (int(known.size()) <= i)
            known.push_back(registers(t.parameters[known.size()]));
        return known[size_t(i)];
    };
    const auto color = [&](int i) { return at(i) + ".xyz"; };
    const auto pair = [&](int i) { return at(i) + ".xy"; };
    const auto number = [&](int i) { return at(i) + ".x"; };
    const auto flag = [](bool b) { return std::string(b ? "true" : "false"); };
    const std::string mode = std::to_string(t.mode), variant = std::to_string(t.variant);
    const std::string retro = flag(t.flagA);
    const std::string tail = ", " + retro + ", " + mode + ", " + flag(t.sharedInterface) + ", " +
                             std::to_string(t.compensate);
    switch (t.prebuilt.kind) {
    case LobeKind::Layered: break;
    case LobeKind::OrenNayar:
        return "orenNayarModel(" + color(0) + ", " + number(1) + ", " + retro + ", " +
               std::to_string(int(t.diffuse)) + ")";
    case LobeKind::Subsurface: return "orenNayarSetup(" + color(0) + ", 0.0, false)";
    case LobeKind::Burley: return "burleySetup(" + color(0) + ", " + number(1) + ")";
    case LobeKind::Translucent: return "translucentSetup(" + color(0) + ")";
    case LobeKind::Dielectric:
        return "dielectricSetup(" + color(0) + ", " + number(1) + ", " + pair(2) + tail + ")";
    case LobeKind::Conductor: {
        const std::string metal = "conductorSetup(" + color(0) + ", " + color(1) + ", " + pair(2) +
                                  ", " + retro + ", " + std::to_string(t.compensate) + ")";
        return t.film ? "conductorFilm(" + metal + ", " + number(3) + ", " + number(4) + ")"
                      : metal;
    }
    case LobeKind::Schlick: {
        if (t.filmDielectric)
            return "filmDielectricSetup(" + color(0) + ", " + number(1) + ", " + pair(2) + ", " +
                   number(3) + ", " + number(4) + tail + ")";
        const std::string bare = "schlickSetup(" + color(0) + ", " + color(1) + ", " + color(2) +
                                 ", " + number(3) + ", " + pair(4) + tail + ")";
        return t.film ? "schlickFilm(" + bare + ", " + number(5) + ", " + number(6) + ")" : bare;
    }
    case LobeKind::Sheen: {
        const std::string bare = "sheenSetup(" + color(0) + ", " + number(1) + ", " + variant + ")";
        return t.sheenAlbedo == sh::SHEEN_TABLED
                   ? bare
                   : "sheenMethods(" + bare + ", " + std::to_string(t.sheenAlbedo) + ")";
    }
    case LobeKind::Phong: return "phongSetup(" + color(0) + ", " + number(1) + ")";
    case LobeKind::BlinnPhong: return "blinnPhongSetup(" + color(0) + ", " + number(1) + ")";
    case LobeKind::Ward: return "wardSetup(" + color(0) + ", " + pair(1) + ", " + variant + ")";
    case LobeKind::CookTorrance:
        return "cookTorranceSetup(" + color(0) + ", " + color(1) + ", " + color(2) + ", " +
               number(3) + ", " + variant + ")";
    case LobeKind::ChiangHair:
        return "chiangHairSetup(" + color(0) + ", " + color(1) + ", " + color(2) + ", " +
               number(3) + ", " + pair(4) + ", " + pair(5) + ", " + pair(6) + ", " + number(7) +
               ", " + color(8) + ")";
    }
    return "";
}

} // namespace patina
