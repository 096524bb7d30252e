// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"
#include "materialNetwork/shadingPoint.h"

namespace patina {

/// The registers of one evaluation. Small programs live on the stack.
class RegisterFile {
public:
    explicit RegisterFile(const MaterialIr& ir);
    glm::vec4* data() { return _data; }
    void run(const MaterialIr& ir, const std::vector<Instruction>& instructions,
             const ShadingPoint& point);

private:
    static constexpr int localCount = 192;
    glm::vec4 _local[localCount];
    glm::vec4* _data;
};

} // namespace patina
