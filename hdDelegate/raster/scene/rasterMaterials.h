// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/plan/scenePlan.h"
#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/gl/programCompiler.h"
#include "hdDelegate/raster/scene/rasterLightPlan.h"
#include "hdDelegate/raster/scene/rasterAovRequest.h"
#include "hdDelegate/raster/scene/rasterTextures.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"
#include "materialNetwork/glsl/glslMaterial.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <map>

namespace patina {

/// Programs of one text.
struct RasterPrograms {
    std::unique_ptr<GlProgram> color, aovs;
    std::unique_ptr<GlProgram> shadow; ///< only of what light may pass
    std::unique_ptr<GlProgram> tint;   ///< only of what colours the light that passes
    mutable bool drawn = false;        ///< `color` was, for which some drivers compile once more
};

/// Programs that may still be compiled.
struct PendingPrograms {
    std::atomic<bool> done{false};
    std::shared_ptr<const RasterPrograms> programs; ///< null where the driver does not take them
    std::string error;
    std::exception_ptr failure; ///< that they were not made for: no memory, say
};

/// A material on the GPU.
struct RasterMaterial {
    void bind() const; ///< its parameters and textures, for a program that is its own

    std::shared_ptr<const MaterialProgram> program;
    GlslMaterial glsl;
    std::shared_ptr<const RasterPrograms> programs; ///< displayColor's where its own do not compile
    GlBuffer parameters;
    std::vector<std::shared_ptr<const GlTexture>> textures;
    std::vector<std::string> primvars; ///< that its surfaces carry, in the shaders' order
};

/// The materials of a scene. Equal texts share a program, which stays for a while after its last
/// use; an edit of a parameter writes a buffer.
class RasterMaterials {
public:
    /// How far the programs are that a scene asks for.
    struct Ready {
        size_t ready = 0, wanted = 0;
    };

    /// @param compiler of programs; null: this thread compiles them
    explicit RasterMaterials(CompiledScene& compiled, ProgramCompiler* compiler = nullptr);

    /// Lets a material be compiled that get() will be asked for.
    void prepare(const std::string& path, const SceneState& state, const RenderSettings& settings);
    /// Waits for the programs of all materials that are in use.
    /// @param notify is called with how far they are, again and again
    void finish(const std::atomic<bool>& stop, const std::function<void(const Ready&)>& notify);
    /// The same until one more is ready, or for so long.
    void waitForMore(std::chrono::milliseconds maximum);
    Ready ready() const;
    /// Whether get() gives stand-ins for what is not ready, instead of waiting for it.
    void showStandIns(bool show) { _showStandIns = show; }
    /// How often get() has done so since update().
    size_t standIns() const { return _standIns; }

    /// @param path of a material, or empty for displayColor
    /// @param user who is told about in messages
    const RasterMaterial& get(const std::string& path, const std::string& user,
                              const SceneState& state, const RenderSettings& settings);
    /// Forgets materials whose prim has changed, and unused programs; textures stay.
    /// @param lights that materials are lit by, for how they are
    void update(const SceneState& state, const RenderSettings& settings,
                const RasterLightPlan& lights);
    /// Takes over edits of materials in between two calls of update().
    /// @returns false, and takes over nothing, where a material in use asks for other surfaces than
    /// before: with other primvars, with displacement or with light of its own
    bool edit(const SceneDelta::Paths& edited, const SceneState& state,
              const RenderSettings& settings);
    /// Whether materials in use are drawn by their own programs, and nothing stands in for them.
    bool areShown(const SceneDelta::Paths& edited) const;
    /// The outputs of programs beside light.
    const RasterAovRequest& aovs() const { return _aovs; }
    /// Methods of `domeLight` that materials have been built with since update().
    const std::set<std::string>& domeMethods() const { return _domeMethods; }
    /// Samples where domes are filtered: the most that a material asks for.
    int environmentSamples() const {
        return _environmentSamples > 0 ? _environmentSamples : standardEnvironmentSamples;
    }
    static constexpr int standardEnvironmentSamples = 16;

    size_t programsBuilt() const { return _built; }
    size_t programsKept() const { return _programs.size(); }
    /// Drops programs that nobody uses, but for `unusedPrograms` of them, those that were in use
    /// last. So the memory of a session stays bounded while networks change.
    void forgetUnused(const RenderSettings& settings);

    /// Expected cost of the methods of the materials in use.
    ScenePlan plan() const;

private:
    struct Cached {
        std::shared_ptr<const MaterialPrim> prim;
        std::map<std::string, std::string> methods;
        double tolerance = -1.0;
        RasterMaterial material;
        std::vector<PlannedMethod> light; ///< how it is lit
        std::string lighting;             ///< text in front of the lighting: methods in force
        bool filtered = false;            ///< its text knows light filters
        std::string lights;               ///< RasterLightPlan::text() before its text
        bool lit = false;                 ///< `light` is of this update
        bool built = false;               ///< its text, and its programs are asked for
        bool taken = false;               ///< its GPU objects are there
        std::shared_ptr<const PendingPrograms> pending;
        std::unique_ptr<Cached> standIn; ///< what was shown until it was taken
    };

    /// The programs of one text, and when they were last seen in use.
    struct Kept {
        std::shared_ptr<PendingPrograms> programs;
        uint64_t lastUse = 0;
        bool used() const { ///< by others than this
            return !programs->done || programs.use_count() > 1 ||
                   programs->programs.use_count() > 1;
        }
    };

    Cached& compiled(const std::string& path, const std::string& user, const SceneState& state,
                     const RenderSettings& settings);
    Cached& asked(const std::string& path, const std::string& user, const SceneState& state,
                  const RenderSettings& settings);
    /// Makes a material's text and asks for its programs, where that is not done.
    /// @param key of the material
    /// @param atOnce this thread makes them
    void ask(Cached& cached, const std::string& key, bool atOnce, const RenderSettings& settings);
    /// Makes the GPU objects of a material whose programs are done.
    /// @returns false where the driver does not take them
    bool take(Cached& cached);
    /// What is shown for a material that is not ready.
    const RasterMaterial& standIn(Cached& cached, const std::string& user, const SceneState& state,
                                  const RenderSettings& settings);
    std::shared_ptr<const PendingPrograms> build(const GlslMaterial& glsl, int primvars,
                                                 const std::string& lighting,
                                                 const std::string& user, bool atOnce);
    void await(const PendingPrograms& pending);
    /// Shows displayColor in place of a material.
    void copyDisplayColor(RasterMaterial& to, const std::string& user, const SceneState& state,
                          const RenderSettings& settings);
    /// Chooses how a material is lit. @returns whether that is new
    bool light(Cached& cached, const RenderSettings& settings);

    ProgramCompiler* _compiler;
    RasterLightPlan _lights;
    RasterAovRequest _aovs;
    bool _culls = false; ///< the camera passes faces by
    std::set<std::string> _domeMethods;
    int _environmentSamples = 0; ///< 0: nobody has said how many
    Diagnostics& _diagnostics;
    CompiledMaterials& _compiledMaterials;
    std::map<std::string, Cached> _materials;
    std::map<std::string, Kept> _programs; ///< by text
    uint64_t _turn = 0;                    ///< grows with each use of a program
    bool _showStandIns = false;
    size_t _standIns = 0;
    double _standInSeconds = 0.0; ///< taken by making stand-ins since update()
    RasterTextures _uploaded;
    size_t _built = 0;
};

} // namespace patina
