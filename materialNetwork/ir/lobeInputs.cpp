// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/ir/materialIr.h"
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

/// Of the first node that makes each kind of lobe.
struct LobeInputs {
    std::vector<std::string> numbers;
    std::string flag;

    explicit LobeInputs(LobeKind kind) {
        for (const auto& def : NodeTable::get().all()) {
            if (!isLobe(def->closure) || lobeKind(def->closure) != kind) continue;
            for (const InputDef& input : def->inputs) {
                const bool isFlag = input.type == ValueType::Bool;
                if (isFlag && flag.empty()) flag = input.name;
                if (!isFlag && valueTypeComponents(input.type) > 0 && input.geomprop.empty() &&
                    input.name != "weight")
                    numbers.push_back(input.name);
            }
            return;
        }
    }
};

const LobeInputs& inputsOf(LobeKind kind) {
    static const LobeInputs table[] = {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) LobeInputs(LobeKind::Kind),
#include "materialNetwork/lobeTable.inc"
        LobeInputs(LobeKind::Layered)};
    return table[int(kind)];
}

} // namespace

const std::vector<std::string>& lobeParameters(LobeKind kind) {
    return inputsOf(kind).numbers;
}

const std::string& lobeFlag(LobeKind kind) {
    return inputsOf(kind).flag;
}

} // namespace patina
