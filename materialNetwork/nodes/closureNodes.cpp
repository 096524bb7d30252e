// SPDX-License-Identifier: Apache-2.0
// Closures: BSDF, EDF and VDF nodes, their combiners, and the shaders made of them.
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

constexpr NodeRow closure(const char* id, const char* category, const char* inputs,
                          const char* outputs, ClosureKind kind, const char* types = nullptr) {
    return {id, category, inputs, outputs, nullptr, Algebra::None, types, nullptr, kind};
}

const NodeRow rows[] = {
#define PATINA_LOBE_NODE(Kind, id, category, inputs)                                               \
    closure(id, category, inputs, "BSDF", ClosureKind::Kind),
#include "materialNetwork/lobeTable.inc"
    closure("ND_thin_film_bsdf", "thin_film_bsdf", "float thickness=550, float ior=1.5", "BSDF",
            ClosureKind::ThinFilm),
    closure("ND_uniform_edf", "uniform_edf", "color3 color=1", "EDF", ClosureKind::UniformEdf),
    closure("ND_conical_edf", "conical_edf",
            "color3 color=1, vector3 normal=@Nworld, float inner_angle=60, float outer_angle=0",
            "EDF", ClosureKind::ConicalEdf),
    closure("ND_generalized_schlick_edf", "generalized_schlick_edf",
            "color3 color0=1, color3 color90=1, float exponent=5, EDF base", "EDF",
            ClosureKind::SchlickEdf),
    closure("ND_measured_edf", "measured_edf",
            "color3 color=1, vector3 normal=@Nworld, filename file", "EDF",
            ClosureKind::MeasuredEdf),
    closure("ND_absorption_vdf", "absorption_vdf", "vector3 absorption=0", "VDF",
            ClosureKind::AbsorptionVdf),
    closure("ND_anisotropic_vdf", "anisotropic_vdf",
            "vector3 absorption=0, vector3 scattering=0, float anisotropy=0", "VDF",
            ClosureKind::AnisotropicVdf),
    closure("ND_layer_bsdf", "layer", "BSDF top, BSDF base", "BSDF", ClosureKind::Layer),
    // A layer of a model that says itself how much its top darkens the base.
    closure("PatinaCoat", "patina_coat", "BSDF top, BSDF base", "BSDF", ClosureKind::Layer),
    closure("ND_layer_vdf", "layer", "BSDF top, VDF base", "BSDF", ClosureKind::Layer),
    closure("ND_mix_bsdf", "mix", "BSDF fg, BSDF bg, float mix=0", "BSDF", ClosureKind::Mix),
    closure("ND_mix_edf", "mix", "EDF fg, EDF bg, float mix=0", "EDF", ClosureKind::Mix),
    closure("ND_mix_vdf", "mix", "VDF fg, VDF bg, float mix=0", "VDF", ClosureKind::Mix),
    closure("ND_mix_surfaceshader", "mix", "surfaceshader fg, surfaceshader bg, float mix=0",
            "surfaceshader", ClosureKind::Mix),
    closure("ND_mix_displacementshader", "mix",
            "displacementshader fg, displacementshader bg, float mix=0", "displacementshader",
            ClosureKind::Mix),
    closure("ND_mix_volumeshader", "mix", "volumeshader fg, volumeshader bg, float mix=0",
            "volumeshader", ClosureKind::Mix),
    closure("PatinaThinSlab", "patina_thin_slab", "BSDF in", "BSDF", ClosureKind::ThinSlab),
    closure("ND_add_bsdf", "add", "BSDF in1, BSDF in2", "BSDF", ClosureKind::Add),
    closure("ND_add_edf", "add", "EDF in1, EDF in2", "EDF", ClosureKind::Add),
    closure("ND_add_vdf", "add", "VDF in1, VDF in2", "VDF", ClosureKind::Add),
    closure("ND_multiply_bsdfC", "multiply", "BSDF in1, color3 in2=1", "BSDF",
            ClosureKind::Multiply),
    closure("ND_multiply_bsdfF", "multiply", "BSDF in1, float in2=1", "BSDF",
            ClosureKind::Multiply),
    closure("ND_multiply_edfC", "multiply", "EDF in1, color3 in2=1", "EDF", ClosureKind::Multiply),
    closure("ND_multiply_edfF", "multiply", "EDF in1, float in2=1", "EDF", ClosureKind::Multiply),
    closure("ND_multiply_vdfC", "multiply", "VDF in1, color3 in2=1", "VDF", ClosureKind::Multiply),
    closure("ND_multiply_vdfF", "multiply", "VDF in1, float in2=1", "VDF", ClosureKind::Multiply),
    closure("ND_surface", "surface", "BSDF bsdf, EDF edf, float opacity=1, boolean thin_walled=0",
            "surfaceshader", ClosureKind::Surface),
    closure("ND_surface_unlit", "surface_unlit",
            "float emission=1, color3 emission_color=1, float transmission=0, "
            "color3 transmission_color=1, float opacity=1",
            "surfaceshader", ClosureKind::SurfaceUnlit),
    closure("ND_volume", "volume", "VDF vdf, EDF edf", "volumeshader", ClosureKind::Volume),
    closure("ND_surfacematerial", "surfacematerial",
            "surfaceshader surfaceshader, surfaceshader backsurfaceshader, "
            "displacementshader displacementshader",
            "material", ClosureKind::Material),
    closure("ND_volumematerial", "volumematerial", "volumeshader volumeshader", "material",
            ClosureKind::Material),
    closure("ND_displacement_float", "displacement", "float displacement=0, float scale=1",
            "displacementshader", ClosureKind::Displacement),
    closure("ND_displacement_vector3", "displacement", "vector3 displacement=0, float scale=1",
            "displacementshader", ClosureKind::Displacement),
};

} // namespace

NodeRows closureNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
