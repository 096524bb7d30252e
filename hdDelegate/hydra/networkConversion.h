// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "materialNetwork/network/network.h"

#include <pxr/base/vt/value.h>
#include <pxr/usd/sdf/path.h>

namespace patina {

/// Translates what a host gives as a material (HdMaterialNetworkMap) into a network. Only authored
/// inputs arrive, typed by their value; node definitions tell the rest (a GfVec3f may be a colour).
/// `colorSpace:NAME` parameters become the colour space of input NAME, `typeName:NAME` its type.
/// @returns a network without terminals, with a warning, when there is nothing that can be used
Network networkOf(const VtValue& resource, const SdfPath& material, HdPatinaRenderParam& param);

/// A parameter as a typed constant. @returns false for types that no input has
bool valueOf(const VtValue& given, const std::string& typeName, const std::string& colorSpace,
             Value& value);

} // namespace patina
