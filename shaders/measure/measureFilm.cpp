// SPDX-License-Identifier: Apache-2.0
#include "shaders/measure/measure.h"
#include "shaders/measure/places.h"

namespace patina::measure {

// The truth is summed in double at every nanometre's third, far finer than what any method does.
std::vector<Row> thinFilm(bool timed) {
    const struct {
        const char* name;
        const char* kind;
        double reflectance; ///< of what is below
        double ior;
        sh64::vec3 n, k;
    } bases[] = {{"1.33 on ior 1.5", "schlick", 0.04, 1.33, sh64::vec3(1.5), sh64::vec3(0.0)},
                 {"1.5 on gold", "conductor", 0.94, 1.5, sh64::vec3(0.18, 0.42, 1.37),
                  sh64::vec3(3.4, 2.35, 1.77)}};
    const char* const names[] = {"gaussian", "table", "spectral"};
    constexpr double thickest = 2000.0; // nm
    constexpr int thicknessCount = 24, filmCosines = 16;
    std::vector<Row> rows;
    for (const auto& base : bases) {
        std::vector<sh64::vec3> truth;
        for (int i = 0; i < thicknessCount * filmCosines; ++i) {
            const double thickness = thickest * (i / filmCosines + 0.5) / thicknessCount;
            const double c = (i % filmCosines + 0.5) / filmCosines;
            const double s2 = 1.0 - c * c, e = base.ior;
            const double ct = std::sqrt(1.0 - s2 / (e * e)), ec = e * ct;
            const double s12 = (c - ec) / (c + ec), p12 = (e * c - ct) / (e * c + ct);
            sh64::vec4 b[3];
            for (int k = 0; k < 3; ++k)
                b[k] = sh64::filmBase(ec, e * e, s2, base.n[k], base.k[k]);
            sh64::vec3 sum(0.0), white(0.0);
            for (double nm = 360.0; nm < 830.0; nm += 1.0 / 3.0) {
                const double phase = sh64::TWO_PI * 2.0 * thickness * ec / nm;
                const sh64::vec2 turn(std::cos(phase), std::sin(phase));
                const sh64::vec3 seen = sh64::filmChannels(nm);
                const sh64::vec3 s = sh64::filmAiry(s12, sh64::vec3(b[0].x, b[1].x, b[2].x),
                                                    sh64::vec3(b[0].y, b[1].y, b[2].y), turn);
                const sh64::vec3 p = sh64::filmAiry(p12, sh64::vec3(b[0].z, b[1].z, b[2].z),
                                                    sh64::vec3(b[0].w, b[1].w, b[2].w), turn);
                sum += seen * (s + p) * 0.5;
                white += seen;
            }
            truth.push_back(sh64::min(sh64::max(sum / white, sh64::vec3(0.0)), sh64::vec3(1.0)));
        }
        for (int m = sh::FILM_GAUSSIANS; m <= sh::FILM_SPECTRAL; ++m) {
            Row row;
            row.point = "thinFilm";
            row.method = names[m];
            row.subject = base.name;
            row.error = "reflectance";
            const auto at = [&](int i) {
                sh::Film film = sh::makeFilm(
                    float(thickest * (i / filmCosines % thicknessCount + 0.5) / thicknessCount),
                    float(base.ior));
                film.method = m;
                return sh::filmReflectance(film, (float(i % filmCosines) + 0.5f) / filmCosines,
                                           sh::vec3(base.n), sh::vec3(base.k));
            };
            row.kind = base.kind;
            row.reflectance = base.reflectance;
            row.axis = "thickness";
            row.axisEnd = thickest;
            Errors errors;
            for (size_t i = 0; i < truth.size(); ++i)
                for (int k = 0; k < 3; ++k)
                    errors.add(double(at(int(i))[k]) - truth[i][k], truth[i][k],
                               (int(i) / filmCosines + 0.5) / thicknessCount,
                               (int(i) % filmCosines + 0.5) / filmCosines);
            errors.into(row);
            if (timed)
                time(
                    [&](int n) {
                        float sum = 0.0f;
                        for (int i = 0; i < n; ++i)
                            sum += at(i * 37 % (thicknessCount * filmCosines)).x;
                        return double(sum);
                    },
                    m == sh::FILM_SPECTRAL ? 48 : 384, row);
            rows.push_back(row);
        }
    }
    return rows;
}

} // namespace patina::measure
