// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include <string>

namespace patina {

/// @returns how many tags and attributes a text holds at most
size_t markupOf(const std::string& text);

/// Reads text as XML.
/// @param most of markupOf(), Limit::markup less what was read before
/// @returns false, with the reason as in "is not readable as XML: ...", when it is none, holds more
///          than that or nests more deeply than Limit::nesting
bool loadXml(const std::string& text, pugi::xml_document& out, std::string& problem, uint64_t most);

/// The name that an element's name, or what it refers to, has for others: "namespace:name" where
/// the element or one around it has a namespace, else the name itself.
std::string qualifiedName(const pugi::xml_node& element, const std::string& name);

} // namespace patina
