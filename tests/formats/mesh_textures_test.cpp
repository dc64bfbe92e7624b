// Textures of meshes: pictures made here by libpng and libjpeg, and squares that are painted with them.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <jpeglib.h>
#include <png.h>

#include "formats/mesh_reader.h"
#include "formats/ors_reader.h"
#include "formats/scaled_mesh.h"
#include "formats/texture_reader_internal.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::mesh_textures_test {

namespace fs = std::filesystem;
using Eigen::Vector2f;
using Eigen::Vector3f;
using ::testing::HasSubstr;

// Rows from the top, red, green, blue.
std::string pngOf(int width, int height, const std::vector<std::uint8_t>& rgb) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = PNG_FORMAT_RGB;
  std::string bytes(100 + 4 * rgb.size(), '\0');
  png_alloc_size_t size = bytes.size();
  EXPECT_NE(png_image_write_to_memory(&header, bytes.data(), &size, 0, rgb.data(), 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

std::string jpegOf(int width, int height, std::vector<std::uint8_t> rgb) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &buffer, &size);
  info.image_width = static_cast<JDIMENSION>(width);
  info.image_height = static_cast<JDIMENSION>(height);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;  // colours as fine as light
  jpeg_set_quality(&info, 100, TRUE);
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    JSAMPROW row = rgb.data() + 3 * info.image_width * info.next_scanline;
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  std::string bytes(reinterpret_cast<const char*>(buffer), size);
  jpeg_destroy_compress(&info);
  std::free(buffer);
  return bytes;
}

// Blue and white above red and green.
const std::vector<std::uint8_t> kFour = {0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255, 0};
const std::vector<std::uint8_t> kFourUpward = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

std::string base64Of(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[(word >> (18 - 6 * k)) & 63];
  }
  return text;
}

class MeshTextures : public testing::Test {
 protected:
  MeshTextures() { fs::create_directories(folder_.path() / "meshes/deep"); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  // A square in the plane of x and z whose points are (x, z).
  fs::path square(const std::string& material, const std::string& name = "meshes/square.obj") const {
    write("meshes/square.mtl", "newmtl m\nKd 0.2 0.4 0.6\n" + material + "\n");
    return write(name,
                 "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n"
                 "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n");
  }
  static void expectPainted(const TexturedMesh& read) {
    EXPECT_THAT(read.missing, testing::IsEmpty());
    ASSERT_EQ(read.mesh.paint().textures.size(), 1u);
    const Texture& texture = read.mesh.paint().textures[0];
    EXPECT_EQ(texture.width, 2);
    EXPECT_EQ(texture.height, 2);
    EXPECT_EQ(texture.rgb, kFourUpward);
    ASSERT_EQ(read.mesh.parts().size(), 1u);
    EXPECT_EQ(read.mesh.parts()[0].texture, 0u);
    EXPECT_LT((*read.mesh.parts()[0].color - Eigen::Vector4f::Ones()).norm(), 1e-6f);
    ASSERT_EQ(read.mesh.positions().size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3f& p = read.mesh.positions()[i];
      EXPECT_LT((read.mesh.paint().points[i] - Vector2f(p.x(), p.z())).norm(), 1e-6f) << p.transpose();
    }
  }

  TemporaryFolder folder_;
};

TEST_F(MeshTextures, OfObjFilesLieBesideThem) {
  write("meshes/four.png", pngOf(2, 2, kFour));
  write("meshes/deep/four.png", pngOf(2, 2, kFour));
  expectPainted(readTexturedMesh(square("map_Kd four.png")));
  expectPainted(readTexturedMesh(square("map_Kd deep/four.png")));
  expectPainted(readTexturedMesh(square("map_Kd deep\\four.png")));
  const TriangleMesh bare = readMesh(square("map_Kd four.png"));
  EXPECT_TRUE(bare.paint().textures.empty());
  EXPECT_TRUE(bare.paint().points.empty());
  EXPECT_LT((*bare.parts()[0].color - Eigen::Vector4f(.2f, .4f, .6f, 1)).norm(), 1e-6f);
}

TEST_F(MeshTextures, OfGltfFilesLieInThem) {
  std::string buffer;
  const auto add = [&](const auto& value) {
    buffer.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const auto& [x, y] : {std::pair{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}})
    add(std::array<float, 3>{x, y, 0});
  for (const auto& [u, v] : {std::pair{0.f, 1.f}, {1.f, 1.f}, {1.f, 0.f}, {0.f, 0.f}})  // v down
    add(std::array<float, 2>{u, v});
  add(std::array<std::uint16_t, 6>{0, 1, 2, 0, 2, 3});
  const std::string text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" +
      base64Of(pngOf(2, 2, kFour)) + R"("}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":12}],
"buffers":[{"byteLength":92,"uri":"data:application/octet-stream;base64,)" +
      base64Of(buffer) + R"("}]})";
  expectPainted(readTexturedMesh(write("meshes/square.gltf", text)));
}

