// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledMaterials.h"

#include <chrono>

namespace patina {

std::shared_ptr<const MaterialPrim> CompiledMaterials::find(const std::string& path,
                                                            const std::string& user,
                                                            const SceneState& state,
                                                            const RenderSettings& settings) const {
    if (path.empty() || !settings.enableSceneMaterials) return nullptr;
    const auto found = state.materials.find(path);
    if (found != state.materials.end()) return found->second;
    _diagnostics.warn(user, "material:binding", messages::materialMissing(path));
    return nullptr;
}

std::shared_ptr<const MaterialProgram>
CompiledMaterials::program(const std::shared_ptr<const MaterialPrim>& prim,
                           const MethodChoices& methods, double tolerance) {
    std::promise<Program> promise;
    std::multimap<const MaterialPrim*, Entry>::iterator entry;
    {
        std::unique_lock<std::mutex> lock(_mutex);
        const auto range = _entries.equal_range(prim.get());
        for (auto it = range.first; it != range.second; ++it) {
            const Entry& entry = it->second;
            if (entry.methods != methods || entry.tolerance != tolerance) continue;
            const std::shared_future<Program> known = entry.program;
            lock.unlock();
            return known.get();
        }
        forgetUnused();
        entry = _entries.emplace(prim.get(),
                                 Entry{prim, methods, tolerance, promise.get_future().share()});
        ++_built;
    }
    try {
        const Program program = compileMaterial(
            prim && !prim->network.empty() ? prim->network : makeDisplayColorNetwork(), _textures,
            _diagnostics, methods, tolerance);
        promise.set_value(program);
        return program;
    } catch (...) { // out of memory: the next who asks tries again
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _entries.erase(entry);
        }
        promise.set_exception(std::current_exception());
        throw;
    }
}

void CompiledMaterials::forgetUnused() {
    const auto unused = [](const std::shared_future<Program>& program) {
        return program.wait_for(std::chrono::seconds(0)) == std::future_status::ready &&
               program.get().use_count() == 1;
    };
    constexpr int prims = 4; // so at most about a fourth of all entries are unused ones
    auto it = _entries.lower_bound(_hand);
    for (int i = 0; i < prims && !_entries.empty(); ++i) {
        if (it == _entries.end()) it = _entries.begin();
        for (const auto end = _entries.upper_bound(it->first); it != end;)
            it = unused(it->second.program) ? _entries.erase(it) : std::next(it);
    }
    _hand = it == _entries.end() ? nullptr : it->first;
}

size_t CompiledMaterials::programsBuilt() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _built;
}

} // namespace patina
