// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/microsurfaceWalk.h"
#include "shaders/measure/places.h"

namespace patina::measure {

namespace {

constexpr int gridSide = 16;
constexpr int walkCount = 6000;
constexpr int sampleCount = 256;

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
    const char* const names[] = {"vndf", "boundedVndf", "fullNdf"};
    const std::vector<Place> grid = places(gridSide);
    const Metal white = {"white metal", 0.0, 10.0};
    std::vector<Row> rows;
    for (int m = sh::SAMPLING_VNDF; m <= sh::SAMPLING_FULL_NDF; ++m) {
        Row row = named("sampling", names[m], "white metal", "noise");
        auto lobes = metalLobes(grid, white, sh::COMPENSATE_NONE);
        Errors errors;
        for (size_t i = 0; i < grid.size(); ++i) {
            lobes[i].sampling = m;
            double sum = 0.0, squares = 0.0;
            for (int k = 0; k < sampleCount; ++k) {
                const double w =
                    double(sh::conductorSample(lobes[i], sh::vec3(grid[i].wo), point(k)).weight.x);
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
                        sum += sh::conductorSample(lobes[size_t(i)], sh::vec3(grid[size_t(i)].wo),
                                                   point(i & 63))
                                   .weight.x;
                    return double(sum);
                },
                int(grid.size()), row);
        rows.push_back(row);
    }
    return rows;
}

std::vector<Row> fresnel(bool timed) {
    const char* const names[] = {"exact", "schlick", "f82"};
    constexpr int places = 256;
    std::vector<Row> rows;
    for (const auto& [ior, subject] :
         {std::pair(1.05, "ior 1.05"), {1.5, "ior 1.5"}, {3.0, "ior 3"}})
        for (int m = sh::FRESNEL_EXACT; m <= sh::FRESNEL_F82; ++m) {
            Row row = named("fresnel", names[m], subject, "reflectance");
            sh::DielectricLobe lobe =
                sh::dielectricSetup(sh::vec3(1.0f), float(ior), sh::vec2(0.0f), false,
                                    sh::SCATTER_R, false, sh::COMPENSATE_NONE);
            lobe.fresnel = m;
            const auto at = [&](int i) {
                return sh::dielectricFresnel(lobe, (float(i) + 0.5f) / float(places), float(ior));
            };
            Errors errors;
            for (int i = 0; i < places; ++i)
                addAt(errors, double(at(i)), sh64::fresnelDielectric((i + 0.5) / places, ior),
                      (i + 0.5) / places);
            row.kind = "dielectric";
            row.reflectance = sh64::fresnelDielectric(1.0, ior);
            errors.into(row);
            if (timed)
                time(
                    [&](int n) {
                        float sum = 0.0f;
                        for (int i = 0; i < n; ++i)
                            sum += at(i);
                        return double(sum);
                    },
                    places, row);
            rows.push_back(row);
        }
    for (const Metal& metal : measuredMetals)
        for (int m = sh::FRESNEL_EXACT; m <= sh::FRESNEL_F82; ++m) {
            Row row = named("fresnel", names[m], metal.name, "reflectance");
            const sh::ConductorLobe lobe = sh::conductorFresnel(
                metalLobe(metal, {sh64::vec3(0.0, 0.0, 1.0), 0.0}, sh::COMPENSATE_NONE), m);
            const auto at = [&](int i) {
                return sh::conductorReflectance(lobe, (float(i) + 0.5f) / float(places)).x;
            };
            Errors errors;
            for (int i = 0; i < places; ++i)
                addAt(errors, double(at(i)),
                      sh64::fresnelConductorChannel((i + 0.5) / places, metal.n, metal.k),
                      (i + 0.5) / places);
            row.kind = "conductor";
            row.reflectance = sh64::fresnelConductorChannel(1.0, metal.n, metal.k);
            errors.into(row);
            if (timed)
                time(
                    [&](int n) {
                        float sum = 0.0f;
                        for (int i = 0; i < n; ++i)
                            sum += at(i);
                        return double(sum);
                    },
                    places, row);
            rows.push_back(row);
        }
    return rows;
}

// Models of their own rather than approximations of one: the error is what a white surface loses.
std::vector<Row> diffuse(bool timed) {
    const struct {
        const char* name;
        int model;
    } models[] = {{"lambert", sh::DIFFUSE_LAMBERT},
                  {"qualitative", sh::DIFFUSE_QUALITATIVE},
                  {"fujii", sh::DIFFUSE_FUJII},
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
            addAt(errors, double(sh::orenNayarAlbedo(lobes.back(), sh::vec3(p.wo)).x), 1.0, p);
        }
        errors.into(row);
        if (timed) timeEval(lobes, grid, sh::orenNayarEval, row);
        rows.push_back(row);
    }
    return rows;
}

} // namespace patina::measure
