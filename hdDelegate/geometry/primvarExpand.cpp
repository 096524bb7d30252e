// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/primvarExpand.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

const char* nameOf(Interpolation interpolation) {
    switch (interpolation) {
    case Interpolation::Constant: return "constant";
    case Interpolation::Uniform: return "uniform";
    case Interpolation::Varying: return "varying";
    case Interpolation::Vertex: return "vertex";
    case Interpolation::FaceVarying: return "faceVarying";
    }
    return "";
}

const MeshAttribute* find(const std::vector<MeshAttribute>& list, const std::string& name) {
    for (const MeshAttribute& attribute : list)
        if (attribute.name == name) return &attribute;
    return nullptr;
}

} // namespace

const MeshAttribute* TriangleMesh::attribute(const std::string& name) const {
    return find(attributes, name);
}
const MeshAttribute* CurveSet::attribute(const std::string& name) const {
    return find(attributes, name);
}
const MeshAttribute* PointSet::attribute(const std::string& name) const {
    return find(attributes, name);
}

size_t ElementCounts::of(Interpolation interpolation) const {
    switch (interpolation) {
    case Interpolation::Constant: return 1;
    case Interpolation::Uniform: return uniform;
    case Interpolation::Varying: return varying;
    case Interpolation::Vertex: return vertex;
    case Interpolation::FaceVarying: return faceVarying;
    }
    return 1;
}

bool expandPrimvar(const Primvar& primvar, const ElementCounts& counts, const std::string& prim,
                   Diagnostics& diagnostics, std::vector<float>& out) {
    const std::string input = "primvars:" + primvar.name;
    const int n = primvar.components;
    if (n < 1 || n > 16) {
        diagnostics.warn(prim, input, messages::primvarComponents(n));
        return false;
    }
    const size_t stored = primvar.values.size() / size_t(n);
    const size_t elements = primvar.indices.empty() ? stored : primvar.indices.size();
    const size_t expected = counts.of(primvar.interpolation);
    const bool constant = primvar.interpolation == Interpolation::Constant;
    const bool one =
        elements == 1; // one for all, whatever is authored, as Storm and RenderMan take it
    if (constant ? elements < 1 : elements != expected && !one) {
        diagnostics.warn(prim, input,
                         messages::primvarCount(elements, nameOf(primvar.interpolation), expected));
        return false;
    }
    size_t badIndices = 0, badValues = 0;
    out.assign(expected * n, 0.0f);
    if (primvar.indices.empty()) {
        for (size_t i = 0; i < expected * n; ++i)
            out[i] = primvar.values[one ? i % n : i];
    } else {
        for (size_t i = 0; i < expected; ++i) {
            const int index = primvar.indices[one ? 0 : i];
            if (index < 0 || size_t(index) >= stored) {
                ++badIndices;
                continue;
            }
            std::copy_n(&primvar.values[size_t(index) * n], n, &out[i * n]);
        }
    }
    for (float& value : out)
        if (!std::isfinite(value)) {
            value = 0.0f;
            ++badValues;
        }
    if (badIndices > 0) diagnostics.warn(prim, input, messages::indicesOutOfRange(badIndices));
    if (badValues > 0) diagnostics.warn(prim, input, messages::valuesNotFinite(badValues));
    return true;
}

bool expandConstant(const Primvar& primvar, const std::string& prim, Diagnostics& diagnostics,
                    MeshAttribute& out) {
    out.name = primvar.name;
    out.components = primvar.components;
    out.rate = MeshAttribute::Rate::Constant;
    return expandPrimvar(primvar, ElementCounts(), prim, diagnostics, out.data);
}

} // namespace patina
