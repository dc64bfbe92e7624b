#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace rex {

/// Reads a mesh from an STL, OBJ (with its MTL), PLY, DAE, glTF, GLB, OFF or MuJoCo's MSH file without
/// scaling its lengths; scaledMesh() converts them to metres. The unit and up axis of a DAE file are
/// respected, and glTF and GLB have y up; both are turned to z up. Nodes are placed by their transforms.
/// Normals are computed as by weldedMesh(); those of the file are ignored. Materials become parts with their
/// base colour, without textures (see readTexturedMesh()). A file without triangles gives its points. Files
/// that it names are read from its folder or below.
///
/// Throws Error naming the file if it is missing, of another kind, over 32 MiB (STL, PLY, GLB, MSH) or 16 MiB
/// (others), or faulty; if it has numbers that are not finite or beyond 1e6, more than a million triangles,
/// 2.1 million vertices, 1000 corners of a face or 5000 nested nodes (in glTF: nodes that have children);
/// or if all its triangles have no area. Runs in a process of its own for at most 10 s and 1 GiB; throws
/// Interrupted as callIsolated() does. Measured with files of a million triangles: 0.7 s, 350 MB.
[[nodiscard]] TriangleMesh readMesh(const std::filesystem::path& file);

/// A mesh, and one line for each texture that could not be read; its parts are untextured.
struct TexturedMesh {
  TriangleMesh mesh;
  std::vector<std::string> missing;
  /// The turn to z up from the axes of a Collada file, which is done; identity if it has z up, and for
  /// other files.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

/// The same with the textures of base or diffuse colours, PNG or JPEG, inside the file or in its folder or
/// below: at most 64, of at most 16 MiB and 2^24 pixels each and 2^25 pixels together. Only their colours
/// and the first texture coordinates of the mesh are used. In OBJ and DAE a texture replaces the colour; in
/// glTF and GLB it is multiplied by it.
[[nodiscard]] TexturedMesh readTexturedMesh(const std::filesystem::path& file);

/// The same as readMesh() for the content of a file in memory. `name` stands for it in messages, and its
/// extension says the kind. Reads no file, so files that the mesh names are not found.
[[nodiscard]] TriangleMesh parseMesh(std::string_view bytes, const std::string& name);

}  // namespace rex
