// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/ir/registerFile.h"

#include <cstring>

namespace patina {

RegisterFile::RegisterFile(const MaterialIr& ir) : _data(_local) {
    if (ir.registerCount > localCount) {
        static thread_local std::vector<glm::vec4> large;
        if (int(large.size()) < ir.registerCount) large.resize(size_t(ir.registerCount));
        _data = large.data();
    }
    std::memcpy(static_cast<void*>(_data), ir.constants.data(),
                ir.constants.size() * sizeof(glm::vec4));
}

void RegisterFile::run(const MaterialIr& ir, const std::vector<Instruction>& instructions,
                       const ShadingPoint& point) {
    const PatternContext context{&point, ir.textures};
    for (const Instruction& i : instructions)
        i.function({_data, ir.inputPool.data() + i.firstInput, i.output, i.data, context});
}

} // namespace patina
