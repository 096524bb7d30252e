// SPDX-License-Identifier: Apache-2.0
// Numbers of a BSDF for the Python module. Arrays of directions have a row of three for each; unit
// vectors in the shading frame (z normal, x tangent).

#include "plugin/python/warningList.h"

#include "hdDelegate/image/textureSystem.h"
#include "materialNetwork/material.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

namespace py = pybind11;

namespace patina {

namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// Texture coordinates as every primvar of two floats; other primvars are not there.
class UvPrimvars : public PrimvarReader {
public:
    explicit UvPrimvars(const MaterialProgram& program) : _program(program) {}
    bool read(int slot, float out[4]) const override {
        if (_program.primvars()[size_t(slot)].type != ValueType::Vec2) return false;
        out[0] = uv.x;
        out[1] = uv.y;
        return true;
    }
    glm::vec2 uv{0.0f};

private:
    const MaterialProgram& _program;
};

/// A compiled material with all that it needs to live.
struct MaterialProbe {
    Diagnostics diagnostics;
    TextureSystem textures{diagnostics};
    std::shared_ptr<const MaterialProgram> program;

    MaterialProbe(const Network& network, const MethodChoices& methods, double tolerance) {
        py::gil_scoped_release release;
        program = compileMaterial(network, textures, diagnostics, methods, tolerance);
        primvars = std::make_unique<UvPrimvars>(*program);
    }

    /// The place is the point (u, v) of the unit square in the xy plane, once it is chosen.
    void moveTo(float u, float v) {
        placed = true;
        primvars->uv = {u, v};
    }

    ShadingPoint seenFrom(const glm::vec3& wo) const {
        ShadingPoint point;
        point.viewDirection = wo;
        if (!placed) return point;
        point.primvars = primvars.get();
        point.position = point.objectPosition = glm::vec3(primvars->uv, 0.0f);
        return point;
    }

    std::unique_ptr<UvPrimvars> primvars;
    bool placed = false;
};

size_t rows(const Floats& array, size_t columns, const char* name) {
    if (array.ndim() != 2 || size_t(array.shape(1)) != columns)
        throw py::value_error(std::string(name) + " must be an array of rows of " +
                              std::to_string(columns) + " numbers");
    return size_t(array.shape(0));
}

void sameRows(size_t a, size_t b) {
    if (a != b) throw py::value_error("the arrays have different numbers of rows");
}

glm::vec3 row(const float* data, size_t i) {
    return {data[3 * i], data[3 * i + 1], data[3 * i + 2]};
}

void store(float* data, size_t i, const glm::vec3& v) {
    for (int c = 0; c < 3; ++c)
        data[3 * i + size_t(c)] = v[c];
}

Floats triples(size_t n) {
    return Floats(std::vector<size_t>{n, 3});
}

Floats singles(size_t n) {
    return Floats(std::vector<size_t>{n});
}

/// Values that are random are shown as means over so many.
constexpr uint32_t stochasticEvaluations = 256, stochasticAlbedos = 64;

BsdfEval meanEval(Bsdf& bsdf, const glm::vec3& wi) {
    if (!bsdf.stochastic()) return bsdf.eval(wi);
    BsdfEval mean;
    for (uint32_t seed = 0; seed < stochasticEvaluations; ++seed) {
        bsdf.seed(seed);
        const BsdfEval e = bsdf.eval(wi);
        mean.diffuse += e.diffuse / float(stochasticEvaluations);
        mean.specular += e.specular / float(stochasticEvaluations);
        mean.pdf = e.pdf;
    }
    return mean;
}

glm::vec3 meanAlbedo(Bsdf& bsdf) {
    if (!bsdf.stochastic()) return bsdf.albedo();
    glm::vec3 mean(0.0f);
    for (uint32_t seed = 0; seed < stochasticAlbedos; ++seed) {
        bsdf.seed(seed);
        mean += bsdf.albedo() / float(stochasticAlbedos);
    }
    return mean;
}

/// All that happens to light: it meets the surface with the chance `presence`, or goes straight on.
struct WholeMaterial {
    Bsdf bsdf; ///< of light that meets the surface
    float presence;
    glm::vec3 passes; ///< colour of light that goes on

