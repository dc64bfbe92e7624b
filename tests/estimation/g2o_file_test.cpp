#include "estimation/g2o_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::g2o_file_test {

using testing::HasSubstr;

constexpr const char* kPlanar =
    "# two rooms\n"
    "VERTEX_SE2 7 1 +2 0.5\r\n"
    "VERTEX_SE2 3 0 0 0\n"
    "FIX 3\n\n"
    "EDGE_SE2 3 7 1 2 .5 10 1 2 20 3 30\n";

constexpr const char* kSpatial =
    "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0.6 0.8 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n"
    "EDGE_SE3:QUAT 1 2 0 1 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4\n";

TEST(G2oFile, ReadsPlanarPoses) {
  const G2oFile file = parseG2o(kPlanar);
  const auto& graph = std::get<PlanarPoseGraph>(file.graph);
  EXPECT_TRUE(file.hasPoses);
  EXPECT_THAT(file.ids, testing::ElementsAre(3, 7));
  EXPECT_EQ(graph.poses.col(1), Eigen::Vector3d(1, 2, .5));
  ASSERT_EQ(graph.edges.size(), 1u);
  EXPECT_EQ(graph.edges[0].to, 1);
  Eigen::Matrix3d information;
  information << 10, 1, 2, 1, 20, 3, 2, 3, 30;
  EXPECT_EQ(graph.edges[0].information, information);
  EXPECT_TRUE(file.notes.empty()) << "the first pose is fixed anyway";
}

TEST(G2oFile, PosesFollowFromMotions) {
  const G2oFile file = parseG2o(kSpatial);
  const auto& graph = std::get<SpatialPoseGraph>(file.graph);
  EXPECT_FALSE(file.hasPoses);
  // The first motion turns by 2 asin(0.6) about z.
  EXPECT_NEAR((graph.poses[2].p - Eigen::Vector3d(1 - .96, .28, 0)).norm(), 0, 1e-12);
}

constexpr const char* kMarked =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 4 1 2\nVERTEX_XY 2 3 0\n"
    "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2_XY 0 4 1 2 5 .5 6\nEDGE_SE2_XY 1 2 2 0 1 0 1\n"
    "EDGE_SE2_XY 1 4 0 2.5 1 0 1\n";

TEST(G2oFile, ReadsLandmarks) {
  const G2oFile file = parseG2o(kMarked);
  const auto& graph = std::get<PlanarPoseGraph>(file.graph);
  EXPECT_THAT(file.landmarkIds, testing::ElementsAre(2, 4));
  EXPECT_EQ(graph.landmarks.col(1), Eigen::Vector2d(1, 2));
  ASSERT_EQ(graph.sightings.size(), 3u);
  EXPECT_EQ(graph.sightings[0].pose, 0);
  EXPECT_EQ(graph.sightings[0].landmark, 1);
  EXPECT_EQ(graph.sightings[0].position, Eigen::Vector2d(1, 2));
  EXPECT_EQ(graph.sightings[0].information, (Eigen::Matrix2d() << 5, .5, .5, 6).finished());
  EXPECT_TRUE(file.notes.empty());
}

TEST(G2oFile, WritesLandmarks) {
  G2oFile file = parseG2o(kMarked);
  const std::string text = writeG2o(file);
  EXPECT_EQ(writeG2o(parseG2o(text)), text);
  EXPECT_THAT(text, HasSubstr("VERTEX_XY 4 1 2\n"));
  EXPECT_THAT(text, HasSubstr("EDGE_SE2_XY 1 4 0 2.5 1 0 1\n"));
  file.landmarkIds.clear();
  EXPECT_THAT(parseG2o(writeG2o(file)).landmarkIds, testing::ElementsAre(2, 3)) << "after those of the poses";
}

TEST(G2oFile, LandmarksFollowFromSightings) {
  const G2oFile file = parseG2o(
      "EDGE_SE2 0 1 1 0 1.5707963267948966 1 0 0 1 0 1\nEDGE_SE2_XY 1 7 2 0 1 0 1\n"
      "EDGE_SE2_XY 0 7 9 9 1 0 1\n");
  EXPECT_FALSE(file.hasPoses);
  EXPECT_LT((std::get<PlanarPoseGraph>(file.graph).landmarks.col(0) - Eigen::Vector2d(1, 2)).norm(), 1e-15)
      << "where it was seen first";
}

TEST(G2oFile, LeavesOutOtherTags) {
  const G2oFile file =
      parseG2o(std::string(kPlanar) + "EDGE_SE22 1 2\nPARAMS_CAMERA 0\nEDGE_SE22 nonsense\n", "map.g2o");
  EXPECT_EQ(std::get<PlanarPoseGraph>(file.graph).edges.size(), 1u);
  ASSERT_EQ(file.notes.size(), 2u);
  EXPECT_EQ(toString(file.notes[0]),
            "map.g2o:7:1: warning: EDGE_SE22: not a tag that rex reads (did you mean 'EDGE_SE2'?); it is "
            "left out (2 "
            "lines, this is the first)");
  EXPECT_EQ(toString(file.notes[1]),
            "map.g2o:8:1: warning: PARAMS_CAMERA: not a tag that rex reads; it is left out");
}

