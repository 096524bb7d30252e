// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/color/renderingSpace.h"
#include "base/messages.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

/// Turns pixels of one colour space into another. Immutable, thread safe.
class ColorTransform {
public:
    virtual ~ColorTransform() = default;
    /// Converts in place the first three floats of each pixel; what follows them (alpha) stays.
    /// @param stride floats from one pixel to the next, at least 3
    virtual void apply(float* pixels, size_t count, int stride) const = 0;
    virtual bool isIdentity() const = 0;
};

using ColorTransformPtr = std::shared_ptr<const ColorTransform>;

/// The colour spaces of an OCIO configuration, seen from linear Rec.709 (D65), and from there from
/// the rendering space.
///
/// Only this class knows names of colour spaces, for values and textures alike:
/// - The built-in configuration has the names of MaterialX 1.39, of USD's GfColorSpaceNames, and
///   the usual ones of the ACES configurations.
/// - With a configuration of the user's, its names come first. The built-in configuration has the
///   names that it lacks.
/// - "raw", "none", "Non-Color", "data", "identity", "unknown" and the empty name mean data that is
///   never converted, in any configuration.
/// - Upper and lower case are the same.
/// - A space without a name, which stages may define, is written as "chromaticities(rx ry gx gy bx
///   by wx wy gamma bias)": CIE 1931 xy of red, green, blue and white, then the exponent and the
///   offset of its curve (2.4 and 0.055 for sRGB).
class ColorSpaces {
public:
    /// @param configFile an OCIO configuration; empty for the built-in one alone
    /// @throws std::runtime_error when it cannot be read
    explicit ColorSpaces(const std::string& configFile = {});
    ~ColorSpaces();

    /// The configuration that the environment variable OCIO names, else the built-in one.
    static const ColorSpaces& shared();
    /// Why the file that OCIO names could not be used by shared(); empty when all is well.
    static const std::optional<Message>& sharedProblem();

    static bool isData(const std::string& name);
    /// How the configuration spells a name of any case, or an alias.
    /// @returns an empty name for an unknown one
    std::string nameOf(const std::string& name) const;

    /// @returns null for an unknown name
    ColorTransformPtr toRec709(const std::string& name) const;
    ColorTransformPtr fromRec709(const std::string& name) const;
    /// Data stays as it is.
    ColorTransformPtr toRendering(const std::string& name, const RenderingSpace& to) const;
    /// Converts colour values to linear Rec.709 (not a texture's: "auto" leaves them as they are).
    /// Quick when repeated.
    /// @param stride floats from one value to the next, at least 3; what follows the three stays
    /// @returns false for an unknown name, which leaves them as they are too
    bool valueToRec709(const std::string& name, float* values, size_t count = 1,
                       int stride = 3) const;
    /// The same to the rendering space. A value without a name is one of linear Rec.709, as
    /// UsdColorSpaceAPI says; data ("raw") stays as it is.
    bool valueToRendering(const std::string& name, const RenderingSpace& to, float* values,
                          size_t count = 1, int stride = 3) const;

    /// From the rendering space to the signal of a display. Empty names take the default of the
    /// configuration; the built-in default is display "sRGB", view "Standard", which has no tone
    /// curve. Values above 1 stay above 1.
    /// @throws std::runtime_error naming what is unknown, and what is known
    ColorTransformPtr display(const std::string& display = {}, const std::string& view = {},
                              const RenderingSpace& from = RenderingSpace::rec709()) const;

    std::vector<std::string> displays() const;
    std::vector<std::string> views(const std::string& display) const;
    std::vector<std::string> names() const; ///< of all colour spaces, without aliases

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

} // namespace patina
