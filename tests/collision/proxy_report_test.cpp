#include "collision/proxy_report.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_file.h"

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
