// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/light.h"
#include "base/diagnostics.h"

#include <memory>

namespace patina {

struct RenderingSpace;

/// The light with its inputs as their nodes say. The colour of a dome or a rect that varies stays
/// in the network. Where there is no value that the light can take, its own stays, with a warning.
std::shared_ptr<const Light> withNetworkValues(const Light& light, const RenderingSpace& space,
                                               Diagnostics& diagnostics);

} // namespace patina
