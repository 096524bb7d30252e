#include "materialNetwork/differences.h"

#include "materialNetwork/nodeTable.h"

namespace patina {

namespace {

bool isHeightToNormal(const GraphNode& node) {
    return node.def->category == "heighttonormal" && !node.inputs[0].isConstant();
}

class Inserter {
public:
    explicit Inserter(const Graph& graph) : _in(graph) {}

    Graph run() {
        _out.path = _in.path;
        for (size_t i = 0; i < _in.nodes.size(); ++i) {
            GraphNode node = _in.nodes[i];
            for (Operand& operand : node.inputs)
                operand = mapped(operand, _map);
            if (isHeightToNormal(_in.nodes[i])) node = slopeOf(_in.nodes[i], std::move(node));
            _map.push_back(add(std::move(node)));
        }
        for (const auto& [name, operand] : _in.terminals)
            _out.terminals[name] = mapped(operand, _map);
        return std::move(_out);
    }

private:
    static Operand mapped(Operand operand, const std::vector<int>& map) {
        if (!operand.isConstant()) operand.node = map[size_t(operand.node)];
        return operand;
    }

    int add(GraphNode node) {
        _out.nodes.push_back(std::move(node));
        return int(_out.nodes.size()) - 1;
    }

    GraphNode slopeOf(const GraphNode& source, GraphNode node) {
        GraphNode slope;
        slope.def = NodeTable::get().find("PatinaSlope");
        slope.path = node.path;
        slope.inputs = {node.inputs[0],
                        shifted(source.inputs[0], 0),
                        shifted(source.inputs[0], 1),
                        node.inputs[1],
                        node.inputs[2],
                        shifted(source.inputs[2], 0),
                        shifted(source.inputs[2], 1)};
        slope.authored.assign(slope.inputs.size(), true);
        return slope;
    }

    /// The same value a step further along an axis. Nodes that do not move are shared.
    Operand shifted(const Operand& operand, int axis) {
        if (operand.isConstant()) return operand;
        std::vector<bool> needed(_in.nodes.size(), false);
        needed[size_t(operand.node)] = true;
        for (size_t i = size_t(operand.node) + 1; i-- > 0;)
            if (needed[i])
                for (const Operand& input : _in.nodes[i].inputs)
                    if (!input.isConstant()) needed[size_t(input.node)] = true;
        std::vector<int> map = _map;
        map.resize(_in.nodes.size(), -1);
        for (size_t i = 0; i <= size_t(operand.node); ++i)
            if (needed[i]) map[i] = copyOf(i, axis, map);
        return mapped(operand, map);
    }

    int copyOf(size_t index, int axis, const std::vector<int>& map) {
        const GraphNode& source = _in.nodes[index];
        const char* id = shiftOf(source);
        if (id) {
            GraphNode shift;
            shift.def = NodeTable::get().find(id);
            shift.path = source.path;
            const bool world =
                source.def->category == "position" && source.inputs[0].value.text == "world";
            shift.inputs = {Operand{_map[index], 0, {}}, number(float(axis))};
            if (shift.def->inputs.size() == 3) shift.inputs.push_back(number(world ? 1.0f : 0.0f));
            shift.authored.assign(shift.inputs.size(), true);
            return add(std::move(shift));
        }
        GraphNode node = source;
        bool moved = false;
        for (Operand& operand : node.inputs) {
            if (operand.isConstant()) continue;
            moved |= map[size_t(operand.node)] != _map[size_t(operand.node)];
            operand.node = map[size_t(operand.node)];
        }
        return moved ? add(std::move(node)) : _map[index];
    }

    static const char* shiftOf(const GraphNode& node) {
        const std::string& category = node.def->category;
        if (category == "position") return "PatinaShiftPosition";
        const ValueType type =
            node.def->outputs.empty() ? ValueType::Unknown : node.def->outputs[0].type;
        if (category == "texcoord" && type == ValueType::Vec3) return "PatinaShiftTexcoord_vector3";
        const bool reads =
            category == "texcoord" || category == "geompropvalue" || category == "UsdPrimvarReader";
        return reads && type == ValueType::Vec2 ? "PatinaShiftTexcoord_vector2" : nullptr;
    }

    static Operand number(float x) {
        Operand operand;
        operand.value = Value::makeFloat(x);
        return operand;
    }

    const Graph& _in;
    Graph _out;
    std::vector<int> _map; ///< from nodes of _in that are done
};

} // namespace

Graph insertDifferences(const Graph& graph) {
    for (const GraphNode& node : graph.nodes)
        if (isHeightToNormal(node)) return Inserter(graph).run();
    return graph;
}

} // namespace patina