    WholeMaterial(const MaterialProgram& program, const ShadingPoint& point) {
        presence = program.opacity(point, &passes);
        program.evaluate(point, bsdf);
    }

    BsdfEval eval(const glm::vec3& wi) {
        BsdfEval e = meanEval(bsdf, wi);
        e.diffuse *= presence;
        e.specular *= presence;
        e.pdf *= presence;
        return e;
    }

    BsdfSample sample(const glm::vec4& u, const glm::vec3& wo) const {
        BsdfSample s;
        if (u.w < presence) {
            s = bsdf.sample(glm::vec3(u), std::min(u.w / presence, 0x1.fffffep-1f));
            s.pdf *= presence;
            return s;
        }
        s.wi = -wo;
        s.weight = passes;
        s.pdf = 1.0f - presence;
        s.event = sh::LOBE_TRANSMIT | sh::LOBE_DELTA;
        return s;
    }

    glm::vec3 albedo() { return presence * meanAlbedo(bsdf) + (1.0f - presence) * passes; }
};

/// The material for one outgoing direction after the other: set up where it is not that of the row
/// before.
class MaterialByRow {
public:
    explicit MaterialByRow(const MaterialProbe& probe) : _probe(probe) {}

    WholeMaterial& seenFrom(const glm::vec3& wo) {
        if (_material && std::memcmp(&wo, &_wo, sizeof wo) == 0) return *_material;
        _wo = wo;
        return _material.emplace(*_probe.program, _probe.seenFrom(wo));
    }

private:
    const MaterialProbe& _probe;
    glm::vec3 _wo{0.0f};
    std::optional<WholeMaterial> _material;
};

py::tuple eval(const MaterialProbe& probe, const Floats& wo, const Floats& wi) {
    const size_t n = rows(wo, 3, "wo");
    sameRows(n, rows(wi, 3, "wi"));
    Floats f = triples(n), pdf = singles(n);
    const float *outgoing = wo.data(), *incoming = wi.data();
    float *values = f.mutable_data(), *densities = pdf.mutable_data();
    {
        py::gil_scoped_release release;
        MaterialByRow materials(probe);
        for (size_t i = 0; i < n; ++i) {
            const glm::vec3 direction = row(incoming, i);
            const BsdfEval e = materials.seenFrom(row(outgoing, i)).eval(direction);
            const float cosine = std::abs(direction.z);
            store(values, i, cosine > 0.0f ? (e.diffuse + e.specular) / cosine : glm::vec3(0.0f));
            densities[i] = e.pdf;
        }
    }
    return py::make_tuple(f, pdf);
}

py::dict sample(const MaterialProbe& probe, const Floats& wo, const Floats& u) {
    const size_t n = rows(wo, 3, "wo");
    sameRows(n, rows(u, 4, "u"));
    Floats wi = triples(n), weight = triples(n), pdf = singles(n);
    py::array_t<int> event(std::vector<size_t>{n});
    const float *outgoing = wo.data(), *random = u.data();
    float *directions = wi.mutable_data(), *weights = weight.mutable_data(),
          *densities = pdf.mutable_data();
    int* events = event.mutable_data();
    {
        py::gil_scoped_release release;
        MaterialByRow materials(probe);
        for (size_t i = 0; i < n; ++i) {
            const glm::vec3 wo = row(outgoing, i);
            WholeMaterial& material = materials.seenFrom(wo);
            const float* r = random + 4 * i;
            material.bsdf.seed(uint32_t(i));
            const BsdfSample s = material.sample({r[0], r[1], r[2], r[3]}, wo);
            store(directions, i, s.event ? s.wi : glm::vec3(0.0f));
            store(weights, i, s.event ? s.weight : glm::vec3(0.0f));
            densities[i] = s.event ? s.pdf : 0.0f;
            events[i] = s.event;
        }
    }
    py::dict result;
    result["wi"] = wi;
    result["weight"] = weight;
    result["pdf"] = pdf;
    result["event"] = event;
    return result;
}

/// One colour for each outgoing direction.
template <class Function> Floats perDirection(const Floats& wo, Function function) {
    const size_t n = rows(wo, 3, "wo");
    Floats result = triples(n);
    const float* outgoing = wo.data();
    float* values = result.mutable_data();
    {
        py::gil_scoped_release release;
        for (size_t i = 0; i < n; ++i)
            store(values, i, function(row(outgoing, i)));
    }
    return result;
}

Floats albedo(const MaterialProbe& probe, const Floats& wo) {
    return perDirection(wo, [&](const glm::vec3& direction) {
        return WholeMaterial(*probe.program, probe.seenFrom(direction)).albedo();
    });
}

Floats emission(const MaterialProbe& probe, const Floats& wo) {
    return perDirection(wo, [&](const glm::vec3& direction) {
        return probe.program->emission(probe.seenFrom(direction), direction);
    });
}

Floats emissionAt(const MaterialProbe& probe, const Floats& uv, float footprint) {
    const size_t n = rows(uv, 2, "uv");
    Floats result = triples(n);
    const float* places = uv.data();
    float* values = result.mutable_data();
    {
        py::gil_scoped_release release;
        UvPrimvars primvars(*probe.program);
        ShadingPoint point;
        point.primvars = &primvars;
        point.uvFootprint = footprint;
        for (size_t i = 0; i < n; ++i) {
            primvars.uv = {places[2 * i], places[2 * i + 1]};
            point.position = point.objectPosition = glm::vec3(primvars.uv, 0.0f);
            glm::vec3 sum(0.0f);
            const uint32_t seeds = probe.program->jitters() ? MaterialProgram::steadySeeds : 1;
            for (uint32_t seed = 0; seed < seeds; ++seed) {
                point.seed = seeds > 1 ? seed + 1 : 0;
                sum += probe.program->emission(point, glm::vec3(0, 0, 1));
            }
            store(values, i, sum / float(seeds));
        }
    }
    return result;
}

} // namespace

