// The files are read back by a reader of their own, from the text of the glTF 2.0 specification.
#include "render/glb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/rng.h"
#include "formats/mesh_reader.h"
#include "render/glb_writer_internal.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"

namespace rex::glb_test {

namespace fs = std::filesystem;
using Eigen::Affine3d;
using Eigen::Vector3d;
using nlohmann::json;

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

class GlbFile {
 public:
  explicit GlbFile(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(wordAt(bytes, 4), 2u);
    EXPECT_EQ(wordAt(bytes, 8), bytes.size());
    const std::uint32_t textSize = wordAt(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(textSize % 4, 0u);
    root = json::parse(bytes.substr(20, textSize));
    const std::size_t second = 20 + textSize;
    if (bytes.size() == second) {
      EXPECT_FALSE(root.contains("buffers"));
      return;
    }
    EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(wordAt(bytes, second) % 4, 0u);
    data = bytes.substr(second + 8);
    EXPECT_EQ(data.size(), wordAt(bytes, second));
    EXPECT_LE(root["buffers"][0]["byteLength"].get<std::size_t>(), data.size());
    EXPECT_GT(root["buffers"][0]["byteLength"].get<std::size_t>() + 4, data.size());
    EXPECT_FALSE(root["buffers"][0].contains("uri"));
  }

  // Rows of an accessor of floats.
  std::vector<std::vector<double>> floats(int index) const {
    const json& accessor = root["accessors"][index];
    EXPECT_EQ(accessor["componentType"], 5126);
    const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t width = widths.at(accessor["type"]), count = accessor["count"];
    const json& view = root["bufferViews"][accessor["bufferView"].get<int>()];
    const std::size_t start = view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u);
    EXPECT_EQ(start % 4, 0u);
    EXPECT_LE(count * width * 4, view["byteLength"].get<std::size_t>());
    EXPECT_EQ(view.value("byteStride", width * 4), width * 4);
    std::vector<std::vector<double>> rows(count, std::vector<double>(width));
    for (std::size_t i = 0; i < count * width; ++i) {
      float value = 0;
      std::memcpy(&value, data.data() + start + 4 * i, 4);
      rows[i / width][i % width] = value;
    }
    return rows;
  }

  std::vector<int> named(const std::string& name) const {
    std::vector<int> found;
    for (std::size_t i = 0; i < root["nodes"].size(); ++i)
      if (root["nodes"][i].value("name", "") == name) found.push_back(static_cast<int>(i));
    return found;
  }

  // Translation, rotation (x, y, z, w) or scale of a node at a time.
  std::vector<double> part(int node, const std::string& path, std::vector<double> otherwise,
                           double time) const {
    std::vector<double> value = root["nodes"][node].value(path, otherwise);
    if (!root.contains("animations")) return value;
    const json& animation = root["animations"][0];
    for (const json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      const json& sampler = animation["samplers"][channel["sampler"].get<int>()];
      value = sampled(floats(sampler["input"]), floats(sampler["output"]), time,
                      sampler.value("interpolation", "LINEAR") == "STEP");
    }
    return value;
  }

  Affine3d local(int node, double time) const {
    const auto t = part(node, "translation", {0, 0, 0}, time), r = part(node, "rotation", {0, 0, 0, 1}, time),
               s = part(node, "scale", {1, 1, 1}, time);
    Affine3d X = Affine3d::Identity();
    X.translate(Vector3d(t[0], t[1], t[2]));
    X.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
    return X.scale(Vector3d(s[0], s[1], s[2]));
  }

  // From a node to the world of the file.
  Affine3d world(int node, double time) const {
    for (std::size_t i = 0; i < root["nodes"].size(); ++i) {
      const std::vector<int> children = root["nodes"][i].value("children", std::vector<int>());
      if (std::find(children.begin(), children.end(), node) != children.end())
        return world(static_cast<int>(i), time) * local(node, time);
    }
    return local(node, time);
  }

  bool isShown(int node, double time) const { return world(node, time).linear().norm() > 1e-9; }

