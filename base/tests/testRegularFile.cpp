// SPDX-License-Identifier: Apache-2.0
// Only regular files of a bounded size are read.
#include "base/regularFile.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

using namespace patina;

namespace {

class RegularFile : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = testing::TempDir() + "patinaFilesXXXXXX";
        ASSERT_NE(::mkdtemp(&pattern[0]), nullptr);
        folder = pattern + "/";
        std::ofstream(folder + "ten") << "0123456789";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string reasonOf(const std::string& path, uint64_t maximum = 100) {
        std::string bytes = "left over", problem;
        EXPECT_FALSE(readRegularFile(path, maximum, bytes, problem)) << path;
        EXPECT_TRUE(bytes.empty());
        EXPECT_FALSE(whyUnreadable(path, maximum).empty()) << path;
        return problem;
    }

    std::string folder;
};

TEST_F(RegularFile, IsReadWhole) {
    std::string bytes, problem = "left over";
    EXPECT_TRUE(readRegularFile(folder + "ten", 10, bytes, problem));
    EXPECT_EQ(bytes, "0123456789");
    EXPECT_EQ(problem, "");
    EXPECT_EQ(whyUnreadable(folder + "ten", 10), "");
    ASSERT_EQ(::symlink((folder + "ten").c_str(), (folder + "link").c_str()), 0);
    EXPECT_TRUE(readRegularFile(folder + "link", 10, bytes, problem));
    EXPECT_EQ(bytes, "0123456789");
}

TEST_F(RegularFile, IsRefusedBeyondTheBound) {
    EXPECT_EQ(reasonOf(folder + "ten", 9), "holds 10 bytes; at most 9 are read");
    // Files whose size is not told are bounded too.
    std::string bytes, problem;
    EXPECT_FALSE(readRegularFile("/proc/self/maps", 9, bytes, problem));
    EXPECT_EQ(problem, "holds more bytes than the 9 that are read");
}

TEST_F(RegularFile, NothingElseIsRead) {
    ASSERT_EQ(::mkfifo((folder + "pipe").c_str(), 0600), 0);
    ASSERT_EQ(::symlink("loop", (folder + "loop").c_str()), 0);
    ASSERT_EQ(::symlink("/dev/zero", (folder + "zero").c_str()), 0);
    EXPECT_EQ(reasonOf(folder + "pipe"), "is a named pipe, not a regular file"); // would wait
    EXPECT_EQ(reasonOf("/dev/zero"), "is a device, not a regular file");         // has no end
    EXPECT_EQ(reasonOf(folder + "zero"), "is a device, not a regular file");
    EXPECT_EQ(reasonOf(folder), "is a folder, not a regular file");
    EXPECT_EQ(reasonOf(folder + "none"), "does not exist");
    EXPECT_EQ(reasonOf(folder + "loop").rfind("cannot be opened: ", 0), 0u);
}

// The reader of DICOM looks through all of them.
TEST_F(RegularFile, ZerosAreNoImage) {
    std::ofstream(folder + "zeros") << "";
    std::filesystem::resize_file(folder + "zeros", uint64_t(20)
                                                       << 30); // without a block on the disk
    EXPECT_EQ(whyNoImage(folder + "zeros"), "is no image: it begins with zeros");
    EXPECT_EQ(whyNoImage(folder + "ten"), "");
    EXPECT_EQ(whyNoImage(folder + "none"), "does not exist");
}

} // namespace
