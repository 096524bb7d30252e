// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/sourceFormsSceneIndex.h"

#include "hdDelegate/hydra/sourceForms.h"
#include "plugin/hydra/overlays.h"

#include <map>
#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

struct Attribute {
    TfToken primvar;
    HdDataSourceLocator locator;
};

Attribute attribute(const std::string& name, const HdDataSourceLocator& locator) {
    return {TfToken(patina::sourcePrefix + name), locator};
}

/// By type of prim, which is also where its attributes are.
const std::map<TfToken, std::vector<Attribute>>& attributes() {
    static const std::map<TfToken, std::vector<Attribute>> all = [] {
        std::map<TfToken, std::vector<Attribute>> map;
        const auto plain = [&](const char* type, std::initializer_list<const char*> names) {
            for (const char* name : names)
                map[TfToken(type)].push_back(
                    attribute(name, HdDataSourceLocator(TfToken(type), TfToken(name))));
        };
        plain("nurbsPatch", {"uVertexCount", "vVertexCount", "uOrder", "vOrder", "uKnots", "vKnots",
                             "uRange", "vRange"});
        for (const std::string name :
             {"counts", "orders", "vertexCounts", "knots", "ranges", "points"})
            map[TfToken("nurbsPatch")].push_back(attribute(
                "trimCurve:" + name,
                HdDataSourceLocator(TfToken("nurbsPatch"), TfToken("trimCurve"), TfToken(name))));
        plain("nurbsCurves", {"order", "knots", "ranges"});
        plain(patina::hermitePrimType, {"tangents"});
        plain("plane", {"width", "length", "axis"});
        for (const char* name : {"tetVertexIndices", "surfaceFaceVertexIndices"})
            map[TfToken("tetMesh")].push_back(attribute(
                name, HdDataSourceLocator(TfToken("tetMesh"), TfToken("topology"), TfToken(name))));
        return map;
    }();
    return all;
}

/// The attributes of a prim as primvars, looked up when they are asked for: a source of an
/// attribute does not see opinions that come later.
class SourcePrimvars final : public HdContainerDataSource {
public:
    HD_DECLARE_DATASOURCE(SourcePrimvars);

    TfTokenVector GetNames() override {
        TfTokenVector names;
        for (const Attribute& attribute : _attributes)
            if (valueOf(attribute)) names.push_back(attribute.primvar);
        return names;
    }
    HdDataSourceBaseHandle Get(const TfToken& name) override {
        for (const Attribute& attribute : _attributes)
            if (attribute.primvar == name)
                if (const HdSampledDataSourceHandle value = valueOf(attribute))
                    return HdPatinaConstantPrimvar(value);
        return nullptr;
    }

private:
    SourcePrimvars(const std::vector<Attribute>& attributes,
                   const HdContainerDataSourceHandle& prim)
        : _attributes(attributes), _prim(prim) {}

    HdSampledDataSourceHandle valueOf(const Attribute& attribute) const {
        return HdSampledDataSource::Cast(HdContainerDataSource::Get(_prim, attribute.locator));
    }

    const std::vector<Attribute>& _attributes;
    const HdContainerDataSourceHandle _prim;
};

/// What the next scene indices know.
TfToken knownType(const TfToken& type) {
    return type == patina::hermitePrimType ? TfToken("nurbsCurves") : type;
}

} // namespace

HdSceneIndexPrim HdPatinaSourceFormsSceneIndex::GetPrim(const SdfPath& path) const {
    HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(path);
    const auto found = attributes().find(prim.primType);
    if (found == attributes().end() || !prim.dataSource) return prim;
    prim.dataSource = HdOverlayContainerDataSource::New(
        HdRetainedContainerDataSource::New(HdPrimvarsSchemaTokens->primvars,
                                           SourcePrimvars::New(found->second, prim.dataSource)),
        prim.dataSource);
    prim.primType = knownType(prim.primType);
    return prim;
}

void HdPatinaSourceFormsSceneIndex::_PrimsAdded(const HdSceneIndexBase&, const Added& entries) {
    Added added = entries;
    for (auto& entry : added)
        entry.primType = knownType(entry.primType);
    _SendPrimsAdded(added);
}

void HdPatinaSourceFormsSceneIndex::_PrimsDirtied(const HdSceneIndexBase&, const Dirtied& entries) {
    Dirtied dirtied = entries;
    for (auto& entry : dirtied)
        for (const auto& type : attributes())
            if (entry.dirtyLocators.Intersects(HdDataSourceLocator(type.first)))
                entry.dirtyLocators.insert(HdPrimvarsSchema::GetDefaultLocator());
    _SendPrimsDirtied(dirtied);
}

PXR_NAMESPACE_CLOSE_SCOPE
