// SPDX-License-Identifier: Apache-2.0
#include "testenv/fuzz/targets/useMaterial.h"

#include "materialNetwork/cpu/materialProgram.h"
#include "base/diagnostics.h"
#include "materialNetwork/glsl/glslMaterial.h"
#include "materialNetwork/glsl/glslWeb.h"
#include "materialNetwork/material.h"
#include "materialNetwork/textureSource.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace patina {

namespace {

/// Textures that are there and hold the extremes that files can hold.
class Textures : public TextureSource {
public:
    int open(const TextureRequest&) override { return _count++; }
    bool valid(int handle) const override { return handle % 4 != 3; }
    glm::vec4 sample(int handle, glm::vec2 uv, float) const override {
        return handle % 2 ? glm::vec4(0.0f) : glm::vec4(uv.x, 65504.0f, -1.0f, 0.5f);
    }
    int channels(int handle) const override { return 1 + handle % 4; }

private:
    int _count = 0;
};

class Primvars : public PrimvarReader {
public:
    bool read(int slot, float out[4]) const override {
        if (slot % 3 == 2) return false;
        for (int i = 0; i < 4; ++i)
            out[i] = slot % 3 ? -1.0f : 0.25f * float(i + 1);
        return true;
    }
};

void must(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "promise broken: %s\n", what);
    std::abort();
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool positive(const glm::vec3& v) {
    return finite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f;
}

void look(const MaterialProgram& program, const glm::vec3& wo) {
    static const Primvars primvars;
    ShadingPoint point;
    point.viewDirection = wo;
    point.position = {0.3f, -0.2f, 1.0f};
    point.primvars = &primvars;
    glm::vec3 passes;
    const float opacity = program.opacity(point, &passes);
    must(opacity >= 0.0f && opacity <= 1.0f && finite(passes), "opacity is from 0 to 1");
    must(positive(program.emission(point, wo)), "emission is finite and not negative");
    must(finite(program.displacement(point)), "displacement is finite");
    if (program.hasInterior()) (void)program.interior(point);
    Bsdf bsdf;
    program.evaluate(point, bsdf);
    must(finite(bsdf.albedo()), "albedo is finite");
    for (const glm::vec3& wi : {glm::vec3(0, 0, 1), glm::vec3(0.6f, 0, 0.8f),
                                glm::vec3(0, 0.8f, -0.6f), glm::vec3(0.99999f, 0, 0.0044721f)}) {
        const BsdfEval eval = bsdf.eval(wi);
        must(positive(eval.diffuse) && positive(eval.specular),
             "values are finite and not negative");
        must(std::isfinite(eval.pdf) && eval.pdf >= 0.0f, "densities are finite and not negative");
    }
    for (float u : {0.0f, 0.37f, 0.99999994f}) {
        const BsdfSample sample = bsdf.sample({u, 1.0f - u, 0.5f}, u);
        if (sample.event == 0) continue;
        must(finite(sample.wi) && positive(sample.weight), "samples are finite and not negative");
        must(sample.pdf >= 0.0f, "the density of a sample is not negative");
    }
}

} // namespace

void useMaterial(const Network& network, const std::string& source) {
    Diagnostics diagnostics;
    Textures textures;
    const auto program = compileMaterial(network, textures, diagnostics);
    for (const glm::vec3& wo : {glm::vec3(0, 0, 1), glm::vec3(0, 0.6f, 0.8f), glm::vec3(0, 0, -1),
                                glm::vec3(0.99999f, 0, 0.0044721f)})
        look(*program, wo);
    const GlslMaterial glsl = makeGlslMaterial(program->ir());
    const GlslWebMaterial web = makeGlslWebMaterial(program->ir());
    if (source.find(fuzzMark) != std::string::npos)
        for (const std::string* text : {&glsl.text, &glsl.albedoText, &glsl.passesText,
                                        &glsl.traitsText, &glsl.definitions, &web.text})
            must(text->find(fuzzMark) == std::string::npos, "no string of a scene reaches GLSL");
    (void)explainMaterial(network, diagnostics);
}

} // namespace patina
