// SPDX-License-Identifier: Apache-2.0
// Every lobe as the driver runs it, against the same text as C++ in double precision.

#include "hdDelegate/raster/tests/agreement.h"
#include "hdDelegate/raster/tests/rasterFixture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace patina;
using namespace patina::test;

namespace {

/// Facts that hold for all lobes of a row, as the rasterizer says it of a material: drivers take
/// several times as long for what never runs.
std::string knownOf(const AgreementRow& row) {
    std::string text;
    if (row.setup.find("ilm") == std::string::npos) text += "#define PATINA_FILM(present) false\n";
    if (row.hasEnergy()) text += "#define PATINA_ENERGY_KNOWN(known) true\n";
    if (row.name.compare(0, 7, "methods") != 0)
        text += "#define PATINA_ALBEDO_METHOD(method) 0\n#define PATINA_FILM_METHOD(method) 0\n";
    return text;
}

std::string shaderOf(const AgreementRow& row) {
    std::string text = knownOf(row) + R"(
#include "shaders/compat/glsl.glsl"
#include "shaders/lobes.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Parameters { float parameters[]; };
layout(std430, binding = 1) readonly buffer Points { float points[]; };
layout(std430, binding = 2) writeonly buffer Answers { float answers[]; };
layout(location = 0) uniform int pointCount;
layout(location = 1) uniform int total;
int base;
float p1(int i) { return parameters[base + i]; }
vec2 p2(int i) { return vec2(p1(i), p1(i + 1)); }
vec3 p3(int i) { return vec3(p1(i), p1(i + 1), p1(i + 2)); }
vec3 splat(float x) { return vec3(x); }
bool pb(int i) { return p1(i) > 0.5; }
int pn(int i) { return int(p1(i) + 0.5); }
vec3 point3(int i) { return vec3(points[i], points[i + 1], points[i + 2]); }
void put(int i, vec3 v) {
    answers[i] = v.x;
    answers[i + 1] = v.y;
    answers[i + 2] = v.z;
}
void main() {
    int id = int(gl_GlobalInvocationID.x);
    if (id >= total) return;
    base = (id / pointCount) * PARAMETERS;
    int p = (id % pointCount) * 9;
    int o = id * 20;
    vec3 wo = point3(p);
    vec3 wi = point3(p + 3);
    vec3 u = point3(p + 6);
)";
    if (row.prefix.empty()) {
        text += "    put(o, " + row.setup + ");\n}\n";
    } else {
        const std::string& f = row.prefix;
        std::string type = f;
        type[0] = char(type[0] - 'a' + 'A');
        text += "    " + type + "Lobe l = " + row.setup + ";\n";
        if (row.hasEnergy()) text += "    l = " + f + "At(l, wo);\n";
        text += "    LobeEval e = " + f + "Eval(l, wo, wi);\n    LobeSample s = " + f +
                "Sample(l, wo, u);\n" + R"(
    put(o, e.value);
    answers[o + 3] = e.pdf;
    put(o + 4, s.wi);
    put(o + 7, s.weight);
    answers[o + 10] = s.pdf;
    answers[o + 11] = float(s.event);
    answers[o + 12] = s.eta;
)";
        text += "    put(o + 13, " + row.albedo + "(l, wo));\n}\n";
    }
    const std::string key = "PARAMETERS";
    text.replace(text.find(key), key.size(), std::to_string(AgreementRow::maxParameters));
    return text;
}

AgreementAnswer fromDriver(const AgreementRow& row, const float* v) {
    AgreementAnswer a;
    const auto vec = [v](int i) { return vec3(v[i], v[i + 1], v[i + 2]); };
    a.eval = {vec(0), v[3]};
    if (row.prefix.empty()) {
        a.sample = sh64::lobeSampleNone();
        return a;
    }
    a.sample = {vec(4), vec(7), v[10], int(v[11]), v[12]};
    a.albedo = vec(13);
    return a;
}

