// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/temporaryFailure.h"
#include "hdDelegate/film/tests/filmFixtures.h"

#include <filesystem>

#include <csignal>

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace patina {

namespace {

struct SmallFilm : TestFilm {
    SmallFilm() : TestFilm(4, 4, {standardAov("depth")}) { addColor(0, 0, {1, 1, 1}, 1); }
};

/// Beyond a size writing fails, as it does on a disk that is full.
class FullDisk {
public:
    explicit FullDisk(size_t room) : _handler(std::signal(SIGXFSZ, SIG_IGN)) {
        EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &_before), 0);
        rlimit full = _before;
        full.rlim_cur = rlim_t(room);
        EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
    }
    ~FullDisk() {
        EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &_before), 0);
        std::signal(SIGXFSZ, _handler);
    }

private:
    void (*_handler)(int);
    rlimit _before;
};

} // namespace

TEST(OutputFailures, HaveReasonsOfOneLineThatNameThePath) {
    TempFolder temp;
    SmallFilm film;
    TestFilm empty(0, 0);
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
    SmallFilm film;
    TestFilm empty(0, 0);
    for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
        std::string file = temp.file(name);
        writeImage(film, file);
        std::string before = bytesOfFile(file);
        ASSERT_FALSE(before.empty());
        EXPECT_THROW(writeImage(empty, file), std::runtime_error);
        ImageOptions options;
        options.display = "Cinema";
        options.aovs = {"color", "glitter"};
        EXPECT_THROW(writeImage(film, file, options), std::runtime_error);
        EXPECT_EQ(bytesOfFile(file), before) << name;
    }
    EXPECT_EQ(temp.fileCount(), 3u);
}

TEST(OutputFailures, ReplacedImagesKeepTheirPermissionsAndLinks) {
    TempFolder temp;
    const SmallFilm film;
    writeImage(film, temp.file("real.png"));
    std::filesystem::permissions(temp.file("real.png"), std::filesystem::perms(06640));
    std::filesystem::create_symlink("real.png", temp.file("link.png"));
    writeImage(film, temp.file("link.png"));
    EXPECT_TRUE(std::filesystem::is_symlink(temp.file("link.png")));
    EXPECT_EQ(std::filesystem::status(temp.file("real.png")).permissions(),
              std::filesystem::perms(0640));
}

TEST(OutputFailures, WhatIsNoRegularFileStaysAsItIs) {
    TempFolder temp;
    const SmallFilm film;
    namespace fs = std::filesystem;
    ASSERT_EQ(::mkfifo(temp.file("pipe.png").c_str(), 0600), 0);
    fs::create_symlink("pipe.png", temp.file("toPipe.png"));
    fs::create_symlink("/dev/null", temp.file("toDevice.png"));
    fs::create_symlink("absent.png", temp.file("dangling.png"));
    fs::create_symlink("loop.png", temp.file("loop.png"));
    fs::create_symlink(".", temp.file("toFolder.png"));
    size_t expected = 6;
    if (::mknod(temp.file("device.png").c_str(), S_IFCHR | 0600, makedev(1, 3)) == 0)
        ++expected; // root alone may
    const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    temp.file("socket.png").copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ++expected;
    std::map<std::string, ino_t> before;
    for (auto& entry : fs::directory_iterator(temp.path())) {
        struct stat found;
        ASSERT_EQ(::lstat(entry.path().c_str(), &found), 0);
        before[entry.path().string()] = found.st_ino;
    }
    ASSERT_EQ(before.size(), expected);
    for (const auto& [file, number] : before) {
        const std::string name = file;
        for (const std::string& reason :
             {reasonOf([&] { checkImagePath(name); }), reasonOf([&] { writeImage(film, name); })})
            EXPECT_TRUE(has(reason, name + "': it is a ")) << reason;
        EXPECT_THROW(film.saveCheckpoint(name), std::runtime_error);
        struct stat found;
        ASSERT_EQ(::lstat(name.c_str(), &found), 0);
        EXPECT_EQ(found.st_ino, number) << name << " was replaced";
    }
    EXPECT_EQ(temp.fileCount(), expected);
    ::close(listener);
}

TEST(OutputFailures, AFullDiskKeepsTheOldImage) {
    TempFolder temp;
    TestFilm film(64, 64);
    ImageOptions options;
    options.compression = "none";
    const std::string file = temp.file("a.exr");
    std::ofstream(file) << "old";
    {
        const FullDisk full(4096);
        EXPECT_THROW(writeImage(film, file, options), std::runtime_error);
        EXPECT_THROW(film.saveCheckpoint(file), std::runtime_error);
    }
    EXPECT_EQ(bytesOfFile(file), "old");
    EXPECT_EQ(temp.fileCount(), 1u);
    writeImage(film, file, options);
    EXPECT_GT(std::filesystem::file_size(file), 4096u) << "the size that was too large";
}

TEST(OutputFailures, WhatMayPassIsToldFromWhatMayNot) {
    for (int error : {ENOSPC, EDQUOT, ENOMEM, ESTALE, EIO})
        EXPECT_THROW(failWith("x", error), TemporaryFailure);
    for (int error : {ENOENT, EACCES, EROFS, EISDIR, EFBIG})
        try {
            failWith("cannot write 'x'", error);
            FAIL() << error;
        } catch (const TemporaryFailure&) {
            ADD_FAILURE() << error << " does not pass by itself";
        } catch (const std::runtime_error& reported) {
            EXPECT_EQ(reported.what(), "cannot write 'x': " + std::string(std::strerror(error)));
        }
}

