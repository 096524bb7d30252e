// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/subdivCage.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <mutex>

namespace patina {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

thread_local std::string* messages = nullptr;

void keep(const char* message) {
    if (messages && messages->empty()) *messages = message;
}

/// Collects what OpenSubdiv says on this thread, which it would print otherwise.
class MessageCapture {
public:
    MessageCapture() {
        static std::once_flag once;
        std::call_once(once, [] {
            Far::SetErrorCallback([](Far::ErrorType, const char* message) { keep(message); });
            Far::SetWarningCallback([](const char* message) { keep(message); });
        });
        messages = &text;
    }
    ~MessageCapture() { messages = nullptr; }
    std::string text;
};

template <class T> T choose(const std::string& value,
                            std::initializer_list<std::pair<const char*, T>> choices, T fallback,
                            const Mesh& mesh, const char* input, Diagnostics& diagnostics) {
    for (const auto& choice : choices)
        if (value == choice.first) return choice.second;
    if (!value.empty()) diagnostics.warn(mesh.path, input, messages::valueUnknown);
    return fallback;
}

Sdc::Options sdcOptions(const Mesh& mesh, Diagnostics& diagnostics) {
    using O = Sdc::Options;
    O options;
    options.SetVtxBoundaryInterpolation(choose<O::VtxBoundaryInterpolation>(
        mesh.interpolateBoundary,
        {{"none", O::VTX_BOUNDARY_NONE},
         {"edgeOnly", O::VTX_BOUNDARY_EDGE_ONLY},
         {"edgeAndCorner", O::VTX_BOUNDARY_EDGE_AND_CORNER}},
        O::VTX_BOUNDARY_EDGE_AND_CORNER, mesh, "interpolateBoundary", diagnostics));
    options.SetFVarLinearInterpolation(choose<O::FVarLinearInterpolation>(
        mesh.faceVaryingLinearInterpolation,
        {{"none", O::FVAR_LINEAR_NONE},
         {"cornersOnly", O::FVAR_LINEAR_CORNERS_ONLY},
         {"cornersPlus1", O::FVAR_LINEAR_CORNERS_PLUS1},
         {"cornersPlus2", O::FVAR_LINEAR_CORNERS_PLUS2},
         {"boundaries", O::FVAR_LINEAR_BOUNDARIES},
         {"all", O::FVAR_LINEAR_ALL}},
        O::FVAR_LINEAR_CORNERS_PLUS1, mesh, "faceVaryingLinearInterpolation", diagnostics));
    options.SetTriangleSubdivision(choose<O::TriangleSubdivision>(
        mesh.triangleSubdivisionRule,
        {{"catmullClark", O::TRI_SUB_CATMARK}, {"smooth", O::TRI_SUB_SMOOTH}}, O::TRI_SUB_CATMARK,
        mesh, "triangleSubdivisionRule", diagnostics));
    return options;
}

Sdc::SchemeType sdcScheme(const Mesh& mesh, const SubdivCage& cage, Diagnostics& diagnostics) {
    if (mesh.scheme == SubdivisionScheme::Bilinear) return Sdc::SCHEME_BILINEAR;
    if (mesh.scheme == SubdivisionScheme::Loop) {
        if (cage.allTriangles) return Sdc::SCHEME_LOOP;
        diagnostics.warn(mesh.path, "subdivisionScheme", messages::loopNeedsTriangles);
    }
    return Sdc::SCHEME_CATMARK;
}

} // namespace

std::unique_ptr<Far::TopologyRefiner>
refineTopology(const Mesh& mesh, const SubdivCage& cage,
               const std::vector<FaceVaryingChannel>& channels, int level,
               Diagnostics& diagnostics) {
    std::vector<Far::TopologyDescriptor::FVarChannel> fvar(channels.size());
    for (size_t i = 0; i < channels.size(); ++i) {
        fvar[i].numValues = int(channels[i].values.size() / channels[i].components);
        fvar[i].valueIndices = channels[i].indices.data();
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(cage.points.size());
    descriptor.numFaces = int(cage.counts.size());
    descriptor.numVertsPerFace = cage.counts.data();
    descriptor.vertIndicesPerFace = cage.vertices.data();
    descriptor.numCreases = int(cage.creaseWeights.size());
    descriptor.creaseVertexIndexPairs = cage.creaseEdges.data();
    descriptor.creaseWeights = cage.creaseWeights.data();
    descriptor.numCorners = int(cage.cornerWeights.size());
    descriptor.cornerVertexIndices = cage.cornerVertices.data();
    descriptor.cornerWeights = cage.cornerWeights.data();
    descriptor.numHoles = int(cage.holes.size());
    descriptor.holeIndices = cage.holes.data();
    descriptor.numFVarChannels = int(fvar.size());
    descriptor.fvarChannels = fvar.data();

    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const Factory::Options options(sdcScheme(mesh, cage, diagnostics),
                                   sdcOptions(mesh, diagnostics));
    MessageCapture capture;
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, options));
    if (!refiner) {
        diagnostics.warn(mesh.path, "subdivisionScheme", messages::openSubdivFails(capture.text));
        return nullptr;
    }
    Far::TopologyRefiner::UniformOptions uniform(level);
    uniform.fullTopologyInLastLevel = true; // limit masks and sharp normals look around
    refiner->RefineUniform(uniform);
    if (!capture.text.empty())
        diagnostics.warn(mesh.path, "subdivisionScheme", messages::openSubdivSays(capture.text));
    return refiner;
}

} // namespace patina
