// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderBuffer.h"

#include "hdDelegate/hydra/clearValue.h"
#include "hdDelegate/hydra/pixelFormats.h"
#include "hdDelegate/parallel.h"

#include <pxr/base/gf/vec3i.h>
#include <pxr/base/tf/diagnostic.h>

#include <new>
#include <unordered_map>

namespace patina {

namespace {

constexpr uint64_t maxPixels = uint64_t(1) << 32; // as of a film

/// All buffers that there are, by the pointer that hosts have. Never destroyed: some hosts free
/// their buffers when the process ends.
struct Registry {
    std::mutex mutex;
    std::unordered_map<const HdRenderBuffer*, HdPatinaRenderBuffer*> buffers;
};

Registry& registry() {
    static Registry& all = *new Registry;
    return all;
}

unsigned int nextAllocation() {
    static std::atomic<unsigned int> last{0};
    return ++last;
}

} // namespace

HdPatinaRenderBuffer::HdPatinaRenderBuffer(const SdfPath& id,
                                           std::shared_ptr<HdPatinaHostTextures> textures)
    : HdRenderBuffer(id), _textures(std::move(textures)) {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    registry().buffers.emplace(this, this);
}

HdPatinaRenderBuffer::~HdPatinaRenderBuffer() {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    registry().buffers.erase(this);
    _textures->forget(this);
}

HdPatinaRenderBuffer* HdPatinaRenderBuffer::known(const HdRenderBuffer* buffer) {
    const std::lock_guard<std::mutex> lock(registry().mutex);
    const auto found = registry().buffers.find(buffer);
    return found == registry().buffers.end() ? nullptr : found->second;
}

void HdPatinaRenderBuffer::leaveDevice(const HdPatinaHostTextures& textures) {
    std::vector<std::shared_ptr<DeviceImage>> images; // go when nothing is locked
    const std::lock_guard<std::mutex> all(registry().mutex);
    for (const auto& [key, buffer] : registry().buffers) {
        if (buffer->_textures.get() != &textures) continue;
        const std::lock_guard<std::mutex> lock(buffer->_mutex);
        images.push_back(std::move(buffer->_image));
        buffer->forgetImage();
    }
}

bool HdPatinaRenderBuffer::Allocate(const GfVec3i& dimensions, HdFormat format, bool) {
    _Deallocate();
    const char* name = GetId().GetText();
    if (dimensions[2] != 1) {
        TF_WARN("render buffer %s: a depth of %d is not possible; it stays empty", name,
                dimensions[2]);
        return false;
    }
    if (dimensions[0] < 0 || dimensions[1] < 0 ||
        uint64_t(dimensions[0]) * uint64_t(dimensions[1]) > maxPixels) {
        TF_WARN("render buffer %s: a size of %d x %d is not possible; it stays empty", name,
                dimensions[0], dimensions[1]);
        return false;
    }
    if (!isWritableFormat(format)) {
        TF_WARN("render buffer %s: pixels of format %d cannot be written; it stays empty", name,
                int(format));
        return false;
    }
    std::lock_guard<std::mutex> lock(_mutex);
    try {
        _bytes.assign(size_t(dimensions[0]) * size_t(dimensions[1]) * HdDataSizeOfFormat(format),
                      0);
    } catch (const std::bad_alloc&) {
        TF_WARN("render buffer %s: there is no memory for %d x %d pixels; it stays empty", name,
                dimensions[0], dimensions[1]);
        return false;
    }
    _width = unsigned(dimensions[0]);
    _height = unsigned(dimensions[1]);
    _format = format;
    return true;
}

void HdPatinaRenderBuffer::_Deallocate() {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_mappers > 0) {
        TF_WARN("render buffer %s is freed while it is mapped", GetId().GetText());
        // What a host has a pointer to stays. Of one that forgets its maps that is one image.
        _mappedBytes = std::move(_bytes);
        _mappersBefore = _mappers;
    }
    _width = 0;
    _height = 0;
    _format = HdFormatInvalid;
    std::vector<uint8_t>().swap(_bytes);
    forgetImage();
    _mappers = 0;
    _mappedInRow = 0;
    _converged = false;
    _allocation = nextAllocation();
}

void* HdPatinaRenderBuffer::Map() {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_bytesAreOld) {
        ++_mappedInRow;
        bool read = false;
        runIsolated([&] { read = _image->read(_bytes.data()); });
        if (!read)
            TF_RUNTIME_ERROR("render buffer %s: the device gives no pixels", GetId().GetText());
    }
    _bytesAreOld = false;
    ++_mappers;
    return _bytes.empty() ? nullptr : _bytes.data();
}

void HdPatinaRenderBuffer::Unmap() {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_mappersBefore > 0)
        --_mappersBefore;
    else if (_mappers > 0)
        --_mappers;
    if (_mappersBefore == 0) std::vector<uint8_t>().swap(_mappedBytes);
}

bool HdPatinaRenderBuffer::take(HdPatinaPixels& image) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (image.device ? _bytes.empty() : image.bytes.empty() || image.bytes.size() != _bytes.size())
        return true;
    if (_mappers > 0) return false;
    if (image.device) {
        if (_bytesAreOld) _mappedInRow = 0;
        std::swap(_image, image.device);
        _isDepth = image.isDepth;
        _bytesAreOld = true;
        return true;
    }
    forgetImage();
    _bytes.swap(image.bytes);
    return true;
}

void HdPatinaRenderBuffer::forgetImage() {
    _image.reset();
    _bytesAreOld = false;
    _resource = HgiTextureHandle();
    _textures->forget(this);
}

void HdPatinaRenderBuffer::Resolve() {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_image) return;
    _resource = _textures->of(this, _width, _height, _format, _isDepth);
    if (_resource && !_image->copyTo(_resource->GetRawResource())) _resource = HgiTextureHandle();
}

bool HdPatinaRenderBuffer::staysOnDevice() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _mappedInRow < 2 && (_format == HdFormatInt32 ||
                                HdPatinaHostTextures::formatOf(_format) != HgiFormatInvalid);
}

VtValue HdPatinaRenderBuffer::GetResource(bool) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _resource ? VtValue(_resource) : VtValue();
}

void HdPatinaRenderBuffer::clear(const VtValue& value) {
    const ClearValue clear = clearValueOf(value);
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_mappers > 0 || _bytes.empty()) return;
    forgetImage();
    const unsigned width = _width;
    // Isolated: work of others that wants this buffer would wait for the lock that is held here.
    runIsolated([&] {
        fillPixels(_bytes.data(), width, _height, clear.isInteger, _format,
                   [&](int, float* pixels) {
                       for (size_t i = 0; i < 4 * size_t(width); ++i)
                           pixels[i] = clear.values[i % 4];
                   });
    });
}

} // namespace patina
