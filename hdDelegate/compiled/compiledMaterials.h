// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/madeOnce.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"
#include "materialNetwork/material.h"

#include <atomic>

namespace patina {

/// The programs of a scene's materials, each compiled once for all who ask for it. Thread safe.
class CompiledMaterials {
public:
    CompiledMaterials(TextureSource& textures, Diagnostics& diagnostics)
        : _textures(textures), _diagnostics(diagnostics) {}

    /// The material that a prim is bound to.
    /// @param path empty: none is bound
    /// @param user the prim, which is named where there is no such material
    /// @returns null where displayColor is shown
    std::shared_ptr<const MaterialPrim> find(const std::string& path, const std::string& user,
                                             const SceneState& state,
                                             const RenderSettings& settings) const;

    /// Its program, which is kept for as long as anybody holds it.
    /// @param prim null: displayColor
    /// @param methods, tolerance as compileMaterial() takes them
    std::shared_ptr<const MaterialProgram> program(const std::shared_ptr<const MaterialPrim>& prim,
                                                   const MethodChoices& methods, double tolerance);
    /// Warns of the coordinate systems that a material names and its prim has not.
    void tellOfSpaces(const MaterialProgram& program, const Geometry& prim) const;

    /// The space of colours, for programs that are asked for from now on.
    void setRenderingSpace(const RenderingSpace& space) { _renderingSpace = &space; }

    /// The program of what is no material of the scene.
    std::shared_ptr<const MaterialProgram> compile(const Network& network) const {
        return compileMaterial(network, _textures, _diagnostics, {}, -1.0, *_renderingSpace);
    }

    size_t programsBuilt() const { return _programs.count(); } ///< since this was made

private:
    struct Request {
        std::shared_ptr<const MaterialPrim> prim;
        const MethodChoices& methods;
        double tolerance;
        const RenderingSpace* space;
    };
    struct Key {
        Reference<const MaterialPrim> prim;
        MethodChoices methods;
        double tolerance;
        const RenderingSpace* space;
        Key(const Request& request)
            : prim(request.prim), methods(request.methods), tolerance(request.tolerance),
              space(request.space) {}
        bool isOf(const Request& request) const {
            return prim.is(request.prim) && methods == request.methods &&
                   tolerance == request.tolerance && space == request.space;
        }
    };

    TextureSource& _textures;
    Diagnostics& _diagnostics;
    std::atomic<const RenderingSpace*> _renderingSpace{&RenderingSpace::rec709()};
    MadeOnce<Request, Key, MaterialProgram> _programs;
};

} // namespace patina
