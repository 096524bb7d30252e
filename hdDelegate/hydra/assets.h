// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/usd/sdf/assetPath.h>

#include <string>

namespace patina {

PXR_NAMESPACE_USING_DIRECTIVE

/// \return the path of a file on disk with what an asset holds: the resolved path, or that of a
/// copy when the asset lies in a package ("a.usdz[b.png]") or comes from a resolver that has no
/// files; the path as it was authored when nothing is found. "<UDIM>" stays in the path; all tiles
/// are copied then. Copies lie in one temporary folder for the process, which is removed at exit.
/// Any thread may call it.
std::string fileOf(const SdfAssetPath& asset);

} // namespace patina
