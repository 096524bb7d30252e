// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/color/colorSpacesBuiltin.h"

#include <glm/glm.hpp>

#include <cmath>
#include <initializer_list>
#include <locale>
#include <sstream>
#include <vector>

namespace ocio = OCIO_NAMESPACE;

namespace patina {

namespace {

// CIE 1931 chromaticities: ITU-R BT.709 and BT.2020, SMPTE RP 431-2 with D65 (Display P3), Adobe
// RGB (1998), SMPTE ST 2065-1 (AP0) and ACES S-2014-004 (AP1).
constexpr double d65x = 0.3127, d65y = 0.3290, acesX = 0.32168, acesY = 0.33767;
const Primaries rec709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {d65x, d65y}};
const Primaries rec2020 = {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {d65x, d65y}};
const Primaries displayP3 = {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {d65x, d65y}};
const Primaries adobeRgb = {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {d65x, d65y}};
const Primaries ap0 = {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, {acesX, acesY}};
const Primaries ap1 = {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {acesX, acesY}};
// The axes of XYZ themselves; their white is that of the data.
const Primaries xyzD65 = {{1, 0}, {0, 1}, {0, 0}, {d65x, d65y}};

enum class Curve { Linear, Srgb, Gamma };

struct Space {
    const char* name;
    std::initializer_list<const char*> aliases;
    const Primaries* primaries;
    Curve curve;
    double gamma;
};

const Space spaces[] = {
    {"lin_rec709",
     {"lin_rec709_scene", "lin_rec709_srgb", "lin_srgb", "linear", "scene-linear Rec.709-sRGB",
      "Linear Rec.709 (sRGB)", "Utility - Linear - sRGB", "Utility - Linear - Rec.709",
      "Linear sRGB", "Linear BT.709"},
     &rec709,
     Curve::Linear,
     1.0},
    {"srgb_texture",
     {"sRGB", "srgb_rec709_scene", "srgb_tx", "sRGB - Texture", "Utility - sRGB - Texture",
      "sRGB Encoded Rec.709 (sRGB)", "srgb_encoded_rec709", "Input - Generic - sRGB - Texture"},
     &rec709,
     Curve::Srgb,
     2.4},
    {"srgb_display",
     {"srgb_rec709_display", "Output - sRGB", "sRGB - Display"},
     &rec709,
     Curve::Srgb,
     2.4},
    {"g22_rec709",
     {"g22_rec709_scene", "g22_rec709_display", "g22_rec709_tx", "gamma22",
      "Gamma 2.2 Rec.709 - Texture", "Gamma 2.2 Encoded Rec.709",
      "Utility - Gamma 2.2 - Rec.709 - Texture"},
     &rec709,
     Curve::Gamma,
     2.2},
    {"g18_rec709",
     {"g18_rec709_scene", "g18_rec709_tx", "gamma18", "Gamma 1.8 Rec.709 - Texture",
      "Gamma 1.8 Encoded Rec.709"},
     &rec709,
     Curve::Gamma,
     1.8},
    {"rec709_display",
     {"g24_rec709", "g24_rec709_scene", "g24_rec709_display", "g24_rec709_tx", "gamma24",
      "Gamma 2.4 Rec.709 - Texture", "Gamma 2.4 Encoded Rec.709"},
     &rec709,
     Curve::Gamma,
     2.4},
    {"lin_ap1", {"lin_ap1_scene", "acescg", "ACES - ACEScg", "ACEScg"}, &ap1, Curve::Linear, 1.0},
    {"g22_ap1",
     {"g22_ap1_scene", "g22_ap1_tx", "Gamma 2.2 AP1 - Texture", "Gamma 2.2 Encoded AP1"},
     &ap1,
     Curve::Gamma,
     2.2},
    {"srgb_ap1",
     {"srgb_ap1_scene", "srgb_encoded_ap1_tx", "sRGB Encoded AP1"},
     &ap1,
     Curve::Srgb,
     2.4},
    {"lin_ap0",
     {"lin_ap0_scene", "ACES2065-1", "aces", "ACES - ACES2065-1"},
     &ap0,
     Curve::Linear,
     1.0},
    {"lin_rec2020",
     {"lin_rec2020_scene", "Linear Rec.2020", "Utility - Linear - Rec.2020"},
     &rec2020,
     Curve::Linear,
     1.0},
    {"lin_displayp3",
     {"lin_p3d65", "lin_p3d65_scene", "Linear P3-D65"},
     &displayP3,
     Curve::Linear,
     1.0},
    {"srgb_displayp3",
     {"srgb_p3d65_scene", "srgb_p3d65_display", "srgb_encoded_p3d65_tx",
      "sRGB Encoded P3-D65 - Texture", "sRGB Encoded P3-D65"},
     &displayP3,
     Curve::Srgb,
     2.4},
    {"lin_adobergb", {"lin_adobergb_scene", "Linear AdobeRGB"}, &adobeRgb, Curve::Linear, 1.0},
    {"adobergb",
     {"g22_adobergb_scene", "g22_adobergb", "AdobeRGB", "Gamma 2.2 Encoded AdobeRGB"},
     &adobeRgb,
     Curve::Gamma,
     563.0 / 256.0},
    {"lin_ciexyzd65",
     {"lin_ciexyzd65_scene", "CIE-XYZ-D65", "CIE XYZ-D65 - Scene-referred"},
     &xyzD65,
     Curve::Linear,
     1.0},
};

glm::dvec3 xyzOf(const double (&xy)[2]) {
    return {xy[0], xy[1], 1.0 - xy[0] - xy[1]};
}

glm::dmat3 toXyz(const Primaries& p) {
    glm::dmat3 axes(xyzOf(p.red), xyzOf(p.green), xyzOf(p.blue));
    if (&p == &xyzD65) return axes;
    glm::dvec3 scale = glm::inverse(axes) * (xyzOf(p.white) / p.white[1]);
    return {axes[0] * scale.r, axes[1] * scale.g, axes[2] * scale.b};
}

glm::dmat3 bradford(const double (&fromWhite)[2], const double (&toWhite)[2]) {
    const glm::dmat3 cone = glm::transpose(
        glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    glm::dvec3 from = cone * (xyzOf(fromWhite) / fromWhite[1]);
    glm::dvec3 to = cone * (xyzOf(toWhite) / toWhite[1]);
    glm::dvec3 ratio = to / from;
    glm::dmat3 diagonal(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z);
    return glm::inverse(cone) * diagonal * cone;
}

/// @param offset of an exponent that becomes linear towards black, as that of sRGB; 0: a plain one
void appendCurve(ocio::GroupTransformRcPtr& group, double gamma, double offset) {
    if (offset > 0.0) {
        auto curve = ocio::ExponentWithLinearTransform::Create();
        curve->setGamma({gamma, gamma, gamma, 1.0});
        curve->setOffset({offset, offset, offset, 0.0});
        curve->setNegativeStyle(ocio::NEGATIVE_LINEAR);
        group->appendTransform(curve);
    } else if (gamma != 1.0) {
        auto curve = ocio::ExponentTransform::Create();
        curve->setValue({gamma, gamma, gamma, 1.0});
        curve->setNegativeStyle(ocio::NEGATIVE_MIRROR);
        group->appendTransform(curve);
    }
}

void appendMatrix(ocio::GroupTransformRcPtr& group, const Primaries& primaries) {
    std::array<double, 9> m = matrixToRec709(primaries);
    auto matrix = ocio::MatrixTransform::Create();
    matrix->setMatrix(std::array<double, 16>{m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7],
                                             m[8], 0, 0, 0, 0, 1}
                          .data());
    group->appendTransform(matrix);
}

ocio::TransformRcPtr toReference(const Space& space) {
    ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
    if (space.curve != Curve::Linear)
        appendCurve(group, space.gamma, space.curve == Curve::Srgb ? 0.055 : 0.0);
    if (space.primaries != &rec709) appendMatrix(group, *space.primaries);
    return group;
}

} // namespace

