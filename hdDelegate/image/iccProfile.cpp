// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/iccProfile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <locale>
#include <sstream>
#include <vector>

namespace patina {

namespace {

constexpr CurveShape srgbCurve = {2.4, 0.055};

/// Numbers of a profile, big-endian; what lies beyond its end is 0.
struct Bytes {
    const uint8_t* data;
    size_t size;

    uint32_t number(size_t at, int count) const {
        uint32_t value = 0;
        for (size_t i = at; i < at + size_t(count); ++i)
            value = value << 8 | (i < size ? data[i] : 0u);
        return value;
    }
    double fixed(size_t at) const { return double(int32_t(number(at, 4))) / 65536.0; }
    bool is(size_t at, const char* name) const {
        return at <= size && size - at >= 4 && std::memcmp(data + at, name, 4) == 0;
    }
    /// @returns what a tag points to; empty where there is none
    Bytes tag(const char* name) const {
        constexpr size_t table = 128;
        const size_t count = std::min<size_t>(number(table, 4), 100);
        for (size_t i = 0; i < count; ++i) {
            const size_t row = table + 4 + 12 * i, at = number(row + 4, 4);
            if (is(row, name) && at < size)
                return {data + at, std::min<size_t>(number(row + 8, 4), size - at)};
        }
        return {data, 0};
    }
};

using Curve = std::function<double(double)>;

double evaluate(const CurveShape& shape, double x) {
    if (shape.offset <= 0.0) return std::pow(x, shape.gamma);
    const double g = shape.gamma, b = shape.offset;
    const double corner = b / (g - 1.0); // where the line through 0 touches
    const double slope = std::pow((corner + b) / (1.0 + b), g) / corner;
    return x > corner ? std::pow((x + b) / (1.0 + b), g) : slope * x;
}

bool follows(const Curve& curve, const CurveShape& shape) {
    constexpr double near = 1e-3; // sRGB and an exponent of 2.2 differ by 8 times as much
    for (int i = 0; i <= 64; ++i)
        if (!(std::abs(curve(i / 64.0) - evaluate(shape, i / 64.0)) < near)) return false;
    return true;
}

/// A curveType or parametricCurveType. @returns false for others
bool readCurve(const Bytes& tag, Curve& curve, CurveShape& guess) {
    if (tag.is(0, "curv")) {
        const size_t count = tag.number(8, 4);
        if (count < 2) {
            guess.gamma = count == 0 ? 1.0 : tag.number(12, 2) / 256.0;
            curve = [g = guess.gamma](double x) { return std::pow(x, g); };
            return true;
        }
        if (count > tag.size / 2) return false;
        curve = [tag, count](double x) {
            const double place = x * double(count - 1);
            const size_t i = std::min(size_t(place), count - 2);
            const double a = tag.number(12 + 2 * i, 2), b = tag.number(14 + 2 * i, 2);
            return (a + (b - a) * (place - double(i))) / 65535.0;
        };
        guess.gamma = std::log(curve(0.5)) / std::log(0.5);
        return true;
    }
    if (!tag.is(0, "para")) return false;
    // Y = (a X + b)^g + e from d on, c X + f below it; simpler types leave out the last ones.
    const uint32_t type = tag.number(8, 2);
    if (type > 4) return false;
    double p[7] = {1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const int counts[] = {1, 3, 4, 5, 7};
    for (int i = 0; i < counts[type]; ++i)
        p[i] = tag.fixed(size_t(12 + 4 * i));
    if (type == 1 || type == 2) {
        p[5] = p[6] = type == 2 ? p[3] : 0.0;
        p[3] = 0.0;
        p[4] = p[1] != 0.0 ? -p[2] / p[1] : 0.0;
    }
    curve = [p = std::vector<double>(p, p + 7)](double x) {
        return x >= p[4] ? std::pow(std::max(p[1] * x + p[2], 0.0), p[0]) + p[5] : p[3] * x + p[6];
    };
    guess = {p[0], p[1] > 0.0 ? std::max(p[2] / p[1], 0.0) : 0.0};
    return true;
}

/// @returns false where no exponent follows the curve
bool shapeOf(const Bytes& tag, CurveShape& shape) {
    Curve curve;
    CurveShape guess;
    if (!readCurve(tag, curve, guess)) return false;
    for (const CurveShape& tried : {CurveShape(), srgbCurve, guess}) {
        shape = tried;
        if (follows(curve, tried)) return true;
    }
    return false;
}

/// The chromaticities of colorants that are adapted to the white of the profile.
bool primariesOf(const Bytes& profile, Primaries& primaries) {
    double sum[3] = {};
    double(*const xy[])[2] = {&primaries.red, &primaries.green, &primaries.blue};
    const char* names[] = {"rXYZ", "gXYZ", "bXYZ"};
    for (int c = 0; c < 4; ++c) {
        double xyz[3] = {sum[0], sum[1], sum[2]};
        if (c < 3) {
            const Bytes tag = profile.tag(names[c]);
            if (!tag.is(0, "XYZ ") || tag.size < 20) return false;
            for (int k = 0; k < 3; ++k)
                sum[k] += xyz[k] = tag.fixed(size_t(8 + 4 * k));
        }
        const double all = xyz[0] + xyz[1] + xyz[2];
        if (!(std::abs(all) > 1e-4)) return false;
        double(&to)[2] = c < 3 ? *xy[c] : primaries.white;
        to[0] = xyz[0] / all;
        to[1] = xyz[1] / all;
    }
    return true;
}

/// Whether a profile's description, in 8 or 16 bits a letter, names sRGB.
bool isCalledSrgb(const Bytes& profile) {
    const Bytes tag = profile.tag("desc");
    std::string letters;
    for (size_t i = 8; i < std::min<size_t>(tag.size, 400); ++i)
        if (tag.data[i]) letters += char(tag.data[i]);
    return letters.find("sRGB") != std::string::npos;
}

bool isRec709(const Primaries& primaries) {
    const std::array<double, 9> m = matrixToRec709(primaries);
    for (size_t i = 0; i < 9; ++i)
        if (!(std::abs(m[i] - (i % 4 == 0 ? 1.0 : 0.0)) < 3e-3)) return false;
    return true;
}

} // namespace

std::string spaceOf(const Primaries* primaries, const CurveShape& curve) {
    static const Primaries rec709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
    const auto nearly = [&](const CurveShape& other) {
        return follows([&](double x) { return evaluate(curve, x); }, other);
    };
    if (primaries && isRec709(*primaries)) primaries = nullptr;
    if (!primaries && nearly(CurveShape())) return "raw";
    if (!primaries && nearly(srgbCurve)) return "srgb_texture";
    const Primaries& p = primaries ? *primaries : rec709;
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(9);
    text << "chromaticities(";
    for (const double(*xy)[2] : {&p.red, &p.green, &p.blue, &p.white})
        text << (*xy)[0] << ' ' << (*xy)[1] << ' ';
    text << curve.gamma << ' ' << curve.offset << ')';
    return text.str();
}

std::string spaceOfIccProfile(const uint8_t* bytes, size_t size) {
    const Bytes profile{bytes, size};
    if (!profile.is(36, "acsp")) return {};
    Primaries primaries;
    CurveShape curve;
    if (profile.is(16, "GRAY") && shapeOf(profile.tag("kTRC"), curve))
        return spaceOf(nullptr, curve);
    if (profile.is(16, "RGB ") && shapeOf(profile.tag("gTRC"), curve) &&
        primariesOf(profile, primaries))
        return spaceOf(&primaries, curve);
    return isCalledSrgb(profile) ? "srgb_texture" : "";
}

} // namespace patina
