#pragma once

#include <pugixml.hpp>

#include <string>

namespace patina {

/// Elements nest no deeper than this, so that whatever walks them may recurse. Documents need 5.
inline constexpr int maxNesting = 64;

/// Reads text as XML.
/// @returns false, with the reason as in "is not readable as XML: ...", when it is none or nests
/// too deeply
bool loadXml(const std::string& text, pugi::xml_document& out, std::string& problem);

/// The name that an element's name, or what it refers to, has for others: "namespace:name" where
/// the element or one around it has a namespace, else the name itself.
std::string qualifiedName(const pugi::xml_node& element, const std::string& name);

} // namespace patina
