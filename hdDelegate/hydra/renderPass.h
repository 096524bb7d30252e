// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/aovs.h"
#include "hdDelegate/hydra/delegateState.h"
#include "hdDelegate/hydra/renderBuffer.h"
#include "hdDelegate/hydra/renderProducts.h"
#include "hdDelegate/hydra/view.h"

#include <pxr/imaging/hd/renderPass.h>

#include <map>
#include <set>

namespace patina {

/// Keeps one renderer busy with the view that a host wants, and copies finished frames into the
/// host's buffers.
///
/// Executing never blocks. It starts over when scene, settings, camera, framing or bindings have
/// changed, and takes the newest frame that the renderer has finished. The pass is converged when
/// the last frame is in the buffers, even if the render failed, so hosts neither stop early nor
/// wait forever. If there are render products to write (a UsdRenderSettings prim is active and the
/// host is not interactive), it writes those instead, and the buffers keep their clear values.
class HdPatinaRenderPass final : public HdRenderPass {
public:
    HdPatinaRenderPass(HdRenderIndex* index, const HdRprimCollection& collection,
                       std::shared_ptr<HdPatinaDelegateState> state);
    ~HdPatinaRenderPass() override;

    bool IsConverged() const override;

private:
    /// A bound buffer, and what is shown in it.
    struct Target {
        TfToken aovName;
        HdPatinaShownAov shown;
        HdPatinaRenderBuffer* buffer = nullptr;
        unsigned int allocation = 0;
        VtValue clearValue;

        bool operator==(const Target& other) const;
    };

    void _Execute(const HdRenderPassStateSharedPtr& passState,
                  const TfTokenVector& renderTags) override;
    std::vector<Target> targetsOf(const HdRenderPassAovBindingVector& bindings);
    HdPatinaSettings settingsFor(const HdPatinaView& view, const TfTokenVector& renderTags) const;
    void readRenderTags();
    void show(HdPatinaFrame& frame);
    void finish();

    std::shared_ptr<HdPatinaDelegateState> _state;
    std::shared_ptr<HdPatinaSession> _session;
    HdPatinaRenderProducts _products;
    std::string _cameraPath;                        ///< of a camera of its own; no path of a stage
    std::map<TfToken, HdPatinaShownAov> _shownAovs; ///< of each name that was bound
    std::set<TfToken> _inexact;                     ///< of these: warned of

    // what the running render was started with
    std::vector<Target> _targets;
    HdPatinaView _view;
    TfTokenVector _renderTags;
    HdRprimCollection _shownCollection;
    uint64_t _sceneVersion = 0;
    unsigned int _renderTagVersion = 0;
    unsigned int _settingsVersion = 0;

    bool _hasOwnCamera = false;
    std::shared_ptr<HdPatinaFrame> _pending; ///< could not be written yet: buffers are mapped
    bool _converged = false;
};

} // namespace patina