  const json& primitive(int node, int index = 0) const {
    return root["meshes"][root["nodes"][node]["mesh"].get<int>()]["primitives"][index];
  }
  std::vector<double> color(int node) const {
    const json& material = root["materials"][primitive(node)["material"].get<int>()];
    return material["pbrMetallicRoughness"]["baseColorFactor"];
  }
  // With the scale of the node.
  std::vector<std::vector<double>> positions(int node) const {
    std::vector<std::vector<double>> all = floats(primitive(node)["attributes"]["POSITION"]);
    const auto scale = root["nodes"][node].value("scale", std::vector<double>{1, 1, 1});
    for (std::vector<double>& p : all)
      for (std::size_t i = 0; i < 3; ++i) p[i] *= scale[i];
    return all;
  }

  json root;
  std::string data;

 private:
  static std::vector<double> sampled(const std::vector<std::vector<double>>& times,
                                     const std::vector<std::vector<double>>& values, double time, bool step) {
    EXPECT_EQ(times.size(), values.size());
    std::size_t next = 0;
    while (next < times.size() && times[next][0] <= time) ++next;
    if (next == 0) return values.front();
    if (next == times.size() || step) return values[next - 1];
    const double share = (time - times[next - 1][0]) / (times[next][0] - times[next - 1][0]);
    std::vector<double> mixed = values[next];
    for (std::size_t i = 0; i < mixed.size(); ++i)
      mixed[i] = share * mixed[i] + (1 - share) * values[next - 1][i];
    return mixed;
  }
};

Affine3d asAffine(const Pose& X) {
  Affine3d result = Affine3d::Identity();
  result.linear() = X.R;
  result.translation() = X.p;
  return result;
}

// z up as we have it, from y up as glTF has it.
const Affine3d kOurs(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()));

Solid boxAt(const Pose& X, const Color& color = {0.7f, 0.2f, 0.1f}, const std::string& name = "box") {
  return {.shape = {ShapeType::kBox, {0.4, 0.3, 0.2}, 0}, .X_WS = X, .color = color, .name = name};
}

Film tumblingFilm() {
  Rng rng(3);
  Film film;
  Pose X;
  for (int k = 0; k < 20; ++k) {
    X = translation(rng.uniform(-1, 1), 0.1 * k, 0.5) * Pose{X.R} *
        rotation(1.5, {0.3, 1, rng.uniform(-1, 1)});
    Picture picture;
    picture.solids = {boxAt(X, {0.7f, 0.2f, 0.1f}, "tumbler"),
                      boxAt(translation(1, 1, 1), {0, 0, 1}, "still")};
    film.push_back({5 + 0.25 * k, picture});
  }
  return film;
}

TEST(Glb, PutsEveryNodeWhereTheFilmHasIt) {
  const Film film = tumblingFilm();
  const GlbFile file(toGlb(film));
  ASSERT_EQ(file.named("tumbler").size(), 1u);
  ASSERT_EQ(file.named("still").size(), 1u);
  for (const Frame& frame : film) {
    const double time = frame.time - film[0].time;
    for (const Solid& solid : frame.picture.solids) {
      const Affine3d X = kOurs * file.world(file.named(solid.name)[0], time);
      EXPECT_TRUE(X.isApprox(asAffine(solid.X_WS), 1e-5)) << solid.name << " at " << time;
    }
  }
}

TEST(Glb, MovesOnlyWhatMovesThroughOneTimeLine) {
  const GlbFile file(toGlb(tumblingFilm()));
  const json& animation = file.root["animations"][0];
  std::set<int> inputs;
  for (const json& sampler : animation["samplers"]) inputs.insert(sampler["input"].get<int>());
  EXPECT_EQ(inputs.size(), 1u);
  EXPECT_EQ(file.root["accessors"][*inputs.begin()]["min"], json({0.0}));
  EXPECT_EQ(file.root["accessors"][*inputs.begin()]["max"], json({4.75}));
  std::multiset<std::string> paths;
  for (const json& channel : animation["channels"]) {
    EXPECT_EQ(channel["target"]["node"], file.named("tumbler")[0]);
    paths.insert(channel["target"]["path"].get<std::string>());
  }
  EXPECT_EQ(paths, (std::multiset<std::string>{"rotation", "translation"}));
}

