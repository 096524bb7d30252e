// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/host.h"

#include "testenv/hydra/host/buffers.h"

#include <pxr/imaging/hd/rendererPluginRegistry.h>
#include <pxr/imaging/hd/rprimCollection.h>
#include <pxr/imaging/hd/tokens.h>
#include <pxr/usd/usdGeom/metrics.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace patina {

namespace {

TfTokenVector tagsOf(const std::vector<std::string>& purposes) {
    TfTokenVector tags;
    for (const std::string& purpose : purposes)
        tags.push_back(purpose == "default" ? HdRenderTagTokens->geometry : TfToken(purpose));
    return tags;
}

bool showsImage(const VtDictionary& statistics) {
    const auto found = statistics.find("patina:imagesShown");
    return found != statistics.end() && found->second.GetWithDefault(0.0) > 0.0;
}

} // namespace

Host::Host(const UsdStageRefPtr& stage, const HostOptions& options, const Host* shared)
    : _options(options), _stage(stage) {
    _delegate = HdRendererPluginRegistry::GetInstance().CreateRenderDelegate(
        TfToken(options.renderer), options.settings);
    if (!_delegate)
        throw std::runtime_error("the renderer " + options.renderer +
                                 " is not found or does not start (see PXR_PLUGINPATH_NAME)");
    // Hydra has no word for it; this is how hosts that know tell it.
    _delegate->SetRenderSetting(TfToken("stageMetersPerUnit"),
                                VtValue(UsdGeomGetStageMetersPerUnit(stage)));
    _index.reset(HdRenderIndex::New(_delegate.Get(), {}, options.instanceName));
    if (!_index) throw std::runtime_error("there is no render index for " + options.renderer);
    _buffers = std::make_unique<HostBuffers>(_index.get());
    if (shared) _input = shared->_input->makeShared(_index.get());
    if (!_input)
        _input = options.sceneIndex ? makeSceneIndexInput(_index.get(), stage)
                                    : makeDelegateInput(_index.get(), stage);
    HdRprimCollection collection(HdTokens->geometry, HdReprSelector(HdReprTokens->smoothHull));
    collection.SetRootPath(SdfPath::AbsoluteRootPath());
    _task = std::make_shared<HostRenderTask>(_delegate->CreateRenderPass(_index.get(), collection),
                                             tagsOf(options.purposes));
    _buffers->resize(options.width, options.height);
    setAovs(options.aovs);
    setCamera(options.camera);
}

Host::~Host() {
    // As HdEngine's users have to: nothing of the delegate may outlive it.
    _task.reset();
    _input.reset();
    _buffers.reset();
    _index.reset();
}

void Host::dropBuffers() {
    _buffers.reset();
}

void Host::bind() {
    HostRenderTask::View view;
    view.camera = _options.camera;
    view.framing = CameraUtilFraming(GfRect2i(GfVec2i(0), _options.width, _options.height));
    for (const HostAov& aov : _options.aovs) {
        if (!_buffers->find(aov.name)) continue;
        HdRenderPassAovBinding binding;
        binding.aovName = TfToken(aov.name);
        binding.renderBufferId = _buffers->pathOf(aov.name);
        const HdAovDescriptor own = _delegate->GetDefaultAovDescriptor(binding.aovName);
        binding.clearValue = own.clearValue;
        view.aovs.push_back(binding);
    }
    _task->setView(view);
}

void Host::execute() {
    try {
        _input->update(_options.time, _options.refineLevel);
    } catch (...) {
        _isLost = true;
        throw;
    }
    HdTaskSharedPtrVector tasks = {_task};
    _engine.Execute(_index.get(), &tasks);
}

bool Host::render(double limit) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto end = start + std::chrono::duration<double>(limit);
    const auto elapsed = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    bool seen = false;
    for (execute(); !isConverged(); execute()) {
        if (Clock::now() > end) return false;
        if (!seen && showsImage(_delegate->GetRenderStats())) {
            _secondsUntilSeen = elapsed();
            seen = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (!seen) _secondsUntilSeen = elapsed();
    return true;
}

void Host::setCamera(const SdfPath& camera) {
    _options.camera = camera;
    _input->setCamera(camera);
    bind();
}

void Host::setSize(int width, int height) {
    _options.width = width;
    _options.height = height;
    _buffers->resize(width, height);
    bind();
}

void Host::setAovs(const std::vector<HostAov>& aovs) {
    _options.aovs = aovs;
    _buffers->clear();
    for (const HostAov& aov : aovs) {
        HdFormat format = aov.format;
        const HdAovDescriptor own = _delegate->GetDefaultAovDescriptor(TfToken(aov.name));
        if (own.format == HdFormatInvalid) continue; // the delegate does not know it
        if (format == HdFormatInvalid)
            format = aov.name == "color" ? HdFormatFloat32Vec4 : own.format;
        _buffers->add(aov.name, format, own.multiSampled);
    }
    bind();
}

void Host::setPurposes(const std::vector<std::string>& purposes) {
    _options.purposes = purposes;
    _task->setRenderTags(tagsOf(purposes));
}

void Host::setSetting(const std::string& name, const VtValue& value) {
    _delegate->SetRenderSetting(TfToken(name), value);
    _options.settings[TfToken(name)] = _delegate->GetRenderSetting(TfToken(name)); // if accepted
}

HdRenderBuffer* Host::buffer(const std::string& aov) const {
    return _buffers->find(aov);
}

HostImage Host::read(const std::string& aov) const {
    HdRenderBuffer* found = _buffers->find(aov);
    if (!found) throw std::runtime_error("there is no output " + aov);
    return readBuffer(*found);
}

std::vector<HostLayer> Host::readAll() const {
    std::vector<HostLayer> layers;
    for (const HostAov& aov : _options.aovs)
        if (_buffers->find(aov.name)) layers.push_back({aov.name, read(aov.name)});
    return layers;
}

bool Host::dumpScene(const std::string& path) {
    return _delegate->InvokeCommand(TfToken("patina:dumpScene"),
                                    {{TfToken("file"), VtValue(path)}});
}

} // namespace patina
