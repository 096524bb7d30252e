// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/cageFaces.h"

namespace patina {

namespace {

/// Counts faults of one kind.
struct Fault {
    size_t count = 0, first = 0;

    void add(size_t index) {
        if (count++ == 0) first = index;
    }
    void report(const Mesh& mesh, const char* input, const MessageMaker<2>& what,
                Diagnostics& diagnostics) {
        if (count > 0) diagnostics.warn(mesh.path, input, what(count, first));
    }
};

void markHoles(const Mesh& mesh, CageFaces& faces, Diagnostics& diagnostics) {
    if (mesh.holeIndices.empty()) return;
    std::vector<uint8_t> authoredHole(faces.authoredFaces);
    Fault outside;
    for (size_t i = 0; i < mesh.holeIndices.size(); ++i) {
        const int face = mesh.holeIndices[i];
        if (face >= 0 && size_t(face) < authoredHole.size())
            authoredHole[face] = 1;
        else
            outside.add(i);
    }
    outside.report(mesh, "holeIndices", messages::holesOutOfRange, diagnostics);
    faces.hole.resize(faces.size());
    for (size_t f = 0; f < faces.size(); ++f)
        faces.hole[f] = authoredHole[faces.authored[f]];
}

} // namespace

CageFaces cageFaces(const Mesh& mesh, const PointSteps& points, Diagnostics& diagnostics) {
    CageFaces faces;
    faces.authoredFaces = mesh.faceVertexCounts.size();
    faces.authoredCorners = mesh.faceVertexIndices.size();
    faces.counts.reserve(faces.authoredFaces);
    faces.firstCorner.reserve(faces.authoredFaces);
    faces.authored.reserve(faces.authoredFaces);

    Fault small, truncated, outside, notFinite;
    size_t corner = 0;
    for (size_t f = 0; f < faces.authoredFaces; ++f) {
        const int count = mesh.faceVertexCounts[f];
        const size_t first = corner;
        corner += size_t(std::max(count, 0));
        if (count < 3) {
            small.add(f);
            continue;
        }
        if (corner > faces.authoredCorners) {
            truncated.add(f);
            continue;
        }
        bool inRange = true, finite = true;
        for (size_t c = first; c < corner && inRange; ++c) {
            const int index = mesh.faceVertexIndices[c];
            inRange = index >= 0 && size_t(index) < points.count();
            finite = finite && inRange && !points.isBad(size_t(index));
        }
        if (!inRange)
            outside.add(f);
        else if (!finite)
            notFinite.add(f);
        if (!inRange || !finite) continue;
        faces.counts.push_back(count);
        faces.firstCorner.push_back(first);
        faces.authored.push_back(int(f));
    }
    small.report(mesh, "faceVertexCounts", messages::facesTooSmall, diagnostics);
    truncated.report(mesh, "faceVertexIndices", messages::facesTruncated, diagnostics);
    if (corner < faces.authoredCorners)
        diagnostics.warn(mesh.path, "faceVertexIndices",
                         messages::indicesOfNoFace(faces.authoredCorners - corner));
    outside.report(mesh, "faceVertexIndices", messages::facesOutOfRange, diagnostics);
    notFinite.report(mesh, "points", messages::facesNotFinite, diagnostics);
    markHoles(mesh, faces, diagnostics);
    return faces;
}

} // namespace patina
