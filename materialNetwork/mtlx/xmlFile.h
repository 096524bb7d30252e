// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include <string>

namespace patina {

/// Elements nest no deeper than this, so that whatever walks them may recurse. Documents need 5.
inline constexpr int maxNesting = 64;

/// Tags and attributes of a document and of all that it includes: each takes some 500 bytes while
/// it is read. A material of ten nodes has about 200.
inline constexpr size_t maxMarkup = size_t(1) << 21;

/// @returns how many tags and attributes a text holds at most
size_t markupOf(const std::string& text);

/// Reads text as XML.
/// @param limit see markupOf()
/// @returns false, with the reason as in "is not readable as XML: ...", when it is none, holds more
///          than that or nests too deeply
bool loadXml(const std::string& text, pugi::xml_document& out, std::string& problem,
             size_t limit = maxMarkup);

/// The name that an element's name, or what it refers to, has for others: "namespace:name" where
/// the element or one around it has a namespace, else the name itself.
std::string qualifiedName(const pugi::xml_node& element, const std::string& name);

} // namespace patina
