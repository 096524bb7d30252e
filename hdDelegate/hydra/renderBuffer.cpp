// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderBuffer.h"

#include "hdDelegate/hydra/clearValue.h"
#include "hdDelegate/hydra/pixelFormats.h"

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

bool HdPatinaRenderBuffer::write(bool isInteger,
                                 const std::function<void(int, int, float*)>& pixel) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_mappers > 0) return false;
    const size_t size = _bytes.empty() ? 0 : HdDataSizeOfFormat(_format);
    uint8_t* out = _bytes.data();
    for (unsigned y = 0; size && y < _height; ++y)
        for (unsigned x = 0; x < _width; ++x, out += size) {
            float values[4] = {0.0f, 0.0f, 0.0f, 1.0f};
            pixel(int(x), int(y), values);
            writePixel(values, isInteger, _format, out);
        }
    return true;
}

void HdPatinaRenderBuffer::clear(const VtValue& value) {
    const ClearValue clear = clearValueOf(value);
    write(clear.isInteger, [&](int, int, float* out) {
        for (int i = 0; i < 4; ++i)
            out[i] = clear.values[i];
    });
}

} // namespace patina
