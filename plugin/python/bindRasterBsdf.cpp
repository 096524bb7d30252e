// SPDX-License-Identifier: Apache-2.0
// RasterProbe: numbers of a material as the rasterizer's driver computes them, with the methods of
// MaterialProbe.
#ifdef PATINA_HAS_RASTER

#include "plugin/python/warningList.h"

#include "hdDelegate/raster/scene/rasterBsdf.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace py = pybind11;

namespace patina {

namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

struct RasterProbe {
    Diagnostics diagnostics;
    TextureSystem textures{diagnostics};
    std::unique_ptr<RasterBsdf> bsdf;
    bool placed = false;
    glm::vec2 uv{0.0f};

    RasterProbe(const Network& network, const MethodChoices& methods,
                const std::vector<const RasterProbe*>& like) {
        std::vector<const RasterBsdf*> others;
        for (const RasterProbe* probe : like) {
            if (!probe) throw py::type_error("`like` holds None");
            others.push_back(probe->bsdf.get());
        }
        std::string error;
        {
            const py::gil_scoped_release release;
            bsdf = RasterBsdf::make(compileMaterial(network, textures, diagnostics, methods),
                                    textures, diagnostics, error, others);
        }
        if (!bsdf) throw std::runtime_error(error);
    }
};

glm::vec4 row(const Floats& array, size_t i) {
    const size_t columns = size_t(array.shape(1));
    const float* from = array.data() + i * columns;
    return {from[0], from[1], from[2], columns > 3 ? from[3] : 0.0f};
}

/// Answers for the rows of wo, and of a second array of directions or random numbers.
std::vector<RasterBsdf::Answer> answers(const RasterProbe& probe, const Floats& wo,
                                        const Floats* second, size_t columns) {
    if (wo.ndim() != 2 || wo.shape(1) != 3)
        throw py::value_error("wo must be an array of rows of 3 numbers");
    const size_t n = size_t(wo.shape(0));
    if (second && (second->ndim() != 2 || size_t(second->shape(1)) != columns ||
                   size_t(second->shape(0)) != n))
        throw py::value_error("the second array must have as many rows as wo, of " +
                              std::to_string(columns) + " numbers");
    std::vector<RasterBsdf::Query> queries(n);
    for (size_t i = 0; i < n; ++i) {
        queries[i].wo = row(wo, i);
        if (second) (columns == 3 ? queries[i].wi : queries[i].u) = row(*second, i);
    }
    const py::gil_scoped_release release;
    return probe.bsdf->evaluate(queries, probe.placed ? &probe.uv : nullptr);
}

using Part = std::function<glm::vec3(const RasterBsdf::Answer&, size_t)>;

Floats colors(const std::vector<RasterBsdf::Answer>& all, const Part& part) {
    Floats out(std::vector<size_t>{all.size(), 3});
    float* to = out.mutable_data();
    for (size_t i = 0; i < all.size(); ++i) {
        const glm::vec3 v = part(all[i], i);
        for (int k = 0; k < 3; ++k)
            *to++ = v[k];
    }
    return out;
}

py::tuple eval(const RasterProbe& probe, const Floats& wo, const Floats& wi) {
    const auto all = answers(probe, wo, &wi, 3);
    py::array_t<float> pdf(std::vector<size_t>{all.size()});
    for (size_t i = 0; i < all.size(); ++i)
        pdf.mutable_data()[i] = all[i].diffuse.w;
    const Floats f = colors(all, [&](const RasterBsdf::Answer& a, size_t i) {
        const float cosine = std::abs(row(wi, i).z);
        return cosine > 0.0f ? glm::vec3(a.diffuse + a.specular) / cosine : glm::vec3(0.0f);
    });
    return py::make_tuple(f, pdf);
}

py::dict sample(const RasterProbe& probe, const Floats& wo, const Floats& u) {
    const auto all = answers(probe, wo, &u, 4);
    py::array_t<float> pdf(std::vector<size_t>{all.size()});
    py::array_t<int> event(std::vector<size_t>{all.size()});
    for (size_t i = 0; i < all.size(); ++i) {
        event.mutable_data()[i] = int(all[i].wi.w);
        pdf.mutable_data()[i] = all[i].wi.w != 0.0f ? all[i].weight.w : 0.0f;
    }
    const auto met = [](const RasterBsdf::Answer& a, const glm::vec4& v) {
        return a.wi.w != 0.0f ? glm::vec3(v) : glm::vec3(0.0f);
    };
    py::dict result;
    result["wi"] = colors(all, [&](const RasterBsdf::Answer& a, size_t) { return met(a, a.wi); });
    result["weight"] =
        colors(all, [&](const RasterBsdf::Answer& a, size_t) { return met(a, a.weight); });
    result["pdf"] = pdf;
    result["event"] = event;
    return result;
}

Floats albedo(const RasterProbe& probe, const Floats& wo) {
    return colors(answers(probe, wo, nullptr, 0),
                  [](const RasterBsdf::Answer& a, size_t) { return glm::vec3(a.albedo); });
}

Floats emission(const RasterProbe& probe, const Floats& wo) {
    return colors(answers(probe, wo, nullptr, 0),
                  [](const RasterBsdf::Answer& a, size_t) { return glm::vec3(a.emission); });
}

float opacity(const RasterProbe& probe, const std::array<float, 3>& wo) {
    Floats row(std::vector<size_t>{1, 3});
    std::copy(wo.begin(), wo.end(), row.mutable_data());
    return answers(probe, row, nullptr, 0)[0].specular.w;
}

} // namespace

void bindRasterBsdf(py::module_& m) {
    py::class_<RasterProbe>(m, "RasterProbe",
                            "A material at one shading point, computed by the rasterizer's driver "
                            "from its GLSL. RuntimeError where there is no OpenGL. It uses "
                            "the shader of one of `like` where only numbers differ.")
        .def(py::init<const Network&, const MethodChoices&,
                      const std::vector<const RasterProbe*>&>(),
             py::arg("network"), py::arg("methods") = MethodChoices(),
             py::arg("like") = std::vector<const RasterProbe*>())
        .def("eval", &eval, py::arg("wo"), py::arg("wi"))
        .def("sample", &sample, py::arg("wo"), py::arg("u"))
        .def("albedo", &albedo, py::arg("wo"))
        .def("emission", &emission, py::arg("wo"))
        .def("opacity", &opacity, py::arg("wo") = std::array<float, 3>{0.0f, 0.0f, 1.0f})
        .def(
            "move_to",
            [](RasterProbe& probe, float u, float v) {
                probe.placed = true;
                probe.uv = {u, v};
            },
            py::arg("u"), py::arg("v"))
        .def_property_readonly("shares_shader",
                               [](const RasterProbe& p) { return p.bsdf->sharesShader(); })
        .def_property_readonly("warnings",
                               [](const RasterProbe& p) { return warningList(p.diagnostics); });
}

} // namespace patina

#endif
