// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/nodes/models.h"

#include "materialNetwork/mtlx/document.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "base/regularFile.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace patina {

const ModelLibrary& ModelLibrary::get() {
    static const ModelLibrary library;
    return library;
}

ModelLibrary::ModelLibrary() {
    namespace fs = std::filesystem;
    if (const char* folders = std::getenv("PATINA_MODEL_PATH")) {
        std::istringstream list(folders);
        for (std::string folder; std::getline(list, folder, ':');) {
            std::error_code error;
            std::vector<fs::path> files;
            for (fs::directory_iterator it(folder, error), end; !error && it != end;
                 it.increment(error))
                if (it->path().extension() == ".mtlx") files.push_back(it->path());
            if (error) _diagnostics.warn(folder, "PATINA_MODEL_PATH", messages::folderUnreadable);
            std::sort(files.begin(), files.end());
            for (const fs::path& file : files) {
                std::string text, problem;
                if (readRegularFile(file.string(), Limit::documentBytes, text, problem))
                    add(text, file.string());
                else
                    _diagnostics.warn(file.string(), "", messages::fileUnreadable(problem));
            }
        }
    }
    for (const EmbeddedModel* model = embeddedModels; model->name; ++model)
        add(model->text, model->name);
}

void ModelLibrary::add(const std::string& text, const std::string& path) {
    MtlxDocument document;
    if (!parseMtlx(text, path, false, document, _diagnostics)) return;
    for (ShadingModel& model : document.models) {
        _models.push_back(std::make_unique<ShadingModel>(std::move(model)));
        const ShadingModel* added = _models.back().get();
        _byId.emplace(added->def.id, added);
        _byId.emplace(added->def.category, added);
        _byId.emplace("ND_" + added->def.category, added);
    }
}

const ShadingModel* ModelLibrary::find(const std::string& id) const {
    const auto found = _byId.find(id);
    return found == _byId.end() ? nullptr : found->second;
}

void BestModel::offer(const ShadingModel& model) {
    // A model may have more outputs than the one that a document names.
    const bool several = model.def.outputs.size() > 1;
    const int fit = nodeDefFit(model.def, several ? ValueType::Unknown : _outputType, _inputTypes);
    if (fit < 0) return;
    const bool right = _version.empty() ? model.isDefaultVersion || model.version.empty()
                                        : model.version == _version;
    if (_best && (right == _rightVersion ? fit <= _fit : _rightVersion)) return;
    _best = &model;
    _rightVersion = right;
    _fit = fit;
}

const ShadingModel* ModelLibrary::resolve(const std::string& category, ValueType outputType,
                                          const std::map<std::string, ValueType>& inputTypes,
                                          const std::string& version) const {
    BestModel best(outputType, inputTypes, version);
    for (const auto& model : _models)
        if (model->def.category == category) best.offer(*model);
    return best.model();
}

const NodeDef* findNodeDef(const std::string& id) {
    if (const NodeDef* def = NodeTable::get().find(id)) return def;
    const ShadingModel* model = ModelLibrary::get().find(id);
    return model ? &model->def : nullptr;
}

} // namespace patina
