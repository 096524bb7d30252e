#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace patina {

/// How the samples of a pixel become one value.
enum class AovKind {
    Mean,   ///< average over samples (colour, albedo)
    First,  ///< the sample nearest the pixel's centre: no mixing (depth, ids, position, normal, primvars)
};

/// One channel group of the film.
struct AovSpec {
    std::string name;   ///< color, alpha, depth, cameraDepth, normal, Neye, position, albedo, primvars:NAME, primId, instanceId, elementId, sampleCount, variance
    int components = 3; ///< floats per pixel
    AovKind kind = AovKind::Mean;
    float clearValue = 0.0f;
    bool isInteger = false; ///< ids: stored as float bits of int32 (glm::intBitsToFloat)
};

/// The standard spec of an AOV by name. @throws std::invalid_argument naming an unknown AOV.
AovSpec standardAov(const std::string& name);

/// Accumulates what a renderer finds. Row 0 is the top row. One thread writes one pixel at a time;
/// different pixels may be written at once. Sums are kept in double so that the order of passes
/// does not matter to the printed digits.
class Film {
public:
    /// Clears everything unless size and AOVs are as before and keep is set.
    void reset(int width, int height, const std::vector<AovSpec>& aovs, bool keep = false);

    int width() const { return _width; }
    int height() const { return _height; }
    const std::vector<AovSpec>& aovs() const { return _aovs; }
    int aovIndex(const std::string& name) const; ///< -1 when absent

    /// Colour and alpha always exist. Not finite or negative samples are counted and dropped as a
    /// whole (the sample counts as black); @returns false then.
    bool addColor(int x, int y, glm::vec3 radiance, float alpha);
    /// @param distance of the sample from the pixel's centre, for AovKind::First
    void addAov(int aov, int x, int y, const float* values, float distance);

    uint32_t sampleCount(int x, int y) const { return _pixels[size_t(y) * _width + x].count; }
    glm::vec3 color(int x, int y) const; ///< mean so far
    float alpha(int x, int y) const;
    /// Variance of the mean of the luminance: s^2 / n. 0 with fewer than two samples.
    float varianceOfMean(int x, int y) const;
    float luminance(int x, int y) const;

    /// Resolved pixels of any AOV (also color, alpha, sampleCount, variance): components floats per
    /// pixel, top row first. @returns empty for an unknown name.
    std::vector<float> resolve(const std::string& name) const;

    uint64_t droppedSamples() const { return _dropped; }

    std::string resumeToken; ///< hash of everything that must be equal to continue the samples

    /// Writes and reads every accumulator, bit for bit. Writing is atomic (temporary, then rename).
    /// @throws std::runtime_error with a one-line reason.
    void saveCheckpoint(const std::string& file) const;
    void loadCheckpoint(const std::string& file);

private:
    struct Pixel {
        double sum[3] = {0, 0, 0};
        double alpha = 0;
        double luminanceSquared = 0;
        uint32_t count = 0;
    };
    int _width = 0, _height = 0;
    std::vector<AovSpec> _aovs;
    std::vector<Pixel> _pixels;
    std::vector<std::vector<float>> _planes; ///< per AOV: components + 1 (count or distance) per pixel
    std::vector<uint64_t> _droppedRow;
    uint64_t _dropped = 0;
};

} // namespace patina
