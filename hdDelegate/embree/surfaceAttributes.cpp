#include "hdDelegate/embree/surface.h"

#include <algorithm>

namespace patina {

namespace {

/// Values that are blended for one lookup, and their weights.
struct Blend {
    size_t element[3];
    float weight[3];
    int count;
};

Blend constantBlend(size_t element) { return {{element, 0, 0}, {1.0f, 0.0f, 0.0f}, 1}; }

Blend blendOf(const Surface& surface, MeshAttribute::Rate rate, unsigned primitive, float u,
              float v) {
    using Rate = MeshAttribute::Rate;
    const float w = 1.0f - u - v;
    switch (surface.shape) {
    case Surface::Shape::Triangles:
        if (rate == Rate::PerFace)
            return constantBlend(size_t(surface.mesh.triangleFace[primitive]));
        if (rate == Rate::PerVertex) {
            const uvec3 t = surface.mesh.triangles[primitive];
            return {{t.x, t.y, t.z}, {w, u, v}, 3};
        }
        if (rate == Rate::PerCorner) {
            const size_t c = size_t(primitive) * 3;
            return {{c, c + 1, c + 2}, {w, u, v}, 3};
        }
        break;
    case Surface::Shape::Curves:
        if (rate == Rate::PerFace)
            return constantBlend(size_t(surface.curves.segmentCurve[primitive]));
        if (rate == Rate::PerCorner) {
            const size_t c = size_t(primitive) * 2;
            return {{c, c + 1, 0}, {1.0f - u, u, 0.0f}, 2};
        }
        break;
    case Surface::Shape::Points:
        if (rate == Rate::PerVertex)
            return constantBlend(primitive);
        break;
    }
    return constantBlend(0);
}

} // namespace

bool readAttribute(const Surface& surface, int attribute, unsigned primitive, float u, float v,
                   float out[4]) {
    const MeshAttribute& a = surface.attributes()[attribute];
    const Blend blend = blendOf(surface, a.rate, primitive, u, v);
    const int components = std::min(a.components, 4);
    for (int c = 0; c < components; ++c) {
        float sum = 0.0f;
        for (int k = 0; k < blend.count; ++k) {
            const size_t index = blend.element[k] * size_t(a.components) + size_t(c);
            if (index >= a.data.size())
                return false;
            sum += blend.weight[k] * a.data[index];
        }
        out[c] = sum;
    }
    return true;
}

} // namespace patina
