#include "hdDelegate/raster/rasterMaterials.h"

#include "hdDelegate/raster/deviceError.h"
#include "hdDelegate/raster/glFaults.h"
#include "materialNetwork/material.h"

namespace patina {

namespace {

/// Methods as the planner may use them here: random walks are the path tracer's, so that the errors
/// of what stands in for them are counted.
MethodChoices drawable(MethodChoices methods, double tolerance) {
    if (tolerance < 0.0) return methods;
    for (const char* point : {"energyCompensation", "layering"})
        methods.emplace(point, chosenMethod({}, point));
    return methods;
}

} // namespace

RasterMaterials::RasterMaterials(Diagnostics& diagnostics)
    : _diagnostics(diagnostics), _textures(diagnostics), _uploaded(_textures, diagnostics) {}

void RasterMaterials::update(const SceneState& state, const RenderSettings& settings) {
    // Text that the default method does not need is kept from the driver: compiling it takes long.
    const std::string method = chosenMethod(settings.methods, "domeLight");
    _lighting = method == "filtered"      ? "#define DOME_METHOD DOME_FILTERED\n"
                : method == "prefiltered" ? "#define DOME_METHOD DOME_PREFILTERED\n"
                : method == "harmonics" || method == "harmonicsUnwindowed"
                    ? "#define DOME_METHOD DOME_HARMONICS\n"
                    : "";
    if (chosenMethod(settings.methods, "areaLight") == "linearlyTransformedCosines")
        _lighting += "#define AREA_OUTLINES\n";
    for (auto it = _materials.begin(); it != _materials.end();) {
        const auto found = state.materials.find(it->first);
        const auto now = found != state.materials.end() && settings.enableSceneMaterials
                             ? found->second
                             : nullptr;
        it = it->second.prim == now && it->second.methods == settings.methods &&
                     it->second.tolerance == settings.tolerance
                 ? std::next(it)
                 : _materials.erase(it);
    }
}

const RasterMaterial& RasterMaterials::get(const std::string& path, const std::string& user,
                                           const SceneState& state,
                                           const RenderSettings& settings) {
    std::shared_ptr<const MaterialPrim> prim;
    if (!path.empty() && settings.enableSceneMaterials) {
        const auto found = state.materials.find(path);
        if (found != state.materials.end())
            prim = found->second;
        else
            _diagnostics.warn(user, "material:binding",
                              "material " + path + " does not exist; displayColor is shown");
    }
    const std::string key = prim ? path : std::string();
    const auto known = _materials.find(key);
    if (known != _materials.end()) return known->second.material;
    Cached& cached = _materials[key];
    cached.prim = prim;
    cached.methods = settings.methods;
    cached.tolerance = settings.tolerance;
    RasterMaterial& m = cached.material;
    m.program = compileMaterial(
        prim && !prim->network.empty() ? prim->network : makeDisplayColorNetwork(), _textures,
        _diagnostics, drawable(settings.methods, settings.tolerance), settings.tolerance);
    m.glsl = makeGlslMaterial(*m.program);
    for (const std::string& line : m.glsl.leftOut)
        _diagnostics.warn(key, "", line);
    m.programs = build(m.glsl, int(m.program->primvars().size()), key);
    if (!m.programs && key.empty())
        throw DeviceError("the driver does not take the shader of displayColor");
    if (!m.programs) {
        const RasterMaterial& shown = get(std::string(), user, state, settings);
        m.program = shown.program;
        m.glsl = shown.glsl;
        m.programs = shown.programs;
    }
    m.parameters = GlBuffer(m.glsl.parameters);
    m.textures = _uploaded.units(m.glsl.textures);
    return m;
}

ScenePlan RasterMaterials::plan() const {
    ScenePlan plan;
    for (const auto& item : _materials)
        plan.add(item.first, withoutWalks(item.second.material.program->planned()));
    return plan;
}

std::shared_ptr<const RasterPrograms> RasterMaterials::build(const GlslMaterial& glsl, int primvars,
                                                             const std::string& user) {
    const bool faulty = !user.empty() && glFault("material") == user;
    const std::string head = "#define PRIMVARS " + std::to_string(primvars) + "\n" +
                             (glsl.presence ? "#define PRESENCE\n" : "") +
                             "#define MATERIAL_GLOWS " + (glsl.emission ? "true\n" : "false\n") +
                             (glsl.transmits ? "#define MATERIAL_TRANSMITS\n" : "") +
                             (glsl.holds ? "#define MATERIAL_HOLDS\n" : "") +
                             (glsl.volumeOnly ? "#define MATERIAL_IS_VOLUME\n" : "") +
                             (glsl.fibre ? "#define MATERIAL_IS_FIBRE\n" : "") +
                             "#define MATERIAL_IS_THIN " + (glsl.thin ? "true\n" : "false\n");
    auto& shared = _programs[head + _lighting + glsl.text + (faulty ? "faulty" : "")];
    if (shared) return shared;
    const GlStage vertex{GL_VERTEX_SHADER, "surface",
                         head + "#include \"shaders/raster/surface.vert.glsl\"\n"};
    const std::string surface = head +
                                "#include \"shaders/raster/material.glsl\"\n"
                                "#include \"shaders/raster/pass.glsl\"\n" +
                                glsl.text + "#include \"shaders/raster/surface.frag.glsl\"\n" +
                                (faulty ? "#error asked for by PATINA_GL_FAULT\n" : "");
    auto programs = std::make_shared<RasterPrograms>();
    std::string error;
    programs->color =
        GlProgram::make({vertex,
                         {GL_FRAGMENT_SHADER, "material",
                          surface + _lighting + (_lighting.empty() ? "" : glsl.traitsText) +
                              "#include \"shaders/raster/lighting.frag.glsl\"\n"}},
                        error);
    if (programs->color)
        programs->aovs =
            GlProgram::make({vertex,
                             {GL_FRAGMENT_SHADER, "material",
                              surface + "#include \"shaders/raster/aovs.frag.glsl\"\n"}},
                            error);
    if (programs->aovs && glsl.presence)
        programs->shadow = GlProgram::make(
            {{GL_VERTEX_SHADER, "shadow",
              "#define SHADOW\n" + head + "#include \"shaders/raster/surface.vert.glsl\"\n"},
             {GL_FRAGMENT_SHADER, "material",
              surface + "#include \"shaders/raster/presence.frag.glsl\"\n"}},
            error);
    if (programs->shadow && glsl.tints)
        programs->tint =
            GlProgram::make({vertex,
                             {GL_FRAGMENT_SHADER, "material",
                              surface + "#include \"shaders/raster/tint.frag.glsl\"\n"}},
                            error);
    ++_built;
    if (!programs->aovs || (glsl.presence && !programs->shadow) ||
        (glsl.tints && glsl.presence && !programs->tint)) {
        _diagnostics.warn(user, "",
                          "the driver does not take the material's shader; displayColor is "
                          "shown: " +
                              oneLine(error));
        return nullptr;
    }
    return shared = programs;
}

} // namespace patina
