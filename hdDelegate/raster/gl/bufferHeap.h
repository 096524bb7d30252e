// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glResources.h"

#include <cstdint>
#include <map>
#include <memory>

namespace patina {

/// Ranges of few large buffers, so that what is drawn one after another needs the same bindings.
/// Made and used with one context current, by one thread.
class BufferHeap {
public:
    /// A buffer, and what is free of it.
    struct Page {
        GlBuffer buffer;
        std::map<size_t, size_t> free; ///< offset to size, both multiples of `grain`; none touch
        size_t tooLarge = SIZE_MAX;    ///< bytes that did not fit; until something is given back
    };

    /// A part of a page, which it gives back in the end. Movable, empty when default constructed.
    class Range {
    public:
        Range() = default;
        ~Range();
        Range(Range&& o) noexcept { swap(o); }
        Range& operator=(Range&& o) noexcept {
            swap(o);
            return *this;
        }

        const GlBuffer& buffer() const { return _page->buffer; }
        size_t offset() const { return _offset; } ///< bytes, a multiple of `grain`
        size_t size() const { return _size; }     ///< bytes
        bool alone() const { return _alone; }     ///< its page has no other ranges, ever

    private:
        friend class BufferHeap;
        void swap(Range& o) noexcept;
        std::shared_ptr<Page> _page;
        size_t _offset = 0, _size = 0;
        bool _alone = false;
    };

    /// Bytes that offsets are multiples of: of the strides of all that is kept in pages.
    static constexpr size_t grain = 336;
    /// Bytes of a page with several ranges: what a storage binding shows in every driver, 16 MB.
    static constexpr size_t largestPage = (size_t(1) << 24) / grain * grain;
    /// Whether so many bytes have a page of their own: more than a fourth of one.
    static bool isAlone(size_t bytes);

    /// @param alone in a page of its own, as isAlone() says
    Range make(const std::vector<char>& bytes, bool alone);
    size_t pages() const; ///< that are in use

private:
    std::vector<std::weak_ptr<Page>> _pages; ///< with several ranges, the newest last
    size_t _next = size_t(1) << 18;          ///< bytes of the next page
};

} // namespace patina