/// Why points of a lobe are further than 1e-4 from the oracle. All of them are rounding of single
/// precision: float C++ has as many, and as far off.
struct Reason {
    const char* row; ///< beginning of the row's name
    const char* cause;
};
const Reason reasons[] = {
    {"dielectric",
     "past total reflection and under shared interfaces what passes is 1 minus nearly 1"},
    {"schlick",
     "past total reflection and under shared interfaces what passes is 1 minus nearly 1; an index "
     "of up to 22, from a colour near 1, multiplies the rounding of the cosine by its square"},
    {"conductor", "n below 1 with k 0: facets lie on both sides of total reflection"},
    {"methods of conductor",
     "at grazing angles narrow facets multiply the rounding of their slope"},
    {"methods of dielectric", "at grazing angles and past total reflection what passes is 1 minus "
                              "nearly 1; narrow facets multiply the rounding of their slope"},
    {"methods of schlick",
     "past total reflection and from a colour of 1 what passes is the ratio of "
     "two that are 1 minus nearly 1; narrow facets as above"},
    {"film schlick", "as schlick, and amplitudes of the two faces cancel"},
    {"film", "amplitudes of the two faces cancel, and what passes is 1 minus nearly 1"},
    {"phong", "the exponent multiplies the rounding of the cosine"},
    {"blinnPhong", "the exponent multiplies the rounding of the cosine"},
    {"cookTorrance", "n near 1 with k 0: the reflectance is a difference of nearly equal numbers"},
    {"chiangHair", "densities are exponentials of differences of large numbers"},
};

/// Parts of which more than 0.1 % lie between 1e-5 and 1e-4 where float C++ has fewer.
struct Allowance {
    const char* row;
    AgreementPart part;
    double share; ///< of points above 1e-5
    const char* cause;
};
const Allowance allowances[] = {
    {"phong", PartSamplePdf, 0.02, "exponents up to 2000 multiply the rounding of exp2"},
    {"blinnPhong", PartSamplePdf, 0.02, "exponents up to 2000 multiply the rounding of exp2"},
    {"blinnPhong", PartWeight, 0.006, "exponents up to 2000 multiply the rounding of exp2"},
    {"sheen", PartSamplePdf, 0.004, "exponents up to 200 multiply the rounding of exp2"},
    {"sheen", PartWeight, 0.003, "exponents up to 200 multiply the rounding of exp2"},
    {"methods of sheen", PartSamplePdf, 0.004, "as sheen"},
    {"methods of sheen", PartWeight, 0.004, "as sheen"},
    {"phaseHenyeyGreenstein", PartSamplePdf, 0.15,
     "1 - g of a peak has few digits without fused products"},
    {"film conductor", PartAlbedo, 0.003, "the driver's rounding, below 2e-5; float C++ has none"},
    {"edf schlick", PartEval, 0.025, "the rounding of pow; float C++ calls an exact one"},
};

const char* reasonFor(const std::string& row) {
    for (const Reason& r : reasons)
        if (row.compare(0, std::string(r.row).size(), r.row) == 0) return r.cause;
    return nullptr;
}

double allowedShare(const std::string& row, int part) {
    for (const Allowance& a : allowances)
        if (row == a.row && part == a.part) return a.share;
    return 0.001;
}

/// One part of a lobe's answers over all points.
struct Tally {
    int points = 0, above5 = 0, above4 = 0;
    double worst = 0.0;
    size_t set = 0, point = 0; ///< where it is worst
    void add(double difference, size_t s, size_t i) {
        ++points;
        above5 += difference > 1e-5;
        above4 += difference > 1e-4;
        if (difference <= worst) return;
        worst = difference;
        set = s;
        point = i;
    }
    double share5() const { return double(above5) / points; }
    double share4() const { return double(above4) / points; }
};

/// What chance adds to a share. Rounding is another on the driver, so a point beside a bound may
/// fall on either side. An albedo hangs on wo alone, so its points of one wo fall together, and
/// there are few of such groups: three standard deviations of the difference of two counts of them.
double chanceOf(double share, const Tally& tally, int part) {
    if (part != PartAlbedo) return 0.0;
    constexpr double pointsOfOneWo = 15.0; // see agreementPoints()
    const double groups = tally.points / pointsOfOneWo;
    return 3.0 * std::sqrt(2.0 * std::max(1.0, share * groups)) / groups;
}

/// Whether this processor runs what agreementLoosest.cpp is compiled to.
bool canFuse() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

std::vector<float> runOnDriver(const AgreementRow& row, const GlProgram& program) {
    const std::vector<AgreementPoint> points = agreementPoints();
    std::vector<float> parameters;
    for (const auto& set : row.sets)
        parameters.insert(parameters.end(), set.begin(), set.end());
    const int total = int(points.size() * row.sets.size());
    const std::vector<float> table(patinaAlbedoTable, patinaAlbedoTable + sh::ALBEDO_TABLE_SIZE);
    const GlBuffer parameterBuffer(parameters), pointBuffer(points), tableBuffer(table),
        answerBuffer(std::vector<float>(size_t(total) * 20, 0.0f));
    parameterBuffer.bindStorage(0);
    pointBuffer.bindStorage(1);
    answerBuffer.bindStorage(2);
    tableBuffer.bindStorage(7);
    program.use();
    gl.Uniform1i(0, int(points.size()));
    gl.Uniform1i(1, total);
    return computed<float>(program, size_t(total + 63) / 64, answerBuffer, size_t(total) * 20);
}

} // namespace

