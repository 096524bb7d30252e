// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/mtlx/document.h"
#include "materialNetwork/tests/patternFixture.h"

#include <filesystem>
#include <fstream>

#include <stdlib.h>

namespace patina {

inline const std::string version138 = "version='1.38'", version139 = "version='1.39'";

/// A folder of documents that lives as long as the test.
class Documents {
public:
    Documents() {
        std::string pattern = testing::TempDir() + "patinaMtlxXXXXXX";
        EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
        _folder = pattern + "/";
    }
    ~Documents() { std::filesystem::remove_all(_folder); }
    std::string path(const std::string& name) const { return _folder + name; }
    void writeText(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
        std::ofstream(path(name)) << text;
    }
    void write(const std::string& name, const std::string& body,
               const std::string& attributes = version139) const {
        writeText(name,
                  "<?xml version='1.0'?>\n<materialx " + attributes + ">" + body + "</materialx>");
    }
    std::vector<Network> read(const std::string& name, Diagnostics& diagnostics,
                              double metersPerUnit = 1.0) const {
        return readMtlx(path(name), diagnostics, metersPerUnit);
    }

private:
    std::string _folder;
};

/// A test of documents. The one that is read is called main.mtlx.
class MtlxTest : public testing::Test {
protected:
    std::vector<Network> read(const std::string& body, const std::string& attributes = version139) {
        documents.write("main.mtlx", body, attributes);
        return documents.read("main.mtlx", diagnostics);
    }
    /// Materials whose definitions are not expanded yet.
    std::vector<Network> parse(const std::string& body,
                               const std::string& attributes = version139) {
        MtlxDocument document;
        EXPECT_TRUE(parseMtlx("<materialx " + attributes + ">" + body + "</materialx>", "main.mtlx",
                              true, document, diagnostics));
        return document.materials;
    }
    testing::AssertionResult reported(const std::string& text) const {
        return told(diagnostics, text);
    }

    Documents documents;
    Diagnostics diagnostics;
};

/// The only material of a document about which there is nothing to say.
inline Network readOne(const std::string& body, const std::string& attributes = version139) {
    const Documents documents;
    documents.write("main.mtlx", body, attributes);
    Diagnostics diagnostics;
    const auto networks = documents.read("main.mtlx", diagnostics);
    EXPECT_TRUE(nothingTold(diagnostics));
    EXPECT_EQ(networks.size(), 1u);
    return networks.empty() ? Network() : networks[0];
}

inline std::string inputOf(const std::string& name, const std::string& type,
                           const std::string& value) {
    return "<input name='" + name + "' type='" + type + "' value='" + value + "'/>";
}

inline std::string inputFrom(const std::string& name, const std::string& type,
                             const std::string& node) {
    return "<input name='" + name + "' type='" + type + "' nodename='" + node + "'/>";
}

inline std::string constantOf(const std::string& name, const std::string& type,
                              const std::string& value) {
    return "<constant name='" + name + "' type='" + type + "'>" + inputOf("value", type, value) +
           "</constant>";
}

/// Node "p", a color3 of another type's node.
inline std::string convertOf(const std::string& type, const std::string& node) {
    return "<convert name='p' type='color3'>" + inputFrom("in", type, node) + "</convert>";
}

/// A definition ND_ID, and its graph NG_ID, whose output is node "c".
/// @param inside inputs and tokens of the definition; @param body nodes of the graph
inline std::string definition(const std::string& id, const std::string& category,
                              const std::string& inside, const std::string& body,
                              const std::string& type = "color3",
                              const std::string& attributes = "") {
    return "<nodedef name='ND_" + id + "' node='" + category + "' " + attributes + ">" + inside +
           "<output name='out' type='" + type + "'/></nodedef><nodegraph name='NG_" + id +
           "' nodedef='ND_" + id + "'>" + body + "<output name='out' type='" + type +
           "' nodename='c'/></nodegraph>";
}

/// A surface whose BSDF is node NAME of a document.
inline std::string surfaceOfBsdf(const std::string& name) {
    return "<surface name='s' type='surfaceshader'>" + inputFrom("bsdf", "BSDF", name) +
           "</surface>";
}

/// A diffuse surface whose colour is node NAME of a document.
inline std::string surfaceOfColor(const std::string& name) {
    return "<oren_nayar_diffuse_bsdf name='d' type='BSDF'>" + inputFrom("color", "color3", name) +
           "</oren_nayar_diffuse_bsdf>" + surfaceOfBsdf("d");
}

inline std::string materialOf(const std::string& shader, const std::string& name = "M") {
    return "<surfacematerial name='" + name + "' type='material'>" +
           inputFrom("surfaceshader", "surfaceshader", shader) + "</surfacematerial>";
}

/// The emission of a surface whose light is node "p" of a document, a color3.
inline glm::vec3 lightOf(const std::string& body, const ShadingPoint& point = {},
                         std::map<std::string, glm::vec4> primvars = {},
                         const std::string& attributes = version139) {
    return emitted(readOne(body + "<uniform_edf name='e' type='EDF'>" +
                               inputFrom("color", "color3", "p") +
                               "</uniform_edf><surface name='s' type='surfaceshader'>" +
                               inputFrom("edf", "EDF", "e") + "</surface>",
                           attributes),
                   point, std::move(primvars));
}

} // namespace patina
