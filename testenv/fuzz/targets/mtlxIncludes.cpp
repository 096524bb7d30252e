// SPDX-License-Identifier: Apache-2.0
// MaterialX documents that include each other: bytes of value 1 part them. An @ stands for their
// folder, for names that are absolute. What is no document lies beside them.
#include "base/limits.h"
#include "base/utf8.h"
#include "materialNetwork/mtlx/document.h"
#include "testenv/fuzz/targets/inputLimits.h"
#include "testenv/fuzz/targets/scratchFiles.h"
#include "testenv/fuzz/targets/targets.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>

#include <sys/stat.h>
#include <unistd.h>

namespace patina {

namespace {

const char* const names[] = {"0.mtlx", "1.mtlx", "2.mtlx", "in/3.mtlx", "in/4.mtlx", "in/in/5"};

/// Documents in a folder with a pipe, a device, a folder, and links up, to nothing and to itself.
class Folder {
public:
    Folder() {
        namespace fs = std::filesystem;
        const fs::path folder = _files.folder();
        fs::create_directories(folder / "in/in");
        fs::create_symlink("..", folder / "in/up");
        fs::create_symlink("/dev/zero", folder / "device");
        fs::create_symlink("none", folder / "nothing");
        fs::create_symlink("itself", folder / "itself");
        fs::create_symlink("1.mtlx", folder / "link");
        if (::mkfifo((folder / "pipe").c_str(), 0600) != 0) std::abort();
    }

    /// @returns the path of the first document
    std::string fill(const std::string& bytes) {
        size_t at = 0;
        for (size_t i = 0; i < std::size(names); ++i) {
            const char* const name = names[i];
            const size_t end = std::min(bytes.find('\1', at), bytes.size());
            const std::string text =
                at > bytes.size() ? "" : withFolder(bytes.substr(at, end - at));
            if (at > bytes.size())
                ::unlink((_files.folder() + "/" + name).c_str());
            else if (text != _last[i] || text.empty())
                _files.write(name, text.data(), text.size());
            _last[i] = text; // most inputs differ in one of them from the input before
            at = end + 1;
        }
        return _files.folder() + "/" + names[0];
    }

private:
    std::string withFolder(const std::string& text) const {
        std::string all;
        for (char c : text)
            c == '@' ? all += _files.folder() : all += c;
        return all;
    }

    ScratchFiles _files;
    std::string _last[std::size(names)];
};

void must(bool holds, const char* promise) {
    if (holds) return;
    std::fprintf(stderr, "promise broken: %s\n", promise);
    std::abort();
}

} // namespace

} // namespace patina

bool fuzzMtlxIncludes(const uint8_t* data, size_t size) {
    using namespace patina;
    limitInputs();
    static Folder folder;
    const std::string path = folder.fill(std::string(reinterpret_cast<const char*>(data), size));
    Diagnostics diagnostics;
    const std::vector<Network> materials = readMtlx(path, diagnostics);
    size_t includes = 0;
    for (const Diagnostic& warning : diagnostics.all()) {
        if (warning.message.find("included document '") == 0) ++includes;
        const std::string shown = validUtf8(warning.message);
        must(validUtf8(shown) == shown, "what is shown is UTF-8");
    }
    must(includes <= limitOf(Limit::includes) + 1,
         "as many documents are included as the limit says");
    const std::vector<std::string> files = documentFiles(path);
    must(files.size() <= 1 + limitOf(Limit::includes) && files.front() == path,
         "the files of a document are told");
    return !materials.empty();
}
