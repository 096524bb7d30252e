#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/cpu/energyCurve.h"
#include "materialNetwork/cpu/pattern.h"
#include "materialNetwork/plan/plan.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace patina {

using Register = uint16_t;

struct Instruction {
    PatternFunction function; ///< the pattern's
    const Pattern* pattern;
    Register output;
    uint32_t firstInput; ///< into ProgramCode::inputPool
    PatternData data;
};

/// Parameters of a lobe: registers in the order of lobeParameters(), and what is known at compile
/// time.
/// Methods of the choice point diffuse, in its order.
enum class DiffuseModel : uint8_t { Authored, Lambert, Qualitative, Fujii, Eon };

struct LobeTemplate {
    static constexpr int maxParameters = 10;

    BsdfLobe prebuilt; ///< set up already when constant; kind, diffuse and frame always
    bool constant = false;
    bool flagA = false; ///< retroreflective, or energy_compensation
    bool sharedInterface = false;
    bool film = false;           ///< has a thin film
    bool filmDielectric = false; ///< a dielectric with a film: LobeKind::Schlick
    bool thin = false;           ///< of a thin wall
    bool passThrough = false;    ///< passes light straight on: part of the presence
    int mode = 0;                ///< SCATTER_*
    int variant = 0;             ///< lobeVariant()
    int ndf = 0;                 ///< microfacetDistribution()
    int compensate = 1;          ///< COMPENSATE_*
    bool walks = false;          ///< between its facets, see cpu/microsurface.h
    int albedo = 0;              ///< ALBEDO_*
    int sampling = 0;            ///< SAMPLING_VNDF and others
    int fresnel = 0;             ///< FRESNEL_*
    int filmMethod = 0;          ///< FILM_*
    int sheenAlbedo = 0;         ///< SHEEN_TABLED and others
    DiffuseModel diffuse = DiffuseModel::Authored; ///< of an Oren-Nayar lobe
    EnergyCurve energy;                            ///< of constant interfaces
    Register weight = 0;
    Register parameters[maxParameters] = {};
};

/// A closure of the plan with registers for operands. Parts come before wholes.
struct ClosureOp {
    ClosureKind kind = ClosureKind::None;
    int a = -1, b = -1;
    int lobe = -1;                   ///< index of the lobe, for lobes
    bool needsTransmittance = false; ///< stands somewhere in a layer's top
    bool walked = false;             ///< a layer that is walked, see cpu/layerWalk.h
    bool beneath = false;            ///< stands somewhere in a layer's base
    bool returns = false;            ///< a layer whose top sends light back down that counts
    uint32_t lobes = 0;              ///< that are part of it, a bit each
    Register factor = 0;             ///< lobe: weight; Mix: mix; Multiply: factor; EDF: value
                                     ///< VDF: absorption
    Register scattering = 0, anisotropy = 0; ///< of an AnisotropicVdf
    /// ConicalEdf: inner and outer angle. SchlickEdf: color90 and exponent (factor is color0).
    Register first = 0, second = 0;
    int normal = -1; ///< ConicalEdf, MeasuredEdf: its own normal, -1 for that of the point
    std::shared_ptr<const EmissionProfile> profile; ///< MeasuredEdf; null emits evenly
};

struct FrameTemplate {
    int normal = -1, tangent = -1; ///< registers, -1 for the shading frame's own
    bool flips = true;             ///< turns to the viewer; false where the surface has an inside
};

/// Methods of the choice point layerTransmittance.
enum class LayerTransmittance : uint8_t { Returned, Largest, Average, Tinted };

struct ProgramCode {
    std::vector<glm::vec4> constants; ///< the first registers
    int registerCount = 0;
    std::vector<Register> inputPool;
    std::vector<Instruction> opacityCode, emissionCode, interiorCode, surfaceCode, displacementCode;

    std::vector<ClosureOp> bsdf, edf, vdf, volumeEdf; ///< the last op is the root
    std::vector<LobeTemplate> lobes;
    std::vector<FrameTemplate> frames;
    Register opacity = 0;
    Register displacement = 0, displacementScale = 0;
    bool displacementIsVector = false;
    int walkedLayers = 0;          ///< of `bsdf`
    bool hasPassThrough = false;   ///< a lobe passes light straight on
    bool slabsHaveTwoFaces = true; ///< thin walls
    LayerTransmittance layerTransmittance = LayerTransmittance::Returned;
    bool returnsLight = false;        ///< a layer of `bsdf` returns light
    bool opacityFromPrimvars = false; ///< only primvars can make opacity less than 1
    const TextureSource* textures = nullptr;
};

/// The registers of one evaluation. Small programs live on the stack.
class RegisterFile {
public:
    explicit RegisterFile(const ProgramCode& code);
    glm::vec4* data() { return _data; }
    void run(const ProgramCode& code, const std::vector<Instruction>& instructions,
             const ShadingPoint& point);

private:
    static constexpr int localCount = 192;
    glm::vec4 _local[localCount];
    glm::vec4* _data;
};

} // namespace patina