class Agreement : public ::testing::TestWithParam<size_t> {};

TEST_P(Agreement, OfLobeWithOracle) {
    PATINA_NEED_CONTEXT();
    const AgreementRow row = agreementRows()[GetParam()];
    // A driver in software computes as C++ does. Others have what GLSL allows.
    const bool exact = context->renderer().find("llvmpipe") != std::string::npos || !canFuse();
    const AgreementRow allowed = loosestRows()[GetParam()];
    const auto program = computeProgram(row.name, shaderOf(row));
    ASSERT_TRUE(program);
    const std::vector<float> answers = runOnDriver(row, *program);
    const std::vector<AgreementPoint> points = agreementPoints();
    Tally driver[PartCount], single[PartCount], loosest[PartCount];
    for (size_t s = 0; s < row.sets.size(); ++s) {
        const BoundLobe f32 = row.f32(row.sets[s].data());
        const BoundLobe f64 = row.f64(row.sets[s].data());
        for (size_t i = 0; i < points.size(); ++i) {
            const AgreementAnswer oracle = answerOf(f64, points[i]);
            double d[PartCount], f[PartCount];
            differences(fromDriver(row, &answers[(s * points.size() + i) * 20]), oracle, d);
            differences(answerOf(f32, points[i]), oracle, f);
            for (int part = 0; part < PartCount; ++part) {
                driver[part].add(d[part], s, i);
                single[part].add(f[part], s, i);
            }
            if (exact) continue;
            differences(answerOf(allowed.f32(row.sets[s].data()), points[i]), oracle, f);
            for (int part = 0; part < PartCount; ++part)
                loosest[part].add(f[part], s, i);
        }
    }
    for (int part = 0; part < PartCount; ++part) {
        const Tally& d = driver[part];
        Tally f = single[part];
        f.above5 = std::max(f.above5, loosest[part].above5);
        f.above4 = std::max(f.above4, loosest[part].above4);
        f.worst = std::max(f.worst, loosest[part].worst);
        const char* name = agreementPartNames[part];
        const char* reason = d.above4 > 0 ? reasonFor(row.name) : "";
        std::printf("  %-21s %-10s %5d points, above 1e-5 %6.3f%% (float C++ %6.3f%%), above 1e-4 "
                    "%6.3f%% (%6.3f%%), worst %.0e (%.0e) at set %zu, point %zu %s\n",
                    row.name.c_str(), name, d.points, 100.0 * d.share5(), 100.0 * f.share5(),
                    100.0 * d.share4(), 100.0 * f.share4(), d.worst, f.worst, d.set, d.point,
                    reason ? reason : "NO REASON");
        EXPECT_TRUE(reason) << name << ": a point is above 1e-4";
        EXPECT_LE(d.share5(), std::max(allowedShare(row.name, part), 1.25 * f.share5() + 1e-3) +
                                  chanceOf(f.share5(), f, part))
            << name;
        EXPECT_LE(d.share4(), 1.25 * f.share4() + 5e-4 + chanceOf(f.share4(), f, part)) << name;
        EXPECT_LE(d.worst, std::max(1e-4, 4.0 * f.worst)) << name;
    }
}

namespace {

/// A row whose program takes a driver in software a quarter of a minute, of a lobe that other rows
/// have.
bool isCostly(const AgreementRow& row) {
    return row.name == "film schlick";
}

std::vector<size_t> rowsThat(bool areCostly) {
    const std::vector<AgreementRow> rows = agreementRows();
    std::vector<size_t> found;
    for (size_t i = 0; i < rows.size(); ++i)
        if (isCostly(rows[i]) == areCostly) found.push_back(i);
    return found;
}

std::string nameOfRow(const ::testing::TestParamInfo<size_t>& info) {
    std::string name = agreementRows()[info.param].name;
    for (char& c : name)
        if (c == ' ') c = '_';
    return name;
}

} // namespace

INSTANTIATE_TEST_SUITE_P(EveryLobe, Agreement, ::testing::ValuesIn(rowsThat(false)), nameOfRow);
INSTANTIATE_TEST_SUITE_P(CostlyLobe, Agreement, ::testing::ValuesIn(rowsThat(true)), nameOfRow);
