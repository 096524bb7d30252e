// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/edits/edits.h"

#include <pxr/usd/usd/errors.h>

namespace patina {

RandomEdits::RandomEdits(const UsdStageRefPtr& stage, Host& host, uint32_t seed)
    : _stage(stage), _host(host), _random(seed),
      _groups({&geometryEdits(), &shadingEdits(), &structureEdits(), &hostEdits()}) {}

std::string RandomEdits::apply() {
    const std::vector<Edit>& group = *_random.pick(_groups);
    const Edit& edit = _random.pick(group);
    try {
        edit.apply(_stage, _host, _random);
    } catch (const UsdExpiredPrimAccessError&) {
        // Another edit took away what this one is about.
    }
    return edit.name;
}

} // namespace patina
