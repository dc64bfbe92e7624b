#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace rex {

/// Reads a mesh from an STL, OBJ (with its MTL), PLY, DAE, glTF, GLB or OFF file, its lengths as they are;
/// scaledMesh() makes metres of them. Units and the upward axis that a DAE file names count, and y is up in
/// glTF and GLB; both are turned to z up. Nodes are put in their places, and normals made as by weldedMesh():
/// those of the file do not count. Materials become parts with their base colour, without
/// textures (see readTexturedMesh()). A file without triangles gives its points. Files that it names are read
/// from its folder or below.
///
/// Throws Error naming the file: missing, of another kind, over 32 MiB (STL, PLY, GLB) or 16 MiB, faulty,
/// with numbers that are not finite or beyond 1e6, with more than a million triangles, 2.1 million
/// vertices, 1000 corners of a face or 5000 nodes below each other (of glTF: nodes that have children), or
/// with nothing but triangles without area. Works in a process of its own for at most 10 s and 1 GiB;
/// Interrupted as of callIsolated(). Measured, files of a million triangles: 0.7 s, 350 MB.
[[nodiscard]] TriangleMesh readMesh(const std::filesystem::path& file);

/// A mesh, and what is wrong with textures that it names, a line each; their parts are bare.
struct TexturedMesh {
  TriangleMesh mesh;
  std::vector<std::string> missing;
};

/// The same with the textures of base or diffuse colours, PNG or JPEG, inside the file or in its folder or
/// below: at most 64, of 16 MiB and 2^24 pixels each and 2^25 together. Only their colours and the first
/// coordinates of the mesh count. In OBJ and DAE a texture takes the place of the colour, in glTF and GLB it
/// is multiplied with it.
[[nodiscard]] TexturedMesh readTexturedMesh(const std::filesystem::path& file);

/// The same as readMesh() for the content of a file at hand; `name` stands for it in messages, and its ending
/// says the kind. Reads no file: what it names is not found.
[[nodiscard]] TriangleMesh parseMesh(std::string_view bytes, const std::string& name);

}  // namespace rex
