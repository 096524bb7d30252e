// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "hdDelegate/film/aovTable.h"
#include "hdDelegate/film/coverage.h"
#include "hdDelegate/film/deepPixels.h"
#include "hdDelegate/film/filmSource.h"

#include <glm/glm.hpp>

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// One channel group of the film.
struct AovSpec {
    std::string name;   ///< of aovs.def, primvars:NAME, lpe:EXPR or NAME=lpe:EXPR
    int components = 3; ///< floats per pixel
    AovKind kind = AovKind::Mean;
    float clearValue = 0.0f; ///< of pixels that no sample reached
    bool isInteger = false;  ///< ids: stored as float bits of int32 (glm::intBitsToFloat)
    AovId id = AovId::unknown;
    std::string primvar = {}; ///< that it shows: NAME of primvars:NAME
    std::string paths = {};   ///< the light path expression that it is of
};

/// The standard spec of an AOV by name.
///
/// depth is the distance along the camera's axis and cameraDepth that from the camera's centre, in
/// scene units (1e10 where nothing is); deviceDepth is OpenGL's window depth in [0,1] (1 where
/// nothing is). normal and position are in world space, Neye in camera space. Ids are -1 where
/// nothing is. primvars:NAME has two components for texture
/// coordinates (st*, uv*, UV*), one for displayOpacity and widths, otherwise three.
/// @throws std::invalid_argument naming an unknown AOV, or what is wrong with its light path
/// expression
AovSpec standardAov(const std::string& name);
/// Files of others may hold any AOV. Who reads one by its name counts on what the table says of it.
/// @throws std::invalid_argument for one that no film can have: with other than 1 to 16 components
/// (of Cryptomatte more), or unlike the row of its name
void checkAovSpec(const AovSpec& spec);

/// The specs of those that a renderer writes: all but the film's own.
/// @param cryptomatteLevels ids per pixel that images hold, 1 to 16
/// @throws std::invalid_argument naming an unknown AOV.
std::vector<AovSpec> renderedAovs(const std::vector<std::string>& names, int cryptomatteLevels = 6);
/// Takes those AOVs of light paths out that a render has no room for beside those before them.
/// @returns why, for each
std::vector<Message> leaveOutLightPaths(std::vector<std::string>& names);

/// Accumulates what a renderer finds. Row 0 is the top row. One thread writes one pixel at a time;
/// different pixels may be written at once. Sums are kept in double and in a fixed order, span by
/// span (spans.h), so that a frame can be cut into parts that add up to its bits.
class Film {
public:
    /// Clears everything unless size and AOVs are as before and keep is set. color, alpha,
    /// sampleCount and variance are always there and may be listed.
    /// @throws std::invalid_argument for a negative or absurd size or number of components, or an
    /// AOV of the table (aovs.def) that is unlike its row
    void reset(int width, int height, const std::vector<AovSpec>& aovs, bool keep = false);

    /// Becomes a film whose image another one keeps: it takes no samples, and resolve() asks the
    /// source for what that has. Until reset().
    void resetTo(const FilmSource* source, int width, int height, const std::vector<AovSpec>& aovs);
    const FilmSource* source() const { return _source; } ///< or null

    /// Renderers say so while they write to the film.
    void beginRender() { ++_renders.count; }
    void endRender() { --_renders.count; }
    bool isRendered() const { return _renders.count > 0; }

    int width() const { return _width; }
    int height() const { return _height; }
    const std::vector<AovSpec>& aovs() const { return _aovs; }
    /// -1 when absent. @param name of an AOV, or of the channels of one of light paths
    int aovIndex(const std::string& name) const;

    /// After reset(): the film holds samples from this one on, as a part of a frame does, and
    /// within one span. 0 of a whole frame.
    void setFirstSample(uint32_t index) { _firstSample = index; }
    uint32_t firstSample() const { return _firstSample; }
    /// Index of the sample that a pixel takes next.
    uint32_t nextSample(int x, int y) const { return _firstSample + pixel(x, y).count; }

    /// After reset(): the scene's lights take light away, so that negative samples are no mistake.
    void allowNegative(bool allow) { _allowsNegative = allow; }
    bool allowsNegative() const { return _allowsNegative; }

