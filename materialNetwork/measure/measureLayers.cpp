// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/measure/measureLayers.h"

#include "materialNetwork/measure/layerSubjects.h"
#include "materialNetwork/plan/methods.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 32;
constexpr double coatIor = 1.5;
constexpr int metalSide = 8, sampleCount = 4096;

/// Facets lose nothing by either method, so that layers alone are compared.
const MethodChoices walkedMethods = {{"energyCompensation", "randomWalk"},
                                     {"layering", "positionFree"}};

double reflected(double alpha, sh::vec3 wo, int method) {
    const sh::DielectricLobe l = sh::dielectricMethods(
        sh::dielectricSetup(sh::vec3(1.0f), float(coatIor), sh::vec2(float(alpha)), false,
                            sh::SCATTER_R, false, sh::COMPENSATE_SCALE),
        method, sh::SAMPLING_VNDF, sh::FRESNEL_EXACT);
    return double(sh::dielectricAlbedo(l, wo).x);
}

Row named(const char* point, const std::string& method, const std::string& subject,
          const std::string& kind, double albedo) {
    Row row;
    row.point = point;
    row.method = method;
    row.subject = subject;
    row.error = "albedo";
    row.kind = kind;
    row.reflectance = albedo;
    return row;
}

/// The light that a layer adds to that of its base.
void timeLayer(const Base& base, const MethodChoices& methods, Row& row) {
    std::vector<std::shared_ptr<const MaterialProgram>> with;
    for (int i = 0; i < metalSide; ++i)
        with.push_back(layered(base, std::pow((i + 0.5) / metalSide, 2.0), methods));
    timeEvaluations(with, row);
    Row alone;
    timeEvaluations({layered(base, -1.0, methods)}, alone);
    for (double* ns : {&row.ns, &row.nsLow, &row.nsHigh})
        *ns = std::max(*ns - alone.ns, 1.0);
}

/// The truth has no error, only a time.
Row walked(const Base& base, const std::string& subject, const std::string& kind, double albedo,
           bool timed) {
    Row row = named("layering", "positionFree", subject, kind, albedo);
    Errors errors;
    errors.add(0.0);
    errors.into(row);
    if (timed) timeLayer(base, {{"layering", "positionFree"}}, row);
    return row;
}

/// An interface over a Lambert base of albedo a. Light from the base is spread by the cosine
/// again, so all that bounces between the two is a geometric series: with E what the interface
/// reflects from outside and R the mean of what it reflects from inside, the whole reflects
/// E + (1 - E) a (1 - R) / (1 - a R). R follows from the mean of E by reciprocity,
/// 1 - R = (1 - mean E) / ior^2.
class OverDiffuse {
public:
    OverDiffuse() {
        for (int a = 0; a < gridSide; ++a) {
            double mean = 0.0;
            for (int m = 0; m < gridSide; ++m) {
                const Place& p = _grid[size_t(a * gridSide + m)];
                _e.push_back(reflected(p.alpha, sh::vec3(p.wo), sh::ALBEDO_FIT));
                mean += 2.0 * p.wo.z * _e.back() / gridSide;
            }
            _inside.push_back(1.0 - (1.0 - mean) / (coatIor * coatIor));
        }
    }

    /// Error of layers that are scaled by albedo.
    void measure(double albedo, const MethodChoices& methods, Row& row) const {
        Errors errors;
        std::shared_ptr<const MaterialProgram> program;
        for (size_t i = 0; i < _grid.size(); ++i) {
            const Place& p = _grid[i];
            if (i % gridSide == 0) program = layered({albedo}, p.alpha, methods);
            const double r = _inside[i / gridSide], a = albedo;
            const double truth = _e[i] + (1.0 - _e[i]) * a * (1.0 - r) / (1.0 - a * r);
            errors.add(knownAlbedo(*program, p.wo.z) - truth, truth, std::sqrt(p.alpha), p.wo.z);
        }
        errors.into(row);
    }

private:
    std::vector<Place> _grid = places(gridSide);
    std::vector<double> _e, _inside;
};

