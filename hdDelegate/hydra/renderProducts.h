// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/delegateState.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Writes the products of the active UsdRenderSettings prim, one after the other, in the
/// background. Each has its own camera, resolution, conform policy, data window and render vars.
///
/// Products of type `raster` are images, those of type `deepRaster` deep ones. The source of a
/// render var is an AOV of the film (named as in Hydra or the film, `Ci`, `a` and `z` included), or
/// with sourceType primvar a primvar. A file appears whole, or the earlier file stays.
class HdPatinaRenderProducts {
public:
    explicit HdPatinaRenderProducts(HdPatinaDelegateState& state);
    ~HdPatinaRenderProducts();

    /// Whether there is something to write: the host is not interactive and a settings prim with
    /// products is active.
    bool wanted() const;
    /// Of the film, of all products that are wanted.
    std::vector<std::string> aovs() const;
    /// Starts over when scene or settings have changed, goes on otherwise. Never blocks on a
    /// render.
    /// @returns whether all products are written (or have failed, with a warning)
    bool update();

private:
    struct Output {
        SdfPath path;     ///< of the product
        std::string file; ///< to write
        std::string camera;
        HdPatinaSettings settings;
        std::vector<std::string> order; ///< AOVs of the file; of a deep one none
    };

    bool prepare(const HdRenderSettings::RenderProduct& product, Output& output);
    void startNext();
    void write(const Output& output);

    HdPatinaDelegateState& _state;
    std::shared_ptr<HdPatinaSession> _session;
    HdRenderSettings::RenderProducts _known;
    std::vector<Output> _outputs;
    size_t _next = 0;      ///< output that renders, or the number of outputs
    bool _started = false; ///< _known are those that are written
    uint64_t _sceneVersion = 0;
    unsigned int _settingsVersion = 0;
};

} // namespace patina
