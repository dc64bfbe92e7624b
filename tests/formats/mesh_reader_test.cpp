#include "formats/mesh_reader.h"

#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "formats/scaled_mesh.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace rex::mesh_reader_test {

namespace fs = std::filesystem;
using Eigen::Vector3f;

class MeshReader : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }

  TemporaryFolder folder_;
};

std::string asciiStl(const BareMesh& mesh) {
  std::ostringstream text;
  text.precision(9);
  text << "solid sample\n";
  for (const auto& triangle : mesh.triangles) {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const std::uint32_t corner : triangle)
      text << "  vertex " << mesh.positions[corner].transpose() << '\n';
    text << " endloop\nendfacet\n";
  }
  text << "endsolid sample\n";
  return text.str();
}

std::string binaryStl(const BareMesh& mesh) {
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  add(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    add(std::array<float, 3>{});
    for (const std::uint32_t corner : triangle) add(mesh.positions[corner]);
    add(std::uint16_t{0});
  }
  return bytes;
}

constexpr const char* kTetrahedronOff =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

TEST_F(MeshReader, ReadsStlAsASmoothSurface) {
  const BareMesh sphere = sphereSample(0.5f, 3);
  for (const fs::path& file :
       {write("ascii.stl", asciiStl(sphere)), write("binary.STL", binaryStl(sphere))}) {
    const TriangleMesh mesh = scaledMesh(readMesh(file), Eigen::Vector3d::Constant(2), "sphere");
    EXPECT_EQ(mesh.positions().size(), 258u) << file;
    EXPECT_EQ(mesh.triangles().size(), 512u);
    // A sphere of radius 1, less what its flat sides cut off.
    EXPECT_NEAR(volumeOf(mesh), 4 * std::numbers::pi / 3, 0.03 * 4.19);
    EXPECT_LT(volumeOf(mesh), 4 * std::numbers::pi / 3);
    EXPECT_NEAR(areaOf(mesh), 4 * std::numbers::pi, 0.02 * 12.6);
    for (std::size_t i = 0; i < mesh.normals().size(); ++i)
      EXPECT_GT(mesh.normals()[i].dot(mesh.positions()[i]), std::cos(0.03));
    ASSERT_EQ(mesh.parts().size(), 1u);
    EXPECT_FALSE(mesh.parts()[0].color.has_value()) << "STL has no colours";
  }
}

TEST_F(MeshReader, ReadsMaterialsOfObj) {
  write("two.mtl", "newmtl blue\nKd 0.1 0.2 0.9\nd 0.5\nnewmtl red\nKd 0.8 0.1 0\n");
  const BareMesh cube = cubeSample(1);
  std::ostringstream text;
  for (const Vector3f& p : cube.positions) text << "v " << p.transpose() << '\n';
  const std::string bottomAndTop = "f 1 3 4 2\nf 5 6 8 7\n";
  const std::string sides = "f 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const TriangleMesh mesh = readMesh(write(
      "two.obj", "mtllib two.mtl\n" + text.str() + "usemtl red\n" + bottomAndTop + "usemtl blue\n" + sides));
  EXPECT_NEAR(volumeOf(mesh), 8, 1e-5);
  EXPECT_EQ(mesh.positions().size(), 24u);
  ASSERT_EQ(mesh.parts().size(), 2u);
  EXPECT_EQ(mesh.parts()[0].triangleCount, 4u);
  ASSERT_TRUE(mesh.parts()[0].color && mesh.parts()[1].color);
  EXPECT_LT((*mesh.parts()[0].color - Eigen::Vector4f(0.8f, 0.1f, 0, 1)).norm(), 1e-6f);
  EXPECT_LT((*mesh.parts()[1].color - Eigen::Vector4f(0.1f, 0.2f, 0.9f, 0.5f)).norm(), 1e-6f);
  const TriangleMesh plain = readMesh(write("plain.obj", text.str() + bottomAndTop + sides));
  for (const auto& part : plain.parts()) EXPECT_FALSE(part.color.has_value()) << "no material";
}

