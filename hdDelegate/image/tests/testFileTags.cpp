// SPDX-License-Identifier: Apache-2.0
// What image files say of their colours and of their edges.
#include "hdDelegate/image/iccProfile.h"
#include "hdDelegate/image/tests/imageFixtures.h"

namespace patina {

namespace {

using Attributes = Tag;

/// Big-endian bytes of a profile.
struct Profile {
    std::string bytes = std::string(36, '\0') + "acsp" + std::string(88, '\0');
    std::vector<std::pair<std::string, std::string>> tags;

    static std::string number(uint32_t n, int count = 4) {
        std::string text;
        for (int i = count; i-- > 0;)
            text += char(n >> (8 * i) & 255);
        return text;
    }
    static std::string xyz(double x, double y, double z) {
        std::string text = "XYZ " + number(0);
        for (double v : {x, y, z})
            text += number(uint32_t(int32_t(std::lround(v * 65536))));
        return text;
    }
    static std::string gamma(double g) {
        return "curv" + number(0) + number(1) + number(uint32_t(std::lround(g * 256)), 2) +
               number(0, 2);
    }
    static std::string srgbTable() {
        std::string text = "curv" + number(0) + number(1024);
        for (int i = 0; i < 1024; ++i)
            text += number(uint32_t(std::lround(65535 * srgb(float(i) / 1023))), 2);
        return text;
    }
    static std::string srgbParameters() {
        std::string text = "para" + number(0) + number(3 << 16);
        for (double v : {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045})
            text += number(uint32_t(std::lround(v * 65536)));
        return text;
    }
    Attributes tagged(const std::string& space) const {
        std::string table = number(uint32_t(tags.size())), data;
        for (const auto& tag : tags) {
            table += tag.first + number(uint32_t(132 + 12 * tags.size() + data.size())) +
                     number(uint32_t(tag.second.size()));
            data += tag.second;
        }
        std::string all = bytes + table + data;
        all.replace(16, 4, space).replace(12, 4, "mntr").replace(20, 4, "XYZ ");
        all.replace(68, 12, xyz(0.9642, 1.0, 0.8249).substr(8)); // D50
        all.replace(0, 4, number(uint32_t(all.size()))).replace(8, 4, number(0x02400000));
        return [all](OIIO::ImageSpec& spec) {
            spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(all.size())),
                           all.data());
        };
    }
    /// @param white scale of the colorants of Rec.709, or those of Adobe RGB (1998), under D50
    static Attributes rgb(const std::string& curve, bool adobe = false) {
        Profile p;
        p.tags = {{"rXYZ", adobe ? xyz(0.60974, 0.31111, 0.01947) : xyz(0.43607, 0.22249, 0.01392)},
                  {"gXYZ", adobe ? xyz(0.20528, 0.62567, 0.06087) : xyz(0.38515, 0.71687, 0.09708)},
                  {"bXYZ", adobe ? xyz(0.14919, 0.06322, 0.74457) : xyz(0.14307, 0.06061, 0.71410)},
                  {"rTRC", curve},
                  {"gTRC", curve},
                  {"bTRC", curve}};
        return p.tagged("RGB ");
    }
    static Attributes grey(const std::string& curve) {
        Profile p;
        p.tags = {{"kTRC", curve}};
        return p.tagged("GRAY");
    }
};

class FileTags : public TextureTest {};

} // namespace

