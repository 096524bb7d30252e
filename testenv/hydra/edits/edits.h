// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/edits/random.h"
#include "testenv/hydra/host/host.h"

#include <string>
#include <vector>

namespace patina {

/// One kind of random edit.
struct Edit {
    const char* name;
    void (*apply)(const UsdStageRefPtr& stage, Host& host, Random& random);
};

/// Of points, primvars, topology, shapes, transforms, visibility and purposes.
const std::vector<Edit>& geometryEdits();
/// Of materials, networks, bindings and lights.
const std::vector<Edit>& shadingEdits();
/// Of instancers, added and removed prims, variants, activation, and the whole stage at once.
const std::vector<Edit>& structureEdits();
/// Of what a host sets: camera, size, outputs, purposes, settings, pause and stop.
const std::vector<Edit>& hostEdits();

/// Edits a stage while a host renders it. The same seed gives the same edits.
class RandomEdits {
public:
    RandomEdits(const UsdStageRefPtr& stage, Host& host, uint32_t seed);

    /// @returns the name of what was changed
    std::string apply();

private:
    UsdStageRefPtr _stage;
    Host& _host;
    Random _random;
    std::vector<const std::vector<Edit>*> _groups;
};

} // namespace patina
