// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// The ids that the samples of one pixel have met. Numbers of samples add up alike in any order, so
/// parts of a frame give its bits. Most pixels have one id, which takes no memory of its own.
class CoverageCell {
public:
    CoverageCell() = default;
    CoverageCell(const CoverageCell& other) { *this = other; }
    CoverageCell& operator=(const CoverageCell& other);
    CoverageCell(CoverageCell&&) = default;
    CoverageCell& operator=(CoverageCell&&) = default;

    /// @returns whether the id is new in this pixel
    bool add(uint32_t id, uint32_t samples = 1);
    void add(const CoverageCell& other);

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