TEST(Glb, TurnsTheShortWay) {
  const GlbFile file(toGlb(tumblingFilm()));
  int compared = 0;
  for (std::size_t i = 0; i < file.root["accessors"].size(); ++i) {
    if (file.root["accessors"][i]["type"] != "VEC4") continue;
    const auto q = file.floats(static_cast<int>(i));
    for (std::size_t k = 1; k < q.size(); ++k, ++compared)
      EXPECT_GT(q[k][0] * q[k - 1][0] + q[k][1] * q[k - 1][1] + q[k][2] * q[k - 1][2] + q[k][3] * q[k - 1][3],
                0);
  }
  EXPECT_EQ(compared, 19);
}

Film filmOfOne(const Picture& picture) { return {{0, picture}}; }

TEST(Glb, StandsStillWithOneFrame) {
  Picture picture;
  picture.solids = {boxAt(translation(1, 2, 3))};
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_FALSE(file.root.contains("animations"));
  EXPECT_TRUE((kOurs * file.world(file.named("box")[0], 0)).isApprox(asAffine(translation(1, 2, 3)), 1e-5));
}

// Positions within the bounds of the shape and touching them, normals of length one that point outward.
void expectSurface(const GlbFile& file, int node, const Vector3d& half) {
  const json& primitive = file.primitive(node);
  const auto positions = file.positions(node), normals = file.floats(primitive["attributes"]["NORMAL"]);
  ASSERT_EQ(positions.size(), normals.size());
  Vector3d reach = Vector3d::Zero();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector3d p(positions[i][0], positions[i][1], positions[i][2]),
        n(normals[i][0], normals[i][1], normals[i][2]);
    reach = reach.cwiseMax(p.cwiseAbs());
    EXPECT_NEAR(n.norm(), 1, 1e-5);
    EXPECT_GT(p.dot(n), 0);
  }
  // The edges of round meshes touch the round surface, their corners lie a little outside.
  EXPECT_TRUE(reach.isApprox(half, 0.01)) << reach.transpose() << " instead of " << half.transpose();
}

// The volume that the triangles enclose; negative if they are wound inside out.
double volume(const GlbFile& file, int node) {
  const json& accessor = file.root["accessors"][file.primitive(node)["indices"].get<int>()];
  EXPECT_EQ(accessor["componentType"], 5123);
  const auto positions = file.positions(node);
  const std::size_t start =
      file.root["bufferViews"][accessor["bufferView"].get<int>()].value("byteOffset", std::size_t{0});
  double six = 0;
  for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); i += 3) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      std::uint16_t index = 0;
      std::memcpy(&index, file.data.data() + start + 2 * (i + k), 2);
      corners.col(k) = Eigen::Map<const Vector3d>(positions.at(index).data());
    }
    six += corners.determinant();
  }
  return six / 6;
}

TEST(Glb, HasASurfaceForEachShape) {
  const std::vector<std::pair<Shape, double>> shapes = {
      {{ShapeType::kBox, {0.4, 0.3, 0.2}, 0}, 0.024},
      {{.type = ShapeType::kSphere, .radius = 0.3}, 4. / 3 * std::numbers::pi * 0.027},
      {{ShapeType::kCapsule, {0, 0, 0.5}, 0.2}, std::numbers::pi * (0.04 * 0.5 + 4. / 3 * 0.008)},
      {{ShapeType::kCylinder, {0, 0, 0.5}, 0.2}, std::numbers::pi * 0.04 * 0.5},
      {{ShapeType::kCone, {0, 0, 0.5}, 0.2}, std::numbers::pi * 0.04 * 0.5 / 3},
      {{ShapeType::kEllipsoid, {0.6, 0.4, 0.2}}, std::numbers::pi / 6 * 0.048},
      {{ShapeType::kRoundedBox, {0.4, 0.3, 0.2}, 0.05}, 0.02224}};  // core, faces, edges, corners
  Picture picture;
  for (const auto& [shape, unused] : shapes)
    picture.solids.push_back({.shape = shape, .name = std::string(toString(shape.type))});
  const GlbFile file(toGlb(filmOfOne(picture)));
  for (const auto& [shape, wanted] : shapes) {
    SCOPED_TRACE(toString(shape.type));
    const int node = file.named(std::string(toString(shape.type)))[0];
    expectSurface(file, node, halfBounds(shape));
    EXPECT_NEAR(volume(file, node), wanted, 0.05 * wanted);
  }
}

