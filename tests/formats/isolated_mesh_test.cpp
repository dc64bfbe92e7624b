#include <algorithm>

#include <gtest/gtest.h>

#include "formats/mesh_reader_internal.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::mesh::isolated_mesh_test {

// What fuzzing found; its first byte says the kind.
std::string crashing() { return fileText(sourcePath("tests/fuzz/corpus/mesh/dae_crash")).substr(1); }

// assimp compares each material with all others.
std::string slow() {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += "usemtl m" + std::to_string(i) + "\n";
  return text;
}

TEST(ReadIsolated, GivesTheMeshThatAssimpGives) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const TriangleMesh here = readByAssimp(text, "a.obj", {}).mesh;
  const TriangleMesh mesh = readIsolated(text, "a.obj", {}).mesh;
  EXPECT_TRUE(std::ranges::equal(mesh.positions(), here.positions()));
  EXPECT_TRUE(std::ranges::equal(mesh.normals(), here.normals()));
  EXPECT_TRUE(std::ranges::equal(mesh.triangles(), here.triangles()));
  ASSERT_EQ(mesh.parts().size(), 1u);
  EXPECT_EQ(mesh.parts()[0].triangleCount, 4u);
}

TEST(ReadIsolated, RefusesWhatAssimpDoesNotSurvive) {
  EXPECT_REX_ERROR(readIsolated(crashing(), "a.dae", {}),
                   "a.dae: cannot read the mesh file: found one on which assimp crashes, wanted a mesh, e.g. "
                   "the same one saved by another program or as STL");
  EXPECT_REX_ERROR(
      readIsolated(slow(), "a.obj", {}, {.cpuSeconds = 1}),
      "a.obj: cannot read the mesh file: found one that assimp does not finish reading, wanted a mesh");
}

#ifndef __SANITIZE_ADDRESS__  // sanitizers reserve all addresses
TEST(ReadIsolated, RefusesWhatNeedsTooMuchMemory) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 100'000; ++i) text += "f 1 2 3\n";
  EXPECT_REX_ERROR(
      readIsolated(text, "a.obj", {}, {.memory = 4u << 20}),
      "a.obj: cannot read the mesh file: found one for which assimp needs too much memory, wanted a mesh");
}
#endif

}  // namespace rex::mesh::isolated_mesh_test
