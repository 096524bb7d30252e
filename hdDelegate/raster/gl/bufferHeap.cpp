// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/bufferHeap.h"

#include "hdDelegate/raster/gl/glFaults.h"

#include <algorithm>

namespace patina {

namespace {

constexpr size_t whole(size_t bytes) {
    return std::max<size_t>((bytes + BufferHeap::grain - 1) / BufferHeap::grain, 1) *
           BufferHeap::grain;
}

void giveBack(std::map<size_t, size_t>& free, size_t offset, size_t size) {
    auto after = free.lower_bound(offset);
    if (after != free.end() && offset + size == after->first) {
        size += after->second;
        after = free.erase(after);
    }
    if (after != free.begin()) {
        const auto before = std::prev(after);
        if (before->first + before->second == offset) {
            before->second += size;
            return;
        }
    }
    free[offset] = size;
}

} // namespace

BufferHeap::Range::~Range() {
    if (!_page || _alone) return;
    giveBack(_page->free, _offset, whole(_size));
    _page->tooLarge = SIZE_MAX;
}

bool BufferHeap::isAlone(size_t bytes) {
    return bytes > largestPage / 4 || !glFault("ownPages").empty();
}

void BufferHeap::Range::swap(Range& o) noexcept {
    std::swap(_page, o._page);
    std::swap(_offset, o._offset);
    std::swap(_size, o._size);
    std::swap(_alone, o._alone);
}

BufferHeap::Range BufferHeap::make(const std::vector<char>& bytes, bool alone) {
    Range range;
    range._size = bytes.size();
    const size_t size = whole(bytes.size());
    if (alone) {
        range._page = std::make_shared<Page>();
        range._page->buffer = GlBuffer(bytes);
        range._alone = true;
        return range;
    }
    _pages.erase(std::remove_if(_pages.begin(), _pages.end(),
                                [](const auto& page) { return page.expired(); }),
                 _pages.end());
    const auto takeFrom = [&](const std::shared_ptr<Page>& page) {
        if (size >= page->tooLarge) return false;
        const auto room = std::find_if(page->free.begin(), page->free.end(),
                                       [&](const auto& item) { return item.second >= size; });
        if (room == page->free.end()) {
            page->tooLarge = size;
            return false;
        }
        range._page = page;
        range._offset = room->first;
        const size_t left = room->second - size;
        page->free.erase(room);
        if (left > 0) page->free[range._offset + size] = left;
        return true;
    };
    bool found = false;
    for (auto it = _pages.rbegin(); it != _pages.rend() && !found; ++it)
        found = takeFrom(it->lock());
    if (!found) {
        const auto page = std::make_shared<Page>();
        const size_t all = std::min(whole(std::max(_next, 4 * size)), largestPage);
        page->buffer = GlBuffer(all, nullptr);
        page->free[0] = all;
        _next = std::min(2 * all, largestPage);
        _pages.push_back(page);
        takeFrom(page);
    }
    range._page->buffer.write(bytes.data(), bytes.size(), range._offset);
    return range;
}

size_t BufferHeap::pages() const {
    return size_t(std::count_if(_pages.begin(), _pages.end(),
                                [](const auto& page) { return !page.expired(); }));
}

} // namespace patina