    /// Colour and alpha always exist, and come last of a sample's values. Samples that are not
    /// finite, or negative where that is not allowed, are counted and dropped as a whole (the
    /// sample counts as black); @returns false then. The alpha of such a sample is kept when it is
    /// a number, so that a dropped sample makes no hole.
    bool addColor(int x, int y, glm::vec3 radiance, float alpha);
    /// @returns whether addColor() takes it
    bool usable(const glm::vec3& radiance, float alpha) const;
    /// Values that are not finite (and not ids) are counted and dropped as a whole.
    /// @param distance of the sample from the pixel's centre, for AovKind::First; of equally near
    ///        samples the earlier one stays
    void addAov(int aov, int x, int y, const float* values, float distance);

    /// Adds a sample, which addColor() gets as well, to those that count for pixels around.
    /// @param colors,shares places of the AOVs quarterColors and quarterShares
    /// @param quarter of PixelFilter::quarterOf()
    /// @param radius of the pixel filter, the same for all
    void addQuarter(int colors, int shares, int x, int y, int quarter, const glm::vec3& radiance,
                    float alpha, float radius);
    /// Counts a sample of a pixel for an AOV of AovKind::Coverage.
    /// @param name that cryptomatteId() made the id of
    void addCoverage(int aov, int x, int y, const std::string& name);
    /// Whether some pixel met more ids than there was room for: see CoverageRoom. Files hold no
    /// such thing.
    bool leftOutCoverage() const;
    /// After reset(): sets how many ids beyond the first of each pixel an AOV has room for.
    void limitCoverage(uint64_t most);
    /// The names of the ids that such an AOV has met.
    CoverageNames::Map coverageNames(const std::string& aov) const;

    /// From now on the means of the pixels' own samples show, where samples counted for others too.
    void forgetQuarters();
    /// Replaces the mean of a pixel that has samples; their number and the variance stay.
    void setMean(int x, int y, glm::vec3 color, float alpha);
    /// Shows another colour than the mean of the samples, which then is "color.noisy", until
    /// reset() is called (as each render does when it starts). Likewise of an AOV of three
    /// components.
    /// @param pixels three floats for each, top row first
    /// @throws std::invalid_argument for another number of values
    void setDenoised(std::vector<float> pixels, const std::string& aov = "color");
    bool denoised(const std::string& aov = "color") const { return _denoised.count(aov) > 0; }

    /// Until reset() is called or size is 1, pixels without samples show that of a neighbour: the
    /// first pixel of their block, or of the block to the left or above. Sample counts and
    /// variances stay their own.
    /// @param size of a block's side in pixels
    /// @param window x0, y0, x1, y1, without the last column and row: where the blocks are
    void showBlocks(int size, const glm::ivec4& window) {
        _blockSize = size;
        _blockWindow = window;
    }

    /// After reset(): samples are kept by their depths, too. @param most of a pixel
    void keepDeep(int most) { _deep = std::make_shared<DeepPixels>(_width, _height, most); }
    DeepPixels* deep() const { return _deep.get(); } ///< or null

    /// Becomes equal to another film, but for deep pixels, with all of its accumulators. The image
    /// of a source becomes one sample of each pixel.
    void copyFrom(const Film& other);

    uint32_t sampleCount(int x, int y) const { return pixel(x, y).count; }
    glm::vec3 color(int x, int y) const; ///< mean of the pixel's own samples so far
    float alpha(int x, int y) const;
    /// Variance of the mean of the luminance: s^2 / n. 0 with fewer than two samples.
    float varianceOfMean(int x, int y) const;
    /// Expected size of the error of the mean of the luminance, as the well spread sequence of the
    /// samples leaves it, which varianceOfMean() does not know of: from how far means have moved.
    /// Where m is the mean of the first half, |M - m| has the distribution of the error of M if
    /// samples err up and down alike: both are sums of two independent halves. The halves of all
    /// powers of two count, each half as much as the next. One number per pixel, so that it is
    /// right in the mean over some pixels only. 0 with fewer than two samples.
    float deviationOfMean(int x, int y) const { return deviationOfMean(pixel(x, y)); }
    /// As deviationOfMean() was at half of the largest power of two samples below those of now; 0
    /// where that is one sample.
    float deviationBefore(int x, int y) const { return pixel(x, y).deviationEarlier; }
    float luminance(int x, int y) const; ///< Rec.709
    /// How far the mean of the luminance has moved since the last power of two samples.
    float changeOfMean(int x, int y) const;
    /// Of the pixel filter, where the samples of a pixel count for others too (pixelSplat.h), so
    /// that resolve() gives colour and alpha of all of them; else 0.
    float splatRadius(int x, int y) const;

