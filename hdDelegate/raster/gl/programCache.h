// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace patina {

/// Linked programs on disk, by what they were made from and by the driver that made them: in
/// $PATINA_CACHE/programs, without it in $XDG_CACHE_HOME/patina/programs or
/// ~/.cache/patina/programs; an empty PATINA_CACHE turns it off. Several processes may use a folder
/// at once: files appear whole. A file that does not fit (damaged, of another driver) is as if it
/// were not there, and is written anew. Nothing here fails a render.
class ProgramCache {
public:
    static constexpr uint64_t largestFolder = 256u << 20; ///< bytes
    static constexpr uint64_t largestFile = 64u << 20;    ///< bytes

    /// @param sources texts of all stages, in a fixed order. Call with a context current.
    explicit ProgramCache(const std::vector<std::string>& sources);

    /// Gives a new program what is stored. @returns false when it has to be compiled
    bool load(GLuint program) const;
    /// Call before linking what store() will be called with.
    void prepare(GLuint program) const;
    void store(GLuint program) const;

    const std::string& file() const { return _file; } ///< empty: the cache is off

    /// Removes the files that were not used for longest until three quarters of the limit are left.
    static void trim(const std::string& folder, uint64_t limit);

private:
    std::string _folder, _file, _key;
};

} // namespace patina
