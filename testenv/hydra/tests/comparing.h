// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/host/host.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace patina {

/// @returns the delegate's scene as text
inline std::string sceneText(Host& host) {
    const std::string path = testing::TempDir() + "hydraScene" +
                             std::to_string(reinterpret_cast<uintptr_t>(&host)) + ".txt";
    if (!host.dumpScene(path)) return "(no scene)";
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    in.close();
    std::remove(path.c_str());
    return text.str();
}

/// Names of tests by whether they are of scene indices.
inline std::string inputName(const testing::TestParamInfo<bool>& info) {
    return info.param ? "SceneIndex" : "Delegate";
}

constexpr const char* hidden = "  hidden\n";

/// Of a prim that no ray meets only the name and that: Hydra does not sync what it holds.
inline std::string drawnText(const std::string& prim) {
    for (const char* ray : {"camera", "diffuse", "shadow", "specular", "transmission", "volume"})
        if (prim.find(std::string("  visibility ") + ray + " = false\n") == std::string::npos)
            return prim;
    return prim.substr(0, prim.find('\n') + 1) + hidden;
}

/// The prims of a scene's text, without what hosts number in the order in which they came by it
/// (prototypes), and without links: UsdImagingDelegate names equal collections by the first of
/// them.
inline std::multiset<std::string> primsOf(const std::string& text) {
    static const std::regex names("proto[0-9]+_|_id[0-9]+|__Prototype_[0-9]+");
    const std::string renamed = std::regex_replace(text, names, "_");
    std::multiset<std::string> prims;
    std::istringstream in(renamed);
    std::string line;
    std::string prim;
    while (std::getline(in, line)) {
        if (!line.empty() && line[0] != ' ') {
            prims.insert(drawnText(prim));
            prim.clear();
        }
        const bool isLink = line.find("Link = ") != std::string::npos ||
                            line.find("  categories") != std::string::npos;
        if (isLink) continue;
        prim += line + "\n";
    }
    prims.insert(drawnText(prim));
    return prims;
}

/// @returns the prims of a fresh host's text that an edited host does not have like that, and
/// what that has instead; empty when there are none. Prims that are not drawn (purposes) stay in an
/// edited host, but never reach a fresh one: the picture tells whether they matter.
inline std::string differences(const std::string& edited, const std::string& fresh) {
    const auto a = primsOf(edited), b = primsOf(fresh);
    std::string difference;
    for (const std::string& prim : b) {
        if (a.count(prim) >= b.count(prim)) continue;
        const std::string name = prim.substr(0, prim.find('\n') + 1);
        // Instancers that nothing visible asks for are not synced: the picture tells.
        if (name.rfind("Instancer ", 0) == 0 && prim == name + hidden) continue;
        std::string instead;
        for (const std::string& other : a)
            if (other.compare(0, name.size(), name) == 0 && !b.count(other)) instead += other;
        difference += "fresh:\n" + prim + "edited:\n" + instead;
    }
    return difference;
}

/// @returns the number of pixels that differ in any bit; -1 for images of other sizes
inline int differentPixels(const HostImage& a, const HostImage& b) {
    if (a.width != b.width || a.height != b.height || a.components != b.components) return -1;
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            count += std::memcmp(a.pixel(x, y), b.pixel(x, y),
                                 sizeof(float) * size_t(a.components)) != 0;
    return count;
}

} // namespace patina
