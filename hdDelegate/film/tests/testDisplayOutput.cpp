// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/tests/filmFixtures.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <set>

namespace patina {

namespace {

float encoded(float v) {
    return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

struct Ramp : TestFilm {
    Ramp() : TestFilm(256, 2) {
        addColors(*this, [](int x, int) { return glm::vec3(float(x) / 255.0f); });
    }
};

ImageData written(const Film& film, const std::string& file, const ImageOptions& options = {}) {
    writeImage(film, file, options);
    return readImage(file);
}

} // namespace

TEST(DisplayOutput, PngIsTheSrgbFormulaRounded) {
    TempFolder temp;
    ImageData image = written(Ramp(), temp.file("a.png"));
    EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
    for (int x = 0; x < 256; ++x) {
        float expected = encoded(float(x) / 255.0f) * 255.0f;
        EXPECT_NEAR(image.pixels[size_t(x) * 4] * 255.0f, expected, 0.505f) << x;
        EXPECT_EQ(image.pixels[size_t(x) * 4 + 3], 1.0f);
    }
}

TEST(DisplayOutput, SixteenBits) {
    TempFolder temp;
    ImageOptions options;
    options.bits = 16;
    for (const char* name : {"a.png", "a.tif"}) {
        ImageData image = written(Ramp(), temp.file(name), options);
        EXPECT_EQ(OIIO::ImageInput::open(temp.file(name))->spec().format, OIIO::TypeUInt16);
        for (int x = 0; x < 256; ++x)
            EXPECT_NEAR(image.pixels[size_t(x) * 4], encoded(float(x) / 255.0f), 3e-5f) << name;
    }
}

TEST(DisplayOutput, BrightAndRaw) {
    TempFolder temp;
    TestFilm film(2, 1);
    film.addColor(0, 0, {40, 0.5f, 0.25f}, 1);
    ImageOptions raw;
    raw.raw = true;
    ImageData image = written(film, temp.file("raw.png"), raw);
    EXPECT_EQ(image.pixels[0], 1.0f) << "clamped";
    EXPECT_NEAR(image.pixels[1], 0.5f, 0.003f);
    EXPECT_NEAR(image.pixels[2], 0.25f, 0.003f);
}

TEST(DisplayOutput, AlphaIsStraightOnScreensAndPremultipliedInExr) {
    TempFolder temp;
    TestFilm film(2, 1);
    film.addColor(0, 0, glm::vec3(0.8f), 1);
    film.addColor(0, 0, glm::vec3(0.0f), 0);
    for (const char* name : {"a.png", "a.tif", "a.tga"}) {
        ImageData image = written(film, temp.file(name));
        EXPECT_NEAR(image.pixels[0], encoded(0.8f), 0.003f) << name;
        EXPECT_NEAR(image.pixels[3], 0.5f, 0.003f) << name;
        EXPECT_EQ(image.pixels[4], 0.0f) << name;
        EXPECT_EQ(image.pixels[7], 0.0f) << name;
    }
    EXPECT_FLOAT_EQ(written(film, temp.file("a.exr")).pixels[0], 0.4f);
    ImageData jpeg = written(film, temp.file("a.jpg"));
    EXPECT_EQ(jpeg.channels.size(), 3u);
    EXPECT_NEAR(jpeg.pixels[0], encoded(0.4f), 0.03f) << "over black";
    ImageOptions color;
    color.aovs = {"color"};
    EXPECT_EQ(written(film, temp.file("rgb.png"), color).channels.size(), 3u);
    color.aovs = {"alpha"};
    EXPECT_EQ(written(film, temp.file("alpha.png"), color).channels.size(), 1u);
}

TEST(DisplayOutput, FloatFormatsAreLinear) {
    TempFolder temp;
    TestFilm film(16, 8);
    addColors(film, [](int, int) { return glm::vec3(3, 0.5f, 12); });
    ImageData hdr = written(film, temp.file("a.hdr"));
    EXPECT_NEAR(hdr.pixels[0], 3, 0.05f);
    EXPECT_NEAR(hdr.pixels[2], 12, 0.05f);
    ImageOptions options;
    options.bits = 32;
    ImageData tiff = written(film, temp.file("a.tif"), options);
    EXPECT_EQ(tiff.pixels[2], 12.0f);
}

TEST(DisplayOutput, OtherDisplaysAndUnknownOnes) {
    TempFolder temp;
    const Ramp film;
    ImageOptions options;
    options.display = "Rec.1886 Rec.709";
    ImageData image = written(film, temp.file("a.png"), options);
    EXPECT_NEAR(image.pixels[128 * 4], std::pow(128 / 255.0f, 1 / 2.4f), 0.003f);
    options.display = "Cinema";
    EXPECT_THROW(writeImage(film, temp.file("b.png"), options), std::runtime_error);
    EXPECT_EQ(temp.fileCount(), 1u);
}

TEST(DisplayOutput, DitherKeepsTheMeanAndIsTheSameEachTime) {
    TempFolder temp;
    TestFilm film(128, 128);
    const float level = 100.3f / 255.0f; // between two steps
    addColors(film, [&](int, int) { return glm::vec3(level); });
    ImageOptions options;
    options.raw = options.dither = true;
    options.aovs = {"color"};
    ImageData a = written(film, temp.file("a.png"), options);
    ImageData b = written(film, temp.file("b.png"), options);
    EXPECT_EQ(a.pixels, b.pixels);
    double mean = 0;
    std::set<int> steps;
    for (float v : a.pixels) {
        mean += v * 255.0 / double(a.pixels.size());
        steps.insert(int(std::lround(v * 255.0f)));
    }
    EXPECT_EQ(steps, (std::set<int>{100, 101}));
    // 49152 values of standard deviation 0.46: six standard errors
    EXPECT_NEAR(mean, 100.3, 6 * 0.46 / std::sqrt(49152.0));
}

TEST(DisplayOutput, MetadataAndCropOfPng) {
    TempFolder temp;
    ImageOptions options = windowed(10, 0, 19, 1);
    writeImage(Ramp(), temp.file("a.png"), options, {{"patina:stage", std::string("a.usda")}});
    ImageData image = readImage(temp.file("a.png"));
    EXPECT_EQ(image.width, 10);
    EXPECT_EQ(image.x, 0);
    EXPECT_NEAR(image.pixels[0], encoded(10 / 255.0f), 0.003f);
    EXPECT_EQ(std::get<std::string>(image.metadata["Software"]), "Patina");
    EXPECT_EQ(std::get<std::string>(image.metadata["patina:stage"]), "a.usda");
}

} // namespace patina