std::array<double, 9> matrixToRec709(const Primaries& primaries) {
    glm::dmat3 m =
        glm::inverse(toXyz(rec709)) * bradford(primaries.white, rec709.white) * toXyz(primaries);
    std::array<double, 9> rows;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            rows[size_t(row * 3 + column)] = m[column][row];
    return rows;
}

glm::dmat3 rec709ToXyz() {
    return toXyz(rec709);
}

std::optional<std::array<float, 8>> builtinChromaticities(const std::string& name) {
    for (const Space& space : spaces)
        if (name == space.name && space.curve == Curve::Linear && space.primaries != &xyzD65) {
            const Primaries& p = *space.primaries;
            return std::array<float, 8>{float(p.red[0]),   float(p.red[1]),  float(p.green[0]),
                                        float(p.green[1]), float(p.blue[0]), float(p.blue[1]),
                                        float(p.white[0]), float(p.white[1])};
        }
    return std::nullopt;
}

ocio::ConstTransformRcPtr parseChromaticities(const std::string& text) {
    const std::string start = "chromaticities(";
    if (text.compare(0, start.size(), start) != 0 || text.back() != ')') return nullptr;
    std::istringstream stream(text.substr(start.size(), text.size() - start.size() - 1));
    stream.imbue(std::locale::classic());
    std::vector<double> n;
    for (double x; stream >> x;)
        n.push_back(x);
    if (!stream.eof() || n.size() != 10) return nullptr;
    const Primaries primaries = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
    const double gamma = n[8], offset = n[9];
    const double area = (n[2] - n[0]) * (n[5] - n[1]) - (n[3] - n[1]) * (n[4] - n[0]);
    if (!(std::abs(area) > 1e-4)) return nullptr; // that of Rec.709 is 0.22
    // OCIO takes exponents of 1 to 10 and offsets of up to 0.9 with them.
    if (!(n[7] > 0.0) || !(gamma >= 0.01 && gamma <= 10.0) || !(offset >= 0.0 && offset <= 0.9) ||
        (offset > 0.0 && !(gamma > 1.0)))
        return nullptr;
    for (const double x : matrixToRec709(primaries))
        if (!std::isfinite(x) || std::abs(x) > 1e6) return nullptr;
    ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
    appendCurve(group, gamma, offset);
    appendMatrix(group, primaries);
    return group;
}