TEST(Glb, IsReadBackAsItStood) {
  const fs::path file = freshFolder("glb_read_back") / "box.glb";
  Picture picture;
  picture.ground.visible = false;
  picture.solids = {{{ShapeType::kBox, {0.2, 0.4, 0.6}, 0}, translation(1, 2, 3)}};
  writeGlb(filmOfOne(picture), file);
  const TriangleMesh mesh = readMesh(file);
  Eigen::Vector3f low = mesh.positions()[0], high = low;
  for (const Eigen::Vector3f& p : mesh.positions()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  EXPECT_LT((low - Eigen::Vector3f(0.9f, 1.8f, 2.7f)).norm(), 1e-6f);
  EXPECT_LT((high - Eigen::Vector3f(1.1f, 2.2f, 3.3f)).norm(), 1e-6f);
}

TEST(Glb, StoresEqualShapesOnce) {
  Picture picture;
  for (int i = 0; i < 10; ++i) picture.solids.push_back(boxAt(translation(i, 0, 0)));
  const std::size_t meshes = GlbFile(toGlb(filmOfOne(picture))).root["meshes"].size();
  EXPECT_EQ(meshes, 2u);  // with the ground
  picture.solids[0].color = {0, 1, 0};
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_EQ(file.root["meshes"].size(), 3u);
  EXPECT_EQ(file.positions(file.named("box")[0]).size(), 24u);
  EXPECT_EQ(file.primitive(file.named("box")[0])["attributes"],
            file.primitive(file.named("box")[1])["attributes"]);
}

TEST(Glb, CountsColoursAsLight) {
  Picture picture;
  picture.solids = {boxAt({}, {0.5f, 0.02f, 1, 0.4f}, "glass")};
  const GlbFile file(toGlb(filmOfOne(picture)));
  const auto color = file.color(file.named("glass")[0]);
  EXPECT_NEAR(color[0], 0.21404, 1e-4);
  EXPECT_NEAR(color[1], 0.02 / 12.92, 1e-6);
  EXPECT_NEAR(color[2], 1, 1e-6);
  EXPECT_NEAR(color[3], 0.4, 1e-6);
  const int material = file.primitive(file.named("glass")[0])["material"];
  EXPECT_EQ(file.root["materials"][material]["alphaMode"], "BLEND");
}

TEST(Glb, TellsTheRangeOfAllPositions) {
  const GlbFile file(toGlb(tumblingFilm()));
  std::set<int> accessors;
  for (const json& mesh : file.root["meshes"])
    for (const json& primitive : mesh["primitives"])
      accessors.insert(primitive["attributes"]["POSITION"].get<int>());
  for (const int index : accessors) {
    const auto rows = file.floats(index);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto less = [&](const auto& a, const auto& b) { return a[k] < b[k]; };
      const auto [low, high] = std::minmax_element(rows.begin(), rows.end(), less);
      EXPECT_EQ(file.root["accessors"][index]["min"][k].get<double>(), (*low)[k]);
      EXPECT_EQ(file.root["accessors"][index]["max"][k].get<double>(), (*high)[k]);
    }
  }
}

TEST(Glb, GrowsATraceInOneBuffer) {
  Film film;
  for (int k = 0; k < 30; ++k) {
    Picture picture;
    Polyline trace{.color = {1, 0, 0}, .width = 3};
    for (int i = 0; i <= k; ++i) trace.points.emplace_back(0.1 * i, std::sin(0.3 * i), 0.5);
    picture.polylines = {trace};
    film.push_back({0.1 * k, picture});
  }
  const GlbFile file(toGlb(film));
  const std::vector<int> nodes = file.named("polyline 0");
  EXPECT_EQ(nodes.size(), 29u);
  std::set<int> views;
  for (const int node : nodes) {
    const json& primitive = file.primitive(node);
    EXPECT_EQ(primitive["mode"], 3);
    views.insert(
        file.root["accessors"][primitive["attributes"]["POSITION"].get<int>()]["bufferView"].get<int>());
  }
  EXPECT_EQ(views.size(), 1u);
  for (int k = 0; k < 30; ++k) {
    std::vector<std::size_t> lengths;
    for (const int node : nodes)
      if (file.isShown(node, 0.1 * k + 0.01)) lengths.push_back(file.positions(node).size());
    EXPECT_EQ(lengths, k == 0 ? std::vector<std::size_t>() : std::vector<std::size_t>{k + 1u}) << k;
  }
}

