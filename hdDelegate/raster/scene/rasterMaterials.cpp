// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterMaterials.h"

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/gl/glFaults.h"
#include "materialNetwork/material.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <thread>

namespace patina {

namespace {

/// Methods as the planner may use them here: random walks are the path tracer's, so that the errors
/// of what stands in for them are counted.
MethodChoices drawable(MethodChoices methods, double tolerance) {
    if (tolerance < 0.0) return methods;
    for (const ChoicePoint& point : choicePoints())
        if (std::any_of(point.methods.begin(), point.methods.end(),
                        [](const Method& m) { return m.walks; }))
            methods.emplace(point.name, chosenMethod({}, point.name));
    return methods;
}

const std::string standInKey = "/standIn"; ///< in place of a path
/// For textured stand-ins of one update; what is not done by then shows displayColor.
constexpr double mostStandInSeconds = 0.2;

/// Text that the default methods do not need is kept from the driver: compiling it takes long.
std::string lightingText(const std::string& dome, const std::string& area) {
    const std::string text = dome == "filtered"      ? "#define DOME_METHOD DOME_FILTERED\n"
                             : dome == "prefiltered" ? "#define DOME_METHOD DOME_PREFILTERED\n"
                             : dome == "harmonics"   ? "#define DOME_METHOD DOME_HARMONICS\n"
                                                     : "";
    return text + (area == "linearlyTransformedCosines" ? "#define AREA_OUTLINES\n" : "");
}

} // namespace

void RasterMaterial::bind() const {
    parameters.bindUniform(1);
    for (size_t i = 0; i < textures.size(); ++i)
        textures[i]->bind(GLuint(i));
}

RasterMaterials::RasterMaterials(CompiledScene& compiled, ProgramCompiler* compiler)
    : _compiler(compiler), _diagnostics(compiled.scene()->diagnostics()),
      _compiledMaterials(compiled.materials()), _uploaded(compiled.textures(), _diagnostics) {}

void RasterMaterials::forgetUnused(const RenderSettings& settings) {
    ++_turn;
    using Place = decltype(_programs)::iterator;
    std::vector<Place> unused;
    for (Place it = _programs.begin(); it != _programs.end(); ++it)
        if (it->second.used())
            it->second.lastUse = _turn;
        else
            unused.push_back(it);
    const size_t most = size_t(std::max(settings.unusedPrograms, 0));
    if (unused.size() <= most) return;
    const auto kept = unused.end() - std::ptrdiff_t(most);
    std::nth_element(unused.begin(), kept - 1, unused.end(),
                     [](Place a, Place b) { return a->second.lastUse < b->second.lastUse; });
    for (auto it = unused.begin(); it != kept; ++it)
        _programs.erase(*it);
}

void RasterMaterials::update(const SceneState& state, const RenderSettings& settings,
                             const RasterLightPlan& lights) {
    forgetUnused(settings);
    _lights = lights;
    const bool culls = settings.cullStyle != "nothing";
    if (const RasterAovRequest aovs(settings.aovs); !(aovs == _aovs) || culls != _culls) {
        _aovs = aovs;
        _culls = culls;
        _materials.clear();
        for (const std::string& name : _aovs.leftOut)
            _diagnostics.warn("", "", messages::primvarAovEmpty(name, _aovs.room()));
    }
    _domeMethods.clear();
    _standIns = 0;
    _standInSeconds = 0.0;
    _environmentSamples = std::max(settings.environmentSamples, 0);
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
    for (auto& item : _materials) {
        item.second.lit = false;
        if (item.second.taken) item.second.standIn.reset();
        if (item.second.standIn) item.second.standIn->lit = false;
    }
}

bool RasterMaterials::edit(const SceneDelta::Paths& edited, const SceneState& state,
                           const RenderSettings& settings) {
    std::vector<std::shared_ptr<const MaterialProgram>> held; // until compiled() asks again
    for (const auto& item : edited) {
        const auto known = _materials.find(item.first);
        if (known == _materials.end()) continue;
        const auto prim = _compiledMaterials.find(item.first, std::string(), state, settings);
        if (!prim) return false;
        held.push_back(_compiledMaterials.program(
            prim, drawable(settings.methods, settings.tolerance), settings.tolerance));
        const MaterialProgram &now = *held.back(), &before = *known->second.material.program;
        const auto special = [](const MaterialProgram& program) {
            return program.hasEmission() || program.hasDisplacement();
        };
        if (special(now) || special(before) || now.tangentSet() != before.tangentSet() ||
            !std::equal(now.primvars().begin(), now.primvars().end(), before.primvars().begin(),
                        before.primvars().end(),
                        [](const auto& a, const auto& b) { return a.name == b.name; }))
            return false;
    }
    for (const auto& item : edited)
        if (_materials.erase(item.first) > 0) asked(item.first, std::string(), state, settings);
    forgetUnused(settings);
    return true;
}

bool RasterMaterials::areShown(const SceneDelta::Paths& edited) const {
    return std::all_of(edited.begin(), edited.end(), [&](const auto& item) {
        const auto known = _materials.find(item.first);
        return known == _materials.end() ||
               (known->second.pending->done && known->second.pending->programs);
    });
}

RasterMaterials::Cached& RasterMaterials::compiled(const std::string& path, const std::string& user,
                                                   const SceneState& state,
                                                   const RenderSettings& settings) {
    const auto prim = _compiledMaterials.find(path, user, state, settings);
    const std::string key = prim ? path : std::string();
    const auto known = _materials.find(key);
    if (known != _materials.end()) return known->second;
    Cached& cached = _materials[key];
    cached.prim = prim;
    cached.methods = settings.methods;
    cached.tolerance = settings.tolerance;
    cached.material.program = _compiledMaterials.program(
        prim, drawable(settings.methods, settings.tolerance), settings.tolerance);
    return cached;
}

RasterMaterials::Cached& RasterMaterials::asked(const std::string& path, const std::string& user,
                                                const SceneState& state,
                                                const RenderSettings& settings) {
    Cached& cached = compiled(path, user, state, settings);
    ask(cached, cached.prim ? path : std::string(), !cached.prim, settings);
    return cached;
}

void RasterMaterials::ask(Cached& cached, const std::string& key, bool atOnce,
                          const RenderSettings& settings) {
    RasterMaterial& m = cached.material;
    const bool first = !cached.built;
    if (first) m.glsl = makeGlslMaterial(m.program->ir());
    const bool relit = !cached.lit && light(cached, settings);
    if (!first && !relit) return;
    cached.built = true;
    cached.taken = false;
    if (first)
        for (const Message& what : m.glsl.leftOut)
            _diagnostics.warn(key, "", what);
    std::vector<std::string> primvars;
    for (const MaterialPrimvar& p : m.program->primvars())
        primvars.push_back(p.name);
    m.primvars = _aovs.with(primvars);
    cached.pending = build(m.glsl, int(m.primvars.size()), cached.lighting, key, atOnce);
}

void RasterMaterials::prepare(const std::string& path, const SceneState& state,
                              const RenderSettings& settings) {
    if (path.empty() || state.materials.count(path) > 0)
        asked(path, std::string(), state, settings);
}

void RasterMaterials::copyDisplayColor(RasterMaterial& to, const std::string& user,
                                       const SceneState& state, const RenderSettings& settings) {
    const RasterMaterial& shown = get(std::string(), user, state, settings);
    to.program = shown.program;
    to.glsl = shown.glsl;
    to.programs = shown.programs;
    to.primvars = shown.primvars;
    to.parameters = GlBuffer(to.glsl.parameters);
    to.textures = _uploaded.units(to.glsl.textures);
}

const RasterMaterial& RasterMaterials::get(const std::string& path, const std::string& user,
                                           const SceneState& state,
                                           const RenderSettings& settings) {
    Cached& cached = asked(path, user, state, settings);
    if (cached.taken) return cached.material;
    const std::string key = cached.prim ? path : std::string();
    if (!cached.pending->done && _showStandIns && !key.empty())
        return standIn(cached, user, state, settings);
    if (take(cached)) return cached.material;
    if (key.empty()) throw DeviceError("the driver does not take the shader of displayColor");
    _diagnostics.warn(key, "", messages::shaderRefused(cached.pending->error));
    copyDisplayColor(cached.material, user, state, settings);
    return cached.material;
}

const RasterMaterial& RasterMaterials::standIn(Cached& cached, const std::string& user,
                                               const SceneState& state,
                                               const RenderSettings& settings) {
    ++_standIns;
    const MaterialProgram& program = *cached.material.program;
    if (!cached.standIn) {
        // Textures are read for it, which may take long. Of UDIM sets no tile is known to be there.
        const auto tiled = [](const GlslTexture& texture) { return !texture.tiles.empty(); };
        const std::vector<GlslTexture>& textures = cached.material.glsl.textures;
        if (!hasStandIn(program) || (!textures.empty() && _standInSeconds > mostStandInSeconds) ||
            std::any_of(textures.begin(), textures.end(), tiled))
            return get(std::string(), user, state, settings);
        const auto start = std::chrono::steady_clock::now();
        auto made = std::make_unique<Cached>();
        made->material.program = _compiledMaterials.compile(makeStandInNetwork(program));
        cached.standIn = std::move(made);
        _standInSeconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    ask(*cached.standIn, standInKey, true, settings);
    if (!cached.standIn->taken && !take(*cached.standIn))
        copyDisplayColor(cached.standIn->material, user, state, settings);
    return cached.standIn->material;
}

bool RasterMaterials::take(Cached& cached) {
    if (cached.taken) return true;
    await(*cached.pending);
    if (cached.pending->failure) std::rethrow_exception(cached.pending->failure);
    cached.taken = true;
    RasterMaterial& m = cached.material;
    m.programs = cached.pending->programs;
    if (!m.programs) {
        throwIfLost();
        return false;
    }
    m.parameters = GlBuffer(m.glsl.parameters);
    m.textures = _uploaded.units(m.glsl.textures);
    return true;
}

void RasterMaterials::await(const PendingPrograms& pending) {
    while (!pending.done)
        if (!_compiler->help()) _compiler->wait(std::chrono::milliseconds(50));
}

RasterMaterials::Ready RasterMaterials::ready() const {
    std::set<const PendingPrograms*> wanted;
    for (const auto& item : _materials)
        if (item.second.pending) wanted.insert(item.second.pending.get());
    Ready count;
    count.wanted = wanted.size();
    for (const PendingPrograms* pending : wanted)
        count.ready += pending->done ? 1 : 0;
    return count;
}

void RasterMaterials::finish(const std::atomic<bool>& stop,
                             const std::function<void(const Ready&)>& notify) {
    while (!stop) {
        const Ready now = ready();
        if (notify) notify(now);
        if (now.ready == now.wanted) return;
        if (!_compiler->help()) _compiler->wait(std::chrono::milliseconds(50));
    }
}

void RasterMaterials::waitForMore(std::chrono::milliseconds maximum) {
    if (_compiler->hasThreads() || !_compiler->help()) _compiler->wait(maximum);
}

bool RasterMaterials::light(Cached& cached, const RenderSettings& settings) {
    cached.lit = true;
    cached.light =
        _lights.choose(withoutWalks(cached.material.program->planned()), settings,
                       cached.material.glsl.transmits || cached.material.glsl.hasInterior);
    std::string dome = chosenMethod(settings.methods, "domeLight");
    std::string area = chosenMethod(settings.methods, "areaLight");
    for (const PlannedMethod& m : cached.light) {
        if (m.point == "domeLight") dome = m.method;
        if (m.point == "areaLight") area = m.method;
        if (m.point == "environmentSamples")
            _environmentSamples = std::max(_environmentSamples, std::atoi(m.method.c_str()));
    }
    _domeMethods.insert(dome);
    const std::string text = lightingText(dome, area);
    const bool changed = text != cached.lighting || cached.filtered != _lights.needsFilters() ||
                         cached.lights != _lights.text();
    cached.lighting = text;
    cached.filtered = _lights.needsFilters();
    cached.lights = _lights.text();
    return changed;
}

ScenePlan RasterMaterials::plan() const {
    ScenePlan plan;
    for (const auto& item : _materials) {
        MethodPlan material = withoutWalks(item.second.material.program->planned());
        for (const PlannedMethod& m : item.second.light) {
            material.error += m.error;
            material.choices.push_back(m);
        }
        plan.add(item.first, material);
    }
    return plan;
}

namespace {

/// The texts of a material's programs, for any thread with a context.
struct ProgramTexts {
    GlStage vertex, color, aovs, shadowVertex, shadow, tint;
    bool lets = false, hasColoredPresence = false; ///< light may pass; and is coloured
};

std::shared_ptr<const RasterPrograms> makePrograms(const ProgramTexts& texts, std::string& error) {
    auto programs = std::make_shared<RasterPrograms>();
    programs->color = GlProgram::make({texts.vertex, texts.color}, error);
    if (programs->color) programs->aovs = GlProgram::make({texts.vertex, texts.aovs}, error);
    if (!programs->aovs) return nullptr;
    if (texts.lets) {
        programs->shadow = GlProgram::make({texts.shadowVertex, texts.shadow}, error);
        if (!programs->shadow) return nullptr;
    }
    if (texts.hasColoredPresence) {
        programs->tint = GlProgram::make({texts.vertex, texts.tint}, error);
        if (!programs->tint) return nullptr;
    }
    return programs;
}

} // namespace

std::shared_ptr<const PendingPrograms>
RasterMaterials::build(const GlslMaterial& glsl, int primvars, const std::string& lighting,
                       const std::string& user, bool atOnce) {
    const bool faulty = !user.empty() && glFault("material") == user;
    const std::string head =
        "#define PRIMVARS " + std::to_string(primvars) + "\n" +
        (_lights.needsFilters() ? "#define LIGHT_FILTERS\n" : "") +
        (glsl.presence ? "#define PRESENCE\n" : "") + (_culls ? "#define CULLS\n" : "") +
        "#define MATERIAL_GLOWS " + (glsl.emission ? "true\n" : "false\n") +
        (glsl.transmits ? "#define MATERIAL_TRANSMITS\n" : "") +
        (glsl.hasInterior ? "#define MATERIAL_HAS_INTERIOR\n" : "") +
        (glsl.volumeOnly ? "#define MATERIAL_IS_VOLUME\n" : "") +
        (glsl.fibre ? "#define MATERIAL_IS_FIBRE\n" : "") + "#define MATERIAL_IS_THIN " +
        (glsl.thin ? "true\n" : "false\n") + glsl.definitions;
    const std::string aovs = _aovs.text();
    const std::string lights = _lights.text();
    std::string key = lights + head + lighting + aovs + glsl.text + (faulty ? "faulty" : "");
    // What waits in the queue of the compiler is not waited for.
    const auto known = atOnce ? _programs.find(key) : _programs.end();
    if (known != _programs.end() && !known->second.programs->done) key += "at once";
    Kept& kept = _programs[key];
    kept.lastUse = ++_turn;
    std::shared_ptr<PendingPrograms>& shared = kept.programs;
    if (shared) return shared;
    ++_built;
    const std::string surface = head +
                                "#include \"shaders/raster/material.glsl\"\n"
                                "#include \"shaders/raster/pass.glsl\"\n" +
                                glsl.text + "#include \"shaders/raster/surface.frag.glsl\"\n" +
                                (faulty ? "#error asked for by PATINA_GL_FAULT\n" : "");
    const auto fragment = [&](const std::string& more) {
        return GlStage{GL_FRAGMENT_SHADER, "material", surface + more};
    };
    ProgramTexts texts;
    texts.vertex = {GL_VERTEX_SHADER, "surface",
                    head + "#include \"shaders/raster/surface.vert.glsl\"\n"};
    texts.color = fragment(lighting + (lighting.empty() ? "" : glsl.traitsText) +
                           "#include \"shaders/raster/lighting.frag.glsl\"\n");
    texts.color.text = lights + texts.color.text;
    texts.aovs = fragment(aovs + (_aovs.albedo ? glsl.albedoText : std::string()) +
                          "#include \"shaders/raster/aovs.frag.glsl\"\n");
    texts.shadowVertex = {GL_VERTEX_SHADER, "shadow",
                          "#define SHADOW\n" + head +
                              "#include \"shaders/raster/surface.vert.glsl\"\n"};
    texts.shadow = fragment((glsl.passesText.empty() ? "" : "#define MATERIAL_PASSES\n") +
                            glsl.passesText + "#include \"shaders/raster/presence.frag.glsl\"\n");
    texts.tint = fragment("#include \"shaders/raster/tint.frag.glsl\"\n");
    texts.lets = glsl.presence || !glsl.passesText.empty();
    texts.hasColoredPresence = glsl.presence && glsl.hasColoredPresence;
    shared = std::make_shared<PendingPrograms>();
    const auto make = [pending = shared, texts = std::move(texts)] {
        if (const std::string slow = glFault("compiling"); !slow.empty())
            std::this_thread::sleep_for(std::chrono::milliseconds(std::atoi(slow.c_str())));
        try {
            std::string error;
            pending->programs = makePrograms(texts, error);
            if (!pending->programs) pending->error = oneLine(error);
        } catch (...) { // for the render's thread
            pending->failure = std::current_exception();
        }
        pending->done = true;
    };
    // displayColor and what stands in for others are shown at once.
    if (_compiler && !atOnce)
        _compiler->add(make);
    else
        make();
    return shared;
}

} // namespace patina