TEST_F(MeshTextures, OfDaeFilesLieBesideThem) {
  write("meshes/four.png", pngOf(2, 2, kFour));
  expectPainted(readTexturedMesh(write("meshes/square.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_images><image id="i" name="i"><init_from>four.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
<technique sid="q"><lambert><diffuse><texture texture="t" texcoord="UV"/></diffuse></lambert></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 0 1 0 0 1</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
<accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="k" count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="sc"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="k" target="#m">
<bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/></instance_material>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#sc"/></scene></COLLADA>)")));
}

TEST_F(MeshTextures, MayBeJpeg) {
  std::vector<std::uint8_t> rgb;  // a ramp upward in red and to the right in green
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      for (const int c : {15 * (15 - y), 8 * x, 100}) rgb.push_back(static_cast<std::uint8_t>(c));
  const Texture texture = mesh::readTexture(jpegOf(32, 16, rgb), "ramp");
  ASSERT_EQ(texture.width, 32);
  ASSERT_EQ(texture.height, 16);
  for (std::size_t y = 0; y < 16; ++y)
    for (std::size_t x = 0; x < 32; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(texture.rgb[3 * (32 * y + x) + c], rgb[3 * (32 * (15 - y) + x) + c], 6);
}

TEST_F(MeshTextures, SurviveScaling) {
  write("meshes/four.png", pngOf(2, 2, kFour));
  const TriangleMesh mesh = readTexturedMesh(square("map_Kd four.png")).mesh;
  const TriangleMesh large = scaledMesh(mesh, {2, 2, -2}, "square");
  EXPECT_EQ(large.paint().points, mesh.paint().points);
  EXPECT_EQ(large.paint().textures[0].rgb, kFourUpward);
}

TEST_F(MeshTextures, ComeFromTheFolderOfTheMeshOnly) {
  write("secret.png", pngOf(2, 2, kFour));
  fs::create_symlink("../secret.png", folder_.path() / "meshes/link.png");
  const auto expectMissing = [&](const std::string& name, const std::string& message) {
    const TexturedMesh read = readTexturedMesh(square("map_Kd " + name));
    ASSERT_EQ(read.missing.size(), 1u) << name;
    EXPECT_THAT(read.missing[0], HasSubstr(message));
    EXPECT_TRUE(read.mesh.paint().textures.empty());
    EXPECT_LT((*read.mesh.parts()[0].color - Eigen::Vector4f(.2f, .4f, .6f, 1)).norm(), 1e-6f);
  };
  const std::string none =
      "found no such file of at most 16 MiB, wanted one in the folder of the mesh or in a subfolder";
  for (const std::string& name : {std::string("none.png"), std::string("../secret.png"),
                                  std::string("link.png"), (folder_.path() / "secret.png").string()})
    expectMissing(name, "texture '" + name + "': " + none);
}

TEST_F(MeshTextures, SayWhatIsWrongWithThem) {
  const std::string png = pngOf(2, 2, kFour), jpeg = jpegOf(2, 2, kFour);
  EXPECT_REX_ERROR(mesh::readTexture("GIF89a", "texture 'a'"),
                   "texture 'a': found neither PNG nor JPEG, wanted one of them");
  EXPECT_REX_ERROR(mesh::readTexture("", "t"), "neither PNG nor JPEG");
  EXPECT_REX_ERROR(mesh::readTexture(png.substr(0, 40), "t"), "t: found a faulty PNG file: ");
  EXPECT_REX_ERROR(mesh::readTexture(jpeg.substr(0, 200), "t"), "t: found a faulty JPEG file: ");
  EXPECT_REX_ERROR(mesh::readTexture(pngOf(8193, 1, std::vector<std::uint8_t>(3 * 8193)), "t"),
                   "t: found 8193 x 1 pixels, wanted at most 8192 per side and 16777216 in total");
  EXPECT_REX_ERROR(mesh::readTexture(jpegOf(9000, 1, std::vector<std::uint8_t>(3 * 9000)), "t"),
                   "t: found 9000 x 1 pixels");
}

TEST_F(MeshTextures, AreReadOnRequestAndMissedWithOneWarning) {
  square("map_Kd none.png");
  const fs::path scene =
      write("scene.ors",
            "shape a { type=3 mesh='meshes/square.obj' }\nshape b { type=3 mesh='meshes/square.obj' }\n");
  EXPECT_THAT(readOrs(scene).notes, testing::IsEmpty());
  const SceneFile read = readOrs(scene, {.textures = true});
  ASSERT_EQ(read.notes.size(), 1u);
  EXPECT_THAT(toString(read.notes[0]), HasSubstr("scene.ors:1:"));
  EXPECT_THAT(toString(read.notes[0]), HasSubstr("warning: shape 'a': mesh '"));
  EXPECT_THAT(toString(read.notes[0]),
              HasSubstr("texture 'none.png': found no such file of at most 16 MiB, wanted one in the folder "
                        "of the mesh or in a subfolder; its colour is drawn instead"));
  write("meshes/none.png", pngOf(2, 2, kFour));
  const SceneFile whole = readOrs(scene, {.textures = true});
  EXPECT_THAT(whole.notes, testing::IsEmpty());
  EXPECT_EQ(whole.spec.worldShapes[1].shape.mesh.paint().textures.size(), 1u);
}

TEST(PaintOfAMesh, IsChecked) {
  const std::vector<Vector3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, normals(3, Vector3f::UnitZ());
  const auto make = [&](std::vector<Vector2f> points, std::vector<Texture> textures,
                        std::optional<std::uint32_t> used) {
    return TriangleMesh(positions, normals, {{0, 1, 2}}, {{.triangleCount = 1, .texture = used}},
                        {std::move(points), std::move(textures)});
  };
  const std::vector<Vector2f> three(3, Vector2f::Zero());
  const Texture dot{1, 1, {1, 2, 3}};
  EXPECT_EQ(make(three, {dot}, 0u).paint().textures[0].rgb[2], 3);
  EXPECT_REX_ERROR(make({Vector2f::Zero()}, {dot}, 0u), "mesh: found 1 texture coordinates, wanted 3");
  EXPECT_REX_ERROR(make({three[0], three[0], {NAN, 0}}, {dot}, 0u),
                   "a texture coordinate that is not finite");
  EXPECT_REX_ERROR(make(three, {dot}, 1u), "mesh: found a part with texture 1, wanted one below 1");
  EXPECT_REX_ERROR(make({}, {dot}, 0u), "mesh: found a part with texture 0");
  EXPECT_REX_ERROR(make(three, {{2, 1, {1, 2, 3}}}, 0u), "a texture of 2 x 1 pixels with 3 bytes");
  EXPECT_REX_ERROR(make(three, {{0, 0, {}}}, 0u), "a texture of 0 x 0 pixels with 0 bytes");
}

}  // namespace rex::mesh_textures_test
