// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "materialNetwork/network/network.h"

#include <pxr/base/vt/value.h>
#include <pxr/usd/sdf/path.h>

namespace patina {

/// Translates a host's material (HdMaterialNetworkMap) into a network. Only authored inputs arrive,
/// typed by their value. Node definitions tell the rest (a GfVec3f may be a colour). A parameter
/// `colorSpace:NAME` becomes the colour space of input NAME, `typeName:NAME` its type.
/// @returns a network without terminals, after a warning, if nothing in the material can be used
Network networkOf(const VtValue& resource, const SdfPath& material, HdPatinaRenderParam& param);

/// Whether a parameter tells the colour space or the type of another.
bool describesAnother(const std::string& parameter);

/// A parameter as a typed constant. @returns false for types that no input has
bool valueOf(const VtValue& given, const std::string& typeName, const std::string& colorSpace,
             Value& value);

} // namespace patina
