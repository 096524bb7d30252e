// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/tests/filmFixtures.h"

#include <OpenImageIO/imageio.h>

namespace patina {

namespace {

/// 3x2 pixels whose values tell where they are.
struct FullFilm : TestFilm {
    FullFilm()
        : TestFilm(3, 2,
                   {standardAov("depth"), standardAov("normal"), standardAov("albedo"),
                    standardAov("primvars:st"), standardAov("primId"), standardAov("sampleCount"),
                    standardAov("variance")}) {
        forPixels(*this, [&](int x, int y) {
            float base = float(y * 3 + x);
            addColor(x, y, {base + 0.1f, base + 0.2f, base + 0.3f}, 0.75f);
            float depth = 0.01f * base, id = floatOfBits(int32_t(base) - 1);
            glm::vec3 normal(-base, 1, base), albedo(0.1f * base);
            addAov(0, x, y, &depth, 0);
            addAov(1, x, y, &normal.x, 0);
            addAov(2, x, y, &albedo.x, 0);
            addAov(3, x, y, &normal.x, 0);
            addAov(4, x, y, &id, 0);
        });
    }
};

float value(const ImageData& image, const std::string& channel, int x, int y) {
    for (size_t c = 0; c < image.channels.size(); ++c)
        if (image.channels[c] == channel)
            return image
                .pixels[(size_t(y) * size_t(image.width) + size_t(x)) * image.channels.size() + c];
    ADD_FAILURE() << "no channel " << channel;
    return -1e30f;
}

OIIO::TypeDesc formatOf(const std::string& file, const std::string& channel) {
    auto input = OIIO::ImageInput::open(file);
    return input->spec().channelformat(input->spec().channelindex(channel));
}

} // namespace

TEST(ExrOutput, EveryAovIsALayerWithItsOwnValues) {
    TempFolder temp;
    FullFilm film;
    std::string file = temp.file("all.exr");
    writeImage(film, file);
    ImageData image = readImage(file);
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    EXPECT_EQ(image.channels.size(), 16u);
    forPixels(film, [&](int x, int y) {
        float base = float(y * 3 + x);
        EXPECT_EQ(value(image, "R", x, y), base + 0.1f);
        EXPECT_EQ(value(image, "B", x, y), base + 0.3f);
        EXPECT_EQ(value(image, "A", x, y), 0.75f);
        EXPECT_EQ(value(image, "depth.Z", x, y), 0.01f * base);
        EXPECT_EQ(value(image, "normal.X", x, y), -base);
        EXPECT_EQ(value(image, "normal.Z", x, y), base);
        EXPECT_EQ(value(image, "albedo.G", x, y), 0.1f * base);
        EXPECT_EQ(value(image, "primvars:st.Y", x, y), 1.0f);
        EXPECT_EQ(value(image, "primId", x, y), base - 1);
        EXPECT_EQ(value(image, "sampleCount", x, y), 1.0f);
        EXPECT_EQ(value(image, "variance", x, y), 0.0f);
    });
    EXPECT_EQ(temp.fileCount(), 1u);
}

TEST(ExrOutput, HalfIsForThePictureAndIdsMayBeIntegers) {
    TempFolder temp;
    FullFilm film;
    film.addColor(0, 0, glm::vec3(1e9f), 1);
    ImageOptions options;
    options.half = options.integerIds = true;
    std::string file = temp.file("half.exr");
    writeImage(film, file, options);
    EXPECT_EQ(formatOf(file, "R"), OIIO::TypeHalf);
    EXPECT_EQ(formatOf(file, "albedo.R"), OIIO::TypeHalf);
    EXPECT_EQ(formatOf(file, "normal.X"), OIIO::TypeFloat);
    EXPECT_EQ(formatOf(file, "depth.Z"), OIIO::TypeFloat);
    EXPECT_EQ(formatOf(file, "primId"), OIIO::TypeUInt32);
    ImageData image = readImage(file);
    EXPECT_EQ(value(image, "R", 0, 0), 65504.0f) << "clamped, not infinite";
    EXPECT_EQ(value(image, "primId", 0, 0), -1.0f);
    EXPECT_EQ(value(image, "primId", 2, 1), 4.0f);
    EXPECT_NEAR(value(image, "G", 1, 0), 1.2f, 1e-3f);
}

TEST(ExrOutput, ChosenAovsOnly) {
    TempFolder temp;
    const FullFilm film;
    ImageOptions options;
    options.aovs = {"depth", "color"};
    writeImage(film, temp.file("a.exr"), options);
    EXPECT_EQ(readImage(temp.file("a.exr")).channels.size(), 4u);
    options.aovs = {"position"};
    EXPECT_THROW(writeImage(film, temp.file("b.exr"), options), std::runtime_error);
    EXPECT_EQ(temp.fileCount(), 1u);
}

TEST(ExrOutput, CropIsTheDataWindowInTheWholeImage) {
    TempFolder temp;
    const FullFilm film;
    ImageOptions options = windowed(1, 1, 2, 1);
    writeImage(film, temp.file("crop.exr"), options);
    ImageData image = readImage(temp.file("crop.exr"));
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(image.x, 1);
    EXPECT_EQ(image.y, 1);
    EXPECT_EQ(image.displayWidth, 3);
    EXPECT_EQ(image.displayHeight, 2);
    EXPECT_EQ(value(image, "R", 0, 0), 4.1f);
    EXPECT_EQ(value(image, "R", 1, 0), 5.1f);
    // a film that holds only the window is placed
    options = windowed(4, 5, 6, 6);
    options.displayWidth = options.displayHeight = 10;
    writeImage(film, temp.file("placed.exr"), options);
    image = readImage(temp.file("placed.exr"));
    EXPECT_EQ(image.x * 100 + image.y, 405);
    EXPECT_EQ(image.displayWidth, 10);
    EXPECT_EQ(value(image, "R", 0, 0), 0.1f);
    // beyond the image
    EXPECT_THROW(writeImage(film, temp.file("no.exr"), windowed(20, 20, 21, 22)),
                 std::runtime_error);
}

TEST(ExrOutput, MetadataComesBackWithItsType) {
    TempFolder temp;
    const FullFilm film;
    ImageOptions options;
    options.pixelAspectRatio = 2.0;
    Metadata metadata = {{"patina:stage", std::string("shaderball.usda")},
                         {"patina:camera", std::string("/World/camera")},
                         {"patina:samples", 64},
                         {"patina:seconds", 12.5},
                         {"patina:tolerance", 0.25}};
    writeImage(film, temp.file("a.exr"), options, metadata);
    ImageData image = readImage(temp.file("a.exr"));
    for (auto& [name, expected] : metadata) {
        ASSERT_TRUE(image.metadata.count(name)) << name;
        EXPECT_EQ(image.metadata[name], expected) << name;
    }
    EXPECT_EQ(std::get<std::string>(image.metadata["Software"]), "Patina");
    EXPECT_EQ(image.pixelAspectRatio, 2.0);
}

TEST(ExrOutput, ManyRowsKeepTheirOrder) {
    TempFolder temp;
    TestFilm film(5, 333);
    addColors(film, [](int x, int y) { return glm::vec3(float(y), float(x), 0); });
    for (const char* compression : {"none", "zip", "zips", "piz", "rle"}) {
        ImageOptions options;
        options.compression = compression;
        writeImage(film, temp.file("rows.exr"), options);
        ImageData image = readImage(temp.file("rows.exr"));
        for (int y = 0; y < 333; ++y) {
            ASSERT_EQ(value(image, "R", 3, y), float(y)) << compression;
            ASSERT_EQ(value(image, "G", 3, y), 3.0f) << compression;
        }
    }
}

TEST(ExrOutput, PixelsOfAnyChannelsRoundTrip) {
    TempFolder temp;
    ImageData image;
    image.width = 2;
    image.height = 1;
    image.channels = {"R", "G", "B", "heat"};
    image.pixels = {1, 2, 3, 4, 5, 6, 7, 8};
    image.metadata["note"] = std::string("hand made");
    writePixels(image, temp.file("p.exr"));
    ImageData back = readImage(temp.file("p.exr"));
    EXPECT_EQ(back.channels, image.channels);
    EXPECT_EQ(back.pixels, image.pixels);
    EXPECT_EQ(std::get<std::string>(back.metadata["note"]), "hand made");
}

} // namespace patina