ocio::ConstConfigRcPtr builtinColorConfig() {
    ocio::ConfigRcPtr config = ocio::Config::Create();
    config->setMajorVersion(2);
    config->setDescription("Patina's built-in colour spaces");
    for (const Space& space : spaces) {
        ocio::ColorSpaceRcPtr cs = ocio::ColorSpace::Create();
        cs->setName(space.name);
        for (const char* alias : space.aliases)
            cs->addAlias(alias);
        cs->setBitDepth(ocio::BIT_DEPTH_F32);
        if (space.curve != Curve::Linear || space.primaries != &rec709)
            cs->setTransform(toReference(space), ocio::COLORSPACE_DIR_TO_REFERENCE);
        config->addColorSpace(cs);
    }
    ocio::ColorSpaceRcPtr raw = ocio::ColorSpace::Create();
    raw->setName("raw");
    raw->setIsData(true);
    config->addColorSpace(raw);

    config->setRole(ocio::ROLE_SCENE_LINEAR, "lin_rec709");
    config->setRole(ocio::ROLE_DEFAULT, "raw");
    config->setRole(ocio::ROLE_INTERCHANGE_SCENE, "lin_ap0");
    struct {
        const char *display, *space;
    } displays[] = {{"sRGB", "srgb_display"},
                    {"Rec.1886 Rec.709", "rec709_display"},
                    {"Display P3", "srgb_displayp3"}};
    for (auto& d : displays) {
        config->addDisplayView(d.display, "Standard", d.space, "");
        config->addDisplayView(d.display, "Raw", "raw", "");
    }
    config->setActiveDisplays("sRGB, Rec.1886 Rec.709, Display P3");
    config->setActiveViews("Standard, Raw");
    return config;
}

} // namespace patina
