// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/marks.h"

#include "hdDelegate/hydra/values.h"

#include <pxr/usd/sdf/assetPath.h>

namespace patina {

bool markOf(const VtValue& value, MarkValue& mark) {
    int components = 0;
    const std::vector<float> numbers = floatsOf(value, components);
    if (components == 1 && numbers.size() == 1) {
        mark = double(numbers[0]);
        return true;
    }
    if (value.IsHolding<VtStringArray>() && value.UncheckedGet<VtStringArray>().size() == 1)
        mark = std::string(value.UncheckedGet<VtStringArray>()[0]);
    else if (value.IsHolding<std::string>() || value.IsHolding<TfToken>() ||
             value.IsHolding<SdfAssetPath>())
        mark = textOf(value);
    else
        return false;
    return true;
}

void readMarks(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
               Geometry& prim) {
    Marks marks;
    for (const auto& descriptor : delegate.GetPrimvarDescriptors(id, HdInterpolationConstant)) {
        const std::string& name = descriptor.name.GetString();
        MarkValue mark;
        if (isMark(name) && markOf(delegate.Get(id, descriptor.name), mark)) marks[name] = mark;
    }
    prim.visibility = Visibility();
    prim.catching = Catching();
    prim.matteName.clear();
    prim.assetName.clear();
    applyMarks(marks, prim, param.scene()->diagnostics());
}

} // namespace patina
