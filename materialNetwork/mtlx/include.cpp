#include "materialNetwork/mtlx/include.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <vector>

namespace patina {

namespace {

namespace fs = std::filesystem;

constexpr size_t maxDocuments = 1000;

std::string canonical(const fs::path& path) {
    std::error_code error;
    const fs::path found = fs::weakly_canonical(path, error);
    return (error ? path.lexically_normal() : found).string();
}

class Includer {
public:
    explicit Includer(Diagnostics& diagnostics) : _diagnostics(diagnostics) {}

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
            _diagnostics.warn(path, "",
                              "the document includes itself through " + name +
                                  "; that include is left out");
            return;
        }
        if (++_documents > maxDocuments) {
            _diagnostics.warn(path, "", "too many included documents; " + name + " is left out");
            return;
        }
        std::ifstream stream(target, std::ios::binary);
        if (name.empty() || !stream) {
            _diagnostics.warn(path, "", "the included document " + name + " cannot be opened");
            return;
        }
        std::ostringstream text;
        text << stream.rdbuf();
        pugi::xml_document xml;
        const pugi::xml_parse_result result = xml.load_string(text.str().c_str());
        const pugi::xml_node included = xml.child("materialx");
        if (!result || !included) {
            _diagnostics.warn(path, "",
                              "the included document " + name +
                                  " is no MaterialX document; it is left out");
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
        for (const char* name : {"colorspace", "version", "fileprefix"}) {
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
    }

    Diagnostics& _diagnostics;
    std::set<std::string> _open;
    size_t _documents = 0;
};

} // namespace

void includeDocuments(pugi::xml_node root, const std::string& path, Diagnostics& diagnostics) {
    Includer(diagnostics).run(root, path);
}

} // namespace patina
