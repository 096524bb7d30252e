// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/iesProfile.h"

#include "base/maths.h"
#include "base/regularFile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace patina {

namespace {
constexpr size_t largestTable = 4u << 20;
constexpr double brightest = 1e30; ///< candela; sums and quotients of such stay finite as floats

/// Numbers of the data block, separated by blanks, line ends or commas.
class Numbers {
public:
    explicit Numbers(const char* text) : _at(text) {}

    bool next(double& value) {
        while (*_at && (std::isspace(static_cast<unsigned char>(*_at)) || *_at == ','))
            ++_at;
        char* end = nullptr;
        value = std::strtod(_at, &end);
        if (end == _at || !std::isfinite(value)) return false;
        _at = end;
        return true;
    }

    bool skip(size_t count) {
        double ignored;
        for (size_t i = 0; i < count; ++i)
            if (!next(ignored)) return false;
        return true;
    }

private:
    const char* _at;
};

/// Reads `count` angles that do not descend.
bool readAngles(Numbers& numbers, size_t count, std::vector<float>& angles) {
    angles.clear();
    for (size_t i = 0; i < count; ++i) {
        double value;
        if (!numbers.next(value) || (i && value < angles.back()) || std::abs(value) > 720.0)
            return false;
        angles.push_back(float(value));
    }
    return true;
}

/// Where x lies among ascending values. @returns false outside them
bool bracket(const std::vector<float>& values, float x, size_t& index, float& fraction) {
    constexpr float slack = 1e-3f; // degrees: the ends of a table are inside
    index = 0;
    fraction = 0.0f;
    if (values.size() < 2 || x < values.front() - slack || x > values.back() + slack) return false;
    const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, x);
    index = size_t(above - values.begin()) - 1;
    const float span = values[index + 1] - values[index];
    fraction = span > 0.0f ? std::clamp((x - values[index]) / span, 0.0f, 1.0f) : 0.0f;
    return true;
}

} // namespace

bool IesProfile::load(const std::string& file, std::string& error) {
    *this = IesProfile();
    std::string text;
    return readRegularFile(file, Limit::documentBytes, text, error) && parse(text, error);
}

bool IesProfile::parse(const std::string& text, std::string& error) {
    *this = IesProfile();
    const size_t tilt = text.find("TILT=");
    if (tilt == std::string::npos) {
        error = "has no TILT line, it is not an IES LM-63 file";
        return false;
    }
    const size_t lineEnd = text.find_first_of("\r\n", tilt);
    if (lineEnd == std::string::npos) {
        error = "ends after its TILT line";
        return false;
    }
    Numbers numbers(text.c_str() + lineEnd);
    error = "is truncated or has something other than numbers in its data";
    if (text.compare(tilt + 5, 7, "INCLUDE") == 0) {
        double geometry, pairs;
        if (!numbers.next(geometry) || !numbers.next(pairs) || pairs < 0.0 || pairs > 1e6 ||
            !numbers.skip(2 * size_t(pairs)))
            return false;
    }
    // lamps, lumens, multiplier, vertical, horizontal, type, units, width, length, height,
    // ballast factor, future use (a second factor in old files, in those of 2019 how it was made),
    // watts
    double head[13];
    for (double& value : head)
        if (!numbers.next(value)) return false;
    if (head[5] != 1.0) {
        error = "has photometric type A or B, only type C is supported";
        return false;
    }
    if (!(head[3] >= 1.0 && head[4] >= 1.0) || head[3] * head[4] > double(largestTable)) {
        error = "has an impossible number of angles";
        return false;
    }
    const size_t verticals = size_t(head[3]), horizontals = size_t(head[4]);
    const bool tellsOrigin = text.compare(0, 14, "IES:LM-63-2019") == 0;
    const double factor = head[2] * head[10] * (tellsOrigin ? 1.0 : head[11]);
    if (!readAngles(numbers, verticals, _vertical) ||
        !readAngles(numbers, horizontals, _horizontal)) {
        error = "has angles that are missing, too large or not in ascending order";
        *this = IesProfile();
        return false;
    }
    std::vector<float> candela(verticals * horizontals);
    for (float& value : candela) {
        double number;
        if (!numbers.next(number)) {
            *this = IesProfile();
            return false;
        }
        if (!(std::abs(number * factor) <= brightest)) {
            error = "has more candela than any light";
            *this = IesProfile();
            return false;
        }
        value = float(std::max(0.0, number * factor));
    }
    _candela = std::move(candela);
    if (verticals < 2 || !expandHorizontal(error)) {
        if (verticals < 2) error = "has fewer than two vertical angles";
        *this = IesProfile();
        return false;
    }
    measure();
    error.clear();
    return true;
}

