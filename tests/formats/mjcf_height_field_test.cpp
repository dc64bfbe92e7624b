// Height fields of MJCF.
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "formats/mjcf_reader.h"
#include "scene/scene_edit.h"
#include "support/expect_error.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace rex::mjcf_height_field_test {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

std::string model(const std::string& field, const std::string& compiler = "") {
  return "<mujoco><compiler " + compiler + "/><asset><hfield name='h' size='2 1 .5 .25' " + field +
         "/></asset><worldbody><geom name='g' type='hfield' hfield='h' pos='0 0 3'/></worldbody></mujoco>";
}

// The height of the drawn surface at a vertex.
double heightAt(const SceneSpec& spec, double x, double y) {
  double height = -1;
  for (const Eigen::Vector3f& p : spec.worldShapes.at(0).shape.mesh.positions())
    if (std::abs(p.x() - x) < 1e-6 && std::abs(p.y() - y) < 1e-6) height = std::max(height, double(p.z()));
  return height;
}

// Rows of the tag go from the largest y down, and are scaled to 0 to 1.
TEST(MjcfHeightField, IsReadFromItsTag) {
  const SceneFile scene = parseMjcf(model("nrow='2' ncol='3' elevation='1 2 3 5 5 1'"), "m.xml");
  EXPECT_TRUE(scene.notes.empty());
  EXPECT_DOUBLE_EQ(heightAt(scene.spec, -2, 1), 0);
  EXPECT_NEAR(heightAt(scene.spec, 0, 1), .125, 1e-7);
  EXPECT_NEAR(heightAt(scene.spec, 2, 1), .25, 1e-7);
  EXPECT_NEAR(heightAt(scene.spec, -2, -1), .5, 1e-7);
  EXPECT_DOUBLE_EQ(heightAt(scene.spec, 2, -1), 0);
  const auto& shapes = scene.spec.worldShapes;
  ASSERT_EQ(shapes.size(), 5u) << "the surface, and two prisms for each cell";
  EXPECT_TRUE(shapes[0].visible && !shapes[0].contact);
  EXPECT_EQ(shapes[0].X_BS.p, Vector3d(0, 0, 3));
  double touched = 0;
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_TRUE(shapes[i].contact && !shapes[i].visible);
    EXPECT_FALSE(shapes[i].shape.hull.isEmpty());
    touched += volumeOf(shapes[i].shape.hull);
  }
  // Both are closed, turned outside, and the same solid.
  EXPECT_NEAR(volumeOf(shapes[0].shape.mesh), touched, 1e-6);
  // Columns of 2 m x 1 m on the mean of their corners, two triangles for each cell.
  const double h[2][3] = {{.5, .5, 0}, {0, .125, .25}};
  double wanted = 4 * 2 * .25;
  for (int c = 0; c < 2; ++c)
    wanted += 2. * 2 / 2 * ((h[0][c] + h[0][c + 1] + h[1][c]) + (h[1][c] + h[0][c + 1] + h[1][c + 1])) / 3;
  EXPECT_NEAR(touched, wanted, 1e-6);
}

TEST(MjcfHeightField, IsFlatWithoutElevation) {
  const SceneSpec spec = parseMjcf(model("nrow='2' ncol='2'"), "m.xml").spec;
  EXPECT_DOUBLE_EQ(heightAt(spec, 2, 1), 0);
  EXPECT_NEAR(volumeOf(spec.worldShapes.at(0).shape.mesh), 4 * 2 * .25, 1e-6);
}

