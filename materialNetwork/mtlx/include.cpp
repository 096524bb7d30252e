// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/include.h"

#include "base/limits.h"
#include "materialNetwork/mtlx/xmlFile.h"
#include "base/regularFile.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <vector>

namespace patina {

namespace {

namespace fs = std::filesystem;

std::string canonical(const fs::path& path) {
    std::error_code error;
    const fs::path found = fs::weakly_canonical(path, error);
    return (error ? path.lexically_normal() : found).string();
}

class Includer {
public:
    /// @param markup of the document that includes, as markupOf()
    Includer(Diagnostics& diagnostics, size_t markup, std::vector<std::string>* files)
        : _diagnostics(diagnostics), _files(files), _markup(markup) {}

    void run(pugi::xml_node root, const std::string& path) {
        _open.insert(canonical(path));
        std::vector<pugi::xml_node> includes;
        for (const pugi::xml_node& child : root.children("xi:include"))
            includes.push_back(child);
        for (pugi::xml_node& include : includes) {
            replace(root, include, path);
            root.remove_child(include);
        }
        _open.erase(canonical(path));
    }

private:
    void replace(pugi::xml_node root, const pugi::xml_node& include, const std::string& path) {
        const std::string name = include.attribute("href").value();
        const fs::path file =
            fs::path(name).is_absolute() ? fs::path(name) : fs::path(path).parent_path() / name;
        const std::string target = file.lexically_normal().string();
        if (_open.count(canonical(target))) {
            _diagnostics.warn(path, "", messages::includesItself(name));
            return;
        }
        if (++_documents > limitOf(Limit::includes)) {
            _diagnostics.warn(path, "",
                              messages::includesTooMany(limitText(Limit::includes), name));
            return;
        }
        if (_open.size() > limitOf(Limit::includeDepth)) {
            _diagnostics.warn(path, "",
                              messages::includesTooDeep(limitText(Limit::includeDepth), name));
            return;
        }
        if (_files) _files->push_back(target);
        // Of all included documents together.
        const uint64_t maxBytes = limitOf(Limit::documentBytes), most = limitOf(Limit::markup);
        std::string text, problem;
        pugi::xml_document xml;
        if (readRegularFile(target, maxBytes - std::min(_bytes, maxBytes), text, problem) &&
            loadXml(text, xml, problem, most - std::min<uint64_t>(_markup, most)))
            _markup += markupOf(text);
        _bytes += text.size();
        const pugi::xml_node included = xml.child("materialx");
        if (problem.empty() && !included) problem = "is no MaterialX document";
        if (!problem.empty()) {
            _diagnostics.warn(path, "", messages::includeUnusable(name, problem));
            return;
        }
        run(included, target);
        for (const pugi::xml_node& child : included.children())
            if (child.type() == pugi::node_element)
                keep(root.insert_copy_before(child, include), included, target);
    }

    /// An element takes along what it had from its document.
    static void keep(pugi::xml_node element, const pugi::xml_node& document,
                     const std::string& path) {
        if (element.attribute(sourceAttribute)) return; // of a document that this one included
        element.append_attribute(sourceAttribute).set_value(path.c_str());
        element.append_attribute(versionAttribute).set_value(document.attribute("version").value());
        for (const char* name : {"colorspace", "fileprefix", "namespace"}) {
            const pugi::xml_attribute outer = document.attribute(name);
            if (!outer) continue;
            if (const pugi::xml_attribute own = element.attribute(name)) {
                if (!std::strcmp(name, "fileprefix"))
                    element.attribute(name).set_value(
                        (std::string(outer.value()) + own.value()).c_str());
            } else {
                element.append_attribute(name).set_value(outer.value());
            }
        }
        if (pugi::xml_attribute name = element.attribute("name"))
            name.set_value(qualifiedName(element, name.value()).c_str());
    }

    Diagnostics& _diagnostics;
    std::vector<std::string>* _files;
    std::set<std::string> _open;
    size_t _documents = 0, _markup = 0;
    uint64_t _bytes = 0;
};

} // namespace

void includeDocuments(pugi::xml_node root, const std::string& path, size_t markup,
                      Diagnostics& diagnostics, std::vector<std::string>* files) {
    Includer(diagnostics, markup, files).run(root, path);
}

} // namespace patina