// What nobody defines has no colour; of assimp it would have a grey one.
TEST_F(MeshReader, KnowsNoColorWithoutALibrary) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  write("two.mtl", "newmtl  dark red \r\nKd 0.5 0 0\r\n\tnewmtl steel\nKd 1 1 1\nnewmtl\n");
  const auto color = [&](const std::string& material, const std::string& library) {
    return readMesh(write("a.obj", library + triangle + "usemtl " + material + "\nf 1 2 3\n"))
        .parts()[0]
        .color;
  };
  EXPECT_FALSE(color("steel", "")) << "no library";
  EXPECT_FALSE(color("steel", "mtllib gone.mtl\n"));
  EXPECT_FALSE(color("steel", "mtllib two.mtl\n")) << "not in the library";
  const auto red = color("dark red", "mtllib two.mtl\n");
  ASSERT_TRUE(red);
  EXPECT_FLOAT_EQ((*red)[0], .5f);
}

// As MuJoCo writes them: counts, positions, normals, points in textures, faces.
TEST_F(MeshReader, ReadsMeshesOfMujoco) {
  std::string bytes;
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(std::array<std::int32_t, 4>{4, 1, 1, 4});
  add(std::array<float, 12>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  add(std::array<float, 5>{0, 0, 1, .5f, .5f});
  const std::size_t faces = bytes.size();
  add(std::array<std::int32_t, 12>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
  EXPECT_NEAR(volumeOf(readMesh(write("a.msh", bytes))), 1. / 6, 1e-6);
  EXPECT_REX_ERROR(parseMesh(bytes + "x", "a.msh"),
                   "a.msh: MSH file: found 117 bytes after its counts, wanted 116");
  EXPECT_REX_ERROR(parseMesh("$MeshFormat", "a.msh"),
                   "a.msh: MSH file: found 11 bytes, wanted MuJoCo's format");
  EXPECT_REX_ERROR(parseMesh("$MeshFormat 2.2 0 8", "a.msh"), "a.msh: MSH file: found 1936018724 vertices");
  std::string wrong = bytes;
  wrong[faces] = 4;
  EXPECT_REX_ERROR(parseMesh(wrong, "a.msh"),
                   "a.msh: MSH file: found a face with corner 4, wanted indices below 4");
  std::string points = bytes.substr(0, faces);
  points[12] = 0;
  EXPECT_NEAR(volumeOf(parseMesh(points, "a.msh")), 1. / 6, 1e-6) << "the hull";
}

TEST_F(MeshReader, ReadsPlyWithAndWithoutFaces) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const TriangleMesh cloud = readMesh(write("cloud.ply", head + "end_header\n" + points));
  ASSERT_EQ(cloud.positions().size(), 4u);
  EXPECT_TRUE(cloud.triangles().empty());
  EXPECT_EQ(cloud.positions()[1], Vector3f(1, 0, 0));
  const TriangleMesh mesh = readMesh(
      write("mesh.ply", head + "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
                            points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"));
  EXPECT_NEAR(volumeOf(mesh), 1. / 6, 1e-7);
  EXPECT_FALSE(mesh.parts()[0].color.has_value());
}

TEST_F(MeshReader, ReadsOff) {
  const TriangleMesh mesh = readMesh(write("tetrahedron.off", kTetrahedronOff));
  EXPECT_NEAR(volumeOf(mesh), 1. / 6, 1e-7);
  EXPECT_NEAR(areaOf(mesh), 1.5 + std::sqrt(3) / 2, 1e-6);
  EXPECT_EQ(mesh.positions().size(), 12u);
  EXPECT_FALSE(mesh.parts()[0].color.has_value());
}

std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (int k = 0; k < 3; ++k) word = word << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[word >> shift & 63];
  }
  return text;
}

// A tetrahedron with edges of 1, 2 and 3 along x, y and z of the file.
std::string collada(const std::string& asset) {
  return R"(<?xml version="1.0"?><COLLADA version="1.4.1"><asset>)" + asset +
         R"(</asset><library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>
    <accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
    <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 1 2 3 0 3 2</p>
    </triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node>
    <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
    <scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(MeshReader, RespectsUnitsAndUpwardAxisOfCollada) {
  struct Case {
    const char* asset;
    double metre;
    Eigen::Matrix3f turn;  // columns: where x, y and z of the file point
  };
  Eigen::Matrix3f xUp, yUp;
  xUp << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  yUp << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Matrix3f zUp = Eigen::Matrix3f::Identity();
  for (const Case& c : {Case{"<up_axis>Z_UP</up_axis>", 1, zUp},
                        Case{"<unit meter='0.001'/><up_axis>Z_UP</up_axis>", 0.001, zUp},
                        Case{"<unit meter='0.0254' name='inch'/><up_axis>Y_UP</up_axis>", 0.0254, yUp},
                        Case{"", 1, yUp}, Case{"<up_axis>X_UP</up_axis>", 1, xUp}}) {
    const TriangleMesh mesh = parseMesh(collada(c.asset), "edges.dae");
    EXPECT_NEAR(volumeOf(mesh) / std::pow(c.metre, 3), 1, 1e-5) << c.asset;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3f tip = c.turn.col(axis) * static_cast<float>((axis + 1) * c.metre);
      EXPECT_TRUE(std::any_of(mesh.positions().begin(), mesh.positions().end(),
                              [&](const Vector3f& p) { return (p - tip).norm() < 1e-5 * c.metre; }))
          << c.asset << ": " << tip.transpose();
    }
  }
}

TEST_F(MeshReader, RefusesIndicesOfColladaThatAreNone) {
  std::string text = collada("");
  text.replace(text.find("<p>0 2 1"), 8, "<p>0 2'1");
  EXPECT_REX_ERROR(
      parseMesh(text, "a.dae"),
      "a.dae: DAE file: found a list of indices that holds something else, too, wanted whole numbers");
}

TEST_F(MeshReader, TakesOtherKindsAsTheyStand) {
  EXPECT_EQ(parseMesh("v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n", "a.obj").halfBounds(),
            Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(parseMesh("OFF\n3 1 3\n0 0 0\n1 0 0\n0 2 3\n3 0 1 2\n", "a.off").halfBounds(),
            Eigen::Vector3d(1, 2, 3));
}

TEST_F(MeshReader, SeesOnlyFilesOfItsFolder) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  fs::create_directories(folder_.path() / "meshes/deeper");
  for (const char* name : {"secret.mtl", "meshes/near.mtl", "meshes/deeper/far.mtl"})
    write(name, "newmtl red\nKd 1 0 0\n");
  fs::create_symlink("../secret.mtl", folder_.path() / "meshes/link.mtl");
  const auto isRed = [&](const std::string& library) {
    const auto color =
        readMesh(write("meshes/a.obj", "mtllib " + library + "\n" + triangle)).parts()[0].color;
    return color && color->isApprox(Eigen::Vector4f(1, 0, 0, 1));
  };
  EXPECT_TRUE(isRed("near.mtl"));
  EXPECT_TRUE(isRed("deeper/far.mtl"));
  EXPECT_FALSE(isRed("../secret.mtl"));
  EXPECT_FALSE(isRed("link.mtl"));
  EXPECT_FALSE(isRed((folder_.path() / "secret.mtl").string()));
}

// A tetrahedron, mirrored in x and moved by nested nodes.
TEST_F(MeshReader, PlacesTheNodesOfGltf) {
  const std::array<float, 12> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::array<std::uint16_t, 12> indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  std::string bytes(72, '\0');
  std::memcpy(bytes.data(), positions.data(), 48);
  std::memcpy(bytes.data() + 48, indices.data(), 24);
  const std::string text = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"children": [1], "translation": [0, 0, 5]}, {"mesh": 0, "scale": [-2, 1, 1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.2158605, 0, 1]}}],
    "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,)" +
                           base64(bytes) + R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 1]},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]})";
  const TriangleMesh mesh = readMesh(write("tetrahedron.gltf", text));
  EXPECT_NEAR(volumeOf(mesh), 2. / 6, 1e-6) << "not inside out, though mirrored";
  EXPECT_EQ(mesh.halfBounds(), Eigen::Vector3d(2, 6, 1)) << "y is up in the file, z here";
  ASSERT_TRUE(mesh.parts()[0].color.has_value());
  EXPECT_LT((*mesh.parts()[0].color - Eigen::Vector4f(1, 0.5019608f, 0, 1)).norm(), 1e-4f)
      << "linear light becomes sRGB";
}

