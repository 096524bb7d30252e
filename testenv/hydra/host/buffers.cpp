// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/buffers.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/imaging/hd/renderBuffer.h>

namespace patina {

HostBuffers::HostBuffers(HdRenderIndex* index) : HdSceneDelegate(index, SdfPath("/hostBuffers")) {}

HostBuffers::~HostBuffers() {
    clear();
}

void HostBuffers::resize(int width, int height) {
    if (_size == GfVec3i(width, height, 1)) return;
    _size = GfVec3i(width, height, 1);
    for (const auto& item : _formats)
        GetRenderIndex().GetChangeTracker().MarkBprimDirty(item.first,
                                                           HdRenderBuffer::DirtyDescription);
}

void HostBuffers::add(const std::string& aov, HdFormat format, bool multiSampled) {
    const SdfPath path = pathOf(aov);
    if (!_formats.emplace(path, std::make_pair(format, multiSampled)).second) return;
    GetRenderIndex().InsertBprim(HdPrimTypeTokens->renderBuffer, this, path);
}

void HostBuffers::clear() {
    for (const auto& item : _formats)
        GetRenderIndex().RemoveBprim(HdPrimTypeTokens->renderBuffer, item.first);
    _formats.clear();
}

SdfPath HostBuffers::pathOf(const std::string& aov) const {
    return GetDelegateID().AppendChild(TfToken(TfMakeValidIdentifier(aov)));
}

HdRenderBuffer* HostBuffers::find(const std::string& aov) const {
    const SdfPath path = pathOf(aov);
    if (_formats.count(path) == 0) return nullptr;
    return static_cast<HdRenderBuffer*>(const_cast<HostBuffers*>(this)->GetRenderIndex().GetBprim(
        HdPrimTypeTokens->renderBuffer, path));
}

HdRenderBufferDescriptor HostBuffers::GetRenderBufferDescriptor(const SdfPath& id) {
    const auto found = _formats.find(id);
    if (found == _formats.end()) return HdRenderBufferDescriptor();
    return HdRenderBufferDescriptor(_size, found->second.first, found->second.second);
}

} // namespace patina
