// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/imageFile.h"

namespace patina {

// Ids and their coverage as OpenEXR files hold them: Cryptomatte, specification 1.2.0 (Psyop;
// Friedman and Jones 2015, "Fully automatic ID mattes with support for motion blur and
// transparency").

/// Components of a Cryptomatte AOV that keeps so many ids per pixel: pairs of id and coverage, two
/// pairs a layer.
/// @param levels 1 to 16
int cryptomatteComponents(int levels);

/// The name of its layers: crypto_object of cryptoObject.
std::string cryptomatteLayer(const AovSpec& spec);

/// crypto_object00.R ... crypto_object02.A
std::vector<std::string> cryptomatteChannels(const AovSpec& spec);

/// Its metadata in the file: cryptomatte/ID/name, hash, conversion and manifest.
void addCryptomatteMetadata(const AovSpec& spec, const CoverageNames::Map& names,
                            Metadata& metadata);

/// Names and their ids as JSON.
std::string cryptomatteManifest(const CoverageNames::Map& names);

/// @throws std::runtime_error where a compression of OpenEXR would change ids
void checkCryptomatteCompression(const std::string& path, const std::string& compression);

} // namespace patina
