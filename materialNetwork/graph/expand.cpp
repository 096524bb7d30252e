// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/expand.h"

#include "materialNetwork/graph/namedSpaces.h"
#include "materialNetwork/compileCounts.h"
#include "materialNetwork/network/geomprop.h"
#include "materialNetwork/graph/graph.h"
#include "materialNetwork/graph/simplify.h"
#include "base/limits.h"
#include "materialNetwork/network/tokens.h"
#include "materialNetwork/network/value.h"

#include <deque>
#include <optional>
#include <set>

namespace patina {

namespace {

constexpr int maxDepth = 16; ///< of models within models

class Expander {
public:
    Expander(const Network& network, const ModelLookup& models, Diagnostics& diagnostics)
        : _network(network), _models(models), _diagnostics(diagnostics) {
        for (const NetworkNode& node : network.nodes)
            _source.emplace(node.path, &node);
    }

    Network run() {
        _result.path = _network.path;
        for (const auto& [name, c] : _network.terminals)
            request(c.node, 0);
        while (!_queue.empty() && !isTooLarge()) {
            const auto [path, depth] = _queue.front();
            _queue.pop_front();
            const auto found = _source.find(path);
            if (found != _source.end()) visit(*found->second, depth);
        }
        if (isTooLarge()) {
            // Definitions that use others twice, those others twice, and so on.
            if (_nodes > _maxNodes)
                _diagnostics.warn(_network.path, "",
                                  messages::nodesTooMany(limitText(Limit::nodes)));
            else
                _diagnostics.warn(_network.path, "",
                                  messages::materialTextTooLong(limitText(Limit::documentBytes)));
            Network nothing;
            nothing.path = _network.path;
            return nothing;
        }
        for (NetworkNode& node : _result.nodes)
            for (auto it = node.connections.begin(); it != node.connections.end();)
                if (resolve(it->second))
                    ++it;
                else
                    it = node.connections.erase(it);
        for (auto [name, c] : _network.terminals) {
            const auto instance = _instances.find(c.node);
            // Whatever a host calls it, a terminal is the output of its kind.
            if (instance != _instances.end() && !instance->second.model->outputs.count(c.output) &&
                instance->second.model->outputs.count(name))
                c.output = name;
            if (resolve(c)) _result.terminals[name] = c;
        }
        return std::move(_result);
    }

private:
    struct Instance {
        const ShadingModel* model;
        std::string prefix;
    };

    void request(const std::string& path, int depth) {
        if (_seen.insert(path).second) _queue.emplace_back(path, depth);
    }

    void visit(const NetworkNode& node, int depth) {
        const ShadingModel* model = _models(node.id);
        if (model && depth >= maxDepth) {
            // Of many such nodes one is named.
            if (_tooDeep.empty())
                _diagnostics.warn(node.path, "", messages::modelsTooDeep(node.id));
            _tooDeep.insert(node.path);
            return;
        }
        if (!model) {
            ++_nodes;
            for (const auto& [input, c] : node.connections)
                request(c.node, depth);
            _result.nodes.push_back(node);
            return;
        }
        const std::string prefix = node.path + "/";
        _instances[node.path] = {model, prefix};
        _nodes += 1 + model->nodes.size();
        if (isTooLarge()) return;
        reportInputs(node, *model);
        tokens(node, *model);
        for (const NetworkNode& inner : model->nodes) {
            if (isTooLarge()) return;
            _owned.push_back(instantiate(inner, node, *model, prefix, depth));
            _source[_owned.back().path] = &_owned.back();
        }
        for (const auto& [name, c] : model->outputs)
            request(prefix + c.node, depth + 1);
    }

    /// Inputs that the model does not have, and those of what is not modelled.
    void reportInputs(const NetworkNode& node, const ShadingModel& model) {
        const auto check = [&](const std::string& input, const Value* value) {
            const int i = model.def.findInput(input);
            if (i < 0) {
                _diagnostics.warn(node.path, input, messages::inputMissing(node.id));
                return;
            }
            const InputDef& def = model.def.inputs[size_t(i)];
            if (def.notModelled.empty() || !_asked) return;
            const auto c = node.connections.find(input);
            if (!(value ? value->numbers == def.value.numbers : foldsTo(c->second, def.value)))
                _diagnostics.warn(node.path, input, messages::inputNotModelled(def.notModelled));
        };
        for (const auto& [input, value] : node.inputs)
            if (!node.connections.count(input)) check(input, &value);
        for (const auto& [input, c] : node.connections)
            check(input, nullptr);
    }

    /// Whether what is connected is this constant: translations connect every input.
    bool foldsTo(const Connection& c, const Value& value) {
        Network part;
        part.path = _network.path;
        for (const auto& [path, node] : _source)
            part.nodes.push_back(*node);
        part.terminals["value"] = c;
        Diagnostics silent;
        Expander inner(part, _models, silent);
        inner._asked = false; // connections may form a cycle
        std::vector<std::string> cuts;
        const Graph graph = simplify(buildGraph(inner.run(), silent), cuts);
        const auto found = graph.terminals.find("value");
        return found != graph.terminals.end() && found->second.isConstant() &&
               found->second.value.numbers == value.numbers;
    }

    /// Texts that stand in the model's body for "[name]".
    void tokens(const NetworkNode& node, const ShadingModel& model) {
        _tokens.clear();
        for (const InputDef& input : model.def.inputs)
            if (!input.name.empty() && input.name[0] == '[')
                _tokens[input.name.substr(1, input.name.size() - 2)] = authored(node, input).text;
    }
    Value withTokens(Value value) const {
        if (!_tokens.empty() && !value.text.empty())
            value.text = replaceTokens(value.text, [&](const std::string& name) {
                const auto token = _tokens.find(name);
                return token == _tokens.end() ? nullptr : token->second.c_str();
            });
        return value;
    }

