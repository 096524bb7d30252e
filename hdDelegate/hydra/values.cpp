// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/values.h"

#include "hdDelegate/hydra/assets.h"

#include <pxr/base/gf/half.h>
#include <pxr/base/gf/matrix3d.h>
#include <pxr/base/gf/matrix3f.h>
#include <pxr/base/gf/matrix4f.h>
#include <pxr/base/gf/quatd.h>
#include <pxr/base/gf/quatf.h>
#include <pxr/base/gf/quath.h>
#include <pxr/base/gf/vec2d.h>
#include <pxr/base/gf/vec2f.h>
#include <pxr/base/gf/vec2h.h>
#include <pxr/base/gf/vec2i.h>
#include <pxr/base/gf/vec3d.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/gf/vec3h.h>
#include <pxr/base/gf/vec3i.h>
#include <pxr/base/gf/vec4d.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/base/gf/vec4h.h>
#include <pxr/base/gf/vec4i.h>
#include <pxr/usd/sdf/assetPath.h>

namespace patina {

namespace {

template <class T> struct Element { // plain numbers
    static constexpr int components = 1;
    static void append(const T& value, std::vector<float>& out) { out.push_back(float(value)); }
};

template <class T, int N> struct VectorElement {
    static constexpr int components = N;
    static void append(const T& value, std::vector<float>& out) {
        for (int i = 0; i < N; ++i)
            out.push_back(float(value[i]));
    }
};

template <class T, int N> struct MatrixElement {
    static constexpr int components = N * N;
    static void append(const T& value, std::vector<float>& out) {
        for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
                out.push_back(float(value[i][j]));
    }
};

template <class T> struct QuatElement {
    static constexpr int components = 4;
    static void append(const T& value, std::vector<float>& out) {
        out.push_back(float(value.GetReal()));
        for (int i = 0; i < 3; ++i)
            out.push_back(float(value.GetImaginary()[i]));
    }
};

#define PATINA_VECTOR(type, n)                                                                     \
    template <> struct Element<type> : VectorElement<type, n> {}
PATINA_VECTOR(GfVec2f, 2);
PATINA_VECTOR(GfVec2d, 2);
PATINA_VECTOR(GfVec2h, 2);
PATINA_VECTOR(GfVec2i, 2);
PATINA_VECTOR(GfVec3f, 3);
PATINA_VECTOR(GfVec3d, 3);
PATINA_VECTOR(GfVec3h, 3);
PATINA_VECTOR(GfVec3i, 3);
PATINA_VECTOR(GfVec4f, 4);
PATINA_VECTOR(GfVec4d, 4);
PATINA_VECTOR(GfVec4h, 4);
PATINA_VECTOR(GfVec4i, 4);
#undef PATINA_VECTOR
template <> struct Element<GfMatrix3f> : MatrixElement<GfMatrix3f, 3> {};
template <> struct Element<GfMatrix3d> : MatrixElement<GfMatrix3d, 3> {};
template <> struct Element<GfMatrix4f> : MatrixElement<GfMatrix4f, 4> {};
template <> struct Element<GfMatrix4d> : MatrixElement<GfMatrix4d, 4> {};
template <> struct Element<GfQuatf> : QuatElement<GfQuatf> {};
template <> struct Element<GfQuatd> : QuatElement<GfQuatd> {};
template <> struct Element<GfQuath> : QuatElement<GfQuath> {};

template <class T> bool append(const VtValue& value, std::vector<float>& out, int& components) {
    if (value.IsHolding<VtArray<T>>()) {
        const VtArray<T>& array = value.UncheckedGet<VtArray<T>>();
        out.reserve(array.size() * size_t(Element<T>::components));
        for (const T& element : array)
            Element<T>::append(element, out);
    } else if (value.IsHolding<T>()) {
        Element<T>::append(value.UncheckedGet<T>(), out);
    } else {
        return false;
    }
    components = Element<T>::components;
    return true;
}

template <class... T>
bool appendAny(const VtValue& value, std::vector<float>& out, int& components) {
    return (append<T>(value, out, components) || ...);
}

template <class T> bool copyPoints(const VtValue& value, std::vector<vec3>& points) {
    if (!value.IsHolding<VtArray<T>>()) return false;
    const VtArray<T>& array = value.UncheckedGet<VtArray<T>>();
    points.clear();
    points.reserve(array.size());
    for (const T& p : array)
        points.emplace_back(float(p[0]), float(p[1]), float(p[2]));
    return true;
}

} // namespace

dmat4 toMat4(const GfMatrix4d& m) {
    dmat4 result;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            result[i][j] = m[i][j];
    return result;
}

std::vector<float> floatsOf(const VtValue& value, int& components) {
    std::vector<float> out;
    components = 0;
    appendAny<GfVec3f, float, GfVec2f, GfVec4f, int, bool, double, GfHalf, unsigned int, int64_t,
              uint64_t, unsigned char, GfVec2d, GfVec3d, GfVec4d, GfVec2h, GfVec3h, GfVec4h,
              GfVec2i, GfVec3i, GfVec4i, GfMatrix3f, GfMatrix3d, GfMatrix4f, GfMatrix4d, GfQuatf,
              GfQuatd, GfQuath>(value, out, components);
    if (out.empty()) components = 0;
    return out;
}

bool pointsOf(const VtValue& value, std::vector<vec3>& points) {
    return copyPoints<GfVec3f>(value, points) || copyPoints<GfVec3d>(value, points) ||
           copyPoints<GfVec3h>(value, points);
}

std::string textOf(const VtValue& value) {
    if (value.IsHolding<TfToken>()) return value.UncheckedGet<TfToken>().GetString();
    if (value.IsHolding<std::string>()) return value.UncheckedGet<std::string>();
    if (value.IsHolding<SdfAssetPath>()) return fileOf(value.UncheckedGet<SdfAssetPath>());
    return std::string();
}

bool numberOf(const VtValue& value, double& number) {
    int components = 0;
    if (value.IsHolding<double>()) {
        number = value.UncheckedGet<double>();
        return true;
    }
    const std::vector<float> floats = floatsOf(value, components);
    if (components != 1 || floats.size() != 1) return false;
    number = floats[0];
    return true;
}

} // namespace patina