TEST_F(FileTags, AutoFollowsWhatTheFileSays) {
    const float b = 128 / 255.0f;
    const auto claims = [](const char* space) {
        return [=](OIIO::ImageSpec& spec) { spec.attribute("oiio:ColorSpace", space); };
    };
    const Attributes exif = [](OIIO::ImageSpec& spec) { spec.attribute("Exif:ColorSpace", 1); };
    const std::vector<float> grey = {b}, rgb = {b, b, b}, greyAlpha = {b, b};
    const float srgbB = srgb(b), coarse = 2e-3f; // a JPEG's rounding, a profile's of its curve
    struct {
        const char* file;
        std::vector<float> channels;
        OIIO::TypeDesc type;
        Attributes tag;
        float expected, tolerance;
    } cases[] = {
        {"c16.png", rgb, OIIO::TypeUInt16, claims("sRGB"), srgbB, 1e-5f},
        {"g8.png", grey, OIIO::TypeUInt8, claims("sRGB"), srgbB, 1e-5f},
        {"ga8.png", greyAlpha, OIIO::TypeUInt8, claims("sRGB"), srgbB, 1e-5f},
        {"c8linear.png", rgb, OIIO::TypeUInt8, claims("Linear"), b, 1e-5f},
        {"c16gamma22.png", rgb, OIIO::TypeUInt16, claims("GammaCorrected2.2"), srgbB, 1e-5f},
        {"c8gamma18.png", rgb, OIIO::TypeUInt8, claims("GammaCorrected1.8"), std::pow(b, 1.8f),
         1e-4f},
        {"icc16.png", rgb, OIIO::TypeUInt16, Profile::rgb(Profile::srgbTable()), srgbB, 1e-5f},
        {"icc8linear.png", rgb, OIIO::TypeUInt8, Profile::rgb(Profile::gamma(1)), b, 1e-5f},
        {"iccGrey.tif", grey, OIIO::TypeUInt8, Profile::grey(Profile::gamma(2.2)),
         std::pow(b, 2.2f), 1e-3f},
        {"icc.jpg", grey, OIIO::TypeUInt8, Profile::grey(Profile::srgbParameters()), srgbB, coarse},
        {"icc.tif", rgb, OIIO::TypeUInt16, Profile::rgb(Profile::srgbParameters()), srgbB, 1e-5f},
        {"exif.tif", rgb, OIIO::TypeUInt16, exif, srgbB, 1e-5f},
        {"exif.jpg", grey, OIIO::TypeUInt8, exif, srgbB, coarse},
    };
    for (auto& k : cases) {
        writeConstant(temp.file(k.file), 4, 4, k.channels, k.type, k.tag);
        EXPECT_NEAR(middle(open(temp.file(k.file))).g, k.expected, k.tolerance) << k.file;
        EXPECT_NEAR(middle(open(temp.file(k.file), "raw")).g, b, 1e-3f) << k.file;
    }
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(FileTags, AutoFollowsPrimaries) {
    const float ap1[8] = {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f};
    const auto chromaticities = [&](OIIO::ImageSpec& spec) {
        spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), ap1);
    };
    const std::vector<float> color = {0.5f, 0.25f, 0.125f};
    const auto compare = [&](const char* file, const char* same, float tolerance) {
        const glm::vec4 expected = middle(open(temp.file(file), same));
        EXPECT_LT(glm::length(middle(open(temp.file(file))) - expected), tolerance) << file;
        EXPECT_GT(glm::length(expected - middle(open(temp.file(file), "raw"))), 0.05f) << file;
    };
    writeConstant(temp.file("ap1.exr"), 4, 4, color, OIIO::TypeFloat, chromaticities);
    compare("ap1.exr", "lin_ap1", 1e-5f);
    writeConstant(temp.file("adobe.tif"), 4, 4, color, OIIO::TypeUInt16,
                  Profile::rgb(Profile::gamma(563 / 256.0), true));
    compare("adobe.tif", "adobergb", 1e-3f);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST_F(FileTags, ProfilesThatAreNotFollowedAreTold) {
    writeConstant(temp.file("odd.tif"), 4, 4, {0.5f, 0.5f, 0.5f}, OIIO::TypeUInt16,
                  Profile::rgb("curv" + Profile::number(0) + Profile::number(3) +
                               Profile::number(0, 2) + Profile::number(9, 2) +
                               Profile::number(65535, 2)));
    EXPECT_NEAR(middle(open(temp.file("odd.tif"))).g, 0.5f, 1e-4f);
    EXPECT_TRUE(has(onlyMessage(diagnostics), "its ICC profile is none of a matrix and an"));
    // Broken ones, of every length, are no reason to read beyond their end.
    std::string bytes =
        Profile().bytes + Profile::number(90) + "rXYZ" + Profile::number(0xfffffff0);
    for (size_t size = 0; size <= bytes.size(); ++size) {
        std::vector<uint8_t> exact(bytes.begin(), bytes.begin() + std::ptrdiff_t(size));
        EXPECT_EQ(spaceOfIccProfile(exact.data(), size), "");
    }
}

TEST_F(FileTags, WrapModesOfTheFile) {
    const auto write = [&](const char* file, const char* modes) {
        OIIO::ImageSpec spec(2, 2, 1, OIIO::TypeHalf);
        if (modes) spec.attribute("wrapmodes", modes);
        writeImage(temp.file(file), spec, {1, 2, 3, 4});
    };
    const auto tiling = [&](const char* file, bool own) {
        TextureRequest request = requestOf(temp.file(file), "raw");
        request.wrapS = request.wrapT = TextureWrap::Black;
        request.ownWrapS = request.ownWrapT = own;
        return textures.tiling(textures.open(request));
    };
    struct {
        const char *file, *modes;
        TextureWrap s, t;
    } cases[] = {{"both.exr", "periodic,periodic", TextureWrap::Repeat, TextureWrap::Repeat},
                 {"two.exr", "clamp, mirror", TextureWrap::Clamp, TextureWrap::Mirror},
                 {"one.exr", "mirror", TextureWrap::Mirror, TextureWrap::Mirror},
                 {"black.exr", "black,clamp", TextureWrap::Black, TextureWrap::Clamp},
                 {"odd.exr", "sideways,periodic", TextureWrap::Black, TextureWrap::Repeat},
                 {"none.exr", nullptr, TextureWrap::Black, TextureWrap::Black},
                 {"both.tif", "periodic,clamp", TextureWrap::Repeat, TextureWrap::Clamp}};
    for (auto& k : cases) {
        write(k.file, k.modes);
        EXPECT_EQ(tiling(k.file, true).wrapS, k.s) << k.file;
        EXPECT_EQ(tiling(k.file, true).wrapT, k.t) << k.file;
        EXPECT_EQ(tiling(k.file, false).wrapS, TextureWrap::Black) << k.file;
    }
    EXPECT_EQ(diagnostics.count(), 0);
}

} // namespace patina
