// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"

#include <pugixml.hpp>

#include <string>
#include <vector>

namespace patina {

/// Attribute that elements of an included document carry: the path of that document, which file
/// names are relative to.
inline constexpr const char* sourceAttribute = "patina-source";
/// Attribute of the same elements: the version of MaterialX that the document has. (`version` of a
/// node asks for one of its definitions.)
inline constexpr const char* versionAttribute = "patina-version";

/// Replaces every `xi:include` of a document by the elements of the document that it names,
/// relative to the including one. Included elements keep their own colour space, file prefix and
/// version; those of a namespace are named "namespace:name" from then on. Files that cannot be read
/// and documents that include themselves are reported and left out.
/// @param markup of the document, as markupOf(): all of them together hold maxMarkup at most
/// @param files gets the paths of the documents that are looked at, where it is given
void includeDocuments(pugi::xml_node root, const std::string& path, size_t markup,
                      Diagnostics& diagnostics, std::vector<std::string>* files = nullptr);

} // namespace patina