// Against the definition: no symmetric matrix nearby without negative eigenvalues is nearer.
TEST(G2oFile, RepairsInformation) {
  const G2oFile file = parseG2o(
      "EDGE_SE2 0 1 1 0 0 10 0 0 20 0 -30\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 2 0 1 0 1\n",
      "map.g2o");
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(toString(file.notes[0]),
            "map.g2o:1: warning: EDGE_SE2: information: found the eigenvalue -30, wanted no negative "
            "eigenvalue; it is "
            "replaced by the nearest positive semidefinite matrix, whose negative eigenvalues are 0 (2 "
            "lines, this is "
            "the first)");
  auto graph = std::get<PlanarPoseGraph>(file.graph);
  EXPECT_LT((graph.edges[0].information - Eigen::Matrix3d(Eigen::Vector3d(10, 20, 0).asDiagonal())).norm(),
            1e-12);
  const Eigen::Matrix3d wanted = (Eigen::Matrix3d() << 1.5, 1.5, 0, 1.5, 1.5, 0, 0, 0, 1).finished();
  EXPECT_LT((graph.edges[2].information - wanted).norm(), 1e-12);
  EXPECT_EQ(optimize(graph).status, PoseGraphStatus::kConverged);
}

TEST(G2oFile, WritesWhatItReads) {
  const std::string planar = writeG2o(parseG2o(kPlanar));
  EXPECT_EQ(writeG2o(parseG2o(planar)), planar);
  const auto space = std::get<SpatialPoseGraph>(parseG2o(kSpatial).graph);
  const G2oFile written = parseG2o(writeG2o(parseG2o(kSpatial)));
  EXPECT_TRUE(written.hasPoses);
  const auto spaceAgain = std::get<SpatialPoseGraph>(written.graph);
  ASSERT_EQ(spaceAgain.poses.size(), space.poses.size());
  for (std::size_t i = 0; i < space.poses.size(); ++i)
    EXPECT_TRUE(isApprox(spaceAgain.poses[i], space.poses[i], 1e-15));
  EXPECT_EQ(spaceAgain.edges[1].information, space.edges[1].information);
  const auto first = std::get<PlanarPoseGraph>(parseG2o(kPlanar).graph);
  const auto again = std::get<PlanarPoseGraph>(parseG2o(writeG2o(parseG2o(kPlanar))).graph);
  EXPECT_EQ(first.poses, again.poses);
  EXPECT_EQ(first.edges[0].motion, again.edges[0].motion);
  EXPECT_EQ(first.edges[0].information, again.edges[0].information);
}

TEST(G2oFile, NotesWhatItDoesNotNeed) {
  std::string text = kPlanar;
  text.replace(text.find("FIX 3"), 5, "FIX 7");
  const G2oFile file = parseG2o(text, "map.g2o");
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_THAT(toString(file.notes[0]), HasSubstr("map.g2o:4:5: note: FIX 7 has no effect: pose 3 stays"));
}

