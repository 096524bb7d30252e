// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledMaterials.h"
#include "hdDelegate/compiled/madeOnce.h"
#include "hdDelegate/image/volumeMedium.h"

namespace patina {

/// The media of a scene's volume prims, made once for all who ask for the same. Thread safe.
class CompiledVolumes {
public:
    CompiledVolumes(CompiledMaterials& materials, Diagnostics& diagnostics)
        : _materials(materials), _diagnostics(diagnostics) {}

    /// The medium of a prim with the material that it is bound to; a grey one where that is none,
    /// or no volume.
    std::shared_ptr<const VolumeMedium> medium(const std::shared_ptr<const Volume>& prim,
                                               const SceneState& state,
                                               const RenderSettings& settings);
    size_t made() const { return _media.count(); } ///< since this was made

private:
    struct Request {
        std::shared_ptr<const Volume> prim;
        std::shared_ptr<const MaterialProgram> program;
    };
    struct Key {
        Reference<const Volume> prim;
        Reference<const MaterialProgram> program;
        Key(const Request& request) : prim(request.prim), program(request.program) {}
        bool isOf(const Request& request) const {
            return prim.is(request.prim) && program.is(request.program);
        }
    };
    std::shared_ptr<const MaterialProgram> plain();

    CompiledMaterials& _materials;
    Diagnostics& _diagnostics;
    FieldGrids _grids;
    MadeOnce<Request, Key, VolumeMedium> _media;
    std::once_flag _plainMade;
    std::shared_ptr<const MaterialProgram> _plain;
};

} // namespace patina