TEST_F(MeshReader, NamesWhatIsWrong) {
  write("tetrahedron.off", kTetrahedronOff);
  EXPECT_REX_ERROR(
      readMesh(folder_.path() / "tetrahedon.off"),
      "tetrahedon.off: cannot read the mesh file: found no such file, wanted a file (did you mean "
      "'tetrahedron.off'?)");
  EXPECT_REX_ERROR(readMesh("no/such/folder/x.stl"),
                   "no/such/folder/x.stl: cannot read the mesh file: found no such file");
  fs::create_directory(folder_.path() / "folder.stl");
  EXPECT_REX_ERROR(readMesh(folder_.path() / "folder.stl"), "cannot read the mesh file: found a folder");
  fs::create_symlink("loop.stl", folder_.path() / "loop.stl");
  EXPECT_REX_ERROR(readMesh(folder_.path() / "loop.stl"), "found Too many levels of symbolic links");
  fs::create_symlink("/dev/null", folder_.path() / "null.stl");
  EXPECT_REX_ERROR(readMesh(folder_.path() / "null.stl"), "cannot read the mesh file: found a device");
  EXPECT_REX_ERROR(readMesh(write("none.off", "OFF\n0 0 0\n")), "none.off");
  EXPECT_REX_ERROR(readMesh(write("a.tri", "")),
                   "a.tri: not a mesh file that rex can read: found '.tri', wanted .stl, .obj, .ply");
  EXPECT_REX_ERROR(readMesh(write("a.sttl", "")), "(did you mean '.stl'?)");
  EXPECT_REX_ERROR(readMesh(write("a", "")), "found no ending");
  for (const char* name :
       {"junk.stl", "junk.obj", "junk.ply", "junk.dae", "junk.gltf", "junk.glb", "junk.off"}) {
    EXPECT_REX_ERROR(readMesh(write(name, "this is not a mesh, however long one looks at it")), name);
    EXPECT_REX_ERROR(readMesh(write(name, "")), name);
  }
  EXPECT_REX_ERROR(readMesh(write("flat.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")),
                   "flat.off: mesh: found 1 triangles, none of which has an area, wanted a surface");
  EXPECT_REX_ERROR(readMesh(write("nan.stl",
                                  "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 nan\n"
                                  "vertex 0 1 0\nendloop\nendfacet\nendsolid x\n")),
                   "nan.stl: mesh: found vertex 1 at (nan, nan, nan), wanted finite numbers up to 1e6");
  EXPECT_REX_ERROR(readMesh(write("far.off", "OFF\n3 1 3\n0 0 0\n2e6 0 0\n0 1 0\n3 0 1 2\n")),
                   "far.off: mesh: found vertex 1 at (2000000, 0, 0)");
  std::error_code problem;
  fs::resize_file(write("large.stl", "x"), (32u << 20) + 1, problem);
  EXPECT_REX_ERROR(readMesh(folder_.path() / "large.stl"),
                   "large.stl: mesh file too large: found 33554433 bytes, wanted at most 32 MiB");
  EXPECT_REX_ERROR(parseMesh(std::string((16u << 20) + 1, ' '), "large.obj"), "wanted at most 16 MiB");
}

