#include <iterator>

#include "base/error.h"
#include "formats/mesh_limits_internal.h"
#include "formats/mesh_reader.h"
#include "formats/mesh_reader_internal.h"
#include "fuzz/require.h"
#include "geometry/convex_hull.h"

namespace {

using rex::TriangleMesh;
using rex::fuzz::require;

void requireSound(const TriangleMesh& mesh) {
  require(!mesh.isEmpty(), "a mesh has vertices");
  require(mesh.halfBounds().maxCoeff() <= 1.0001e6, "vertices lie within a thousand kilometres");
  if (mesh.triangles().empty()) return;
  require(mesh.normals().size() == mesh.positions().size(), "each vertex has a normal");
  for (const Eigen::Vector3f& normal : mesh.normals())
    require(std::abs(normal.norm() - 1) < 1e-3f, "normals have length 1");
}

void requireHull(const TriangleMesh& hull, const TriangleMesh& mesh) {
  require(!hull.isEmpty() && hull.positions().size() <= mesh.positions().size(),
          "a hull is made of vertices");
  // Points that lie almost on a line or plane of the others may be left out.
  const Eigen::Vector3d missing = (hull.halfBounds() - mesh.halfBounds()).cwiseAbs();
  require(missing.maxCoeff() <= 1e-6 * mesh.halfBounds().maxCoeff(), "a hull reaches as far as its mesh");
}

// As parseMesh(), but of the two kinds at which assimp holds in this process, where the fuzzer sees which
// code is reached.
TriangleMesh parse(std::string_view bytes, const std::string& name) {
  if (name != "a.stl" && name != "a.obj") return rex::parseMesh(bytes, name);
  rex::mesh::requireSize(bytes.size(), name);
  rex::mesh::requireHarmless(bytes, name);
  return rex::mesh::readByAssimp(bytes, name, {}).mesh;
}

}  // namespace

// What assimp forgets to free is not ours.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

// The first byte says the kind, the others are the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kNames[] = {"a.stl", "a.obj", "a.ply", "a.dae", "a.gltf", "a.glb", "a.off"};
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    const TriangleMesh mesh = parse(bytes, kNames[data[0] % std::size(kNames)]);
    requireSound(mesh);
    requireHull(rex::convexHull(mesh), mesh);
  } catch (const rex::Error& error) {
    require(!error.parts().what.empty(), "a refusal has a reason");
  }
  return 0;
}