/// Makes the table go once around: LM-63 leaves out what symmetry implies.
bool IesProfile::expandHorizontal(std::string& error) {
    const size_t rows = _vertical.size();
    const float first = _horizontal.front(), last = _horizontal.back();
    std::vector<float> angles = _horizontal, table = _candela;
    const auto row = [&](size_t from) {
        const std::vector<float> copy(table.begin() + from * rows,
                                      table.begin() + (from + 1) * rows);
        return copy;
    };
    const auto mirror = [&](float about) {
        for (size_t i = angles.size() - 1; i-- > 0;) {
            const std::vector<float> copy = row(i);
            angles.push_back(2.0f * about - angles[i]);
            table.insert(table.end(), copy.begin(), copy.end());
        }
    };
    if (_horizontal.size() == 1) {
        const std::vector<float> copy = row(0);
        angles = {0.0f, 360.0f};
        table.insert(table.end(), copy.begin(), copy.end());
    } else if (first == 0.0f && last == 90.0f) {
        mirror(90.0f);
        mirror(180.0f);
    } else if (first == 0.0f && last == 180.0f) {
        mirror(180.0f);
    } else if (first == 90.0f && last == 270.0f) {
        // Symmetric about the plane 90-270: wrap the half around, starting at 0.
        mirror(270.0f); // 90..450
        std::vector<std::pair<float, size_t>> order;
        for (size_t i = 0; i + 1 < angles.size(); ++i)
            order.push_back({std::fmod(angles[i], 360.0f), i});
        std::sort(order.begin(), order.end());
        std::vector<float> turned, values;
        for (const auto& entry : order) {
            turned.push_back(entry.first);
            const std::vector<float> copy = row(entry.second);
            values.insert(values.end(), copy.begin(), copy.end());
        }
        if (turned.front() > 0.0f) { // no plane at 0: interpolate it
            const float gap = turned.front() + 360.0f - turned.back();
            const float t = gap > 0.0f ? (360.0f - turned.back()) / gap : 0.0f;
            std::vector<float> zero(rows);
            for (size_t v = 0; v < rows; ++v)
                zero[v] = (1.0f - t) * values[values.size() - rows + v] + t * values[v];
            values.insert(values.begin(), zero.begin(), zero.end());
            turned.insert(turned.begin(), 0.0f);
        }
        turned.push_back(360.0f);
        const std::vector<float> zero(values.begin(), values.begin() + rows);
        values.insert(values.end(), zero.begin(), zero.end());
        angles = std::move(turned);
        table = std::move(values);
    } else if (first == 0.0f && last > 180.0f && last < 360.0f) {
        // Goes around without repeating the first plane at 360.
        const std::vector<float> copy = row(0);
        angles.push_back(360.0f);
        table.insert(table.end(), copy.begin(), copy.end());
    } else if (!(first == 0.0f && last == 360.0f)) {
        error = "has horizontal angles that LM-63 does not allow";
        return false;
    }
    _horizontal = std::move(angles);
    _candela = std::move(table);
    return true;
}

float IesProfile::factor(float theta, float phi) const {
    return _mean > 0.0f ? candela(theta, phi) / _mean : 0.0f;
}

void IesProfile::measure() {
    const size_t rows = _vertical.size();
    double total = 0.0;
    for (size_t h = 0; h + 1 < _horizontal.size(); ++h) {
        const double dphi = (_horizontal[h + 1] - _horizontal[h]) * piDouble / 180.0;
        for (size_t v = 0; v + 1 < rows; ++v) {
            const double t0 = _vertical[v] * piDouble / 180.0,
                         t1 = _vertical[v + 1] * piDouble / 180.0;
            if (!(t1 > t0)) continue;
            const double i0 = 0.5 * (_candela[h * rows + v] + _candela[(h + 1) * rows + v]);
            const double i1 = 0.5 * (_candela[h * rows + v + 1] + _candela[(h + 1) * rows + v + 1]);
            // Exact for a table that is linear in the angle: integral of (a + b t) sin t.
            const double b = (i1 - i0) / (t1 - t0), a = i0 - b * t0;
            const auto antiderivative = [&](double t) {
                return -(a + b * t) * std::cos(t) + b * std::sin(t);
            };
            total += dphi * (antiderivative(t1) - antiderivative(t0));
        }
    }
    const bool sphere =
        (_vertical.back() - _vertical.front()) * piDouble / 180.0 > 0.5 * piDouble + 0.1;
    _mean = float(total / (sphere ? 4.0 * piDouble : 2.0 * piDouble));
    _peak = *std::max_element(_candela.begin(), _candela.end());
}

float IesProfile::candela(float theta, float phi) const {
    if (empty()) return 0.0f;
    const float degrees = float(180.0 / piDouble);
    float around = std::fmod(phi * degrees, 360.0f);
    if (around < 0.0f) around += 360.0f;
    size_t h, v;
    float fh, fv;
    if (!bracket(_vertical, theta * degrees, v, fv) || !bracket(_horizontal, around, h, fh))
        return 0.0f;
    const size_t rows = _vertical.size();
    const float* a = &_candela[h * rows + v];
    const float* b = a + rows;
    return (1.0f - fh) * ((1.0f - fv) * a[0] + fv * a[1]) + fh * ((1.0f - fv) * b[0] + fv * b[1]);
}

float IesProfile::scaledTheta(float theta, float angleScale) {
    const float half = float(piDouble);
    if (angleScale > 0.0f)
        theta = theta / angleScale;
    else if (angleScale < 0.0f)
        theta = (theta - half) / -angleScale + half;
    return std::clamp(theta, 0.0f, half);
}

} // namespace patina