TEST_F(MeshReader, RefusesBrokenHeaders) {
  EXPECT_REX_ERROR(parseMesh("ply\nformat ascii 1.0\n", "a.ply"),
                   "a.ply: header of the PLY file: found no 'end_header', wanted one");
  for (const char* line :
       {"property flot x", "property list float int i", "property list uchar", "propery int x"})
    EXPECT_REX_ERROR(parseMesh("ply\nelement vertex 1\n" + std::string(line) + "\nend_header\n", "a.ply"),
                     "bytes of an unknown line, wanted 'element NAME COUNT', 'property TYPE NAME' or");
  EXPECT_REX_ERROR(parseMesh(std::string("glTF\2\0\0\0\40\0\0\0\20\0\0\0JSON{}", 22), "a.glb"),
                   "a.glb: GLB file: found a chunk of 16 bytes, wanted at most the 2 that follow");
  EXPECT_REX_ERROR(parseMesh("OFF\n3 1 3\n0 0 0\n1 0 0\n2 0 0\n3 0 1</p> 2\n", "a.off"),
                   "a.off: OFF file: found a word that is not a number, wanted numbers");
}

// Wherever it is cut: only that its last number was longer, nobody can tell of a text.
TEST_F(MeshReader, RefusesWhatIsCutOff) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  std::string stl = "solid x\n";
  for (int i = 0; i < 2; ++i)
    stl += "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::pair<const char*, std::string> files[] = {
      {"a.ply", ply + corners + "3 0 1 2\n3 0 1 3"},
      {"a.off", "OFF\n4 2 5\n" + corners + "3 0 1 2\n3 0 1 3"},
      {"a.stl", stl + "endsolid"}};
  for (const auto& [name, whole] : files) {
    EXPECT_EQ(parseMesh(whole, name).triangles().size(), 2u);
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_REX_ERROR(parseMesh(whole.substr(0, length), name), name);
  }
  EXPECT_REX_ERROR(parseMesh(ply + corners + "3 0 1 2\n3 0", "a.ply"),
                   "a.ply: PLY file: found the end after 5 elements, wanted as many as its header says");
  EXPECT_REX_ERROR(parseMesh(stl, "a.stl"),
                   "a.stl: STL file: found no 'endsolid' at the end, wanted a complete file");
  EXPECT_REX_ERROR(parseMesh("OFF\n4 2 5\n" + corners + "3 0 1 2\n", "a.off"),
                   "a.off: OFF file: found 5 lines of vertices and faces, wanted 6, as its counts say");
  EXPECT_REX_ERROR(parseMesh("OFF\n4 1 5\n" + corners + "3 0 1\n", "a.off"),
                   "a.off: OFF file: found a face with missing corners, wanted as many as the face declares");
}

