#include "live/live_scene.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "formats/scene_file.h"
#include "render/glb.h"
#include "support/paths.h"

namespace rex::live_scene_test {

using Json = nlohmann::ordered_json;

Model modelOf(const std::string& text) { return compile(parseScene(text, "scene.ors").spec); }

TEST(LiveScene, NamesNodesByShapes) {
  const Model model = modelOf(
      "body a { mass=1 }\nshape (a) { type=0 size=[.1 .1 .1 0] }\n"
      "shape (a) { type=1 size=[0 0 0 .2] rel=<T t(0 0 1)> }\n");
  const std::string glb = liveGlb(model, forwardKinematics(model, model.initialPositions()));
  EXPECT_THAT(glb, testing::HasSubstr("\"s0\""));
  EXPECT_THAT(glb, testing::HasSubstr("\"s1\""));
  const Json about = Json::parse(liveDescription(model));
  EXPECT_EQ(about["shapes"].size(), 2u);
  EXPECT_EQ(about["bodies"][1]["name"], "a");
  EXPECT_EQ(about["shapes"][1]["pose"], Json::parse("[0.0,0.0,1.0,0.0,0.0,0.0,1.0]"));
}

TEST(LiveScene, SaysUnitsAndLimits) {
  const Model model = compile(readScene(homeFolder().string() + "/data/robots/pegInAHole.ors").spec);
  const Json about = Json::parse(liveDescription(model));
  ASSERT_EQ(about["coordinates"].size(), static_cast<std::size_t>(model.nq()));
  EXPECT_EQ(about["coordinates"][0]["unit"], "rad");
}

TEST(LiveScene, SaysWhereRobotsFace) {
  const std::pair<const char*, const char*> cases[] = {{"robots/man.ors", "[0,-1]"},
                                                       {"robots/balancer/balancer.urdf", "[1,0]"}};
  for (const auto& [file, front] : cases) {
    const Model model = compile(readScene(homeFolder().string() + "/data/" + file).spec);
    EXPECT_EQ(Json::parse(liveDescription(model))["front"].dump(), front) << file;
  }
}

TEST(LiveScene, WritesPosesAsFloats) {
  const Model model = modelOf("body a { X=<T t(1 2 3)> mass=1 }\nshape (a) { type=0 size=[.1 .1 .1 0] }\n");
  // Two bodies of seven floats each: 56 bytes, 76 characters.
  EXPECT_EQ(posesText(forwardKinematics(model, model.initialPositions())).size(), 76u);
}

TEST(LiveScene, CutsPicturesIntoPiecesThatStayTheSame) {
  Picture picture;
  picture.solids.push_back({.shape = {.type = ShapeType::kBox, .extent = {1, 2, 3}}, .name = "one"});
  picture.solids.push_back(
      {.shape = {.type = ShapeType::kSphere, .radius = 1}, .X_WS = translation(0, 0, 4), .name = "two"});
  const std::string glb = toGlb({{.picture = picture}});
  const LivePieces first = splitGlb(glb);
  picture.solids[1].X_WS = translation(0, 0, 5);
  const LivePieces moved = splitGlb(toGlb({{.picture = picture}}));
  ASSERT_GE(first.pieces.size(), 4u);
  std::size_t same = 0;
  for (const LivePiece& piece : first.pieces) {
    EXPECT_EQ(glb.substr(20 + first.json.size() + 8 + piece.at, piece.bytes.size()), piece.bytes);
    for (const LivePiece& other : moved.pieces) same += piece.name == other.name;
  }
  EXPECT_GE(same, 4u);
  EXPECT_NE(first.json, moved.json);
}

TEST(LiveScene, RefusesASceneWithoutAnythingToSee) {
  const Model model = modelOf("body a { mass=1 }\n");
  try {
    static_cast<void>(liveGlb(model, forwardKinematics(model, model.initialPositions())));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("found no shape, wanted something to see"));
  }
}

}  // namespace rex::live_scene_test
