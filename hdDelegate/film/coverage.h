// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace patina {

/// How many samples of a pixel have met one id.
struct CoverageCount {
    uint32_t id = 0;      ///< never 0, of an empty cell aside
    uint32_t samples = 0; ///< 0: an empty cell
};

/// Room for the ids of all pixels beyond the first of each, which take memory of their own: of
/// millions of instances smaller than a pixel each sample meets another. Once it is full, pixels
/// that have many ids add no more. What further ids cover is lost, and which those are depends on
/// the order of the samples. Nothing changes where it is never full. Threads may add at once.
class CoverageRoom {
public:
    static constexpr uint64_t mostIds = uint64_t(1) << 27; ///< one to two GiB
    static constexpr size_t idsOfAny = 64; ///< that a pixel adds in any case; images hold 16

    CoverageRoom() = default;
    CoverageRoom(const CoverageRoom& other) { *this = other; }
    CoverageRoom& operator=(const CoverageRoom& other);

    /// @param before ids that the pixel has
    /// @returns whether it may add one more, which then counts
    bool take(size_t before);
    bool leftOut() const { return _leftOut.load(std::memory_order_relaxed); }
    uint64_t taken() const { return _taken.load(std::memory_order_relaxed); }
    void limit(uint64_t most) { _most = most; }

private:
    std::atomic<uint64_t> _taken{0};
    std::atomic<bool> _leftOut{false};
    uint64_t _most = mostIds;
};

/// The ids that the samples of one pixel have met. Numbers of samples add up alike in any order, so
/// parts of a frame give its bits. Most pixels have one id, which takes no memory of its own.
class CoverageCell {
public:
    CoverageCell() = default;
    CoverageCell(const CoverageCell& other) { *this = other; }
    CoverageCell& operator=(const CoverageCell& other);
    CoverageCell(CoverageCell&&) = default;
    CoverageCell& operator=(CoverageCell&&) = default;

    /// @param room of all pixels
    /// @returns whether the id is new in this pixel
    bool add(uint32_t id, uint32_t samples, CoverageRoom& room);
    void add(const CoverageCell& other, CoverageRoom& room);

    size_t size() const { return _first.samples ? 1 + (_more ? _more->size() : 0) : 0; }
    const CoverageCount& operator[](size_t i) const { return i ? (*_more)[i - 1] : _first; }
    /// By falling numbers of samples; equal ones by id.
    std::vector<CoverageCount> ranked() const;

private:
    CoverageCount _first;
    std::unique_ptr<std::vector<CoverageCount>> _more;
};

/// Which name each id stands for. Threads may add at once.
class CoverageNames {
public:
    using Map = std::map<uint32_t, std::string>;

    CoverageNames() = default;
    CoverageNames(const CoverageNames& other) : _names(other.all()) {}
    CoverageNames& operator=(const CoverageNames& other);

    /// Of two names with one id the first in the alphabet stays, whoever comes first.
    void add(uint32_t id, const std::string& name);
    Map all() const;

private:
    mutable std::mutex _mutex;
    Map _names;
};

} // namespace patina