// Of another kind than its ending says: nobody has looked for what the reader of that kind does not bear.
TEST_F(MeshReader, ReadsAFileAsItsEndingSays) {
  const std::string endless = "ply\nformat binary_big_endian\4elem\1";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 0\n";
  EXPECT_EQ(parseMesh(ply, "a.ply").positions().size(), 1u);
  for (const char* name : {"a.stl", "a.obj", "a.dae", "a.gltf", "a.glb", "a.off"}) {
    EXPECT_REX_ERROR(parseMesh(ply, name), name);
    EXPECT_REX_ERROR(parseMesh(endless + std::string(100, '\0'), name), name);
  }
}

TEST_F(MeshReader, RefusesIndicesOfNoVertex) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  EXPECT_REX_ERROR(
      readMesh(write("quad.ply", head + "4 0 2 1 99\n")),
      "quad.ply: mesh: found a face with corner 99, wanted indices below 4, the number of vertices");
  EXPECT_REX_ERROR(readMesh(write("triangle.ply", head + "3 0 2 99\n")),
                   "triangle.ply: mesh: found a face with corner 99");
  for (const std::string corner : {"99", "-1", "1.5"})
    EXPECT_REX_ERROR(
        parseMesh("OFF\n3 1 3\n0 0 0\n1 0 0 # a comment\n\n0 1 0\n3 0 2 " + corner + " .5 .5 .5\n", "a.off"),
        "a.off: OFF file: found a face with corner " + corner +
            ", wanted indices below 3, the number of vertices");
}

// A scene whose nodes, as text, follow each other; each may show the one mesh.
std::string gltf(const std::string& nodes, int triangles) {
  std::string bytes(static_cast<std::size_t>(36 + 3 * triangles), '\0');
  const std::array<float, 9> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::memcpy(bytes.data(), positions.data(), 36);
  for (std::size_t i = 36; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 3);
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + nodes +
         R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": )" +
         std::to_string(bytes.size()) + R"(, "uri": "data:application/octet-stream;base64,)" + base64(bytes) +
         R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": )" +
         std::to_string(3 * triangles) + R"(}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5121, "count": )" +
         std::to_string(3 * triangles) + R"(, "type": "SCALAR"}]})";
}

// Each node stands in the one before and a millimetre higher.
std::string chain(int length) {
  std::string nodes;
  for (int i = 1; i < length; ++i)
    nodes += R"({"translation": [0, 0, 0.001], "children": [)" + std::to_string(i) + "]}, ";
  return nodes + R"({"mesh": 0})";
}

// 2^n nodes of n lines: refused before assimp makes them.
TEST_F(MeshReader, RefusesColladaThatRepeatsItself) {
  const auto file = [](int levels) {
    std::string text = "<COLLADA><library_nodes>\n<node id='n0'/><node id = 'x'></node>";
    for (int i = 1; i <= levels; ++i) {
      const std::string one = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
      text += "<node name='n' id='n" + std::to_string(i) + "'>" + one + one + "</node>\n";
    }
    return text + "</library_nodes></COLLADA>";
  };
  EXPECT_REX_ERROR(
      parseMesh(file(40), "a.dae"),
      "a.dae: mesh file: found nodes that repeat each other too often, wanted at most 100000 when "
      "all are repeated");
  EXPECT_REX_ERROR(parseMesh(file(2), "a.dae"), "a.dae: cannot read the mesh file");
}

