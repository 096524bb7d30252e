// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace patina {

/// Prims of one kind by path, in the order of paths. Copies share what they have in common: the
/// items lie in blocks of some dozens that are never written again, and a change replaces the
/// blocks that it touches. So a copy, an edit and a comparison of n prims cost n / blockSize
/// pointers and the prims that differ.
template <class T> class PrimMap {
public:
    using Value = std::shared_ptr<const T>;
    using Item = std::pair<std::string, Value>;
    using Changes = std::map<std::string, Value>;
    static constexpr size_t blockSize = 64; ///< a block has at most twice as many items

private:
    using Block = std::vector<Item>; // never empty
    using BlockPtr = std::shared_ptr<const Block>;

public:
    class const_iterator {
    public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = Item;
        using difference_type = std::ptrdiff_t;
        using pointer = const Item*;
        using reference = const Item&;

        const_iterator() = default;
        const Item& operator*() const { return (**_block)[_item]; }
        const Item* operator->() const { return &**this; }
        const_iterator& operator++() {
            if (++_item == (*_block)->size()) {
                ++_block;
                _item = 0;
            }
            return *this;
        }
        const_iterator operator++(int) {
            const const_iterator before = *this;
            ++*this;
            return before;
        }
        bool operator==(const const_iterator& other) const {
            return _block == other._block && _item == other._item;
        }
        bool operator!=(const const_iterator& other) const { return !(*this == other); }

    private:
        friend class PrimMap;
        const_iterator(const BlockPtr* block, size_t item) : _block(block), _item(item) {}
        const BlockPtr* _block = nullptr;
        size_t _item = 0;
    };

    const_iterator begin() const { return {_blocks.data(), 0}; }
    const_iterator end() const { return {_blocks.data() + _blocks.size(), 0}; }
    size_t size() const { return _size; }
    bool empty() const { return _size == 0; }
    size_t count(const std::string& path) const { return find(path) == end() ? 0 : 1; }

    const_iterator find(const std::string& path) const {
        const auto block = std::lower_bound(
            _blocks.begin(), _blocks.end(), path,
            [](const BlockPtr& b, const std::string& p) { return b->back().first < p; });
        if (block == _blocks.end()) return end();
        const auto item =
            std::lower_bound((*block)->begin(), (*block)->end(), path,
                             [](const Item& i, const std::string& p) { return i.first < p; });
        if (item->first != path) return end();
        return {_blocks.data() + (block - _blocks.begin()), size_t(item - (*block)->begin())};
    }

    /// @throws std::out_of_range
    const Value& at(const std::string& path) const {
        const const_iterator found = find(path);
        if (found == end()) throw std::out_of_range(path);
        return found->second;
    }

    /// One change. Many at a time are cheaper with changed().
    void set(const std::string& path, Value prim) { *this = changed({{path, std::move(prim)}}); }

    /// This map with prims added, replaced, or taken away.
    /// @param changes by path; a null takes away
    PrimMap changed(const Changes& changes) const;

    /// Calls f(path, before, after) for all that differs, in the order of paths; what is not there
    /// is null.
    template <class F> static void forDifferences(const PrimMap& a, const PrimMap& b, const F& f);

    bool operator==(const PrimMap& other) const {
        bool same = _size == other._size;
        if (same)
            forDifferences(*this, other,
                           [&](const std::string&, const Value&, const Value&) { same = false; });
        return same;
    }
    bool operator!=(const PrimMap& other) const { return !(*this == other); }

private:
    /// Collects the items of new blocks.
    struct Writer {
        std::vector<BlockPtr>& blocks;
        Block open;
        void add(const Item& item) {
            open.push_back(item);
            if (open.size() >= 2 * blockSize) close(blockSize);
        }
        void close(size_t count) {
            if (count == 0) return;
            const auto split = open.begin() + std::ptrdiff_t(count);
            blocks.push_back(std::make_shared<const Block>(open.begin(), split));
            open.erase(open.begin(), split);
        }
    };

    std::vector<BlockPtr> _blocks;
    size_t _size = 0;
};

template <class T> PrimMap<T> PrimMap<T>::changed(const Changes& changes) const {
    if (changes.empty()) return *this;
    PrimMap out;
    out._blocks.reserve(_blocks.size() + changes.size() / blockSize + 1);
    Writer writer{out._blocks, {}};
    auto change = changes.begin();
    const auto take = [&] {
        if (change->second) writer.add(*change);
        ++change;
    };
    for (const BlockPtr& block : _blocks) {
        // A block that no change touches is shared, unless what lies before it is too little for a
        // block of its own: else removals would leave ever smaller ones.
        const bool last = &block == &_blocks.back();
        const bool touched =
            change != changes.end() && (last || change->first <= block->back().first);
        if (!touched && (writer.open.empty() || writer.open.size() >= blockSize / 2)) {
            writer.close(writer.open.size());
            out._blocks.push_back(block);
            continue;
        }
        for (const Item& item : *block) {
            while (change != changes.end() && change->first < item.first)
                take();
            if (change != changes.end() && change->first == item.first)
                take();
            else
                writer.add(item);
        }
    }
    while (change != changes.end())
        take();
    writer.close(writer.open.size());
    for (const BlockPtr& block : out._blocks)
        out._size += block->size();
    return out;
}

template <class T> template <class F>
void PrimMap<T>::forDifferences(const PrimMap& a, const PrimMap& b, const F& f) {
    std::unordered_set<const Block*> ofA, shared;
    for (const BlockPtr& block : a._blocks)
        ofA.insert(block.get());
    for (const BlockPtr& block : b._blocks)
        if (ofA.count(block.get()) > 0) shared.insert(block.get());
    const auto own = [&shared](const PrimMap& map) {
        std::vector<const Item*> items;
        for (const BlockPtr& block : map._blocks)
            if (shared.count(block.get()) == 0)
                for (const Item& item : *block)
                    items.push_back(&item);
        return items;
    };
    const std::vector<const Item*> left = own(a), right = own(b);
    const Value none;
    for (size_t i = 0, j = 0; i < left.size() || j < right.size();) {
        const int order = i == left.size()    ? 1
                          : j == right.size() ? -1
                                              : left[i]->first.compare(right[j]->first);
        if (order < 0) {
            f(left[i]->first, left[i]->second, none);
            ++i;
        } else if (order > 0) {
            f(right[j]->first, none, right[j]->second);
            ++j;
        } else {
            if (left[i]->second != right[j]->second)
                f(left[i]->first, left[i]->second, right[j]->second);
            ++i;
            ++j;
        }
    }
}

} // namespace patina
