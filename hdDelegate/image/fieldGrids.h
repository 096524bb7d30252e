// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/fieldGrid.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

namespace patina {

/// The grids of a scene's volumes, each once for all who read it, and together within
/// Limit::gridBytes. Thread safe.
class FieldGrids {
public:
    /// As readFieldGrid(). A file that has changed is read anew.
    std::shared_ptr<const FieldGrid> read(const std::string& file, const std::string& field,
                                          const std::string& prim, Diagnostics& diagnostics);

private:
    using Key = std::tuple<std::string, std::string, std::filesystem::file_time_type, uintmax_t>;
    std::mutex _mutex;
    std::map<Key, std::weak_ptr<const FieldGrid>> _known;
};

} // namespace patina
