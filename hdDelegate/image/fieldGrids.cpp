// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/fieldGrids.h"

#include "base/limits.h"

namespace patina {

std::shared_ptr<const FieldGrid> FieldGrids::read(const std::string& file, const std::string& field,
                                                  const std::string& prim,
                                                  Diagnostics& diagnostics) {
    std::error_code error;
    const Key key(file, field, std::filesystem::last_write_time(file, error),
                  std::filesystem::file_size(file, error));
    const std::lock_guard<std::mutex> lock(_mutex);
    uint64_t held = 0;
    for (auto it = _known.begin(); it != _known.end();) {
        const auto grid = it->second.lock();
        if (grid && it->first == key) return grid;
        if (grid) held += grid->bytes();
        it = grid ? std::next(it) : _known.erase(it);
    }
    auto grid = readFieldGrid(file, field, prim, diagnostics);
    if (!grid) return nullptr;
    if (held + grid->bytes() > limitOf(Limit::gridBytes)) {
        diagnostics.warn(prim, "field", messages::gridsTooLarge(limitText(Limit::gridBytes)));
        return nullptr;
    }
    _known[key] = grid;
    return grid;
}

} // namespace patina
