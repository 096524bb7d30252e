// Closures: BSDF, EDF and VDF nodes, their combiners, and the shaders made of them.
#include "materialNetwork/nodeTable.h"

namespace patina {

namespace {

constexpr NodeRow closure(const char* id, const char* category, const char* inputs,
                          const char* outputs, ClosureKind kind, const char* types = nullptr) {
    return {id, category, inputs, outputs, nullptr, Algebra::None, types, nullptr, false, kind};
}

#define PATINA_MICROFACET                                                                          \
    "vector2 roughness=0.05, boolean retroreflective=0, float thinfilm_thickness=0, "              \
    "float thinfilm_ior=1.5, vector3 normal=@Nworld, vector3 tangent=@Tworld, "                    \
    "string distribution=ggx"

const NodeRow rows[] = {
    closure("ND_oren_nayar_diffuse_bsdf", "oren_nayar_diffuse_bsdf",
            "float weight=1, color3 color=0.18, float roughness=0, vector3 normal=@Nworld, "
            "boolean energy_compensation=0",
            "BSDF", ClosureKind::OrenNayar),
    closure("ND_burley_diffuse_bsdf", "burley_diffuse_bsdf",
            "float weight=1, color3 color=0.18, float roughness=0, vector3 normal=@Nworld", "BSDF",
            ClosureKind::Burley),
    closure("ND_translucent_bsdf", "translucent_bsdf",
            "float weight=1, color3 color=1, vector3 normal=@Nworld", "BSDF",
            ClosureKind::Translucent),
    closure("ND_dielectric_bsdf", "dielectric_bsdf",
            "float weight=1, color3 tint=1, float ior=1.5, " PATINA_MICROFACET
            ", string scatter_mode=R",
            "BSDF", ClosureKind::Dielectric),
    // The talk's name for the transmitting half.
    closure("ND_dielectric_btdf", "dielectric_btdf",
            "float weight=1, color3 tint=1, float ior=1.5, " PATINA_MICROFACET
            ", string scatter_mode=T",
            "BSDF", ClosureKind::Dielectric),
    closure("ND_conductor_bsdf", "conductor_bsdf",
            "float weight=1, color3 ior=0.183 0.421 1.373, "
            "color3 extinction=3.424 2.346 1.770, " PATINA_MICROFACET,
            "BSDF", ClosureKind::Conductor),
    closure("ND_generalized_schlick_bsdf", "generalized_schlick_bsdf",
            "float weight=1, color3 color0=1, color3 color82=1, color3 color90=1, "
            "float exponent=5, " PATINA_MICROFACET ", string scatter_mode=R",
            "BSDF", ClosureKind::Schlick),
    closure("ND_subsurface_bsdf", "subsurface_bsdf",
            "float weight=1, color3 color=0.18, color3 radius=1, float anisotropy=0, "
            "vector3 normal=@Nworld",
            "BSDF", ClosureKind::Subsurface),
    closure("ND_sheen_bsdf", "sheen_bsdf",
            "float weight=1, color3 color=1, float roughness=0.3, vector3 normal=@Nworld, "
            "string mode=conty_kulla",
            "BSDF", ClosureKind::Sheen),
    // The classic BRDFs. exponent and roughness are those of each paper.
    closure("ND_patina_lambert_bsdf", "patina_lambert_bsdf",
            "float weight=1, color3 color=0.18, vector3 normal=@Nworld", "BSDF",
            ClosureKind::OrenNayar),
    closure("ND_patina_phong_bsdf", "patina_phong_bsdf",
            "float weight=1, color3 color=1, float exponent=32, vector3 normal=@Nworld", "BSDF",
            ClosureKind::Phong),
    closure("ND_patina_blinn_phong_bsdf", "patina_blinn_phong_bsdf",
            "float weight=1, color3 color=1, float exponent=128, vector3 normal=@Nworld", "BSDF",
            ClosureKind::BlinnPhong),
    closure("ND_patina_ward_bsdf", "patina_ward_bsdf",
            "float weight=1, color3 color=1, vector2 roughness=0.2, vector3 normal=@Nworld, "
            "vector3 tangent=@Tworld, string form=bounded",
            "BSDF", ClosureKind::Ward),
    closure("ND_patina_cook_torrance_bsdf", "patina_cook_torrance_bsdf",
            "float weight=1, color3 color=1, color3 ior=2.911 2.950 2.590, "
            "color3 extinction=3.089 2.930 2.770, float roughness=0.2, vector3 normal=@Nworld, "
            "string fresnel=exact",
            "BSDF", ClosureKind::CookTorrance),
    closure("ND_chiang_hair_bsdf", "chiang_hair_bsdf",
            "color3 tint_R=1, color3 tint_TT=1, color3 tint_TRT=1, float ior=1.55, "
            "vector2 roughness_R=0.1, vector2 roughness_TT=0.05, vector2 roughness_TRT=0.2, "
            "float cuticle_angle=0.5, vector3 absorption_coefficient=0, vector3 normal=@Nworld, "
            "vector3 curve_direction=@Tworld",
            "BSDF", ClosureKind::ChiangHair),
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
    closure("PatinaThinWall", "patina_thin_wall", "BSDF in", "BSDF", ClosureKind::ThinWall),
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
