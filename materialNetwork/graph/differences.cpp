// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/differences.h"

#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <functional>

namespace patina {

namespace {

constexpr int blurTaps = sh::BLUR_TAPS * sh::BLUR_TAPS;
constexpr size_t maxNodes = 20000; ///< blurs and slopes of each other multiply; a graph beyond
                                   ///< this stops growing

Operand number(float x) {
    Operand operand;
    operand.value = Value::makeFloat(x);
    return operand;
}

class Inserter {
public:
    Inserter(const Graph& graph, Diagnostics& diagnostics)
        : _in(graph), _diagnostics(diagnostics) {}

    Graph run() {
        _out.path = _in.path;
        for (const GraphNode& source : _in.nodes) {
            GraphNode node = source;
            for (Operand& operand : node.inputs)
                operand = mapped(operand);
            if (node.def->category == "heighttonormal" && !node.inputs[0].isConstant())
                _map.push_back(slopeOf(node));
            else if (node.def->category == "blur")
                _map.push_back(blurred(node));
            else
                _map.push_back(add(std::move(node)));
        }
        for (const auto& [name, operand] : _in.terminals)
            _out.terminals[name] = mapped(operand);
        return std::move(_out);
    }

private:
    /// Makes the node that moves what is read at `read`. @param world a position in world space
    using Move = std::function<Operand(const Operand& read, ValueType type, bool world)>;

    Operand mapped(const Operand& operand) const {
        if (operand.isConstant()) return operand;
        Operand result = _map[size_t(operand.node)];
        if (!result.isConstant()) result.output += operand.output;
        return result;
    }

    Operand add(GraphNode node) {
        _out.nodes.push_back(std::move(node));
        return {int(_out.nodes.size()) - 1, 0, {}};
    }

    Operand add(const std::string& id, std::vector<Operand> inputs, const std::string& path) {
        GraphNode node;
        node.def = NodeTable::get().find(id);
        node.path = path;
        node.authored.assign(inputs.size(), true);
        node.inputs = std::move(inputs);
        return add(std::move(node));
    }

    Operand slopeOf(const GraphNode& node) {
        if (_out.nodes.size() > maxNodes) {
            _diagnostics.warn(node.path, "in", messages::slopeTooLarge);
            return add(node);
        }
        const auto along = [&](int input, float axis) {
            return moved(node.inputs[size_t(input)],
                         [&](const Operand& read, ValueType type, bool world) {
                             return type == ValueType::Unknown
                                        ? add("PatinaShiftPosition",
                                              {read, number(axis), number(world)}, node.path)
                                        : add(typed("PatinaShiftTexcoord_", type),
                                              {read, number(axis)}, node.path);
                         });
        };
        const Operand u = along(0, 0.0f), v = along(0, 1.0f);
        const Operand placeU = along(2, 0.0f), placeV = along(2, 1.0f);
        return add("PatinaSlope",
                   {node.inputs[0], u, v, node.inputs[1], node.inputs[2], placeU, placeV},
                   node.path);
    }

    /// The mean over a square of width `size` in texture coordinates.
    Operand blurred(const GraphNode& node) {
        const Operand in = node.inputs[0], size = node.inputs[1];
        const std::string& filter = node.inputs[2].value.text;
        const bool gaussian = filter == "gaussian";
        if (!gaussian && filter != "box")
            _diagnostics.warn(node.path, "filtertype", messages::wordUnknown(filter, "box"));
        float constantSize = 1.0f;
        if (in.isConstant()) return add(node);
        if (constantNumber(size, constantSize) && !(constantSize > 0.0f)) return in;
        const float blur = float(_blurs++);
        const std::string type = valueTypeName(node.def->outputs[0].type);
        const std::string times = "ND_multiply_" + type + (type == "float" ? "" : "FA");
        Operand sum;
        for (int i = 0; i < blurTaps; ++i) {
            if (_out.nodes.size() > maxNodes) {
                _diagnostics.warn(node.path, "in", messages::blurTooLarge);
                return in;
            }
            const Operand tap = moved(in, [&](const Operand& read, ValueType type, bool world) {
                std::vector<Operand> inputs = {read, size, number(blur), number(float(i)),
                                               number(gaussian)};
                if (type == ValueType::Unknown) inputs.push_back(number(world));
                return add(type == ValueType::Unknown ? "PatinaMovePosition"
                                                      : typed("PatinaMoveTexcoord_", type),
                           inputs, node.path);
            });
            if (tap.node == in.node) return in;
            const Operand part = add(times, {tap, number(1.0f / float(blurTaps))}, node.path);
            sum = i == 0 ? part : add("ND_add_" + type, {sum, part}, node.path);
        }
        return sum;
    }

    static std::string typed(const char* id, ValueType type) {
        return id + std::string(valueTypeName(type));
    }

    /// The same value with everything that is read off the surface moved. Nodes that do not move
    /// are shared.
    Operand moved(const Operand& operand, const Move& move) {
        if (operand.isConstant()) return operand;
        const size_t count = size_t(operand.node) + 1;
        std::vector<bool> needed(count, false);
        needed[count - 1] = true;
        for (size_t i = count; i-- > 0;)
            if (needed[i])
                for (const Operand& input : _out.nodes[i].inputs)
                    if (!input.isConstant()) needed[size_t(input.node)] = true;
        std::vector<int> map(count, -1);
        for (size_t i = 0; i < count; ++i)
            if (needed[i]) map[i] = copyOf(int(i), map, move);
        return {map[count - 1], operand.output, {}};
    }

    int copyOf(int index, const std::vector<int>& map, const Move& move) {
        const GraphNode source = _out.nodes[size_t(index)];
        ValueType type = ValueType::Unknown;
        if (isRead(source, type))
            return move({index, 0, {}}, type,
                        source.def->category == "position" &&
                            source.inputs[0].value.text == "world")
                .node;
        GraphNode node = source;
        bool changed = false;
        for (Operand& operand : node.inputs) {
            if (operand.isConstant()) continue;
            const int to = map[size_t(operand.node)];
            changed |= to != operand.node;
            operand.node = to;
        }
        return changed ? add(std::move(node)).node : index;
    }

    /// @param type of texture coordinates; Unknown for positions
    static bool isRead(const GraphNode& node, ValueType& type) {
        type = texcoordType(node);
        return type != ValueType::Unknown || node.def->category == "position";
    }

    const Graph& _in;
    Diagnostics& _diagnostics;
    Graph _out;
    int _blurs = 0;
    std::vector<Operand> _map; ///< from nodes of _in that are done
};

} // namespace

Graph insertDifferences(const Graph& graph, Diagnostics& diagnostics) {
    for (const GraphNode& node : graph.nodes)
        if ((node.def->category == "heighttonormal" || node.def->category == "blur") &&
            !node.inputs[0].isConstant())
            return Inserter(graph, diagnostics).run();
    return graph;
}

} // namespace patina
