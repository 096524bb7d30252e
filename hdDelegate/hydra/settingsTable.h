// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/settings.h"

#include <pxr/imaging/hd/renderDelegate.h>

#include <string>

namespace patina {

/// The render settings that hosts see: names, types and defaults of HdPatinaSettings. `interactive`
/// is Hydra's enableInteractive and on until a host turns it off.
/// @param backend the default back end
HdRenderSettingDescriptorList settingDescriptors(const std::string& backend = "auto");

/// The table's key for any name under which hosts and UsdRenderSettings prims send a setting:
/// the names themselves, `patina:NAME`, and Hydra's own (convergedSamplesPerPixel -> samples,
/// threadLimit -> threads, enableInteractive -> interactive, ...). Empty when it is none of ours.
TfToken settingKey(const TfToken& name);

/// Sets one field. Numbers and texts of every type are converted; `method:POINT` forces a method.
/// @param name a key of the table
/// @returns an empty text, or what is wrong with the value
std::string applySetting(const TfToken& key, const VtValue& value, HdPatinaSettings& settings);

/// A value in the type that the table gives for a key; empty when it cannot be converted.
VtValue settingValue(const TfToken& key, const VtValue& value);

} // namespace patina
