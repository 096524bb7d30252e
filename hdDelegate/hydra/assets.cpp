// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/assets.h"

#include <pxr/usd/ar/asset.h>
#include <pxr/usd/ar/packageUtils.h>
#include <pxr/usd/ar/resolvedPath.h>
#include <pxr/usd/ar/resolver.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stdlib.h>

namespace patina {

namespace {

namespace fs = std::filesystem;

const std::string UDIM = "<UDIM>";

class Copies {
public:
    ~Copies() {
        std::error_code ignored;
        if (!_folder.empty()) fs::remove_all(_folder, ignored);
    }

    std::string copyOf(const std::string& path) {
        const std::lock_guard<std::mutex> lock(_mutex);
        const auto known = _copies.find(path);
        if (known != _copies.end()) return known->second;
        const std::string copy = write(path);
        // A file that cannot be read now may be there later, when the host asks again.
        if (!copy.empty()) _copies[path] = copy;
        return copy;
    }

private:
    std::string write(const std::string& path) {
        const std::shared_ptr<ArAsset> asset = ArGetResolver().OpenAsset(ArResolvedPath(path));
        const std::shared_ptr<const char> data = asset ? asset->GetBuffer() : nullptr;
        if (!data) return {};
        if (_folder.empty()) _folder = makeFolder();
        if (_folder.empty()) return {};
        const auto [package, inner] = ArSplitPackageRelativePathInner(path);
        const std::string all = inner.empty() ? package : inner;
        // File systems take 255 bytes.
        constexpr size_t longest = 240;
        std::string name = fs::path(all).filename().string();
        name.erase(0, name.size() - std::min(name.size(), longest));
        // One folder per folder of a package: tiles stay together, equal names of others apart.
        const std::string from = (inner.empty() ? std::string() : package) + "\n" +
                                 all.substr(0, all.size() - name.size());
        if (name.empty() || name == "." || name == "..") name = "file";
        const fs::path folder = _folder / std::to_string(std::hash<std::string>{}(from));
        std::error_code error;
        fs::create_directories(folder, error);
        const fs::path file = folder / name;
        std::ofstream out(file, std::ios::binary);
        out.write(data.get(), std::streamsize(asset->GetSize()));
        out.close();
        return out ? file.string() : std::string();
    }

    static fs::path makeFolder() {
        std::error_code error;
        std::string pattern = (fs::temp_directory_path(error) / "patina-XXXXXX").string();
        return !error && ::mkdtemp(pattern.data()) ? fs::path(pattern)
                                                   : fs::path(); // the user's alone
    }

    std::mutex _mutex;
    std::map<std::string, std::string> _copies; // by asset
    fs::path _folder;
};

Copies& copies() {
    static Copies all;
    return all;
}

bool needsCopy(const std::string& path) {
    std::error_code error;
    return ArIsPackageRelativePath(path) || !fs::exists(path, error);
}

std::string tilesOf(const std::string& path) {
    if (!ArIsPackageRelativePath(path)) return path;
    std::string found;
    const size_t at = path.rfind(UDIM);
    for (int tile = 1001; tile <= 1100; ++tile) {
        std::string one = path;
        const std::string number = std::to_string(tile);
        std::string copy = copies().copyOf(one.replace(at, UDIM.size(), number));
        const size_t place = copy.rfind(number);
        if (!copy.empty() && place != std::string::npos)
            found = copy.replace(place, number.size(), UDIM);
    }
    return found.empty() ? path : found;
}

} // namespace

std::string fileOf(const SdfAssetPath& asset) {
    const std::string& path =
        asset.GetResolvedPath().empty() ? asset.GetAssetPath() : asset.GetResolvedPath();
    if (path.empty()) return path;
    if (path.find(UDIM) != std::string::npos) return tilesOf(path);
    if (!needsCopy(path)) return path;
    const std::string copy = copies().copyOf(path);
    return copy.empty() ? path : copy;
}

} // namespace patina
