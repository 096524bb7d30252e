#include "materialNetwork/mtlx/document.h"

#include "materialNetwork/expand.h"
#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/parser.h"
#include "materialNetwork/mtlx/upgrade.h"

#include <fstream>
#include <sstream>

namespace patina {

bool parseMtlx(const std::string& text, const std::string& path, bool wantMaterials,
               MtlxDocument& out, Diagnostics& diagnostics) {
    pugi::xml_document xml;
    const pugi::xml_parse_result result = xml.load_buffer(text.data(), text.size());
    if (!result) {
        diagnostics.warn(path, "",
                         std::string("not readable as XML: ") + result.description() +
                             "; the document is ignored");
        return false;
    }
    pugi::xml_node root = xml.child("materialx");
    if (!root) {
        diagnostics.warn(path, "", "no <materialx> element; the document is ignored");
        return false;
    }
    includeDocuments(root, path, diagnostics);
    upgradeDocument(root, path, diagnostics);
    MtlxParser(path, diagnostics).parse(root, wantMaterials, out);
    return true;
}

std::vector<Network> readMtlx(const std::string& path, Diagnostics& diagnostics) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        diagnostics.warn(path, "", "the file cannot be opened");
        return {};
    }
    std::ostringstream text;
    text << stream.rdbuf();
    MtlxDocument document;
    if (!parseMtlx(text.str(), path, true, document, diagnostics)) return {};
    const auto find = [&](const std::string& id) -> const ShadingModel* {
        for (const ShadingModel& model : document.models)
            if (model.def.id == id) return &model;
        return nullptr;
    };
    for (Network& network : document.materials)
        network = expand(network, find, diagnostics);
    return document.materials;
}

} // namespace patina
