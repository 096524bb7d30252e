// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/hostTextures.h"

#include "hdDelegate/backends/backends.h"

#include <pxr/imaging/hd/driver.h>
#include <pxr/imaging/hgi/tokens.h>

namespace patina {

void HdPatinaHostTextures::setDrivers(const HdDriverVector& drivers) {
    release();
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const HdDriver* driver : drivers)
        if (driver->name == HgiTokens->renderDriver && driver->driver.IsHolding<Hgi*>())
            _hgi = driver->driver.UncheckedGet<Hgi*>();
    _why = _hgi ? "" : "the host names no Hgi";
    if (!_hgi || _hgi->GetAPIName() == HgiTokens->OpenGL) return;
    _why = "the host draws by " + _hgi->GetAPIName().GetString();
    _hgi = nullptr;
}

std::string HdPatinaHostTextures::whyNot() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _why;
}

std::shared_ptr<HostDevice> HdPatinaHostTextures::device(bool make, bool& isCurrent) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_hgi && !_device && !_refused && make) {
        _device = currentHostDevice(_why);
        _refused = !_device && !_why.empty();
    }
    isCurrent = _device && _device->isCurrent();
    if (_hgi && !_refused && make && !isCurrent)
        _why = _device ? "another context is current than the first time"
                       : "no context of EGL or GLX is current";
    else if (isCurrent)
        _why.clear();
    return _device;
}

HgiFormat HdPatinaHostTextures::formatOf(HdFormat format) {
    switch (format) {
    case HdFormatFloat16Vec4: return HgiFormatFloat16Vec4;
    case HdFormatFloat32Vec4: return HgiFormatFloat32Vec4;
    case HdFormatFloat32: return HgiFormatFloat32;
    default: return HgiFormatInvalid;
    }
}

HgiTextureHandle HdPatinaHostTextures::of(const void* buffer, unsigned width, unsigned height,
                                          HdFormat format, bool depth) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const HgiFormat form = formatOf(format);
    if (!_hgi || !_device || !_device->isCurrent() || form == HgiFormatInvalid)
        return HgiTextureHandle();
    const GfVec3i size(int(width), int(height), 1);
    HgiTextureHandle& texture = _textures[buffer];
    HgiTextureDesc wanted;
    wanted.debugName = "Patina's image";
    wanted.dimensions = size;
    wanted.format = form;
    wanted.usage = HgiTextureUsageBitsShaderRead |
                   (depth ? HgiTextureUsageBitsDepthTarget : HgiTextureUsageBitsColorTarget);
    if (texture &&
        (texture->GetDescriptor().dimensions != size || texture->GetDescriptor().format != form ||
         texture->GetDescriptor().usage != wanted.usage))
        destroy(texture);
    if (!texture) texture = _hgi->CreateTexture(wanted);
    return texture;
}

void HdPatinaHostTextures::destroy(HgiTextureHandle& texture) {
    if (_hgi && texture) _hgi->DestroyTexture(&texture);
    texture = HgiTextureHandle();
}

void HdPatinaHostTextures::forget(const void* buffer) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _textures.find(buffer);
    if (found == _textures.end()) return;
    destroy(found->second);
    _textures.erase(found);
}

void HdPatinaHostTextures::release() {
    const std::lock_guard<std::mutex> lock(_mutex);
    for (auto& item : _textures)
        destroy(item.second);
    _textures.clear();
    _device.reset();
    _hgi = nullptr;
    _refused = false;
}

} // namespace patina