TEST(Glb, ShowsWhatChangesOrComesAndGoesWhenItDoes) {
  Film film;
  for (int k = 0; k < 8; ++k) {
    Picture picture;
    picture.solids = {boxAt(translation(k, 0, 0), k < 4 ? Color{1, 0, 0} : Color{0, 1, 0}, "chameleon")};
    if (k == 2 || k == 6) picture.solids.push_back(boxAt(translation(0, k, 0), {}, "guest"));
    film.push_back({1. * k, picture});
  }
  const GlbFile file(toGlb(film));
  ASSERT_EQ(file.named("chameleon").size(), 2u);
  ASSERT_EQ(file.named("guest").size(), 1u);
  for (int k = 0; k < 8; ++k) {
    const double time = k + 0.001;
    EXPECT_EQ(file.isShown(file.named("guest")[0], time), k == 2 || k == 6) << k;
    for (const int node : file.named("chameleon")) {
      const bool red = file.color(node)[0] > 0.5;
      EXPECT_EQ(file.isShown(node, time), red == (k < 4)) << k;
      if (file.isShown(node, time)) {
        EXPECT_NEAR((kOurs * file.world(node, k)).translation().x(), k, 1e-5);
      }
    }
  }
}

TEST(Glb, CarriesOverlays) {
  Film film;
  for (int k = 0; k < 3; ++k) {
    Picture picture;
    picture.pointSets = {{.points = {{0, 0, 0}, {1, k * 0.1, 0}}, .color = {0, 0, 1}, .size = 7}};
    picture.axes = {{translation(0, 0, k), 0.25, "A"}};
    picture.arrows = {{{0, 0, 0}, {0, 1. + k, 0}, {1, 0, 0}, 0.02}};
    picture.ellipsoids = {{translation(0, 0, 1), {0.1 + k, 0.2, 0.3}}};
    picture.labels = {{.text = "top", .p_WQ = {0, 0, 1. * k}, .scale = 2}};
    picture.captions = {{k < 2 ? "start" : "end", Corner::kBottomRight}};
    film.push_back({1. * k, picture});
  }
  const GlbFile file(toGlb(film));
  const auto meshExtras = [&](int node) {
    return file.root["meshes"][file.root["nodes"][node]["mesh"].get<int>()]["extras"];
  };
  ASSERT_EQ(file.named("points 0").size(), 3u);
  EXPECT_EQ(file.primitive(file.named("points 0")[0])["mode"], 0);
  EXPECT_EQ(meshExtras(file.named("points 0")[0])["size"], 7.0);
  const int axes = file.named("axes A")[0];
  EXPECT_EQ(file.root["meshes"][file.root["nodes"][axes]["mesh"].get<int>()]["primitives"].size(), 3u);
  EXPECT_EQ(file.primitive(axes)["mode"], 1);
  EXPECT_NEAR((kOurs * file.world(axes, 2)).translation().z(), 2, 1e-6);
  ASSERT_EQ(file.named("arrow 0").size(), 2u);
  const Affine3d head = kOurs * file.world(file.named("arrow 0")[1], 2);
  EXPECT_TRUE((head * Vector3d::UnitZ()).isApprox(Vector3d(0, 3, 0), 1e-5));
  const Affine3d shaft = kOurs * file.world(file.named("arrow 0")[0], 2);
  EXPECT_TRUE((shaft * Vector3d::UnitZ()).isApprox(head.translation(), 1e-5));
  EXPECT_NEAR((shaft.linear() * Vector3d::UnitX()).norm(), 0.02, 1e-6);
  EXPECT_NEAR((file.world(file.named("ellipsoid 0")[0], 2).linear() * Vector3d::UnitX()).norm(), 2.1, 1e-5);
  const int label = file.named("label 0")[0];
  EXPECT_EQ(file.root["nodes"][label]["extras"]["label"], "top");
  EXPECT_NEAR((kOurs * file.world(label, 2)).translation().z(), 2, 1e-6);
  ASSERT_EQ(file.named("caption 0").size(), 2u);
  for (const int node : file.named("caption 0")) {
    const json& extras = file.root["nodes"][node]["extras"];
    EXPECT_EQ(extras["corner"], "bottom right");
    EXPECT_EQ(file.isShown(node, 2.5), extras["caption"] == "end");
  }
}