/// Over metals the rougher of both counts: both as rough, or one of them smooth.
void overMetal(Base base, MethodChoices methods, Row& row) {
    methods["energyCompensation"] = "randomWalk";
    Errors errors;
    for (const Place& p : places(metalSide))
        for (const auto& [top, below] :
             {std::pair(1.0, 1.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
            base.alpha = below * p.alpha;
            const double alpha = top * p.alpha;
            const Albedo found = sampledAlbedo(*layered(base, alpha, methods), p.wo.z, sampleCount);
            const Albedo truth =
                sampledAlbedo(*layered(base, alpha, walkedMethods), p.wo.z, sampleCount);
            errors.add(found.mean - truth.mean, truth.mean, std::sqrt(p.alpha), p.wo.z,
                       std::hypot(found.sigma, truth.sigma));
        }
    errors.into(row);
}

} // namespace

namespace {

/// Each subject with `named(subject, kind, albedo)`, measured by `methods`, and then `rest`.
template <class Named, class Rest>
void measureSubjects(const OverDiffuse& diffuse, const MethodChoices& methods, bool timed,
                     std::vector<Row>& rows, const Named& name, const Rest& rest) {
    const auto add = [&](Row row, const Base& base) {
        if (timed) timeLayer(base, methods, row);
        rows.push_back(std::move(row));
    };
    for (const auto& [albedo, subject] : {std::pair(0.05, "coat over 0.05"),
                                          {0.2, "coat over 0.2"},
                                          {0.5, "coat over 0.5"},
                                          {0.8, "coat over 0.8"},
                                          {0.95, "coat over 0.95"}}) {
        Row row = name(subject, "layer", albedo);
        diffuse.measure(albedo, methods, row);
        add(std::move(row), {albedo});
        rest(Base{albedo}, subject, "layer", albedo);
    }
    for (const Metal& metal : measuredMetals) {
        const std::string subject = std::string("coat over ") + metal.name;
        const double albedo = sh64::fresnelConductorChannel(1.0, metal.n, metal.k);
        const Base base = {0.0, metal.n, metal.k, 0.1};
        Row row = name(subject, "layerOverMetal", albedo);
        overMetal(base, methods, row);
        add(std::move(row), base);
        rest(base, subject, "layerOverMetal", albedo);
    }
}

} // namespace

std::vector<Row> layerTransmittance(bool timed) {
    std::vector<Row> rows;
    const OverDiffuse diffuse;
    for (const ChoicePoint& point : choicePoints())
        for (size_t i = 0; point.name == "layerTransmittance" && i < point.methods.size(); ++i) {
            const std::string& method = point.methods[i].name;
            measureSubjects(
                diffuse, {{point.name, method}}, timed, rows,
                [&](const std::string& subject, const char* kind, double albedo) {
                    return named("layerTransmittance", method, subject, kind, albedo);
                },
                [](const Base&, const std::string&, const char*, double) {});
        }
    return rows;
}

std::vector<Row> layering(bool timed) {
    std::vector<Row> rows;
    const OverDiffuse diffuse;
    measureSubjects(
        diffuse, {}, timed, rows,
        [](const std::string& subject, const char* kind, double albedo) {
            return named("layering", "albedoScaling", subject, kind, albedo);
        },
        [&](const Base& base, const std::string& subject, const char* kind, double albedo) {
            rows.push_back(walked(base, subject, kind, albedo, timed));
        });
    for (const ChoicePoint& point : choicePoints())
        for (size_t i = 0; point.name == "directionalAlbedo" && i < point.methods.size(); ++i) {
            const std::string& by = point.methods[i].name;
            Row row = named("layering", "albedoScaling", "coat over 0.5, albedo by " + by,
                            "layerBy " + by, 0.5);
            diffuse.measure(0.5, {{"directionalAlbedo", by}}, row);
            if (timed) timeLayer({0.5}, {{"directionalAlbedo", by}}, row);
            rows.push_back(std::move(row));
        }
    return rows;
}

} // namespace patina::measure
