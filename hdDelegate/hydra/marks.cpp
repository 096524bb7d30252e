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
    static_cast<Marked&>(prim) = {};
    applyMarks(marks, prim, id.GetString(), param.scene()->diagnostics());
}

std::vector<Marked> marksOfInstances(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                     const SdfPath& id, size_t count) {
    std::vector<Marks> marks(count);
    bool any = false;
    for (const auto& descriptor : delegate.GetPrimvarDescriptors(id, HdInterpolationInstance)) {
        const std::string& name = descriptor.name.GetString();
        if (!isMark(name)) continue;
        const VtValue value = delegate.Get(id, descriptor.name);
        int components = 0;
        const std::vector<float> numbers = floatsOf(value, components);
        const auto texts = value.GetWithDefault<VtStringArray>();
        for (size_t i = 0; i < count; ++i)
            if (components == 1 && i < numbers.size())
                marks[i][name] = double(numbers[i]);
            else if (i < texts.size())
                marks[i][name] = texts[i];
        any = true;
    }
    std::vector<Marked> result(any ? count : 0);
    for (size_t i = 0; i < result.size(); ++i)
        applyMarks(marks[i], result[i], id.GetString(), param.scene()->diagnostics());
    return result;
}

} // namespace patina
