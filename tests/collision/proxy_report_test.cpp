#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "collision/collision_pairs.h"
#include "formats/scene_file.h"

namespace rex::proxy_report_test {

using ::testing::HasSubstr;

Model modelOf(const char* text) { return compile(parseScene(text, "wall.ors").spec); }

constexpr const char* kWall =
    "body wall { }\n"
    "shape (wall) { type=ST_box size=[.2 2 2] contact }\n"
    "shape gate (wall) { rel=<T t(0 0 3)> type=ST_box size=[.2 2 2] contact }\n"
    "shape (wall) { rel=<T t(0 0 6)> type=ST_box size=[.2 2 2] contact }\n"
    "body ball { }\n"
    "shape bead (ball) { type=ST_sphere size=[0 0 0 .1] contact }\n"
    "joint (world ball) { type=free A=<T t(.25 0 0)> }\n";

TEST(ShapeLabel, CountsTheShapesWithoutAName) {
  const Model model = modelOf(kWall);
  std::vector<std::string> labels;
  for (int i = 0; i < 4; ++i) labels.push_back(shapeLabel(model, i));
  EXPECT_THAT(labels, testing::ElementsAre("wall#1", "gate", "wall#2", "bead"));
}

// A URDF names the collision shapes of a link like the link, and what is only seen likewise.
TEST(ShapeLabel, CountsShapesThatShareAName) {
  const char* kSphere = "<geometry><sphere radius='0.1'/></geometry>";
  const auto shape = [&](const char* tag, double x) {
    return fmt::format("<{0}><origin xyz='{1} 0 0'/>{2}</{0}>", tag, x, kSphere);
  };
  const std::string text = "<robot name='r'><link name='arm'>" + shape("visual", 0) + shape("collision", 0) +
                           shape("collision", 1) + "</link><link name='hand'>" + shape("visual", 0) +
                           shape("collision", 3) +
                           "</link><joint name='j' type='fixed'><parent link='arm'/><child link='hand'/>"
                           "</joint></robot>";
  const Model model = compile(parseScene(text, "r.urdf").spec);
  std::vector<std::string> touching;
  for (std::size_t i = 0; i < model.shapes().size(); ++i)
    if (model.shapes()[i].contact) touching.push_back(shapeLabel(model, static_cast<int>(i)));
  EXPECT_THAT(touching, testing::ElementsAre("arm#1", "arm#2", "hand"));
}

TEST(ProxyReport, ListsTheNearestFirst) {
  const Model model = modelOf(kWall);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  const std::string report = proxyReport(model, proxies(ContactModel(model), poses, 10));
  EXPECT_THAT(report,
              HasSubstr("pair           distance          point of the first         point of the second\n"
                        "wall#1 - bead    0.0500    0.1000   0.0000   0.0000    0.1500   0.0000   0.0000\n"
                        "gate - bead "));
  EXPECT_LT(report.find("gate"), report.find("wall#2"));
  EXPECT_EQ(proxyReport(model, {}),
            "pair  distance          point of the first         point of the second\n");
}

TEST(ProxyReport, ListsWhatIsNoNumberBeforeAllOthers) {
  const Model model = modelOf(kWall);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  std::vector<Proxy> near = proxies(ContactModel(model), poses, 10);
  ASSERT_EQ(near.size(), 3u);
  near[1].proximity.distance = std::nan("");
  const std::string report = proxyReport(model, near);
  EXPECT_THAT(report, HasSubstr("gate - bead         nan "));
  EXPECT_LT(report.find("gate"), report.find("wall#1"));
  EXPECT_LT(report.find("wall#1"), report.find("wall#2"));
}

}  // namespace rex::proxy_report_test