TEST(Glb, TellsSeparateLinesFromOneThroughTheSamePoints) {
  Picture picture;
  picture.lineSets = {{.segments = {{{0, 0, 0}, {1, 0, 1}}}, .color = {1, 0, 0}, .width = 2}};
  picture.polylines = {{.points = {{0, 0, 0}, {1, 0, 1}}, .color = {1, 0, 0}, .width = 2}};
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_EQ(file.primitive(file.named("lines 0")[0])["mode"], 1);
  EXPECT_EQ(file.primitive(file.named("polyline 0")[0])["mode"], 3);
  EXPECT_EQ(file.positions(file.named("lines 0")[0]), file.positions(file.named("polyline 0")[0]));
}

TEST(Glb, DrawsAFlatEllipsoidAsAThinLensAndAPointNot) {
  Picture picture;
  picture.ellipsoids = {{translation(1, 0, 1), {0.5, 0, 0.2}}, {translation(2, 0, 1), {0, 0, 0}}};
  const GlbFile file(toGlb(filmOfOne(picture)));
  ASSERT_EQ(file.named("ellipsoid 0").size(), 1u);
  EXPECT_EQ(file.root["nodes"][file.named("ellipsoid 0")[0]]["scale"], json({0.5, 0.0005, 0.2}));
  EXPECT_TRUE(file.named("ellipsoid 1").empty());
}