    /// @returns whether samples of some pixel do
    bool splats() const;

    /// Resolved pixels of any AOV (also color, alpha, sampleCount, variance, and AOV.noisy where it
    /// is denoised): components floats per
    /// pixel, top row first. @returns empty for an unknown name.
    std::vector<float> resolve(const std::string& name) const;
    /// The spec of anything that resolve() knows. @returns false for an unknown name.
    bool findSpec(const std::string& name, AovSpec& spec) const;

    uint64_t droppedSamples() const { return _dropped.load(std::memory_order_relaxed); }

    /// Hash of everything that must be equal to continue the samples. Its owner sets and compares
    /// it; reset() leaves it alone.
    std::string resumeToken;

    /// Writes and reads every accumulator, bit for bit. No thread may add samples meanwhile.
    /// Writing is atomic (temporary, then rename); after a failed load the film is as before.
    /// @throws std::runtime_error with a one-line reason.
    void saveCheckpoint(const std::string& file) const;
    void loadCheckpoint(const std::string& file);

private:
    friend class FilmStream;

    struct Renders { ///< of this film, and not of its copies
        std::atomic<int> count{0};
        Renders() = default;
        Renders(const Renders&) {}
        Renders& operator=(const Renders&) { return *this; }
    };
    struct Sums {
        double color[3] = {0, 0, 0};
        double alpha = 0;
        double luminanceSquared = 0;
        Sums operator+(const Sums& other) const;
    };
    struct Pixel {
        Sums closed; ///< of the spans that have ended
        Sums open;   ///< of the span that has not
        uint32_t count = 0;
        Sums total() const { return closed + open; }
        // Of the luminance's mean at the largest power of two below count:
        float meanBefore = 0;
        float deviationBefore = 0;  ///< as deviationOfMean() was there; 0 of one sample
        float deviationEarlier = 0; ///< likewise, at half of that power
    };
    /// Means keep components sums of closed spans, as many of the open one, and their count; the
    /// First ones components values and the distance of the sample, and Coverage a cell. Only the
    /// vector of the AOV's kind is filled.
    struct Plane {
        std::vector<double> sums;
        std::vector<float> nearest;
        std::vector<CoverageCell> cells;
        CoverageRoom room; ///< of the cells
        CoverageNames names;
    };

    const double* splatSums() const;
    static float splatRadius(const double* sums);
    size_t index(int x, int y) const { return size_t(y) * size_t(_width) + size_t(x); }
    const Pixel& pixel(int x, int y) const { return _pixels[index(x, y)]; }
    /// The pixel that shows at another: see showBlocks().
    glm::ivec2 shownAt(int x, int y) const;
    static float deviationOfMean(const Pixel& pixel);
    static void recordMean(Pixel& pixel);
    void closeSpan(size_t index);
    void drop() { _dropped.fetch_add(1, std::memory_order_relaxed); }
    static void clearPlane(const AovSpec& spec, size_t pixels, Plane& plane);
    void clear(int width, int height, const std::vector<AovSpec>& aovs);
    std::vector<float> fromSource(const AovSpec& spec) const;

    Renders _renders;
    int _width = 0, _height = 0;
    std::vector<AovSpec> _aovs;
    std::vector<Pixel> _pixels;
    std::vector<Plane> _planes; ///< beside _aovs; empty for those that always exist
    const FilmSource* _source = nullptr;
    std::shared_ptr<DeepPixels> _deep;
    std::map<std::string, std::vector<float>> _denoised; ///< by AOV: what shows instead of means
    std::atomic<uint64_t> _dropped{0};
    uint32_t _firstSample = 0;
    bool _allowsNegative = false;
    int _blockSize = 1;
    glm::ivec4 _blockWindow{0};
};

} // namespace patina
