// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/coverage.h"

#include <algorithm>

namespace patina {

CoverageRoom& CoverageRoom::operator=(const CoverageRoom& other) {
    _taken.store(other.taken(), std::memory_order_relaxed);
    _leftOut.store(other.leftOut(), std::memory_order_relaxed);
    _most = other._most;
    return *this;
}

bool CoverageRoom::take(size_t before) {
    if (before >= idsOfAny && taken() >= _most) {
        _leftOut.store(true, std::memory_order_relaxed);
        return false;
    }
    _taken.fetch_add(1, std::memory_order_relaxed);
    return true;
}

CoverageCell& CoverageCell::operator=(const CoverageCell& other) {
    if (this == &other) return *this;
    _first = other._first;
    _more = other._more ? std::make_unique<std::vector<CoverageCount>>(*other._more) : nullptr;
    return *this;
}

bool CoverageCell::add(uint32_t id, uint32_t samples, CoverageRoom& room) {
    if (!samples) return false;
    if (!_first.samples || _first.id == id) {
        const bool isNew = !_first.samples;
        _first.id = id;
        _first.samples += samples;
        return isNew;
    }
    if (!_more) _more = std::make_unique<std::vector<CoverageCount>>();
    for (CoverageCount& count : *_more)
        if (count.id == id) {
            count.samples += samples;
            return false;
        }
    if (!room.take(size())) return false;
    _more->push_back({id, samples});
    return true;
}

void CoverageCell::add(const CoverageCell& other, CoverageRoom& room) {
    for (size_t i = 0; i < other.size(); ++i)
        add(other[i].id, other[i].samples, room);
}

std::vector<CoverageCount> CoverageCell::ranked() const {
    std::vector<CoverageCount> counts;
    for (size_t i = 0; i < size(); ++i)
        counts.push_back((*this)[i]);
    std::sort(counts.begin(), counts.end(), [](const CoverageCount& a, const CoverageCount& b) {
        return a.samples != b.samples ? a.samples > b.samples : a.id < b.id;
    });
    return counts;
}

CoverageNames& CoverageNames::operator=(const CoverageNames& other) {
    if (this == &other) return *this;
    Map names = other.all();
    const std::lock_guard<std::mutex> lock(_mutex);
    _names = std::move(names);
    return *this;
}

void CoverageNames::add(uint32_t id, const std::string& name) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto [place, isNew] = _names.emplace(id, name);
    if (!isNew && name < place->second) place->second = name;
}

CoverageNames::Map CoverageNames::all() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _names;
}

} // namespace patina
