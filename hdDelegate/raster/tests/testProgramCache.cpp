// SPDX-License-Identifier: Apache-2.0
// Programs come back from disk as they went there; what is damaged is made anew.

#include "hdDelegate/raster/gl/programCache.h"
#include "hdDelegate/film/tests/tempFolder.h"
#include "hdDelegate/raster/tests/rasterFixture.h"
#include "base/tests/testTools.h"

#include <chrono>
#include <cstdlib>

#include <sys/stat.h>

using namespace patina;
namespace fs = std::filesystem;

namespace {

class ProgramCaches : public testing::Test {
protected:
    void SetUp() override { setenv("PATINA_CACHE", _root.c_str(), 1); }
    void TearDown() override { unsetenv("PATINA_CACHE"); }
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        std::error_code error;
        for (const auto& entry : fs::recursive_directory_iterator(_root, error))
            if (entry.is_regular_file()) found.push_back(entry.path());
        return found;
    }
    TempFolder _temp;
    const fs::path _root = _temp.path();
};

std::unique_ptr<GlProgram> make(int value) {
    return computeProgram("test", "layout(local_size_x = 1) in;\n"
                                  "layout(std430, binding = 0) buffer Result { int result; };\n"
                                  "void main() { result = " +
                                      std::to_string(value) + " + int(gl_WorkGroupID.y); }\n");
}

int run(const GlProgram& program) {
    const GlBuffer result(16, nullptr);
    result.bindStorage(0);
    return computed<int>(program, 1, result, 1)[0];
}

#define PATINA_NEED_BINARIES()                                                                     \
    GLint formats = 0;                                                                             \
    gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);                                       \
    if (formats < 1) GTEST_SKIP() << "the driver gives no program binaries"

} // namespace

TEST_F(ProgramCaches, ComesBackFromDisk) {
    PATINA_NEED_CONTEXT();
    PATINA_NEED_BINARIES();
    const auto first = make(41);
    EXPECT_FALSE(first->isFromCache());
    ASSERT_EQ(files().size(), 1u);
    const auto second = make(41), other = make(42);
    EXPECT_TRUE(second->isFromCache());
    EXPECT_FALSE(other->isFromCache());
    EXPECT_EQ(run(*first), 41);
    EXPECT_EQ(run(*second), 41);
    EXPECT_EQ(run(*other), 42);
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(ProgramCaches, DamagedFilesAreMadeAnew) {
    PATINA_NEED_CONTEXT();
    PATINA_NEED_BINARIES();
    make(7);
    ASSERT_EQ(files().size(), 1u);
    const fs::path file = files()[0];
    const auto size = fs::file_size(file);
    for (const size_t at : {size_t(0), size_t(12), size_t(25), size_t(33), size_t(size / 2)}) {
        std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
        out.seekg(std::streamoff(at));
        const char byte = char(out.get() ^ 0x5a);
        out.seekp(std::streamoff(at));
        out.put(byte);
        out.close();
        const auto program = make(7);
        EXPECT_FALSE(program->isFromCache()) << "byte " << at;
        EXPECT_EQ(run(*program), 7);
        EXPECT_TRUE(make(7)->isFromCache()) << "it is written again";
    }
    for (const size_t left : {size_t(0), size_t(20), size_t(size - 1)}) {
        fs::resize_file(file, left);
        EXPECT_FALSE(make(7)->isFromCache()) << left << " bytes";
    }
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST_F(ProgramCaches, CanBeOffAndUnwritable) {
    PATINA_NEED_CONTEXT();
    for (const char* folder : {"", "/proc/no/such/folder", "/dev/null/x"}) {
        setenv("PATINA_CACHE", folder, 1);
        make(3);
        const auto program = make(3);
        EXPECT_FALSE(program->isFromCache());
        EXPECT_EQ(run(*program), 3);
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(ProgramCaches, NobodyElseWritesTheUsersOwn) {
    PATINA_NEED_CONTEXT();
    PATINA_NEED_BINARIES();
    unsetenv("PATINA_CACHE");
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string kept = before ? before : "";
    setenv("XDG_CACHE_HOME", _root.c_str(), 1);
    const auto allowed = [](const fs::path& path) { return fs::status(path).permissions(); };
    const mode_t mask = ::umask(0);
    make(5);
    EXPECT_EQ(allowed(_root / "patina"), fs::perms::owner_all);
    EXPECT_EQ(allowed(_root / "patina" / "programs"), fs::perms::owner_all);
    fs::permissions(_root / "patina", fs::perms::all); // as earlier versions made it
    EXPECT_TRUE(make(5)->isFromCache());
    EXPECT_EQ(allowed(_root / "patina"), fs::perms(0755));
    ::umask(mask);
    if (before)
        setenv("XDG_CACHE_HOME", kept.c_str(), 1);
    else
        unsetenv("XDG_CACHE_HOME");
}

TEST_F(ProgramCaches, ManyWritersAtOnce) {
    {
        PATINA_NEED_CONTEXT();
        PATINA_NEED_BINARIES();
    }
    onThreads(3, [](int) {
        std::string error;
        const auto context = GlContext::create(error);
        ASSERT_TRUE(context) << error;
        const GlContext::Use use(*context);
        for (int i = 0; i < 12; ++i) {
            const auto program = make(100 + i % 4);
            EXPECT_EQ(run(*program), 100 + i % 4);
        }
    });
    EXPECT_EQ(files().size(), 4u) << "no temporary stays";
}

TEST_F(ProgramCaches, TheFolderStaysBounded) {
    const fs::path folder = _root / "programs";
    fs::create_directories(folder);
    const auto now = fs::file_time_type::clock::now();
    for (int i = 0; i < 10; ++i) {
        const fs::path file = folder / (std::to_string(i) + ".glprogram");
        std::ofstream(file) << std::string(1000, 'x');
        fs::last_write_time(file, now - std::chrono::hours(10 - i));
    }
    std::ofstream(folder / "someone's notes.txt") << std::string(5000, 'x');
    ProgramCache::trim(folder.string(), 10000);
    EXPECT_EQ(files().size(), 11u) << "the limit is met";
    ProgramCache::trim(folder.string(), 8000);
    EXPECT_EQ(files().size(), 7u) << "three quarters are left";
    EXPECT_FALSE(fs::exists(folder / "3.glprogram"));
    EXPECT_TRUE(fs::exists(folder / "4.glprogram"));
    EXPECT_TRUE(fs::exists(folder / "someone's notes.txt"));
    ProgramCache::trim((_root / "none").string(), 1);
}