TEST(Glb, TakesACaptionOfAnyNumberOfLines) {
  Picture picture;
  picture.solids = {boxAt({})};
  picture.captions = {{"first" + std::string(200'000, '\n') + "\xfflast\t"}};
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_EQ(file.root["nodes"][file.named("caption 0")[0]]["extras"]["caption"],
            "first" + std::string(200'000, '\n') + "?last ");
}

TEST(Glb, StoresNothingForAGroundThatIsNotVisible) {
  Picture picture;
  picture.solids = {boxAt({})};
  picture.ground.visible = false;
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_EQ(file.root["meshes"].size(), 1u);
  EXPECT_TRUE(file.named("ground").empty());
}

TEST(Glb, NeedsNoDataForTexts) {
  Picture picture;
  picture.labels = {{.text = "here", .p_WQ = {0, 0, 1}}};
  picture.ground.visible = false;
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_FALSE(file.root.contains("buffers"));
  EXPECT_EQ(file.named("label 0").size(), 1u);
}

TEST(Glb, LooksThroughTheCameraOfTheFilm) {
  const Film film = tumblingFilm();
  const GlbFile file(toGlb(film, {1, 1, 1}));
  const Camera camera = framing(film, {1, 1, 1}, 4. / 3);
  EXPECT_TRUE((kOurs * file.world(file.named("camera")[0], 0)).isApprox(asAffine(camera.X_WC), 1e-5));
  EXPECT_NEAR(file.root["cameras"][0]["perspective"]["yfov"], camera.verticalFov, 1e-12);
}

TEST(Glb, KeepsStrangeNames) {
  Picture picture;
  picture.solids = {boxAt({}, {}, "a \"quoted\"\n\\name\xff \xc3\xa4")};
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_EQ(file.named("a \"quoted\" \\name? \xc3\xa4").size(), 1u);
}

TEST(Glb, DrawsMeshesWithTheColoursOfTheirParts) {
  const TriangleMesh mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, std::vector<Eigen::Vector3f>(4, {0, 0, 1}),
      {{0, 1, 2}, {0, 1, 3}},
      {{.firstTriangle = 0, .triangleCount = 1},
       {.color = Eigen::Vector4f(1, 0, 0, 0.5f), .firstTriangle = 1, .triangleCount = 1}});
  internal::GlbWriter writer;
  internal::GlbMeshes meshes(writer);
  Shape shape{.type = ShapeType::kMesh};
  shape.mesh = mesh;
  const int index = meshes.ofShape(shape, {0, 0, 1});
  EXPECT_EQ(meshes.ofShape(shape, {0, 0, 1}), index);
  writer.addNode({.name = "mesh", .mesh = index});
  const GlbFile file(writer.bytes());
  const int node = file.named("mesh")[0];
  EXPECT_EQ(file.color(node), (std::vector<double>{0, 0, 1, 1}));
  const json& part = file.primitive(node, 1);
  EXPECT_EQ(file.root["materials"][part["material"].get<int>()]["pbrMetallicRoughness"]["baseColorFactor"],
            json({1.0, 0.0, 0.0, 0.5}));
  EXPECT_EQ(file.root["accessors"][part["indices"].get<int>()]["count"], 3);
}

Shape openShape(ShapeType type) {
  Shape shape{.type = type};
  shape.mesh = TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Eigen::Vector3f>(3, {0, 0, 1}),
                            {{0, 1, 2}});
  return shape;
}

TEST(Glb, ShowsImportedSurfacesFromBothSides) {
  Picture picture;
  picture.solids = {{.shape = openShape(ShapeType::kMesh), .name = "open"}, {.name = "closed"}};
  const GlbFile file(toGlb(filmOfOne(picture)));
  const auto isSeenFromBothSides = [&](const std::string& name) {
    const int material = file.primitive(file.named(name)[0])["material"];
    return file.root["materials"][material].value("doubleSided", false);
  };
  EXPECT_TRUE(isSeenFromBothSides("open"));
  EXPECT_FALSE(isSeenFromBothSides("closed"));
}

TEST(Glb, ShowsOnlyThePointsOfAPointCloud) {
  Picture picture;
  picture.solids = {{.shape = openShape(ShapeType::kPointCloud), .name = "cloud"}};
  const GlbFile file(toGlb(filmOfOne(picture)));
  EXPECT_EQ(file.primitive(file.named("cloud")[0])["mode"], 0);
}

TEST(Glb, GivesTheSameBytesTwice) { EXPECT_EQ(toGlb(tumblingFilm()), toGlb(tumblingFilm())); }

TEST(Glb, RefusesWhatCannotBePlayed) {
  EXPECT_REX_ERROR(toGlb({}), "a film to replay: found no frames, wanted at least one");
  EXPECT_REX_ERROR(toGlb(filmOfOne({})), "nothing to draw: found no shape");
  Film film = tumblingFilm();
  film[3].time = film[2].time;
  EXPECT_REX_ERROR(toGlb(film),
                   "frame 3 of a film: found time 5.5 after 5.5, wanted finite seconds that increase");
  film[3].time = std::nextafter(film[2].time, 6);
  EXPECT_REX_ERROR(toGlb(film),
                   "frame 3 of a film: found time 5.500000000000001 after 5.5, wanted finite seconds that "
                   "increase from frame to frame, even in single precision");
  film[3].time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(toGlb(film), "frame 3 of a film: found time nan after 5.5");
  film[0].time = std::numeric_limits<double>::infinity();
  EXPECT_REX_ERROR(toGlb(film), "frame 0 of a film: found time inf, wanted");
  film = tumblingFilm();
  film[7].picture.solids[0].X_WS.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(toGlb(film), "solid 'tumbler', pose: found a number that is not finite");
}

TEST(Glb, WritesWholeFilesOrNone) {
  const fs::path folder = freshFolder("glb");
  writeGlb(tumblingFilm(), folder / "film.glb");
  EXPECT_EQ(fileText(folder / "film.glb"), toGlb(tumblingFilm()));
  EXPECT_REX_ERROR(writeGlb(tumblingFilm(), folder / "missing" / "film.glb"),
                   "missing/film.glb': found No such file");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
}

}  // namespace rex::glb_test
