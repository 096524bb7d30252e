// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/microsurfaceWalk.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 16;
constexpr int walkCount = 6000;
constexpr int sampleCount = 256;
constexpr int cosines = 256; ///< of a reflectance

/// Point i of a sequence that fills the unit cube (Roberts 2018, generalized golden ratio).
sh::vec3 point(int i) {
    const double x = 0.8191725133961645 * (i + 1), y = 0.6710436067037893 * (i + 1),
                 z = 0.5497004779019703 * (i + 1);
    return sh::vec3(float(x - std::floor(x)), float(y - std::floor(y)), float(z - std::floor(z)));
}

Row named(const char* point, const char* method, const std::string& subject, const char* error) {
    Row row;
    row.point = point;
    row.method = method;
    row.subject = subject;
    row.error = error;
    return row;
}

/// An error that hangs on the cosine alone.
void addAt(Errors& errors, double value, double truth, double cosine) {
    errors.add(value - truth, truth, -1.0, cosine);
}

/// An error at a place of the grid.
void addAt(Errors& errors, double value, double truth, const Place& p) {
    errors.add(value - truth, truth, std::sqrt(p.alpha), p.wo.z);
}

/// Times eval of a lobe at every place.
template <class Lobe> void timeEval(const std::vector<Lobe>& lobes, const std::vector<Place>& grid,
                                    sh::LobeEval (*eval)(Lobe, sh::vec3, sh::vec3), Row& row) {
    time(
        [&](int n) {
            float sum = 0.0f;
            for (int i = 0; i < n; ++i) {
                const sh::vec3 u = point(i & 63);
                const sh::vec3 wi = sh::sampleCosineHemisphere(sh::vec2(u.x, u.y));
                sum += eval(lobes[size_t(i)], sh::vec3(grid[size_t(i)].wo), wi).value.x;
            }
            return double(sum);
        },
        int(grid.size()), row);
}

/// The share of light that comes back at every place of the grid, by random walks.
std::vector<Walked> walks(const std::vector<Place>& grid,
                          const std::function<double(double)>& reflectance) {
    std::vector<Walked> result(grid.size());
    for (size_t i = 0; i < grid.size(); ++i)
        if (grid[i].alpha < sh64::ALPHA_MIRROR)
            result[i].all = reflectance(grid[i].wo.z);
        else
            result[i] = walkMicrosurface(grid[i].wo, sh64::vec2(grid[i].alpha), sh::NDF_GGX,
                                         reflectance, walkCount, 1 + i);
    return result;
}

sh::ConductorLobe metalLobe(const Metal& metal, const Place& p, int compensate) {
    return sh::conductorSetup(sh::vec3(float(metal.n)), sh::vec3(float(metal.k)),
                              sh::vec2(float(p.alpha)), false, compensate);
}

/// One lobe per place: setting up is no part of what is timed.
std::vector<sh::ConductorLobe> metalLobes(const std::vector<Place>& grid, const Metal& metal,
                                          int compensate) {
    std::vector<sh::ConductorLobe> lobes;
    for (const Place& p : grid)
        lobes.push_back(metalLobe(metal, p, compensate));
    return lobes;
}

/// Draws from all facets by their density (Walter et al. 2007): a method that is only measured.
sh::LobeSample conductorSampleAll(sh::ConductorLobe l, sh::vec3 wo, sh::vec3 u) {
    if (l.alpha.x == 0.0f) return sh::conductorSample(l, wo, u);
    const float r = std::sqrt(u.y / std::max(1.0f - u.y, sh::TINY)), phi = sh::TWO_PI * u.x;
    const sh::vec3 m =
        sh::normalize(sh::vec3(l.alpha.x * r * std::cos(phi), l.alpha.y * r * std::sin(phi), 1.0f));
    const float c = sh::clamp(sh::dot(wo, m), 0.0f, 1.0f);
    const sh::MicrofacetBounce b = sh::microfacetBounce(wo, m, c, l.alpha, 1.0f, true, l.ndf);
    sh::LobeSample s = sh::lobeSampleNone();
    if (!b.valid || c <= 0.0f) return s;
    const float visible = wo.z + sh::microfacetLength(wo, l.alpha, l.ndf);
    s.weight = sh::conductorReflectance(l, c) * (b.ratio * c / (0.5f * m.z * visible));
    return s;
}

} // namespace

