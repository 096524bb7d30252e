// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/lightFilter.h"

#include "hdDelegate/hydra/networkConversion.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/imaging/hd/material.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/tokens.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace patina {

namespace {

constexpr const char* prefixes[] = {"inputs:ri:lightFilter:", "ri:lightFilter:", "inputs:", ""};

/// The inputs of one filter, which hosts give as parameters or as a node of a network.
class Inputs {
public:
    Inputs(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& light,
           const SdfPath& id)
        : _delegate(delegate), _param(param), _light(light), _id(id) {
        const VtValue resource = delegate.GetMaterialResource(id);
        if (!resource.IsHolding<HdMaterialNetworkMap>()) return;
        const HdMaterialNetworkMap& map = resource.UncheckedGet<HdMaterialNetworkMap>();
        const auto found = map.map.find(HdMaterialTerminalTokens->lightFilter);
        if (found != map.map.end() && !found->second.nodes.empty())
            _node = found->second.nodes.back();
    }

    /// The shader's where the prim is of the general type.
    std::string type() const {
        const std::string given = parameter("lightFilterType");
        if (!given.empty() && given != "LightFilter") return given;
        if (!_node.identifier.IsEmpty()) return _node.identifier.GetString();
        // UsdImagingDelegate makes no node of a shader that its registry does not know.
        const std::string shader = parameter("lightFilter:shaderId");
        return shader.empty() ? given : shader;
    }

    void read(const char* names, float& field) const {
        const VtValue value = get(names);
        double number = 0.0;
        if (value.IsEmpty()) return;
        if (numberOf(value, number) && std::isfinite(number))
            field = float(number);
        else
            _param.warn(_light, "light:filters",
                        messages::filterInputNotFinite(_id.GetString(), names));
    }
    void read(const char* names, bool& field) const {
        double number = 0.0;
        if (numberOf(get(names), number)) field = number != 0.0;
    }
    void read(const char* names, std::string& field) const {
        const VtValue value = get(names);
        double number = 0.0;
        if (numberOf(value, number)) {
            if (std::abs(number) <= std::numeric_limits<int>::max()) // not of NaN
                field = std::to_string(int(number));
            else
                _param.warn(_light, "light:filters",
                            messages::filterInputNoNumber(_id.GetString(), names));
        } else if (!textOf(value).empty()) {
            field = textOf(value);
        }
    }
    void read(const char* names, std::vector<float>& field) const {
        int components = 0;
        const VtValue value = get(names);
        const std::vector<float> values = floatsOf(value, components);
        if (components == 1)
            field = values;
        else if (!value.IsEmpty())
            warnOfArray(names);
    }
    void read(const char* names, vec3& field) const {
        std::vector<vec3> values;
        read(names, values);
        if (!values.empty()) field = values[0];
    }
    void read(const char* names, std::vector<vec3>& field) const {
        int components = 0;
        const VtValue value = get(names);
        const std::vector<float> values = floatsOf(value, components);
        if (components != 3) {
            if (!value.IsEmpty()) warnOfArray(names);
            return;
        }
        field.clear();
        for (size_t i = 0; i + 2 < values.size(); i += 3)
            field.emplace_back(values[i], values[i + 1], values[i + 2]);
    }
    /// Warns of inputs that are not evaluated. Of a filter that came as parameters only those are
    /// known that the table lists.
    void warnOfOthers() const {
        for (const IgnoredFilterInput& row : ignoredFilterInputs) {
            const VtValue value = get(row.names);
            if (!value.IsEmpty() && !isIdle(value, row.idle)) warn(row.names);
        }
        for (const auto& parameter : _node.parameters) {
            const std::string& name = parameter.first.GetString();
            if (!describesAnother(name) && !isKnown(withoutPrefix(name))) warn(name);
        }
    }
    bool has(const char* names) const { return !get(names).IsEmpty(); }

private:
    void warnOfArray(const char* names) const {
        _param.warn(_light, "light:filters", messages::filterInputNoArray(_id.GetString(), names));
    }
    void warn(const std::string& input) const {
        _param.warn(_light, "light:filters", messages::filterInputIgnored(_id.GetString(), input));
    }
    static bool isIdle(const VtValue& value, const char* idle) {
        double number = 0.0;
        const bool isNumber = numberOf(value, number);
        std::istringstream words(idle);
        for (std::string word; words >> word;) {
            char* end = nullptr;
            const double wanted = std::strtod(word.c_str(), &end);
            if (word == "*" || (isNumber ? *end == 0 && wanted == number : textOf(value) == word))
                return true;
        }
        return !isNumber && textOf(value).empty();
    }
    static bool isKnown(const std::string& name) {
        std::string all = " ";
#define PATINA_FILTER_INPUT(type, field, names, fallback, description) all += names " ";
#define PATINA_FILTER_IGNORED(names, idle) all += names " ";
#include "hdDelegate/scene/lightFilterInputs.inc"
        return all.find(" " + name + " ") != std::string::npos;
    }
    static std::string withoutPrefix(const std::string& name) {
        for (const std::string prefix : prefixes)
            if (name.compare(0, prefix.size(), prefix) == 0) return name.substr(prefix.size());
        return name;
    }
    std::string parameter(const char* name) const {
        return textOf(_delegate.GetLightParamValue(_id, TfToken(name)));
    }
    VtValue get(const char* names) const {
        std::istringstream words(names);
        for (std::string word; words >> word;)
            for (const char* prefix : prefixes) {
                const TfToken name(prefix + word);
                const auto found = _node.parameters.find(name);
                if (found != _node.parameters.end()) return found->second;
                const VtValue value = _delegate.GetLightParamValue(_id, name);
                if (!value.IsEmpty()) return value;
            }
        return VtValue();
    }
    HdSceneDelegate& _delegate;
    HdPatinaRenderParam& _param;
    const SdfPath &_light, &_id;
    HdMaterialNode _node;
};

const LightFilterRow* rowOf(const std::string& type) {
    for (const LightFilterRow& row : lightFilterRows) {
        std::istringstream words(row.schemas);
        for (std::string word; words >> word;)
            if (word == type) return &row;
    }
    return nullptr;
}

} // namespace

