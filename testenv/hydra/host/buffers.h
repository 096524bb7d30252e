// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/aov.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/sceneDelegate.h>

#include <map>
#include <string>

PXR_NAMESPACE_USING_DIRECTIVE

namespace patina {

/// The render buffers of the host, one for each output, as prims of the render index.
class HostBuffers final : public HdSceneDelegate {
public:
    explicit HostBuffers(HdRenderIndex* index);
    ~HostBuffers() override;

    void resize(int width, int height);
    void add(const std::string& aov, HdFormat format, bool multiSampled);
    void clear();
    SdfPath pathOf(const std::string& aov) const;
    /// @returns null when there is none
    HdRenderBuffer* find(const std::string& aov) const;

    HdRenderBufferDescriptor GetRenderBufferDescriptor(const SdfPath& id) override;

private:
    GfVec3i _size = GfVec3i(0, 0, 1);
    std::map<SdfPath, std::pair<HdFormat, bool>> _formats;
};

} // namespace patina
