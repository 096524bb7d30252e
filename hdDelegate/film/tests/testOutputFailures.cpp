#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/tests/tempFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include <unistd.h>

namespace patina {

namespace {

std::string reasonOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string contentOf(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

Film& smallFilm(Film& film) {
    film.reset(4, 4, {standardAov("depth")});
    film.addColor(0, 0, {1, 1, 1}, 1);
    return film;
}

} // namespace

TEST(OutputFailures, HaveReasonsOfOneLineThatNameThePath) {
    TempFolder temp;
    Film film, empty;
    smallFilm(film);
    empty.reset(0, 0, {});
    struct {
        std::string path, part;
    } cases[] = {{temp.file("a.xyz"), ".xyz"},
                 {temp.file("a"), "no extension"},
                 {temp.file("a.term"), ".term"},
                 {temp.file("no/folder/a.exr"), "does not exist"},
                 {temp.file("no/folder/a.png"), "does not exist"},
                 {"", "extension"}};
    for (auto& c : cases) {
        std::string reason = reasonOf([&] { writeImage(film, c.path); });
        EXPECT_TRUE(has(reason, c.part) && has(reason, c.path)) << reason;
        EXPECT_FALSE(has(reason, "\n")) << reason;
        EXPECT_FALSE(reasonOf([&] { checkImagePath(c.path); }).empty()) << c.path;
    }
    std::filesystem::create_directory(temp.file("folder.exr"));
    EXPECT_TRUE(has(reasonOf([&] { writeImage(film, temp.file("folder.exr")); }), "folder"));
    EXPECT_TRUE(has(reasonOf([&] { writeImage(empty, temp.file("a.exr")); }), "0x0"));
    EXPECT_TRUE(has(reasonOf([&] { writeImage(empty, temp.file("a.png")); }), "0x0"));
    ImageOptions options;
    options.aovs = {"color", "depth"};
    EXPECT_TRUE(has(reasonOf([&] { writeImage(film, temp.file("a.png"), options); }), "depth"));
    EXPECT_TRUE(has(reasonOf([&] { checkImagePath(temp.file("a.png"), {"depth"}); }), "depth"));
    EXPECT_TRUE(has(reasonOf([&] { checkImagePath(temp.file("a.exr"), {"glitter"}); }), "glitter"));
    options = {};
    options.bits = 12;
    EXPECT_TRUE(has(reasonOf([&] { writeImage(film, temp.file("a.png"), options); }), "12"));
    EXPECT_EQ(temp.fileCount(), 1u) << "only the folder of this test";
    EXPECT_EQ(reasonOf([&] { checkImagePath(temp.file("a.exr"), {"depth", "primvars:st"}); }), "");
    EXPECT_EQ(temp.fileCount(), 1u) << "checking leaves nothing";
}

TEST(OutputFailures, LeaveTheOldImage) {
    TempFolder temp;
    Film film, empty;
    smallFilm(film);
    empty.reset(0, 0, {});
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        std::string file = temp.file(name);
        writeImage(film, file);
        std::string before = contentOf(file);
        ASSERT_FALSE(before.empty());
        EXPECT_THROW(writeImage(empty, file), std::runtime_error);
        ImageOptions options;
        options.display = "Cinema";
        options.aovs = {"color", "glitter"};
        EXPECT_THROW(writeImage(film, file, options), std::runtime_error);
        EXPECT_EQ(contentOf(file), before) << name;
    }
    EXPECT_EQ(temp.fileCount(), 3u);
}

TEST(OutputFailures, ReplacedImagesKeepTheirPermissionsAndLinks) {
    TempFolder temp;
    Film film;
    smallFilm(film);
    writeImage(film, temp.file("real.png"));
    std::filesystem::permissions(temp.file("real.png"), std::filesystem::perms(0640));
    std::filesystem::create_symlink("real.png", temp.file("link.png"));
    writeImage(film, temp.file("link.png"));
    EXPECT_TRUE(std::filesystem::is_symlink(temp.file("link.png")));
    EXPECT_EQ(std::filesystem::status(temp.file("real.png")).permissions(),
              std::filesystem::perms(0640));
}

TEST(OutputFailures, UnwritableFolder) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    TempFolder temp;
    Film film;
    smallFilm(film);
    std::filesystem::create_directory(temp.file("locked"));
    std::filesystem::permissions(temp.file("locked"), std::filesystem::perms(0555));
    EXPECT_THROW(writeImage(film, temp.file("locked/a.exr")), std::runtime_error);
}

TEST(OutputFailures, ReadingNamesWhatIsWrong) {
    TempFolder temp;
    Film film;
    film.reset(64, 64, {});
    writeImage(film, temp.file("good.exr"));
    std::string good = contentOf(temp.file("good.exr"));
    std::ofstream(temp.file("cut.exr"), std::ios::binary) << good.substr(0, good.size() / 2);
    std::ofstream(temp.file("text.png")) << "hello";
    for (const char* name : {"cut.exr", "text.png", "absent.png"}) {
        std::string reason = reasonOf([&] { readImage(temp.file(name)); });
        EXPECT_TRUE(has(reason, name)) << reason;
        EXPECT_FALSE(has(reason, "\n")) << reason;
    }
}

} // namespace patina