void bindMaterialProbe(py::module_& m) {
    py::class_<MaterialProbe>(m, "MaterialProbe",
                              "A compiled material at one shading point: its lobes, and light that "
                              "passes straight on.")
        .def(py::init<const Network&, const MethodChoices&, double>(), py::arg("network"),
             py::arg("methods") = MethodChoices(), py::arg("tolerance") = -1.0)
        .def("eval", &eval, py::arg("wo"), py::arg("wi"),
             "f without the cosine, and the density of sample(); delta lobes and light that passes "
             "straight on have no part in it.")
        .def("sample", &sample, py::arg("wo"), py::arg("u"),
             "wi, weight (f cos / pdf), pdf and event (0: no sample) for rows of four random "
             "numbers.")
        .def("albedo", &albedo, py::arg("wo"),
             "Directional albedo: what is reflected, transmitted and passes straight on.")
        .def_property_readonly(
            "stochastic",
            [](const MaterialProbe& probe) {
                Bsdf bsdf;
                probe.program->evaluate(probe.seenFrom({0, 0, 1}), bsdf);
                return bsdf.stochastic();
            },
            "Whether a lobe has no formula: eval() and albedo() are then means over random walks "
            "(256 and 2048 of them), and densities estimates.")
        .def("emission", &emission, py::arg("wo"))
        .def("move_to", &MaterialProbe::moveTo, py::arg("u"), py::arg("v"),
             "Chooses the point (u, v) of the unit square in the xy plane for all that follows.")
        .def("emission_at", &emissionAt, py::arg("uv"), py::arg("footprint") = 0.0f,
             "Emission of the unit square of the xy plane at its points (u, v), seen from above.")
        .def_property_readonly("uses_uv",
                               [](const MaterialProbe& p) { return p.program->usesUv(); })
        .def_property_readonly("constant",
                               [](const MaterialProbe& p) { return p.program->constant(); })
        .def(
            "opacity",
            [](const MaterialProbe& p, const std::array<float, 3>& wo) {
                return p.program->opacity(p.seenFrom({wo[0], wo[1], wo[2]}));
            },
            py::arg("wo") = std::array<float, 3>{0.0f, 0.0f, 1.0f},
            "Presence: the chance that light meets the surface rather than pass straight on.")
        .def_property_readonly("warnings",
                               [](const MaterialProbe& p) { return warningList(p.diagnostics); });
}

} // namespace patina