class MjcfHeightFieldFile : public testing::Test {
 protected:
  SceneSpec read(const std::string& file, const std::string& bytes, Diagnostics* notes = nullptr) const {
    std::filesystem::create_directories(folder_.path() / "assets");
    std::ofstream(folder_.path() / "assets" / file, std::ios::binary) << bytes;
    std::ofstream(folder_.path() / "m.xml") << model("file='" + file + "'", "meshdir='assets'");
    SceneFile scene = readMjcf(folder_.path() / "m.xml");
    if (notes != nullptr) *notes = scene.notes;
    return std::move(scene.spec);
  }
  static std::string binary(std::int32_t rows, std::int32_t columns, const std::vector<float>& heights) {
    std::string bytes(reinterpret_cast<const char*>(&rows), 4);
    bytes.append(reinterpret_cast<const char*>(&columns), 4);
    return bytes.append(reinterpret_cast<const char*>(heights.data()), 4 * heights.size());
  }
  TemporaryFolder folder_;
};

// Rows of the binary file go from the smallest y up.
TEST_F(MjcfHeightFieldFile, IsReadFromBinaryFiles) {
  const SceneSpec spec = read("h.bin", binary(2, 3, {0, 0, 1, 0, 2, 4}));
  EXPECT_NEAR(heightAt(spec, 2, -1), .125, 1e-7);
  EXPECT_NEAR(heightAt(spec, 2, 1), .5, 1e-7);
  EXPECT_REX_ERROR(read("h.bin", binary(2, 3, {0, 0, 1})),
                   "<hfield>: attribute 'file': found 20 bytes, wanted 32");
  EXPECT_REX_ERROR(read("h.bin", binary(1, 3, {0, 0, 1})),
                   "size of the grid: found 1 x 3, wanted at least 2 x 2");
  EXPECT_REX_ERROR(read("h.bin", binary(2, 2, {0, NAN, 1, 0})), "found a height that is not finite");
}

// The first row of a picture is that of the largest y.
TEST_F(MjcfHeightFieldFile, IsReadFromPictures) {
  const std::vector<std::uint8_t> grey = {0, 100, 200, 50, 0, 0};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 3, image.height = 2, image.format = PNG_FORMAT_GRAY;
  const std::filesystem::path file = folder_.path() / "grey.png";
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, grey.data(), 0, nullptr), 0);
  std::ifstream stream(file, std::ios::binary);
  const SceneSpec spec = read("h.png", std::string(std::istreambuf_iterator<char>(stream), {}));
  EXPECT_NEAR(heightAt(spec, 2, 1), .5, 1e-7);
  EXPECT_NEAR(heightAt(spec, 0, 1), .25, 1e-7);
  EXPECT_NEAR(heightAt(spec, -2, -1), .125, 1e-7);
  EXPECT_REX_ERROR(read("h.png", "no picture"), "<hfield> 'h.png': found neither PNG nor JPEG");
}

// Some thousand pieces at most; a warning says how coarse they are.
TEST_F(MjcfHeightFieldFile, HasPiecesOverBlocksIfItIsFine) {
  Diagnostics notes;
  const SceneSpec spec = read("h.bin", binary(101, 101, std::vector<float>(101 * 101, 1)), &notes);
  EXPECT_EQ(spec.worldShapes.size(), 1u + 25 * 25);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(toString(notes[0]),
              HasSubstr("warning: <asset>: <hfield>: 101 x 101 heights are touched as convex "
                        "pieces over 4 x 4 cells each, which fill its hollows"));
}

TEST(MjcfHeightField, IsLeftOutWhereItsFileIs) {
  const SceneFile scene = parseMjcf(model("file='h.png'"), "m.xml");
  EXPECT_TRUE(scene.spec.worldShapes.empty());
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_THAT(scene.notes[0].message,
              HasSubstr("'hfield' is ignored: a scene that is given as text has no files"));
}

TEST(MjcfHeightField, IsRemovedWhereAFileIsNeeded) {
  SceneSpec spec = parseMjcf(model("nrow='2' ncol='2'"), "m.xml").spec;
  EXPECT_EQ(removeMeshesWithoutFile(spec), 3u);
  EXPECT_TRUE(spec.worldShapes.empty());
}

}  // namespace rex::mjcf_height_field_test
