// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/cryptomatte.h"

#include "hdDelegate/film/cryptomatteHash.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <stdexcept>

namespace patina {

namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20) {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04x", unsigned(c));
            out += escape;
        } else {
            out += c;
        }
    }
    return out + '"';
}

} // namespace

int cryptomatteComponents(int levels) {
    return 4 * ((std::clamp(levels, 1, 16) + 1) / 2);
}

std::string cryptomatteLayer(const AovSpec& spec) {
    std::string layer;
    for (const char c : spec.name) {
        if (std::isupper(static_cast<unsigned char>(c))) layer += '_';
        layer += char(std::tolower(static_cast<unsigned char>(c)));
    }
    return layer;
}

std::vector<std::string> cryptomatteChannels(const AovSpec& spec) {
    std::vector<std::string> channels;
    for (int i = 0; i < spec.components; ++i) {
        char part[16];
        std::snprintf(part, sizeof part, "%02d.%c", i / 4, "RGBA"[i % 4]);
        channels.push_back(cryptomatteLayer(spec) + part);
    }
    return channels;
}

std::string cryptomatteManifest(const CoverageNames::Map& names) {
    std::string manifest = "{";
    for (const auto& [id, name] : names)
        manifest += (manifest.size() > 1 ? "," : "") + quoted(name) + ":\"" + hexOf(id) + '"';
    return manifest + "}";
}

void addCryptomatteMetadata(const AovSpec& spec, const CoverageNames::Map& names,
                            Metadata& metadata) {
    const std::string layer = cryptomatteLayer(spec);
    const std::string key = "cryptomatte/" + hexOf(cryptomatteId(layer)).substr(0, 7) + "/";
    metadata[key + "name"] = layer;
    metadata[key + "hash"] = std::string("MurmurHash3_32");
    metadata[key + "conversion"] = std::string("uint32_to_float32");
    metadata[key + "manifest"] = cryptomatteManifest(names);
}

void checkCryptomatteCompression(const std::string& path, const std::string& compression) {
    for (const char* exact : {"none", "rle", "zip", "zips", "piz"})
        if (compression == exact) return;
    throw std::runtime_error("cannot write '" + path + "': compression '" + compression +
                             "' changes the ids of Cryptomatte; none, rle, zip, zips and piz do "
                             "not");
}

Metadata cryptomatteMetadata(const Film& film) {
    Metadata metadata;
    for (const AovSpec& spec : film.aovs())
        if (spec.kind == AovKind::Coverage)
            addCryptomatteMetadata(spec, film.coverageNames(spec.name), metadata);
    return metadata;
}

} // namespace patina
