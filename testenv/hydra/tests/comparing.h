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

/// A scene's text without what hosts number in the order in which they came by it: prototypes. Its
/// prims are sorted.
inline std::string withoutNumbers(const std::string& text) {
    static const std::regex names("proto[0-9]+_|_id[0-9]+|__Prototype_[0-9]+");
    std::multiset<std::string> prims;
    std::istringstream in(std::regex_replace(text, names, "_"));
    std::string line, prim, all;
    while (std::getline(in, line)) {
        if (!line.empty() && line[0] != ' ') {
            prims.insert(prim);
            prim.clear();
        }
        prim += line + "\n";
    }
    prims.insert(prim);
    for (const std::string& one : prims)
        all += one;
    return all;
}

/// @returns the first line that differs, of both; empty when they are equal
inline std::string firstDifference(const std::string& a, const std::string& b) {
    std::istringstream inA(a), inB(b);
    std::string lineA, lineB, prim;
    for (int number = 1;; ++number) {
        const bool moreA = bool(std::getline(inA, lineA)), moreB = bool(std::getline(inB, lineB));
        if (!moreA && !moreB) return std::string();
        if (!moreA) lineA = "(end)";
        if (!moreB) lineB = "(end)";
        if (lineA != lineB)
            return "line " + std::to_string(number) + " of " + prim + ":\n  " + lineA + "\n  " +
                   lineB;
        if (!lineA.empty() && lineA[0] != ' ') prim = lineA;
    }
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
