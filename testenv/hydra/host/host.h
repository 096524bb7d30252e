// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/host/pixels.h"
#include "testenv/hydra/host/renderTask.h"
#include "testenv/hydra/host/sceneInput.h"

#include <pxr/imaging/hd/engine.h>
#include <pxr/imaging/hd/pluginRenderDelegateUniqueHandle.h>
#include <pxr/imaging/hd/renderDelegate.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/usd/usd/stage.h>

#include <memory>
#include <string>
#include <vector>

namespace patina {

class HostBuffers;

/// An output that is asked for.
struct HostAov {
    std::string name = "color";
    HdFormat format = HdFormatInvalid; ///< invalid: the delegate's own, for color 32-bit floats
};

struct HostOptions {
    std::string renderer = "HdPatinaRendererPlugin"; ///< plugin id
    bool sceneIndex = false;                         ///< UsdImaging's scene indices as input
    HdRenderSettingsMap settings;
    int width = 64, height = 64; ///< pixels; zero is allowed
    SdfPath camera;
    UsdTimeCode time = UsdTimeCode::Default();
    int refineLevel = 0; ///< 0 to 8
    std::vector<std::string> purposes = {"default", "render"};
    std::vector<HostAov> aovs = {HostAov()};
    std::string instanceName; ///< of the render index
};

/// A Hydra host without windows and graphics APIs: one stage, one delegate that the plugin registry
/// loads, one render pass. Everything happens on the caller's thread, but for the renderer's own.
class Host {
public:
    /// @param shared host of which the scene indices are taken, with all that they went through;
    /// null: own ones
    /// @throws std::runtime_error when the plugin is not found or does not start
    Host(const UsdStageRefPtr& stage, const HostOptions& options, const Host* shared = nullptr);
    ~Host();

    /// Brings edits of the stage to the renderer and lets it draw once, like a window that is
    /// repainted.
    void execute();
    /// OpenUSD threw while it brought edits: it follows the stage no more, and only another host
    /// does.
    bool isLost() const { return _isLost; }
    bool isConverged() const { return _task && _task->isConverged(); }
    /// Executes until converged. @returns false when it takes longer than the limit, in seconds
    bool render(double limit = 600.0);
    /// Seconds from the start of the last render() until buffers held an image, which may be
    /// coarse. Of renderers that do not say when: until the last one.
    double secondsUntilSeen() const { return _secondsUntilSeen; }

    void setCamera(const SdfPath& camera);
    void setSize(int width, int height);
    void setAovs(const std::vector<HostAov>& aovs);
    void setPurposes(const std::vector<std::string>& purposes);
    void setTime(UsdTimeCode time) { _options.time = time; }
    void setRefineLevel(int level) { _options.refineLevel = level; }
    void setSetting(const std::string& name, const VtValue& value);

    /// @throws std::runtime_error when there is no such output
    HostImage read(const std::string& aov) const;
    /// Outputs that the delegate has.
    std::vector<HostLayer> readAll() const;
    HdRenderBuffer* buffer(const std::string& aov) const;
    HostHit decode(int primId, int instanceId) { return _input->decode(primId, instanceId); }

    /// Asks the delegate for its scene as text. @returns whether the file was written
    bool dumpScene(const std::string& path);

    HdRenderDelegate* delegate() const { return _delegate.Get(); }
    HdRenderIndex* index() const { return _index.get(); }
    const HostOptions& options() const { return _options; }

    /// Takes parts down by hand, for tests of the order. Afterwards only the destructor is allowed,
    /// and further parts that are still there.
    void dropTask() { _task.reset(); }
    void dropInput() { _input.reset(); }
    void dropBuffers();

private:
    void bind();

    HostOptions _options;
    UsdStageRefPtr _stage;
    bool _isLost = false;
    double _secondsUntilSeen = 0.0;
    HdPluginRenderDelegateUniqueHandle _delegate;
    std::unique_ptr<HdRenderIndex> _index;
    std::unique_ptr<HostBuffers> _buffers;
    std::unique_ptr<SceneInput> _input;
    std::shared_ptr<HostRenderTask> _task;
    HdEngine _engine;
};

} // namespace patina
