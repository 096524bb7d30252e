// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/xmlFile.h"

#include "base/limits.h"

#include <algorithm>

namespace patina {

namespace {

bool nestsTooDeeply(const pugi::xml_node& root) {
    const int most = int(limitOf(Limit::nesting));
    int depth = 0;
    for (pugi::xml_node node = root.first_child(); node;) {
        if (const pugi::xml_node child = node.first_child()) {
            if (++depth > most) return true;
            node = child;
            continue;
        }
        while (node && !node.next_sibling()) {
            node = node.parent();
            if (--depth < 0) return false; // back at the root
        }
        node = node.next_sibling();
    }
    return false;
}

} // namespace

size_t markupOf(const std::string& text) {
    return size_t(
        std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; }));
}

bool loadXml(const std::string& text, pugi::xml_document& out, std::string& problem,
             uint64_t most) {
    if (markupOf(text) > most) {
        problem = "holds more tags and attributes than the " + limitText(Limit::markup) +
                  " of a document and what it includes";
        return false;
    }
    const pugi::xml_parse_result result = out.load_buffer(text.data(), text.size());
    if (!result)
        problem = std::string("is not readable as XML: ") + result.description();
    else if (nestsTooDeeply(out))
        problem = "has elements nested more levels deep than " + limitText(Limit::nesting);
    return problem.empty();
}

std::string qualifiedName(const pugi::xml_node& element, const std::string& name) {
    for (pugi::xml_node e = element; e; e = e.parent()) {
        const std::string space = e.attribute("namespace").value();
        if (space.empty()) continue;
        return name.compare(0, space.size() + 1, space + ":") == 0 ? name : space + ":" + name;
    }
    return name;
}

} // namespace patina