TEST(G2oFile, MayBeginWithAFixedPose) {
  const G2oFile file = parseG2o("FIX 0\n" + std::string(kSpatial) + "FIX 0 0\n");
  EXPECT_EQ(std::get<SpatialPoseGraph>(file.graph).poses.size(), 3u);
  EXPECT_TRUE(file.notes.empty());
  std::string planar = kPlanar;
  planar.insert(0, "FIX 3\n");
  EXPECT_EQ(std::get<PlanarPoseGraph>(parseG2o(planar).graph).poses.cols(), 2);
  EXPECT_REX_ERROR(
      parseG2o("FIX 0\n" + std::string(kSpatial) + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n", "map.g2o"),
      "map.g2o:4:1: pose graph: found EDGE_SE2 among VERTEX_SE3:QUAT");
}

TEST(G2oFile, NumbersPosesThatHaveNoIds) {
  G2oFile file = parseG2o(kPlanar);
  file.ids.clear();
  EXPECT_THAT(parseG2o(writeG2o(file)).ids, testing::ElementsAre(0, 1));
}

std::string with(const char* line) { return std::string(kPlanar) + line; }

TEST(G2oFile, SaysWhereAndWhatIsWrong) {
  const auto read = [](const std::string& text) { return parseG2o(text, "map.g2o"); };
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 9 0 0\n")), "map.g2o:7:16: VERTEX_SE2: found 3 numbers, wanted 4");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 9 0 0 0 0\n")),
                   "map.g2o:7:20: VERTEX_SE2: found 5 numbers, wanted 4");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 9 0 zero 0\n")),
                   "map.g2o:7:16: VERTEX_SE2: found 'zero', wanted a finite number");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 9 0 nan 0\n")), "found 'nan', wanted a finite number");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 9 0 1e999 0\n")), "found '1e999', wanted a finite number");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 1.5 0 0 0\n")),
                   "map.g2o:7:12: VERTEX_SE2: found '1.5', wanted a whole number");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 7 0 0 0\n")), "map.g2o:7:12: VERTEX_SE2: found a second pose 7");
  EXPECT_REX_ERROR(read(with("EDGE_SE2 3 8 1 2 .5 10 0 0 20 0 30\n")),
                   "map.g2o:7:12: EDGE_SE2: found pose 8, which the file does not have");
  EXPECT_REX_ERROR(read(with("EDGE_SE2 3 3 1 2 .5 10 0 0 20 0 30\n")),
                   "map.g2o:7:12: EDGE_SE2: found pose 3 again, wanted two different poses");
  EXPECT_REX_ERROR(read(with("FIX 8\n")), "map.g2o:7:5: FIX: found pose 8, which the file does not have");
  EXPECT_REX_ERROR(
      read(with("VERTEX_SE3:QUAT 9 0 0 0 0 0 0 1\n")),
      "map.g2o:7:1: pose graph: found VERTEX_SE3:QUAT among VERTEX_SE2, wanted planar or spatial poses only");
  EXPECT_REX_ERROR(read("VERTEX_SE3:QUAT 9 0 0 0 0 0 0 2\nEDGE_SE3:QUAT 1 2\n"),
                   "map.g2o:1:25: VERTEX_SE3:QUAT: quaternion: found length 2, wanted length 1");
  EXPECT_REX_ERROR(read("VERTEX_SE2 9 0 0 0\n"), "map.g2o: pose graph: found no edges, wanted one or more");
  EXPECT_REX_ERROR(read(""), "map.g2o: pose graph: found no edges");
  EXPECT_REX_ERROR(readG2o("none.g2o"), "none.g2o: pose graph: found a file that cannot be read");
  EXPECT_REX_ERROR(readG2o("."), "found a file that cannot be read");
  EXPECT_REX_ERROR(
      read("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n"),
      "map.g2o:2:10: pose graph: found pose 2, which no edges join to pose 0, wanted a connected graph");
  EXPECT_REX_ERROR(read(with("VERTEX_SE2 9 0 0 0\n")),
                   "map.g2o:7:12: pose graph: found pose 9, which no edges join to pose 3");
  EXPECT_REX_ERROR(read(with("FIX 7\n")),
                   "map.g2o:7:5: FIX: found pose 7 besides pose 3, wanted one pose that is fixed");
  EXPECT_REX_ERROR(read(with("FIX 3 7\n")), "map.g2o:7:7: FIX: found pose 7 besides pose 3");
  EXPECT_REX_ERROR(read(with("FIX\n")), "FIX: found 0 numbers, wanted 1");
  EXPECT_REX_ERROR(
      read(with("VERTEX_XY 9 0 0\n")),
      "map.g2o:7:11: pose graph: found landmark 9, which no pose sees, wanted one or more EDGE_SE2_XY");
  EXPECT_REX_ERROR(read(with("VERTEX_XY 9 0 0\nVERTEX_XY 9 0 0\n")),
                   "map.g2o:8:11: VERTEX_XY: found a second landmark 9");
  EXPECT_REX_ERROR(
      read(with("VERTEX_XY 7 0 0\n")),
      "map.g2o:7:11: pose graph: found landmark 7, which is a pose as well, wanted an id of its own");
  EXPECT_REX_ERROR(read(with("VERTEX_XY 9 0 0 0\n")), "map.g2o:7:17: VERTEX_XY: found 4 numbers, wanted 3");
  EXPECT_REX_ERROR(read(with("EDGE_SE2_XY 3 9 0 0 1 0 1\n")),
                   "map.g2o:7:15: EDGE_SE2_XY: found landmark 9, which the file does not have");
  EXPECT_REX_ERROR(read(with("VERTEX_XY 9 0 0\nEDGE_SE2_XY 4 9 0 0 1 0 1\n")),
                   "map.g2o:8:13: EDGE_SE2_XY: found pose 4, which the file does not have");
  EXPECT_REX_ERROR(read(with("EDGE_SE2_XY 3 9 0 0 1 0\n")), "EDGE_SE2_XY: found 6 numbers, wanted 7");
  EXPECT_REX_ERROR(read(std::string(kSpatial) + "VERTEX_XY 9 0 0\n"),
                   "map.g2o:3:1: pose graph: found VERTEX_XY among VERTEX_SE3:QUAT");
  G2oFile marked = parseG2o(kMarked);
  marked.landmarkIds.pop_back();
  EXPECT_REX_ERROR(writeG2o(marked),
                   "pose graph: ids of landmarks: found 1, wanted 2, one for each landmark, or none");
  G2oFile file = parseG2o(kPlanar);
  file.ids.pop_back();
  EXPECT_REX_ERROR(writeG2o(file), "pose graph: ids: found 1, wanted 2, one for each pose, or none");
  std::get<PlanarPoseGraph>(file.graph).edges[0].to = 5;
  EXPECT_REX_ERROR(writeG2o(file), "edge 0 from pose 0 to pose 5: found pose 5, wanted 0 to 1");
}

}  // namespace rex::g2o_file_test