TEST_F(MeshReader, RefusesDeepGltf) {
  const TriangleMesh mesh = readMesh(write("deep.gltf", gltf(chain(5'001), 1)));
  EXPECT_NEAR(mesh.halfBounds().y(), 5, 1e-3);
  EXPECT_REX_ERROR(readMesh(write("deeper.gltf", gltf(chain(50'001), 1))),
                   "deeper.gltf: mesh file: found nodes nested 50000 deep, wanted at most 5000");
  std::string binary(20, ' ');
  const std::string json = gltf(chain(50'001), 1);
  const auto length = static_cast<std::uint32_t>(json.size());
  std::memcpy(binary.data() + 12, &length, 4);
  EXPECT_REX_ERROR(readMesh(write("deeper.glb", binary + json)), "found nodes nested 50000 deep");
  std::string collada = "<COLLADA><node/>";
  for (int i = 0; i < 5'001; ++i) collada += "<node id='n'>";
  EXPECT_REX_ERROR(readMesh(write("deep.dae", collada)),
                   "deep.dae: mesh file: found nodes nested 5001 deep, wanted at most 5000");
  for (int i = 0; i < 50'000; ++i) collada += "</node><node>";
  EXPECT_REX_ERROR(readMesh(write("deep.dae", collada)), "found nodes nested 5001 deep");
  const std::string brackets(1'000'000, '[');
  EXPECT_REX_ERROR(readMesh(write("brackets.gltf", brackets)),
                   "brackets.gltf: mesh file: found brackets nested 1000000 deep, wanted at most 100");
  // Brackets in a text are none.
  EXPECT_REX_ERROR(readMesh(write("text.gltf", "{\"\\\"" + brackets + "\"}")), "cannot read the mesh file");
}

TEST_F(MeshReader, RefusesMoreThanItCanHold) {
  EXPECT_REX_ERROR(readMesh(write("empty.gltf", gltf("{}", 1))),
                   "empty.gltf: mesh: found no vertices, wanted some");
  std::string nodes = R"({"children": [1)";
  for (int i = 2; i <= 101; ++i) nodes += ", " + std::to_string(i);
  nodes += "]}";
  for (int i = 1; i <= 101; ++i) nodes += R"(, {"mesh": 0})";
  EXPECT_REX_ERROR(readMesh(write("many.gltf", gltf(nodes, 20'000))),
                   "many.gltf: mesh too large: found 1020000 triangles, wanted at most 1000000");
  std::string text = gltf("{}", 1);
  const std::size_t count = text.find("\"count\": 3");
  EXPECT_REX_ERROR(parseMesh(text.replace(count, 10, "\"count\": 9000000"), "claims.gltf"),
                   "claims.gltf: mesh too large: found a count of 3000001, wanted at most 2100000");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n0\n";
  EXPECT_REX_ERROR(parseMesh(ply, "claims.ply"),
                   "claims.ply: mesh too large: found a count of 4000000000, wanted at most 2100000");
  EXPECT_REX_ERROR(parseMesh("OFF # 1\n8 99999999999999999999 1\n", "claims.off"), "mesh too large");
  EXPECT_REX_ERROR(parseMesh("<COLLADA><float_array count=\"7000000\">", "claims.dae"),
                   "found a count of 7000000, wanted at most 3000000");
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::string face = corners + "f", faces = corners;
  for (int i = 0; i < 334; ++i) face += "\t1 2 3 ";
  EXPECT_REX_ERROR(parseMesh(face + "\n", "a.obj"),
                   "a.obj: mesh: found a face with 1002 corners, wanted at most 1000");
  for (int i = 0; i <= 1'000'000; ++i) faces += "f 1 2 3\n";
  EXPECT_REX_ERROR(parseMesh(faces, "a.obj"),
                   "a.obj: mesh too large: found 1000001 triangles, wanted at most 1000000");
  std::string groups;
  for (int i = 0; i <= 10'000; ++i) groups += "g\n";
  EXPECT_REX_ERROR(parseMesh(groups, "groups.obj"),
                   "groups.obj: mesh file: found 10001 materials, groups and objects, wanted at most 10000");
}

}  // namespace rex::mesh_reader_test
