// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/dirtiedPrimvars.h"
#include "hdDelegate/hydra/documentNodes.h"
#include "hdDelegate/scene/scene.h"

#include <pxr/base/gf/vec2f.h>
#include <pxr/imaging/hd/renderDelegate.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace patina {

class HdPatinaInstances;

/// State that the prims of one delegate share: the renderer's scene and the changes that wait to be
/// committed. Renderers work on snapshots, so no prim ever has to stop them: sync only collects
/// changes, and CommitResources applies all of them as one edit.
class HdPatinaRenderParam final : public HdRenderParam {
public:
    HdPatinaRenderParam();
    ~HdPatinaRenderParam() override;

    const std::shared_ptr<Scene>& scene() const { return _scene; }

    /// Collects a change. Any thread.
    template <class Prim> void set(std::shared_ptr<const Prim> prim) {
        std::lock_guard<std::mutex> lock(_mutex);
        _edit.set(std::move(prim));
    }
    void removeGeometry(const std::string& path);
    void removeInstancer(const std::string& path);
    void removeLight(const std::string& path);
    void removeCamera(const std::string& path);
    void removeMaterial(const std::string& path);
    void setMetersPerUnit(double metersPerUnit);

    /// The space that colours are read into.
    const RenderingSpace& renderingSpace() const { return *_renderingSpace; }
    /// readAgain() reads all colours anew where it differs and prims were read. Host's thread.
    void setRenderingSpace(const RenderingSpace& space);
    /// @returns whether it did since the last call
    bool takeRenderingSpaceChanged() { return _renderingSpaceChanged.exchange(false); }

    /// When some camera's shutter is open: (first open, last close), in time codes relative to the
    /// frame. (0, 0) while none ever moves it.
    GfVec2f shutter() const;
    /// @returns whether that made the interval longer: readAgain() samples prims anew then
    bool widenShutter(double open, double close);
    /// AOVs tell motion: prims are sampled a frame before and after from now on, too.
    void tellMotion();
    GfVec2f cameraShutter() const; ///< shutter(), as cameras alone ask for
    bool tellsMotion() const { return _tellsMotion; }
    /// @returns whether it did since the last call
    bool takeShutterWidened() { return _shutterWidened.exchange(false); }

    /// The links of a light changed: those of all prims are to be read again. Any thread.
    void setLinksChanged() { _linksChanged = true; }
    /// @returns whether some did since the last call
    bool takeLinksChanged() { return _linksChanged.exchange(false); }

    /// A warning that names prim and input. Any thread.
    void warn(const SdfPath& prim, const std::string& input, const Message& what);

    /// Instances of rprims, gathered while prims sync.
    HdPatinaInstances& instances() { return *_instances; }

    HdPatinaDirtiedPrimvars& dirtiedPrimvars() { return _dirtiedPrimvars; }
    HdPatinaDocumentNodes& documentNodes() { return _documentNodes; }

    /// Remembers that a prim reads another: a volume a field, a light a filter. Any thread.
    void use(const SdfPath& read, const SdfPath& reader);
    /// A prim that others read changed, came or went: readAgain() asks its readers. Any thread.
    void setChanged(const SdfPath& read);
    /// @returns paths of those that read, or once did, what changed since the last call
    std::set<SdfPath> takeReadersOfChanged();

    /// Hands warnings that came up since the last call to the host, through TF_WARN. Host's thread.
    void reportWarnings();

    /// Applies what was collected as one edit. @returns whether anything changed
    bool commit();

private:
    std::shared_ptr<Scene> _scene;
    mutable std::mutex _mutex;
    SceneEdit _edit;
    std::unique_ptr<HdPatinaInstances> _instances;
    HdPatinaDirtiedPrimvars _dirtiedPrimvars;
    HdPatinaDocumentNodes _documentNodes;
    GfVec2f _shutter{0.0f}, _cameraShutter{0.0f};
    std::atomic<const RenderingSpace*> _renderingSpace{&RenderingSpace::rec709()};
    std::atomic<bool> _shutterWidened{false}, _linksChanged{false}, _renderingSpaceChanged{false};
    std::atomic<bool> _tellsMotion{false};
    std::map<SdfPath, std::set<SdfPath>> _readers; ///< by what they read
    std::set<SdfPath> _changed;                    ///< of what is read
    size_t _reported = 0;                          ///< diagnostics that the host was told
};

} // namespace patina
