// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace patina {

/// How the samples of a pixel become one value.
enum class AovKind {
    Mean,     ///< average over the samples that were added (albedo)
    First,    ///< the sample nearest the pixel's centre: no mixing (depth, ids, position, normal,
              ///< primvars)
    Coverage, ///< ids with the share of the samples that met each (Cryptomatte)
};

enum class AovId {
#define AOV(name, ...) name,
#include "hdDelegate/film/aovs.def"
#undef AOV
    unknown ///< none of the table
};

/// One row of aovs.def.
struct AovRow {
    AovId id = AovId::unknown;
    const char* name = "";
    int components = 3;
    AovKind kind = AovKind::Mean;
    double clear = 0.0; ///< of pixels that no sample reached
    bool ofFilm = false;
    bool isInteger = false;
    bool mayBeHalf = false;
    bool isBare = false;
    const char* letters = ""; ///< of channels in files; empty: X, Y, Z or none
    const char* hydraName = nullptr;
    const char* expression = nullptr; ///< of its light paths
    const char* aliases = "";         ///< of render vars, separated by spaces
    const char* primvar = nullptr;    ///< that it shows

    // The words of aovs.def.
    AovRow& film() {
        ofFilm = true;
        return *this;
    }
    AovRow& integer() {
        isInteger = true;
        return *this;
    }
    AovRow& half() {
        mayBeHalf = true;
        return *this;
    }
    AovRow& bare() {
        isBare = true;
        return *this;
    }
    AovRow& channels(const char* text) {
        letters = text;
        return *this;
    }
    AovRow& hydra(const char* text) {
        hydraName = text;
        return *this;
    }
    AovRow& paths(const char* text) {
        expression = text;
        return *this;
    }
    AovRow& also(const char* text) {
        aliases = text;
        return *this;
    }
    AovRow& reads(const char* text) {
        primvar = text;
        return *this;
    }
    AovRow& all(const char* = "") { return *this; } // for plugin/patina/cli
};

/// By AovId, without AovId::unknown.
const std::vector<AovRow>& aovRows();

/// The rest of a primvar AOV's name after its prefix.
inline constexpr char primvarAovs[] = "primvars:";

/// A light path expression follows; before it may stand NAME=.
inline constexpr char lightPathAovs[] = "lpe:";

/// An AOV of light paths taken apart.
struct LightPathAovName {
    std::string name;       ///< of its channels; made of the expression where it has none
    std::string expression; ///< empty: the AOV is no such one
};
LightPathAovName lightPathAovOf(const std::string& aov);

/// @returns what names the channels of an AOV: NAME of NAME=lpe:EXPR, else the AOV's own name
std::string channelsOfAov(const std::string& aov);

/// The name of the table's row that a render vars' source means by the name or by an alias; else
/// the name itself.
std::string aovNamed(const std::string& source);

/// @returns AovId::unknown for a name that standardAov() does not take
AovId aovIdOf(const std::string& name);

/// A layer of Cryptomatte by its name in files: crypto_object01 is the second one of cryptoObject.
/// @param aov receives the AOV's name
/// @returns its number, 0 to 7; -1 for another name
int cryptomatteLayerOf(const std::string& name, std::string& aov);

/// Whether the film makes an AOV from the samples themselves, so that it is always there.
bool isOfFilm(const std::string& aov);

/// Whether an AOV holds sums of the quarters of pixels (pixelSplat.h), which are no picture.
inline bool isOfQuarters(AovId id) {
    return id == AovId::quarterColors || id == AovId::quarterShares;
}

/// Whether one of these tells how things move from frame to frame.
bool tellMotion(const std::vector<std::string>& aovs);

} // namespace patina