std::vector<Row> energyCompensation(bool timed) {
    const struct {
        const char* name;
        int compensate;
    } methods[] = {{"turquin", sh::COMPENSATE_SCALE},
                   {"none", sh::COMPENSATE_NONE},
                   {"kullaConty", sh::COMPENSATE_ADD}};
    const Metal white = {"white metal", 0.0, 10.0};
    const std::vector<Place> grid = places(gridSide);
    std::vector<Row> rows;
    for (const Metal& metal : {white, measuredMetals[0], measuredMetals[1]}) {
        const auto reflectance = [&](double c) {
            return sh64::fresnelConductorChannel(c, metal.n, metal.k);
        };
        const std::vector<Walked> truth = walks(grid, reflectance);
        for (const auto& method : methods) {
            Row row = named("energyCompensation", method.name, metal.name, "albedo");
            const auto lobes = metalLobes(grid, metal, method.compensate);
            Errors errors;
            for (size_t i = 0; i < grid.size(); ++i)
                errors.add(double(sh::conductorAlbedo(lobes[i], sh::vec3(grid[i].wo)).x) -
                               truth[i].all,
                           truth[i].all, std::sqrt(grid[i].alpha), grid[i].wo.z, truth[i].sigma);
            row.kind = "conductor";
            row.reflectance = reflectance(1.0);
            errors.into(row);
            if (timed) timeEval(lobes, grid, sh::conductorEval, row);
            rows.push_back(row);
        }
    }
    // Interfaces whose transmitted light is someone else's.
    for (const auto& [ior, subject] : {std::pair(1.5, "ior 1.5"), {3.0, "ior 3"}}) {
        const double eta = ior;
        const auto reflectance = [&](double c) { return sh64::fresnelDielectric(c, eta); };
        const std::vector<Walked> truth = walks(grid, reflectance);
        for (const auto& method : methods) {
            Row row = named("energyCompensation", method.name, subject, "albedo");
            Errors errors;
            std::vector<sh::DielectricLobe> lobes;
            for (size_t i = 0; i < grid.size(); ++i) {
                lobes.push_back(sh::dielectricSetup(sh::vec3(1.0f), float(eta),
                                                    sh::vec2(float(grid[i].alpha)), false,
                                                    sh::SCATTER_R, false, method.compensate));
                errors.add(double(sh::dielectricAlbedo(lobes[i], sh::vec3(grid[i].wo)).x) -
                               truth[i].all,
                           truth[i].all, std::sqrt(grid[i].alpha), grid[i].wo.z, truth[i].sigma);
            }
            if (timed) timeEval(lobes, grid, sh::dielectricEval, row);
            row.kind = "dielectric";
            row.reflectance = reflectance(1.0);
            errors.into(row);
            rows.push_back(row);
        }
    }
    for (Row& row : energyTruth(timed))
        rows.push_back(std::move(row));
    return rows;
}

// The error of a sampler is its noise: the standard deviation of one sample's weight, for a mirror
// that reflects all, at every place.
std::vector<Row> sampling(bool timed) {
    const struct {
        const char* name;
        int sampling;
        sh::LobeSample (*sample)(sh::ConductorLobe, sh::vec3, sh::vec3);
    } methods[] = {{"vndf", sh::SAMPLING_VNDF, sh::conductorSample},
                   {"boundedVndf", sh::SAMPLING_BOUNDED_VNDF, sh::conductorSample},
                   {"fullNdf", sh::SAMPLING_VNDF, conductorSampleAll}};
    const std::vector<Place> grid = places(gridSide);
    const Metal white = {"white metal", 0.0, 10.0};
    std::vector<Row> rows;
    for (const auto& method : methods) {
        Row row = named("sampling", method.name, "white metal", "noise");
        auto lobes = metalLobes(grid, white, sh::COMPENSATE_NONE);
        Errors errors;
        for (size_t i = 0; i < grid.size(); ++i) {
            lobes[i].sampling = method.sampling;
            double sum = 0.0, squares = 0.0;
            for (int k = 0; k < sampleCount; ++k) {
                const double w =
                    double(method.sample(lobes[i], sh::vec3(grid[i].wo), point(k)).weight.x);
                sum += w / sampleCount;
                squares += w * w / sampleCount;
            }
            addAt(errors, sum + std::sqrt(std::max(squares - sum * sum, 0.0)), sum, grid[i]);
        }
        errors.into(row);
        if (timed)
            time(
                [&](int n) {
                    float sum = 0.0f;
                    for (int i = 0; i < n; ++i)
                        sum += method
                                   .sample(lobes[size_t(i)], sh::vec3(grid[size_t(i)].wo),
                                           point(i & 63))
                                   .weight.x;
                    return double(sum);
                },
                int(grid.size()), row);
        rows.push_back(row);
    }
    return rows;
}