std::vector<LightFilter> readLightFilters(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                          const SdfPath& light) {
    std::vector<LightFilter> filters;
    const VtValue paths = delegate.GetLightParamValue(light, HdTokens->filters);
    if (!paths.IsHolding<SdfPathVector>()) return filters;
    for (const SdfPath& path : paths.UncheckedGet<SdfPathVector>()) {
        param.use(path, light);
        const Inputs inputs(delegate, param, light, path);
        const LightFilterRow* row = rowOf(inputs.type());
        if (!row) {
            const std::string given = inputs.type();
            if (given.empty())
                param.warn(light, "light:filters", messages::filterWithoutType(path.GetString()));
            else
                param.warn(light, "light:filters",
                           messages::filterTypeNotKnown(path.GetString(), given));
            continue;
        }
        if (!delegate.GetRenderIndex().GetSprim(HdPrimTypeTokens->lightFilter, path)) {
            param.warn(light, "light:filters", messages::noLightFilter(path.GetString()));
            continue;
        }
        LightFilter filter;
        filter.path = path.GetString();
        filter.type = row->type;
        filter.transform = MotionTransform(toMat4(delegate.GetTransform(path)));
#define PATINA_FILTER_INPUT(type, field, names, fallback, description)                             \
    inputs.read(names, filter.field);
#include "hdDelegate/scene/lightFilterInputs.inc"
        inputs.warnOfOthers();
        // Rods are there to block.
        if (row->type == LightFilterType::Rod && !inputs.has("intensity ri:intensity"))
            filter.intensity = 0.0f;
        filters.push_back(std::move(filter));
    }
    return filters;
}

} // namespace patina
