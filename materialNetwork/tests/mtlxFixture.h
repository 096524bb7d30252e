// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/mtlx/document.h"
#include "materialNetwork/tests/patternFixture.h"

#include <filesystem>
#include <fstream>

namespace patina {

/// A folder of documents that lives as long as the test.
class Documents {
public:
    explicit Documents(const std::string& name)
        : _folder(std::filesystem::path(testing::TempDir()) / name) {
        std::filesystem::remove_all(_folder);
        std::filesystem::create_directories(_folder / "sub");
    }
    ~Documents() { std::filesystem::remove_all(_folder); }
    void write(const std::string& name, const std::string& body) const {
        std::ofstream(_folder / name) << "<?xml version=\"1.0\"?>\n" << body;
    }
    std::vector<Network> read(const std::string& name, Diagnostics& diagnostics,
                              double metersPerUnit = 1.0) const {
        return readMtlx((_folder / name).string(), diagnostics, metersPerUnit);
    }

private:
    std::filesystem::path _folder;
};

inline std::vector<Network> readBody(const std::string& body, Diagnostics& diagnostics,
                                     const std::string& version = "1.38") {
    const Documents documents("patinaBody");
    documents.write("a.mtlx", "<materialx version=\"" + version + "\">" + body + "</materialx>");
    return documents.read("a.mtlx", diagnostics);
}

/// The emission of a surface whose light is node "p" of a document, a color3.
inline glm::vec3 lightOf(const std::string& body, ShadingPoint point = {},
                         std::map<std::string, glm::vec4> primvars = {},
                         const std::string& version = "1.38") {
    Diagnostics diagnostics;
    const auto networks = readBody(body + R"(<uniform_edf name="e" type="EDF">
          <input name="color" type="color3" nodename="p" /></uniform_edf>
          <surface name="s" type="surfaceshader">
          <input name="edf" type="EDF" nodename="e" /></surface>)",
                                   diagnostics, version);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
    EXPECT_EQ(networks.size(), 1u);
    return networks.empty() ? glm::vec3(-1) : emitted(networks[0], point, std::move(primvars));
}

} // namespace patina
