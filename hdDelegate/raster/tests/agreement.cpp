// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/tests/agreement.h"

#include <algorithm>
#include <cmath>

namespace patina::test {

const char* const agreementPartNames[PartCount] = {"eval",   "pdf",        "sample",
                                                   "weight", "sample pdf", "albedo"};

std::vector<AgreementPoint> agreementPoints() {
    const double degree = 3.14159265358979 / 180.0;
    std::vector<vec3> directions;
    double phi = 0.3;
    for (const double angle : {0.0, 20.0, 45.0, 65.0, 80.0, 89.0, 89.9, 90.1, 95.0, 125.0, 160.0}) {
        directions.push_back(direction(std::cos(angle * degree), phi));
        phi += 2.39996; // golden angle
    }
    std::vector<AgreementPoint> points;
    const auto add = [&](vec3 wo, vec3 wi) {
        const vec3 u = quasiRandom(int(points.size()));
        AgreementPoint p;
        for (int i = 0; i < 3; ++i) {
            p.wo[i] = float(wo[i]);
            p.wi[i] = float(wi[i]);
            p.u[i] = float(u[i]);
        }
        points.push_back(p);
    };
    for (const vec3& wo : directions) {
        for (const vec3& wi : directions)
            add(wo, wi);
        // Near the mirror direction and near straight on, where narrow lobes live.
        for (const double off : {0.02, 0.2}) {
            add(wo, sh64::normalize(vec3(-wo.x + off, -wo.y, wo.z + off)));
            add(wo, sh64::normalize(vec3(-wo.x, -wo.y + off, -wo.z)));
        }
    }
    return points;
}

AgreementAnswer answerOf(const BoundLobe& lobe, const AgreementPoint& p) {
    const vec3 wo(p.wo[0], p.wo[1], p.wo[2]);
    AgreementAnswer a;
    a.eval = lobe.eval(wo, vec3(p.wi[0], p.wi[1], p.wi[2]));
    a.sample = lobe.sample(wo, vec3(p.u[0], p.u[1], p.u[2]));
    a.albedo = lobe.albedo(wo);
    return a;
}

namespace {

double relative(double a, double b, double minimum = 1e-6) {
    const double d = std::fabs(a - b) / std::max(std::fabs(b), minimum);
    return std::isfinite(d) ? d : 1e30;
}
double relative(vec3 a, vec3 b, double minimum) {
    return std::max(relative(a.x, b.x, minimum),
                    std::max(relative(a.y, b.y, minimum), relative(a.z, b.z, minimum)));
}

} // namespace

void differences(const AgreementAnswer& a, const AgreementAnswer& oracle, double out[PartCount]) {
    out[PartEval] =
        relative(a.eval.value, oracle.eval.value, std::max(1e-6, agreementShare * oracle.eval.pdf));
    out[PartPdf] = relative(a.eval.pdf, oracle.eval.pdf);
    out[PartAlbedo] = relative(a.albedo, oracle.albedo, agreementShare);
    out[PartSample] = out[PartWeight] = out[PartSamplePdf] = 1.0;
    if (a.sample.event != oracle.sample.event) return;
    const vec3 d = a.sample.wi - oracle.sample.wi;
    out[PartSample] = std::max(sh64::length(d), relative(a.sample.eta, oracle.sample.eta));
    out[PartWeight] = relative(a.sample.weight, oracle.sample.weight, agreementShare);
    out[PartSamplePdf] = relative(a.sample.pdf, oracle.sample.pdf);
}

} // namespace patina::test
