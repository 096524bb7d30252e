#include "materialNetwork/measure/measureLayers.h"

#include "materialNetwork/measure/layerSubjects.h"
#include "materialNetwork/methods.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int kSide = 32;
constexpr double kIor = 1.5;
constexpr int kMetalSide = 8, kSamples = 4096;

/// Facets lose nothing by either method, so that layers alone are compared.
const MethodChoices kScaled = {{"energyCompensation", "randomWalk"}};
const MethodChoices kWalked = {{"energyCompensation", "randomWalk"}, {"layering", "positionFree"}};

double reflected(double alpha, sh::vec3 wo, int method) {
    const sh::DielectricLobe l = sh::dielectricMethods(
        sh::dielectricSetup(sh::vec3(1.0f), float(kIor), sh::vec2(float(alpha)), false,
                            sh::SCATTER_R, false, sh::COMPENSATE_SCALE),
        method, sh::FACETS_VISIBLE, sh::FRESNEL_EXACT);
    return double(sh::dielectricAlbedo(l, wo).x);
}

Row named(const char* method, const std::string& subject, const std::string& kind, double albedo) {
    Row row;
    row.point = "layering";
    row.method = method;
    row.subject = subject;
    row.error = "albedo";
    row.kind = kind;
    row.reflectance = albedo;
    return row;
}

/// What a layer adds to its base.
void timeLayer(const Base& base, const MethodChoices& methods, Row& row) {
    std::vector<std::shared_ptr<const MaterialProgram>> with;
    for (int i = 0; i < kMetalSide; ++i)
        with.push_back(layered(base, std::pow((i + 0.5) / kMetalSide, 2.0), methods));
    timeEvaluations(with, row);
    Row alone;
    timeEvaluations({layered(base, -1.0, methods)}, alone);
    for (double* ns : {&row.ns, &row.nsLow, &row.nsHigh})
        *ns = std::max(*ns - alone.ns, 1.0);
}

/// The truth has no error, only a time.
Row walked(const Base& base, const std::string& subject, const std::string& kind, double albedo,
           bool timed) {
    Row row = named("positionFree", subject, kind, albedo);
    Errors errors;
    errors.add(0.0);
    errors.into(row);
    if (timed) timeLayer(base, {{"layering", "positionFree"}}, row);
    return row;
}

/// An interface over a Lambert base of albedo a. What the base sends up is spread by the cosine
/// again, so all that bounces between the two is a geometric series: with E what the interface
/// reflects from outside and R the mean of what it reflects from inside, the whole reflects
/// E + (1 - E) a (1 - R) / (1 - a R). R follows from the mean of E by reciprocity,
/// 1 - R = (1 - mean E) / ior^2. Scaling by albedo takes E + (1 - E) a instead.
class OverDiffuse {
public:
    OverDiffuse() {
        for (int a = 0; a < kSide; ++a) {
            double mean = 0.0;
            for (int m = 0; m < kSide; ++m) {
                const Place& p = _grid[size_t(a * kSide + m)];
                _e.push_back(reflected(p.alpha, sh::vec3(p.wo), sh::ALBEDO_FIT));
                mean += 2.0 * p.wo.z * _e.back() / kSide;
            }
            _inside.push_back(1.0 - (1.0 - mean) / (kIor * kIor));
        }
    }

    /// @param method that finds what the top reflects
    void measure(double albedo, int method, Row& row) const {
        Errors errors;
        for (size_t i = 0; i < _grid.size(); ++i) {
            const Place& p = _grid[i];
            const double r = _inside[i / kSide], a = albedo;
            const double truth = _e[i] + (1.0 - _e[i]) * a * (1.0 - r) / (1.0 - a * r);
            const double e =
                method == sh::ALBEDO_FIT ? _e[i] : reflected(p.alpha, sh::vec3(p.wo), method);
            errors.add(e + (1.0 - e) * a - truth, truth, std::sqrt(p.alpha), p.wo.z);
        }
        errors.into(row);
    }

private:
    std::vector<Place> _grid = places(kSide);
    std::vector<double> _e, _inside;
};

/// Over metals the rougher of both counts: both as rough, or one of them smooth.
void overMetal(Base base, Row& row) {
    Errors errors;
    for (const Place& p : places(kMetalSide))
        for (const auto& [top, below] :
             {std::pair(1.0, 1.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
            base.alpha = below * p.alpha;
            const double alpha = top * p.alpha;
            const Albedo found = sampledAlbedo(*layered(base, alpha, kScaled), p.wo.z, kSamples);
            const Albedo truth = sampledAlbedo(*layered(base, alpha, kWalked), p.wo.z, kSamples);
            errors.add(found.mean - truth.mean, truth.mean, std::sqrt(p.alpha), p.wo.z,
                       std::hypot(found.sigma, truth.sigma));
        }
    errors.into(row);
}

} // namespace

std::vector<Row> layering(bool timed) {
    std::vector<Row> rows;
    const OverDiffuse diffuse;
    const auto add = [&](Row row, const Base& base) {
        if (timed) timeLayer(base, {}, row);
        rows.push_back(std::move(row));
    };
    for (const auto& [albedo, subject] : {std::pair(0.05, "coat over 0.05"),
                                          {0.2, "coat over 0.2"},
                                          {0.5, "coat over 0.5"},
                                          {0.8, "coat over 0.8"},
                                          {0.95, "coat over 0.95"}}) {
        Row row = named("albedoScaling", subject, "layer", albedo);
        diffuse.measure(albedo, sh::ALBEDO_FIT, row);
        add(std::move(row), {albedo});
        rows.push_back(walked({albedo}, subject, "layer", albedo, timed));
    }
    for (const Metal& metal : kMetals) {
        const std::string subject = std::string("coat over ") + metal.name;
        const double albedo = sh64::fresnelConductorChannel(1.0, metal.n, metal.k);
        const Base base = {0.0, metal.n, metal.k, 0.1};
        Row row = named("albedoScaling", subject, "layerOverMetal", albedo);
        overMetal(base, row);
        add(std::move(row), base);
        rows.push_back(walked(base, subject, "layerOverMetal", albedo, timed));
    }
    for (const ChoicePoint& point : choicePoints())
        for (size_t i = 0; point.name == "directionalAlbedo" && i < point.methods.size(); ++i) {
            const std::string& by = point.methods[i].name;
            Row row =
                named("albedoScaling", "coat over 0.5, albedo by " + by, "layerBy " + by, 0.5);
            diffuse.measure(0.5, int(i), row);
            if (timed) timeLayer({0.5}, {{"directionalAlbedo", by}}, row);
            rows.push_back(std::move(row));
        }
    return rows;
}

} // namespace patina::measure
