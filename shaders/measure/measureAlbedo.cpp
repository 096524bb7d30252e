// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 32;
constexpr int spreadCount = 300;
constexpr int quadraturePoints = 96;

const char* const methodNames[] = {"table",        "fit",          "karis",     "mirror",
                                   "monteCarlo16", "monteCarlo64", "quadrature"};
constexpr int evaluationsPerBatch[] = {1024, 1024, 1024, 1024, 256, 64, 8}; // in a batch

/// A reflectance, exact and as a lobe.
struct Subject {
    std::string name;
    std::string kind;
    std::function<double(double c)> exact;
    std::function<double(const Place& place, int method)> lobe; ///< in float
    std::function<double(int evaluations, int method)> batch;   ///< many of them
};

/// Setting a lobe up is no part of what is timed.
template <typename Make, typename Albedo> Subject subject(std::string name, std::string kind,
                                                          std::function<double(double)> exact,
                                                          Make make, Albedo albedo) {
    Subject s;
    s.name = std::move(name);
    s.kind = std::move(kind);
    s.exact = std::move(exact);
    s.lobe = [=](const Place& p, int method) {
        auto l = make(float(p.alpha));
        l.albedo = method;
        return double(albedo(l, sh::vec3(p.wo)).x);
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
            sum += albedo(lobes[j / gridSide % gridSide], directions[j % gridSide]).x;
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
        [](const sh::DielectricLobe& l, sh::vec3 wo) { return sh::dielectricAlbedo(l, wo); });
}

Subject conductor(const Metal& metal) {
    const double n = metal.n, k = metal.k;
    return subject(
        metal.name, "conductor", [=](double c) { return sh64::fresnelConductorChannel(c, n, k); },
        [=](float alpha) {
            return sh::conductorSetup(sh::vec3(float(n)), sh::vec3(float(k)), sh::vec2(alpha),
                                      false, sh::COMPENSATE_NONE);
        },
        [](const sh::ConductorLobe& l, sh::vec3 wo) { return sh::conductorAlbedo(l, wo); });
}

Subject schlick() {
    return subject(
        "schlick 0.04", "schlick", [=](double c) { return 0.04 + 0.96 * std::pow(1.0 - c, 5.0); },
        [=](float alpha) {
            return sh::schlickSetup(sh::vec3(0.04f), sh::vec3(1.0f), sh::vec3(1.0f), 5.0f,
                                    sh::vec2(alpha), false, sh::SCATTER_R, false,
                                    sh::COMPENSATE_NONE);
        },
        [](const sh::SchlickLobe& l, sh::vec3 wo) { return sh::schlickAlbedo(l, wo); });
}

} // namespace

std::vector<Row> directionalAlbedo(bool timed) {
    std::vector<Subject> subjects = {dielectric(1.5, "ior 1.5"), dielectric(1.05, "ior 1.05"),
                                     dielectric(3.0, "ior 3")};
    for (const Metal& metal : measuredMetals)
        subjects.push_back(conductor(metal));
    subjects.push_back(schlick());

    constexpr size_t methods = std::size(methodNames);
    std::vector<Errors> errors(subjects.size() * methods);
    bake::InterfaceQuadrature quadrature(quadraturePoints, sh::NDF_GGX);
    double light[spreadCount], cosine[spreadCount];
    for (const Place& p : places(gridSide)) {
        quadrature.setView(p.wo, sh64::vec2(p.alpha));
        quadrature.spread(spreadCount, light, cosine);
        for (size_t s = 0; s < subjects.size(); ++s) {
            double truth = 0.0;
            for (int i = 0; i < spreadCount; ++i)
                if (light[i] > 0.0) truth += light[i] * subjects[s].exact(cosine[i]);
            for (size_t m = 0; m < methods; ++m)
                errors[s * methods + m].add(subjects[s].lobe(p, int(m)) - truth, truth,
                                            std::sqrt(p.alpha), p.wo.z);
        }
    }
    std::vector<Row> rows;
    for (size_t s = 0; s < subjects.size(); ++s)
        for (size_t m = 0; m < methods; ++m) {
            Row row;
            row.point = "directionalAlbedo";
            row.method = methodNames[m];
            row.subject = subjects[s].name;
            row.error = "albedo";
            row.kind = subjects[s].kind;
            row.reflectance = subjects[s].exact(1.0);
            errors[s * methods + m].into(row);
            if (timed)
                time([&](int n) { return subjects[s].batch(n, int(m)); }, evaluationsPerBatch[m],
                     row);
            rows.push_back(row);
        }
    return rows;
}

} // namespace patina::measure
