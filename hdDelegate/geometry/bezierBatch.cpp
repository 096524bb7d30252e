// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/bezierBatch.h"

namespace patina {

BezierBatch::BezierBatch(const Curves& from) : _out(std::make_shared<Curves>()) {
    static_cast<Geometry&>(*_out) = from;
    _out->primvars.clear();
    _out->basis = CurveBasis::Bezier;
    _out->points.times = from.points.times;
    _out->points.values.resize(from.points.values.size());
}

void BezierBatch::addPlain(const Primvar& primvar, std::vector<float> values) {
    if (primvar.interpolation == Interpolation::Uniform) {
        std::vector<float> kept;
        const size_t n = size_t(primvar.components);
        for (const size_t curve : _authored)
            kept.insert(kept.end(), values.begin() + long(curve * n),
                        values.begin() + long((curve + 1) * n));
        values = std::move(kept);
    }
    add(primvar, primvar.interpolation, std::move(values));
}

void BezierBatch::add(const Primvar& primvar, Interpolation interpolation,
                      std::vector<float> values) {
    Primvar made;
    made.name = primvar.name;
    made.interpolation = interpolation;
    made.components = primvar.components;
    made.values = std::move(values);
    _out->primvars.push_back(std::move(made));
}

std::shared_ptr<const Curves> BezierBatch::finish(size_t authored) {
    if (_authored.size() == authored || _out->subsets.empty()) return _out;
    std::vector<int> numbers(authored, -1);
    for (size_t i = 0; i < _authored.size(); ++i)
        numbers[_authored[i]] = int(i);
    for (GeomSubset& subset : _out->subsets) {
        std::vector<int> kept;
        for (const int curve : subset.faces) {
            if (curve < 0 || size_t(curve) >= authored)
                kept.push_back(curve); // reported where subsets are read
            else if (numbers[size_t(curve)] >= 0)
                kept.push_back(numbers[size_t(curve)]);
        }
        subset.faces = std::move(kept);
    }
    return _out;
}

} // namespace patina
