// SPDX-License-Identifier: Apache-2.0
// Values of inputs: numbers with their units, file names with prefixes and tokens.
#include "materialNetwork/mtlx/parser.h"

#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/lists.h"
#include "materialNetwork/network/tokens.h"

#include <cstring>
#include <filesystem>

namespace patina {

std::string MtlxParser::inherited(const Element& element, const char* attribute) const {
    for (Element e = element; e; e = e.parent())
        if (const auto a = e.attribute(attribute)) return a.value();
    return "";
}

bool MtlxParser::isBefore139(const Element& element) const {
    std::string version = inherited(element, versionAttribute);
    if (version.empty()) version = element.root().child("materialx").attribute("version").value();
    return version.compare(0, 2, "1.") == 0 && std::atoi(version.c_str() + 2) < 39;
}

void MtlxParser::readUnits(const Element& root) {
    for (const Element& def : root.children("unitdef")) {
        const std::string type = def.attribute("unittype").value();
        const auto kind = type == "distance" ? Unit::Kind::Distance
                          : type == "angle"  ? Unit::Kind::Angle
                                             : Unit::Kind::Unknown;
        for (const Element& unit : def.children("unit"))
            if (const double scale = unit.attribute("scale").as_double(); scale > 0.0)
                _units[unit.attribute("name").value()] = {kind, scale};
    }
}

double MtlxParser::factorOf(const Element& port, const std::string& id,
                            const std::string& input) const {
    std::string name = port.attribute("unit").value();
    if (name.empty()) {
        // What a definition is written in, its instances are.
        const auto def = _defExtras.find(id);
        if (def == _defExtras.end() || !def->second.units.count(input)) return 1.0;
        name = def->second.units.at(input);
    }
    const auto own = _units.find(name);
    const Unit unit = own == _units.end() ? unitOf(name) : own->second;
    if (unit.kind == Unit::Kind::Unknown)
        _diagnostics.warn(where(port.parent()), port.attribute("name").value(),
                          messages::unitUnknown(name));
    return unitFactor(unit, id, input, _metersPerUnit);
}

/// The value of a token that an element may name. Those of definitions are left to their instances.
const char* MtlxParser::tokenOf(const Element& element, const std::string& name) {
    for (Element e = element; e && std::strcmp(e.name(), "nodedef") != 0; e = e.parent()) {
        const auto [known, isNew] = _tokens.try_emplace(e.internal_object());
        for (const Element& token : isNew ? e.children("token") : Element().children("token"))
            if (const auto value = token.attribute("value"))
                known->second.emplace(token.attribute("name").value(), value.value());
        const auto found = known->second.find(name);
        if (found != known->second.end()) return found->second;
        if (e.attribute("nodedef") && !std::strcmp(e.name(), "nodegraph")) return nullptr;
    }
    return nullptr;
}

std::string MtlxParser::readFile(const Element& port) {
    namespace fs = std::filesystem;
    std::string text = port.attribute("value").value();
    if (text.empty()) return text;
    for (Element e = port; e; e = e.parent())
        text = e.attribute("fileprefix").value() + text;
    text =
        replaceTokens(text, [&](const std::string& name) { return tokenOf(port.parent(), name); });
    fs::path file(text);
    const std::string source = inherited(port, sourceAttribute);
    const fs::path document(source.empty() ? _path : source);
    if (file.is_relative()) file = document.parent_path() / file;
    return file.lexically_normal().string();
}

Value MtlxParser::readValue(const Element& port, const std::string& id, const std::string& input) {
    Value v;
    v.type = valueTypeFromName(port.attribute("type").value());
    const std::string text = port.attribute("value").value();
    const int n = valueTypeComponents(v.type);
    if (v.type == ValueType::Filename) {
        v.text = readFile(port);
        // Only colours have a colour space; a file says so itself, or is read by a colour node.
        const std::string nodeType = port.parent().attribute("type").value();
        v.colorSpace = nodeType.rfind("color", 0) == 0 || nodeType == "multioutput"
                           ? inherited(port, "colorspace")
                           : port.attribute("colorspace").value();
    } else if (n == 0) {
        v.text = text;
    } else {
        if (!port.attribute("value")) {
            v.numbers.assign(size_t(n), 0.0f);
        } else if (v.type == ValueType::Bool && (text == "true" || text == "false")) {
            v.numbers = {text == "true" ? 1.0f : 0.0f};
        } else if (!readNumbers(text, size_t(n), v.numbers)) {
            // A name may stand for an enumerated value; all else is told of where it is used.
            v.numbers.clear();
            v.type = ValueType::String;
            v.text = text;
        } else if (const double factor = factorOf(port, id, input); factor != 1.0) {
            for (float& x : v.numbers)
                x = float(x * factor);
        }
        if (v.type == ValueType::Color3 || v.type == ValueType::Color4)
            v.colorSpace = inherited(port, "colorspace");
    }
    return v;
}

} // namespace patina