    bool isTooLarge() const { return _nodes > _maxNodes || _bytes > _maxBytes; }

    NetworkNode instantiate(const NetworkNode& inner, const NetworkNode& outer,
                            const ShadingModel& model, const std::string& prefix, int depth) {
        NetworkNode node;
        node.path = prefix + inner.path;
        node.id = inner.id;
        for (const auto& [input, value] : inner.inputs)
            _bytes += (node.inputs[input] = withTokens(value)).text.size();
        _bytes += node.path.size() * (1 + inner.connections.size());
        for (const auto& [input, c] : inner.connections) {
            if (c.node != ShadingModel::interfaceNode) {
                node.connections[input] = {prefix + c.node, c.output};
                continue;
            }
            const int i = model.def.findInput(c.output);
            if (i >= 0) bind(node, input, outer, model.def.inputs[size_t(i)], depth);
        }
        return node;
    }

    /// Connects an input of the body to what the instance gives for an input of the model.
    void bind(NetworkNode& node, const std::string& input, const NetworkNode& outer,
              const InputDef& def, int depth) {
        const auto c = outer.connections.find(def.name);
        if (c != outer.connections.end()) {
            if (valueTypeComponents(def.type) == 0)
                node.connections[input] = c->second;
            else
                node.connections[input] = {dot(outer, def, c->second, depth), ""};
            return;
        }
        const NetworkNode source = geompropNode(def.geomprop);
        if (source.id.empty() || outer.inputs.count(def.name)) {
            node.inputs[input] = authored(outer, def);
            return;
        }
        if (!_source.count(source.path)) {
            _owned.push_back(source);
            _source[source.path] = &_owned.back();
        }
        node.connections[input] = {source.path, ""};
    }

    Value authored(const NetworkNode& outer, const InputDef& def) {
        const auto v = outer.inputs.find(def.name);
        if (v == outer.inputs.end()) return withTokens(def.value);
        Value value;
        std::optional<Message> problem;
        const bool usable = coerceValue(v->second, def, value, problem);
        if (problem) _diagnostics.warn(outer.path, def.name, *problem);
        return usable ? value : def.value;
    }

    std::string dot(const NetworkNode& outer, const InputDef& def, const Connection& c, int depth) {
        NetworkNode dot;
        dot.path = outer.path + "." + def.name;
        if (!_source.count(dot.path)) {
            dot.id = std::string("ND_dot_") + valueTypeName(def.type);
            dot.connections["in"] = c;
            dot.inputs["in"] = authored(outer, def);
            _owned.push_back(dot);
            _source[dot.path] = &_owned.back();
        }
        request(dot.path, depth);
        return dot.path;
    }

    /// Follows a connection through the outputs of models.
    /// @returns false when it ends at a node that was left out
    bool resolve(Connection& c) const {
        for (int guard = 0; guard <= maxDepth + 1; ++guard) {
            const auto found = _instances.find(c.node);
            if (found == _instances.end()) return !_tooDeep.count(c.node);
            const ShadingModel& model = *found->second.model;
            const int i = model.def.findOutput(c.output);
            const auto out =
                i < 0 ? model.outputs.end() : model.outputs.find(model.def.outputs[size_t(i)].name);
            if (out == model.outputs.end()) {
                _diagnostics.warn(c.node, c.output, messages::outputMissing(model.def.category));
                c = {};
                return true;
            }
            c = {found->second.prefix + out->second.node, out->second.output};
        }
        return true;
    }

    const Network& _network;
    const ModelLookup& _models;
    Diagnostics& _diagnostics;
    std::map<std::string, const NetworkNode*> _source;
    std::deque<NetworkNode> _owned; ///< nodes that come from models; addresses must stay
    std::map<std::string, Instance> _instances;
    std::set<std::string> _seen;
    std::set<std::string> _tooDeep;             ///< nodes that are left out
    std::map<std::string, std::string> _tokens; ///< of the instance that is taken apart
    bool _asked = true;                         ///< whether inputs in vain are looked for
    size_t _nodes = 0;                          ///< of the result and of all models taken in
    std::deque<std::pair<std::string, int>> _queue;
    const size_t _maxNodes = limitOf(Limit::nodes);
    const size_t _maxBytes = limitOf(Limit::documentBytes);
    size_t _bytes = 0; ///< of paths and texts of what models became
    Network _result;
};

/// @returns the network without the values whose texts are longer than they may be
std::optional<Network> withoutLongTexts(const Network& network, Diagnostics& diagnostics) {
    const size_t most = limitOf(Limit::textLength);
    std::optional<Network> result;
    for (size_t i = 0; i < network.nodes.size(); ++i)
        for (const auto& [input, value] : network.nodes[i].inputs) {
            if (value.text.size() <= most) continue;
            diagnostics.warn(network.nodes[i].path, input,
                             messages::textTooLong(limitText(Limit::textLength)));
            if (!result) result = network;
            result->nodes[i].inputs.erase(input);
        }
    return result;
}

} // namespace

Network expand(const Network& network, const ModelLookup& models, Diagnostics& diagnostics) {
    ++compileCounts().expansions;
    const auto within = withoutLongTexts(network, diagnostics);
    Network result = Expander(within ? *within : network, models, diagnostics).run();
    resolveNamedSpaces(result);
    return result;
}

Network expand(const Network& network, Diagnostics& diagnostics) {
    const ModelLibrary& library = ModelLibrary::get();
    return expand(
        network, [&](const std::string& id) { return library.find(id); }, diagnostics);
}

} // namespace patina
