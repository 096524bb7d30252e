// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderBuffer.h"

#include "hdDelegate/hydra/clearValue.h"
#include "hdDelegate/hydra/pixelFormats.h"
#include "hdDelegate/parallel.h"

#include <pxr/base/gf/vec3i.h>
#include <pxr/base/tf/diagnostic.h>

namespace patina {

namespace {

unsigned int nextAllocation() {
    static std::atomic<unsigned int> last{0};
    return ++last;
}

} // namespace

HdPatinaRenderBuffer::HdPatinaRenderBuffer(const SdfPath& id) : HdRenderBuffer(id) {}

HdPatinaRenderBuffer::~HdPatinaRenderBuffer() = default;

bool HdPatinaRenderBuffer::Allocate(const GfVec3i& dimensions, HdFormat format, bool) {
    _Deallocate();
    const char* name = GetId().GetText();
    if (dimensions[2] != 1) {
        TF_WARN("render buffer %s: a depth of %d is not possible; it stays empty", name,
                dimensions[2]);
        return false;
    }
    if (dimensions[0] < 0 || dimensions[1] < 0) {
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
    _width = unsigned(dimensions[0]);
    _height = unsigned(dimensions[1]);
    _format = format;
    _bytes.assign(size_t(_width) * _height * HdDataSizeOfFormat(format), 0);
    return true;
}

void HdPatinaRenderBuffer::_Deallocate() {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_mappers > 0) TF_WARN("render buffer %s is freed while it is mapped", GetId().GetText());
    _width = _height = 0;
    _format = HdFormatInvalid;
    std::vector<uint8_t>().swap(_bytes);
    _mappers = 0;
    _converged = false;
    _allocation = nextAllocation();
}

void* HdPatinaRenderBuffer::Map() {
    std::lock_guard<std::mutex> lock(_mutex);
    ++_mappers;
    return _bytes.empty() ? nullptr : _bytes.data();
}

void HdPatinaRenderBuffer::Unmap() {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_mappers > 0) --_mappers;
}

bool HdPatinaRenderBuffer::write(bool isInteger, const std::function<void(int, float*)>& row) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_mappers > 0) return false;
    const size_t size = _bytes.empty() ? 0 : HdDataSizeOfFormat(_format);
    if (size == 0) return true;
    // Isolated: work of others that wants this buffer would wait for the lock that is held here.
    runIsolated([&] {
        parallelFor(0u, _height, [&](unsigned y) {
            std::vector<float> pixels(4 * size_t(_width), 0.0f);
            for (size_t i = 3; i < pixels.size(); i += 4)
                pixels[i] = 1.0f;
            row(int(y), pixels.data());
            writePixels(pixels.data(), _width, isInteger, _format,
                        &_bytes[size_t(y) * _width * size]);
        });
    });
    return true;
}

void HdPatinaRenderBuffer::clear(const VtValue& value) {
    const ClearValue clear = clearValueOf(value);
    write(clear.isInteger, [&](int, float* pixels) {
        for (size_t i = 0; i < 4 * size_t(_width); ++i)
            pixels[i] = clear.values[i % 4];
    });
}

} // namespace patina
