// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 32;
constexpr int spreadCount = 300;
constexpr int quadraturePoints = 96;

/// ALBEDO_* of the lobes, or one that is only measured.
constexpr int mirror = -1; ///< the reflectance at the view's own cosine, as if the lobe were smooth
constexpr int facets = -2; ///< the mean over ALBEDO_STEEP_FACETS visible facets, stratified
const struct {
    const char* name;
    int method;
    int evaluations; ///< in a batch
} methods[] = {{"table", sh::ALBEDO_TABLE, 1024},
               {"fit", sh::ALBEDO_FIT, 1024},
               {"karis", sh::ALBEDO_KARIS, 1024},
               {"mirror", mirror, 1024},
               {"monteCarlo16", sh::ALBEDO_SAMPLES_16, 256},
               {"monteCarlo64", facets, 64},
               {"quadrature", sh::ALBEDO_QUADRATURE, 8}};

/// A reflectance, exact and as a lobe.
struct Subject {
    std::string name;
    std::string kind;
    std::function<double(double c)> exact;
    std::function<double(const Place& place, int method)> lobe; ///< in float
    std::function<double(int evaluations, int method)> batch;   ///< many of them
};

template <typename Lobe, typename Albedo, typename Reflectance>
float albedoBy(int method, const Lobe& l, sh::vec3 wo, Albedo albedo, Reflectance reflectance) {
    if (method >= 0) return albedo(l, wo).x;
    if (method == mirror || l.alpha.x == 0.0f) return reflectance(l, std::min(wo.z, 1.0f));
    float sum = 0.0f;
    for (int j = 0; j < sh::ALBEDO_STEEP_FACETS; ++j) {
        const sh::vec2 facet =
            sh::sampledMicrofacet(wo, l.alpha, l.ndf, sh::ALBEDO_STEEP_FACETS, j);
        sum += reflectance(l, facet.x) * facet.y;
    }
    return sum;
}

/// Setting a lobe up is no part of what is timed.
template <typename Make, typename Albedo, typename Reflectance>
Subject subject(std::string name, std::string kind, std::function<double(double)> exact, Make make,
                Albedo albedo, Reflectance reflectance) {
    Subject s;
    s.name = std::move(name);
    s.kind = std::move(kind);
    s.exact = std::move(exact);
    s.lobe = [=](const Place& p, int method) {
        auto l = make(float(p.alpha));
        l.albedo = method;
        return double(albedoBy(method, l, sh::vec3(p.wo), albedo, reflectance));
    };
    s.batch = [=](int evaluations, int method) {
        static const std::vector<Place> grid = places(gridSide);
        std::vector<decltype(make(0.1f))> lobes;
        for (int i = 0; i < gridSide; ++i) {
            lobes.push_back(make(float(grid[size_t(i * gridSide)].alpha)));
            lobes.back().albedo = method;
        }
        std::vector<sh::vec3> directions;
        for (int i = 0; i < gridSide; ++i)
            directions.emplace_back(grid[size_t(i)].wo);
        float sum = 0.0f;
        for (int i = 0; i < evaluations; ++i) {
            // Steps that share no factor with the grid: a few evaluations are spread over it.
            const size_t j = size_t(i) * 37;
            sum += albedoBy(method, lobes[j / gridSide % gridSide], directions[j % gridSide],
                            albedo, reflectance);
        }
        return double(sum);
    };
    return s;
}

Subject dielectric(double ior, const char* name) {
    return subject(
        name, "dielectric", [=](double c) { return sh64::fresnelDielectric(c, ior); },
        [=](float alpha) {
            return sh::dielectricSetup(sh::vec3(1.0f), float(ior), sh::vec2(alpha), false,
                                       sh::SCATTER_R, false, sh::COMPENSATE_NONE);
        },
        sh::dielectricAlbedo,
        [](const sh::DielectricLobe& l, float c) { return sh::dielectricFresnel(l, c, l.ior); });
}

Subject conductor(const Metal& metal) {
    const double n = metal.n, k = metal.k;
    return subject(
        metal.name, "conductor", [=](double c) { return sh64::fresnelConductorChannel(c, n, k); },
        [=](float alpha) {
            return sh::conductorSetup(sh::vec3(float(n)), sh::vec3(float(k)), sh::vec2(alpha),
                                      false, sh::COMPENSATE_NONE);
        },
        sh::conductorAlbedo,
        [](const sh::ConductorLobe& l, float c) { return sh::conductorReflectance(l, c).x; });
}

Subject schlick() {
    return subject(
        "schlick 0.04", "schlick", [=](double c) { return 0.04 + 0.96 * std::pow(1.0 - c, 5.0); },
        [=](float alpha) {
            return sh::schlickSetup(sh::vec3(0.04f), sh::vec3(1.0f), sh::vec3(1.0f), 5.0f,
                                    sh::vec2(alpha), false, sh::SCATTER_R, false,
                                    sh::COMPENSATE_NONE);
        },
        sh::schlickAlbedo,
        [](const sh::SchlickLobe& l, float c) { return sh::schlickReflectance(l, c, l.ior).x; });
}

} // namespace

std::vector<Row> directionalAlbedo(bool timed) {
    std::vector<Subject> subjects = {dielectric(1.5, "ior 1.5"), dielectric(1.05, "ior 1.05"),
                                     dielectric(3.0, "ior 3")};
    for (const Metal& metal : measuredMetals)
        subjects.push_back(conductor(metal));
    subjects.push_back(schlick());

    constexpr size_t count = std::size(methods);
    std::vector<Errors> errors(subjects.size() * count);
    bake::InterfaceQuadrature quadrature(quadraturePoints, sh::NDF_GGX);
    double light[spreadCount], cosine[spreadCount];
    for (const Place& p : places(gridSide)) {
        quadrature.setView(p.wo, sh64::vec2(p.alpha));
        quadrature.spread(spreadCount, light, cosine);
        for (size_t s = 0; s < subjects.size(); ++s) {
            double truth = 0.0;
            for (int i = 0; i < spreadCount; ++i)
                if (light[i] > 0.0) truth += light[i] * subjects[s].exact(cosine[i]);
            for (size_t m = 0; m < count; ++m)
                errors[s * count + m].add(subjects[s].lobe(p, methods[m].method) - truth, truth,
                                          std::sqrt(p.alpha), p.wo.z);
        }
    }
    std::vector<Row> rows;
    for (size_t s = 0; s < subjects.size(); ++s)
        for (size_t m = 0; m < count; ++m) {
            Row row;
            row.point = "directionalAlbedo";
            row.method = methods[m].name;
            row.subject = subjects[s].name;
            row.error = "albedo";
            row.kind = subjects[s].kind;
            row.reflectance = subjects[s].exact(1.0);
            errors[s * count + m].into(row);
            if (timed)
                time([&](int n) { return subjects[s].batch(n, methods[m].method); },
                     methods[m].evaluations, row);
            rows.push_back(row);
        }
    return rows;
}

} // namespace patina::measure
