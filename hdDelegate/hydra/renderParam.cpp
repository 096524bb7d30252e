// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderParam.h"

#include "hdDelegate/hydra/instances.h"

#include <pxr/base/tf/diagnostic.h>

#include <algorithm>
#include <utility>

namespace patina {

HdPatinaRenderParam::HdPatinaRenderParam()
    : _scene(std::make_shared<Scene>()), _edit(*_scene),
      _instances(std::make_unique<HdPatinaInstances>()) {}

HdPatinaRenderParam::~HdPatinaRenderParam() = default;

void HdPatinaRenderParam::removeGeometry(const std::string& path) {
    std::lock_guard<std::mutex> lock(_mutex);
    _edit.remove(path, PrimKind::Geometry);
}

void HdPatinaRenderParam::removeInstancer(const std::string& path) {
    std::lock_guard<std::mutex> lock(_mutex);
    _edit.remove(path, PrimKind::Instancer);
}

void HdPatinaRenderParam::removeLight(const std::string& path) {
    std::lock_guard<std::mutex> lock(_mutex);
    _edit.remove(path, PrimKind::Light);
}

void HdPatinaRenderParam::removeCamera(const std::string& path) {
    std::lock_guard<std::mutex> lock(_mutex);
    _edit.remove(path, PrimKind::Camera);
}

void HdPatinaRenderParam::removeMaterial(const std::string& path) {
    std::lock_guard<std::mutex> lock(_mutex);
    _edit.remove(path, PrimKind::Material);
}

void HdPatinaRenderParam::use(const SdfPath& read, const SdfPath& reader) {
    std::lock_guard<std::mutex> lock(_mutex);
    _readers[read].insert(reader);
}

void HdPatinaRenderParam::setChanged(const SdfPath& read) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_readers.count(read)) _changed.insert(read);
}

std::set<SdfPath> HdPatinaRenderParam::takeReadersOfChanged() {
    std::lock_guard<std::mutex> lock(_mutex);
    std::set<SdfPath> readers;
    for (const SdfPath& read : std::exchange(_changed, {})) {
        const auto found = _readers.find(read);
        if (found != _readers.end()) readers.insert(found->second.begin(), found->second.end());
    }
    return readers;
}

void HdPatinaRenderParam::setMetersPerUnit(double metersPerUnit) {
    std::lock_guard<std::mutex> lock(_mutex);
    _edit.setMetersPerUnit(metersPerUnit);
}

void HdPatinaRenderParam::setRenderingSpace(const RenderingSpace& space) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_renderingSpace.exchange(&space) == &space) return;
    _edit.setRenderingSpace(space);
    _renderingSpaceChanged = true;
}

GfVec2f HdPatinaRenderParam::shutter() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _shutter;
}

GfVec2f HdPatinaRenderParam::cameraShutter() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _cameraShutter;
}

namespace {

/// @returns whether that made the interval longer
bool widen(GfVec2f& interval, double open, double close) {
    const GfVec2f before = interval;
    const bool first = !(interval[1] > interval[0]);
    interval[0] = first ? float(open) : std::min(interval[0], float(open));
    interval[1] = first ? float(close) : std::max(interval[1], float(close));
    return interval != before;
}

} // namespace

bool HdPatinaRenderParam::widenShutter(double open, double close) {
    if (!(close > open)) return false;
    std::lock_guard<std::mutex> lock(_mutex);
    widen(_cameraShutter, open, close);
    if (!widen(_shutter, open, close)) return false;
    _shutterWidened = true;
    return true;
}

void HdPatinaRenderParam::tellMotion() {
    if (_tellsMotion.exchange(true)) return;
    std::lock_guard<std::mutex> lock(_mutex);
    widen(_shutter, -1.0, 1.0);
    _shutterWidened = true;
}

void HdPatinaRenderParam::warn(const SdfPath& prim, const std::string& input, const Message& what) {
    _scene->diagnostics().warn(prim.GetString(), input, what);
}

void HdPatinaRenderParam::reportWarnings() {
    constexpr size_t most = 256; // of a session that goes on for days, with other values each time
    for (const Diagnostic& d : _scene->diagnostics().news(_reported, most))
        TF_WARN("%s%s%s: %s", d.prim.c_str(), d.input.empty() ? "" : ".", d.input.c_str(),
                d.message.c_str());
}

bool HdPatinaRenderParam::commit() {
    _instances->flush(*this);
    std::lock_guard<std::mutex> lock(_mutex);
    const uint64_t before = _scene->snapshot()->version;
    _edit.commit();
    return _scene->snapshot()->version != before;
}

} // namespace patina