// Curves through few values of the exact reflectance, which are only measured: the renderer has
// them as generalized_schlick_bsdf.
std::vector<Row> fresnel(bool timed) {
    std::vector<Row> rows;
    const auto add = [&](const char* method, const char* subject, const char* kind, const auto& at,
                         const std::function<double(double)>& exact) {
        Row row = named("fresnel", method, subject, "reflectance");
        const auto cosine = [](int i) { return (i + 0.5) / cosines; };
        Errors errors;
        for (int i = 0; i < cosines; ++i)
            addAt(errors, double(at(float(cosine(i)))), exact(cosine(i)), cosine(i));
        row.kind = kind;
        row.reflectance = exact(1.0);
        errors.into(row);
        if (timed)
            time(
                [&](int n) {
                    float sum = 0.0f;
                    for (int i = 0; i < n; ++i)
                        sum += at(float(cosine(i)));
                    return double(sum);
                },
                cosines, row);
        rows.push_back(row);
    };
    const auto addAll = [&](const char* subject, const char* kind, const auto& reflectance,
                            const std::function<double(double)>& exact) {
        add("exact", subject, kind, reflectance, exact);
        const float f0 = reflectance(1.0f);
        const sh::SchlickFresnel rises =
            sh::schlickFresnel(sh::vec3(f0), sh::vec3(1.0f), sh::vec3(1.0f), 5.0f);
        // With a dip that meets the exact value at 82 degrees (Kutz et al. 2021).
        const float at82 = 1.0f / 7.0f, dip = reflectance(at82) / sh::fresnelSchlick(at82, rises).x;
        const sh::SchlickFresnel dips =
            sh::schlickFresnel(sh::vec3(f0), sh::vec3(dip), sh::vec3(1.0f), 5.0f);
        for (const auto& [name, curve] : {std::pair("schlick", rises), {"f82", dips}})
            add(
                name, subject, kind,
                [&c = curve](float z) { return std::min(sh::fresnelSchlick(z, c).x, 1.0f); },
                exact);
    };
    for (const auto& [ior, subject] :
         {std::pair(1.05, "ior 1.05"), {1.5, "ior 1.5"}, {3.0, "ior 3"}}) {
        const float eta = float(ior);
        addAll(
            subject, "dielectric", [=](float c) { return sh::fresnelDielectric(c, eta); },
            [ior = ior](double c) { return sh64::fresnelDielectric(c, ior); });
    }
    for (const Metal& metal : measuredMetals) {
        const sh::vec3 n{float(metal.n)}, k{float(metal.k)};
        addAll(
            metal.name, "conductor", [=](float c) { return sh::fresnelConductor(c, n, k).x; },
            [&](double c) { return sh64::fresnelConductorChannel(c, metal.n, metal.k); });
    }
    return rows;
}

// Models of their own rather than approximations of one: the error is what a white surface loses.
// Fujii's is EON's without its second term.
std::vector<Row> diffuse(bool timed) {
    const struct {
        const char* name;
        int model;
    } models[] = {{"lambert", sh::DIFFUSE_LAMBERT},
                  {"qualitative", sh::DIFFUSE_QUALITATIVE},
                  {"fujii", sh::DIFFUSE_EON},
                  {"eon", sh::DIFFUSE_EON}};
    const std::vector<Place> grid = places(gridSide);
    std::vector<Row> rows;
    for (const auto& model : models) {
        Row row = named("diffuse", model.name, "white", "furnace");
        std::vector<sh::OrenNayarLobe> lobes;
        Errors errors;
        for (const Place& p : grid) {
            lobes.push_back(
                sh::orenNayarModel(sh::vec3(1.0f), float(std::sqrt(p.alpha)), false, model.model));
            if (row.method == "fujii") lobes.back().multi = sh::vec3(0.0f);
            addAt(errors, double(sh::orenNayarAlbedo(lobes.back(), sh::vec3(p.wo)).x), 1.0, p);
        }
        errors.into(row);
        if (timed) timeEval(lobes, grid, sh::orenNayarEval, row);
        rows.push_back(row);
    }
    return rows;
}

} // namespace patina::measure
