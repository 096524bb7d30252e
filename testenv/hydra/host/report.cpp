// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/report.h"

#include <pxr/base/js/json.h>
#include <pxr/base/vt/dictionary.h>

#include <sys/resource.h>

#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>

namespace patina {

namespace {

JsObject pickOf(Host& host, int primId, int instanceId) {
    const HostHit hit = host.decode(primId, instanceId);
    JsObject pick;
    pick["primId"] = JsValue(primId);
    pick["instanceId"] = JsValue(instanceId);
    pick["path"] = JsValue(hit.path.GetString());
    pick["instancer"] = JsValue(hit.instancer.GetString());
    pick["index"] = JsValue(hit.index);
    return pick;
}

JsValue jsonOf(const VtValue& value) {
    if (value.IsHolding<bool>()) return JsValue(value.UncheckedGet<bool>());
    if (value.IsHolding<std::string>()) return JsValue(value.UncheckedGet<std::string>());
    if (value.IsHolding<int>()) return JsValue(value.UncheckedGet<int>());
    const VtValue number = VtValue::Cast<double>(value);
    return number.IsHolding<double>() ? JsValue(number.UncheckedGet<double>()) : JsValue();
}

} // namespace

JsArray picksOf(Host& host, const std::vector<std::pair<int, int>>& pixels) {
    JsArray picks;
    if (pixels.empty()) return picks;
    const HostImage prims = host.read("primId"), instances = host.read("instanceId");
    for (const auto& [x, y] : pixels) {
        if (x < 0 || y < 0 || x >= prims.width || y >= prims.height) continue;
        JsObject pick = pickOf(host, int(*prims.pixel(x, y)), int(*instances.pixel(x, y)));
        pick["x"] = JsValue(x);
        pick["y"] = JsValue(y);
        picks.push_back(pick);
    }
    return picks;
}

JsArray allPicksOf(Host& host) {
    const HostImage prims = host.read("primId"), instances = host.read("instanceId");
    std::map<std::pair<int, int>, int> seen;
    for (int y = 0; y < prims.height; ++y)
        for (int x = 0; x < prims.width; ++x)
            ++seen[{int(*prims.pixel(x, y)), int(*instances.pixel(x, y))}];
    JsArray picks;
    for (const auto& [ids, count] : seen) {
        JsObject pick = pickOf(host, ids.first, ids.second);
        pick["pixels"] = JsValue(count);
        picks.push_back(pick);
    }
    return picks;
}

JsObject statisticsOf(Host& host, const HostTimes& times) {
    JsObject seconds, stats, all;
    for (const auto& [name, value] : times)
        seconds[name] = JsValue(value);
    for (const auto& item : host.delegate()->GetRenderStats())
        stats[item.first] = jsonOf(item.second);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    all["seconds"] = JsValue(seconds);
    all["stats"] = JsValue(stats);
    all["peakMemory"] = JsValue(double(usage.ru_maxrss) * 1024.0);
    return all;
}

void writeJson(const JsObject& object, const std::string& path) {
    const std::string text = JsWriteToString(JsValue(object));
    if (path == "-") {
        std::cout << text << std::endl;
        return;
    }
    std::ofstream out(path);
    out << text << '\n';
    out.close();
    if (!out) throw std::runtime_error(path + " cannot be written");
}

} // namespace patina