/// @param side of the image: a small one is held back by the stream until it is closed or sought in
void everyFormatTellsOfAFullDisk(int side) {
    TempFolder temp;
    ImageData image;
    image.width = image.height = side;
    image.channels = {"R", "G", "B"};
    for (int i = 0; i < side * side * 3; ++i) // noise: nothing that packs well
        image.pixels.push_back(float((i * 7919) % 1009) / 1009.0f);
    for (const char* format : {"exr", "png", "jpg", "tif", "hdr", "bmp", "tga", "webp", "gif",
                               "jp2", "ppm", "sgi", "rla"}) {
        const std::string file = temp.file(std::string("a.") + format);
        writePixels(image, file);
        const std::string whole = bytesOfFile(file);
        ASSERT_GT(whole.size(), 64u) << format;
        for (const size_t room : {size_t(16), whole.size() / 2}) {
            std::string reason;
            {
                const FullDisk full(room);
                reason = reasonOf([&] { writePixels(image, file); });
            }
            EXPECT_TRUE(has(reason, file)) << format << " " << room << " " << reason;
            EXPECT_EQ(bytesOfFile(file), whole) << format;
        }
        std::filesystem::remove(file);
    }
    EXPECT_EQ(temp.fileCount(), 0u);
}

TEST(OutputFailures, EveryFormatTellsOfAFullDisk) {
    everyFormatTellsOfAFullDisk(64);
    everyFormatTellsOfAFullDisk(8);
}

TEST(OutputFailures, TemporariesOfKilledProcessesAreRemoved) {
    TempFolder temp;
    // A process that is killed while it writes.
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        new AtomicFile(temp.file("a.exr"));
        ::raise(SIGKILL);
    }
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    ASSERT_EQ(temp.fileCount(), 1u);
    const std::string dead = std::to_string(child);
    std::ofstream(temp.file(".b." + dead + "-0.exr")) << "of another image";
    std::ofstream(temp.file(".a." + std::to_string(::getppid()) + "-0.exr")) << "still written";
    std::ofstream(temp.file(".a.2026-draft.exr")) << "no temporary";
    std::ofstream(temp.file(".a." + dead + "-05-01.exr")) << "a date";
    std::ofstream(temp.file("a." + dead + "-0.exr")) << "no temporary";
    {
        AtomicFile file(temp.file("a.exr"));
        EXPECT_EQ(temp.fileCount(), 6u); // this one's, and the five that are nobody's business
        AtomicFile second(temp.file("a.exr"));
        EXPECT_EQ(temp.fileCount(), 7u) << "two writers of a process live side by side";
    }
    EXPECT_EQ(temp.fileCount(), 5u);
    EXPECT_FALSE(std::filesystem::exists(temp.file(".a." + dead + "-0.exr")));
}

TEST(OutputFailures, LongNamesAreWritten) {
    TempFolder temp;
    const SmallFilm film;
    const std::string file = temp.file(std::string(251, 'n') + ".png"); // 255: the longest
    writeImage(film, file);
    EXPECT_FALSE(bytesOfFile(file).empty());
    EXPECT_EQ(temp.fileCount(), 1u);
}

TEST(OutputFailures, OnlyRegularFilesAreRead) {
    TempFolder temp;
    ASSERT_EQ(::mkfifo(temp.file("pipe.png").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", temp.file("zero.png"));
    Film film;
    for (const char* name : {"pipe.png", "zero.png"}) { // would wait, and would never end
        EXPECT_TRUE(has(reasonOf([&] { readImage(temp.file(name)); }), "not a regular file"));
        EXPECT_TRUE(
            has(reasonOf([&] { film.loadCheckpoint(temp.file(name)); }), "not a regular file"));
    }
}

TEST(OutputFailures, UnwritableFolder) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    TempFolder temp;
    const SmallFilm film;
    std::filesystem::create_directory(temp.file("locked"));
    std::filesystem::permissions(temp.file("locked"), std::filesystem::perms(0555));
    EXPECT_THROW(writeImage(film, temp.file("locked/a.exr")), std::runtime_error);
}

TEST(OutputFailures, ReadingNamesWhatIsWrong) {
    TempFolder temp;
    TestFilm film(64, 64);
    writeImage(film, temp.file("good.exr"));
    std::string good = bytesOfFile(temp.file("good.exr"));
    std::ofstream(temp.file("cut.exr"), std::ios::binary) << good.substr(0, good.size() / 2);
    std::ofstream(temp.file("text.png")) << "hello";
    for (const char* name : {"cut.exr", "text.png", "absent.png"}) {
        std::string reason = reasonOf([&] { readImage(temp.file(name)); });
        EXPECT_TRUE(has(reason, name)) << reason;
        EXPECT_FALSE(has(reason, "\n")) << reason;
    }
    std::ofstream(temp.file("huge.pgm")) << "P5\n70000 70000\n255\n";
    const std::string reason = reasonOf([&] { readImage(temp.file("huge.pgm")); });
    EXPECT_TRUE(has(reason, "huge.pgm") && has(reason, "--limit textureBytes")) << reason;
}

} // namespace patina
