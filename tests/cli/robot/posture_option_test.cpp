#include "cli/robot/posture_option.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "kinematics/forward_kinematics.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::cli::posture_option_test {

using Eigen::Vector3d;

Model robot(const char* name) { return compile(readOrs(sourcePath("data/robots/").string() + name).spec); }

class MotionFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    std::ofstream(path()) << text;
    return path();
  }
  std::filesystem::path path() const { return folder_.path() / "motion.csv"; }
  const Model arm = robot("pegArm.ors");

 private:
  TemporaryFolder folder_;
};

TEST(PostureOption, TakesAllNumbersOrSomeJoints) {
  const Model arm = robot("pegArm.ors");
  EXPECT_EQ(parsePosture(arm, "0.5,-1 , +2e-1"), Vector3d(0.5, -1, 0.2));
  EXPECT_EQ(parsePosture(arm, " 1 2\t3 "), Vector3d(1, 2, 3));
  EXPECT_EQ(parsePosture(arm, "0"), Vector3d(0, 0, 0));
  EXPECT_EQ(parsePosture(arm, "file"), arm.initialPositions());
  const std::string& last = arm.joints().back().name;
  Eigen::VectorXd q = arm.initialPositions();
  q[arm.joints().back().qIndex] = -0.25;
  EXPECT_EQ(parsePosture(arm, last + "=-0.25"), q);
}

TEST(PostureOption, ExplainsWhatItCannotRead) {
  const Model arm = robot("pegArm.ors");
  const std::string name = arm.joints().back().name;
  EXPECT_REX_ERROR(parsePosture(arm, "1,2"), "--q: found 2 numbers, wanted 3, one for each coordinate of");
  EXPECT_REX_ERROR(parsePosture(arm, ""), "--q: found 0 numbers");
  EXPECT_REX_ERROR(parsePosture(arm, "1"), "--q: found 1 number, wanted 3");
  EXPECT_REX_ERROR(parsePosture(arm, "1,,2,3"), "--q: found an empty field, wanted a number between commas");
  EXPECT_REX_ERROR(parsePosture(arm, "1;2;3"), "--q: found ';', wanted commas or blanks between numbers");
  EXPECT_REX_ERROR(parsePosture(arm, "1,2,x"), "--q: found 'x', wanted a number, or joint=number");
  EXPECT_REX_ERROR(parsePosture(arm, "1,2,nan"), "--q: found 'nan'");
  EXPECT_REX_ERROR(parsePosture(arm, "1,2,3m"), "--q: found '3m'");
  EXPECT_REX_ERROR(parsePosture(arm, name + "=1,5"), "--q: found '5', wanted joint=number");
  EXPECT_REX_ERROR(parsePosture(arm, name + "=fast"), "--q: found 'fast', wanted a number");
  EXPECT_REX_ERROR(parsePosture(arm, name + "x=1"),
                   "has no joint '" + name + "x' that moves (did you mean '" + name + "'?)");
  EXPECT_REX_ERROR(parsePosture(robot("man.ors"), "elbowR=1"),
                   "has no joint 'elbowR' that moves: wanted waist>back, waist>lhip, waist>rhip, back>chest, "
                   "lhip>lup, rhip>rup, chest>shoulders, lup>ldn, rup>rdn, shoulders>shoulderL, "
                   "shoulders>shoulderR, shoulders>neck and 15 more");
  EXPECT_REX_ERROR(parsePosture(arm, "q=1"), "moves: wanted stem>arm1, arm1>arm2, arm2>peg");
  const Model floating =
      compile(parseOrs("body a {}\nbody b {}\njoint free (a b) { type=free }", "f.ors").spec);
  ASSERT_EQ(floating.nq(), 7);
  EXPECT_REX_ERROR(parsePosture(floating, floating.joints()[0].name + "=1"),
                   "found 7 coordinates, wanted one; give all 7 numbers of q instead");
}

TEST(PostureOption, RefusesAQuaternionThatIsZero) {
  const Model model = compile(parseOrs("body a {}\nbody b {}\nbody c {}\njoint (a b) { type=free }\n"
                                       "joint ball (b c) { type=quatBall }",
                                       "f.ors")
                                  .spec);
  const std::string wanted = ", wanted a quaternion w, x, y, z that is not zero";
  EXPECT_REX_ERROR(parsePosture(model, "0,0,0,0,0,0,0,1,0,0,0"),
                   "--q: found (0, 0, 0, 0) for joint 'a>b'" + wanted);
  EXPECT_REX_ERROR(parsePostureAsGiven(model, "--goal", "1,2,3,1,0,0,0,0,-0,0,0"),
                   "--goal: found (0, 0, 0, 0) for joint 'ball'" + wanted);
  EXPECT_EQ(parsePosture(model, "0,0,0,1e-300,0,0,0,0,0,0,-2").size(), 11);
}

TEST(PostureOption, SaysWhichNamesItCannotTake) {
  SceneSpec spec = parseOrs("body a {}\nbody b {}\njoint j (a b) {}", "f.ors").spec;
  spec.joints[0].name = "j 1";
  EXPECT_REX_ERROR(
      parsePosture(compile(spec), "j 1=0.5"),
      "--q: found 'j', wanted joint=number, or all 1 numbers if a joint's name has blanks or commas");
}

TEST(VelocityOption, TakesAllNumbersOrSomeJoints) {
  const Model arm = robot("pegArm.ors");
  EXPECT_EQ(parseVelocities(arm, "0.5,-1,2"), Vector3d(0.5, -1, 2));
  EXPECT_EQ(parseVelocities(arm, "0"), Vector3d(0, 0, 0));
  EXPECT_EQ(parseVelocities(arm, "arm1>arm2=-0.25"), Vector3d(0, -0.25, 0));
  EXPECT_REX_ERROR(parseVelocities(arm, "1"), "--v: found 1 number, wanted 3, one for each coordinate of");
  EXPECT_REX_ERROR(parseVelocities(arm, "1,2,x"), "--v: found 'x', wanted a number, or joint=number");
  EXPECT_REX_ERROR(parseVelocities(arm, "1,,2"), "--v: found an empty field");
  EXPECT_REX_ERROR(parseVelocities(arm, "arm=1,5"), "--v: ");
  const Model floating =
      compile(parseOrs("body a {}\nbody b {}\njoint free (a b) { type=free }", "f.ors").spec);
  EXPECT_EQ(parseVelocities(floating, "1 2 3 4 5 6").size(), 6);
  EXPECT_REX_ERROR(parseVelocities(floating, floating.joints()[0].name + "=1"),
                   "found 6 coordinates, wanted one; give all 6 numbers of v instead");
}

TEST_F(MotionFile, IsReadWithAndWithoutTimes) {
  const Motion plain = readMotion(arm, file("# a comment\nq0,q1,q2\n0,0,0\n1 2 3\n\n2,2,2\r\n"), 10);
  ASSERT_EQ(plain.postures.size(), 3u);
  EXPECT_EQ(plain.postures[1], Vector3d(1, 2, 3));
  EXPECT_EQ(plain.times, (std::vector<double>{0, 0.1, 0.2}));
  const Motion timed = readMotion(arm, file("time,a,b,c\n3,0,0,0\n3.12,1,1,1\n3.13,2,2,2\n3.31,3,3,3\n"), 10);
  ASSERT_EQ(timed.postures.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(timed.times[i], 0.1 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(timed.postures[i][0], (std::vector<double>{0, 0, 2, 2, 3})[i]) << i;
  }
}

TEST_F(MotionFile, IsRefusedWithItsLine) {
  EXPECT_REX_ERROR(readMotion(arm, path(), 30), path().string() + ": cannot read the motion");
  EXPECT_REX_ERROR(readMotion(arm, path().parent_path(), 30), "cannot read the motion");
  EXPECT_REX_ERROR(readMotion(arm, file("0,0,0\n1,2\n"), 30),
                   "motion.csv:2:1: motion: found 2 numbers, wanted 3 as in line 1");
  EXPECT_REX_ERROR(readMotion(arm, file("1\n"), 30),
                   "motion.csv:1:1: motion: found 1 number, wanted 3 for a posture of");
  EXPECT_REX_ERROR(readMotion(arm, file("# time\n0,0,0,0\n1,1,1\n"), 30),
                   "motion.csv:3:1: motion: found 3 numbers, wanted 4 as in line 2");
  EXPECT_REX_ERROR(readMotion(arm, file("1,2,3,4,5\n"), 30), "motion.csv:1:1: motion: found 5 numbers");
  EXPECT_REX_ERROR(readMotion(arm, file("0,0,0.1.2\n"), 30), "motion.csv:1:5: motion: found '0.1.2'");
  EXPECT_REX_ERROR(readMotion(arm, file("1,0,0,0\n1,0,0,0\n"), 30),
                   "motion.csv:2:1: motion: found time 1 after 1, wanted times that increase");
  EXPECT_REX_ERROR(readMotion(arm, file("0,0,0,0\n500,0,0,0\n"), 30),
                   "motion.csv: motion: found 500 s, wanted at most 120 s");
  EXPECT_REX_ERROR(readMotion(arm, file("# nothing\n"), 30), "motion: found no posture, wanted at least one");
}

TEST_F(MotionFile, IsRefusedWithAQuaternionThatIsZero) {
  const Model ball =
      compile(parseOrs("body a {}\nbody b {}\njoint ball (a b) { type=quatBall }", "f.ors").spec);
  EXPECT_REX_ERROR(
      readMotion(ball, file("1,0,0,0\n0,0,0,0\n"), 30),
      "motion.csv:2:1: motion: found (0, 0, 0, 0) for joint 'ball', wanted a quaternion w, x, y, z");
}

TEST_F(MotionFile, MayComeFromASpreadsheet) {
  for (const std::string head : {"", "\xef\xbb\xbf", "\xef\xbb\xbftime,q\r\n", "'q'\n\"a\",\"b\"\n",
                                 "x;y;z\n", "  # 1,,2;\n", "index\n"}) {
    const Motion motion = readMotion(arm, file(head + "1,2,3,\r\n# nan\n\r\n 4, 5 6\n"), 10);
    ASSERT_EQ(motion.postures.size(), 2u) << head;
    EXPECT_EQ(motion.postures[0], Vector3d(1, 2, 3)) << head;
    EXPECT_EQ(motion.postures[1], Vector3d(4, 5, 6)) << head;
  }
}

TEST_F(MotionFile, SkipsNoLineThatShouldBeAPosture) {
  for (const std::string word : {"nan", "NaN", "inf", "Infinity", "-nan", "-inf"}) {
    const std::string found = ": motion: found '" + word + "', wanted a number";
    EXPECT_REX_ERROR(readMotion(arm, file(word + ",0,0\n0,0,0\n"), 30), "motion.csv:1:1" + found);
    EXPECT_REX_ERROR(readMotion(arm, file("0,0,0\n" + word + ",0,0\n"), 30), "motion.csv:2:1" + found);
    EXPECT_REX_ERROR(readMotion(arm, file("head\n0,0," + word + "\n"), 30), "motion.csv:2:5" + found);
  }
  EXPECT_REX_ERROR(readMotion(arm, file("0,0,0\nend,0,0\n"), 30), "motion.csv:2:1: motion: found 'end'");
  EXPECT_REX_ERROR(readMotion(arm, file("0,0,0\n'0',0,0\n"), 30), "motion.csv:2:1: motion: found ''0''");
  for (const std::string line : {"1,,1", ",1,1", "1, ,1,1", "1,1,1,,"})
    EXPECT_REX_ERROR(readMotion(arm, file(line), 30),
                     "motion.csv:1:1: motion: found an empty field, wanted a number between commas");
  EXPECT_REX_ERROR(readMotion(arm, file("a;b;c\n0;0;0\n"), 30),
                   "motion.csv:2:1: motion: found ';', wanted commas or blanks between numbers");
}

TEST(MoveThrough, LastsTwoMinutesAtMost) {
  const Model arm = robot("pegArm.ors");
  const std::vector<Eigen::VectorXd> keys(3, Vector3d(0, 0, 0));
  EXPECT_EQ(moveThrough(arm, keys, 60, 1).times.back(), 120);
  EXPECT_REX_ERROR(moveThrough(arm, keys, 600, 30), "motion through --q: found 1200 s, wanted at most 120 s");
}

TEST(MoveThrough, PassesTheKeysSmoothlyAndRestsAtThem) {
  const Model arm = robot("pegArm.ors");
  const std::vector<Eigen::VectorXd> keys = {Vector3d(0, 0, 0), Vector3d(1, -1, 0.5), Vector3d(0, 1, 0)};
  const Motion motion = moveThrough(arm, keys, 2, 30);
  ASSERT_EQ(motion.postures.size(), 121u);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    EXPECT_LT((motion.postures[60 * k] - keys[k]).norm(), 1e-12);
    EXPECT_NEAR(motion.times[60 * k], 2. * static_cast<double>(k), 1e-12);
  }
  const auto speed = [&](std::size_t i) { return 30 * (motion.postures[i] - motion.postures[i - 1]).norm(); };
  EXPECT_LT(speed(1), 0.1 * speed(30));
  EXPECT_LT(speed(60), 0.1 * speed(30));
  EXPECT_EQ(moveThrough(arm, {keys[1]}, 2, 30).postures.size(), 1u);
}

TEST(ParsePosture, KnowsTheZeroOfEveryJoint) {
  const Model model = compile(parseOrs("body a {} body b {} body c {}\n"
                                       "joint (a b) { type=free Q=<T t(1 2 3)> }\n"
                                       "joint (b c) { q=0.7 }",
                                       "f")
                                  .spec);
  EXPECT_EQ(parsePosture(model, "0"), (Eigen::VectorXd(8) << 0, 0, 0, 1, 0, 0, 0, 0).finished());
  EXPECT_EQ(parsePosture(model, "file"), (Eigen::VectorXd(8) << 1, 2, 3, 1, 0, 0, 0, 0.7).finished());
}

TEST(ParsePosture, KnowsThePosturesOfTheFile) {
  SceneSpec spec = readOrs(sourcePath("data/robots/pegArm.ors")).spec;
  const std::string joint = spec.joints.back().name;
  spec.postures.push_back({.name = "key:home", .joints = {{joint, Eigen::VectorXd::Constant(1, .3)}}});
  const Model model = compile(spec);
  Eigen::VectorXd q = model.initialPositions();
  q[2] = .3;
  EXPECT_EQ(parsePosture(model, "key:home"), q);
  EXPECT_EQ(postureWithinLimits(model, "--goal", "key:home"), q);
  EXPECT_REX_ERROR(parsePosture(model, "key:hom"), "--q: scene '");
  EXPECT_REX_ERROR(parsePosture(model, "key:hom"), "has no posture 'key:hom': wanted key:home (did you mean");
  EXPECT_REX_ERROR(parsePostureAsGiven(model, "--goal", "state:ready"), "--goal: scene '");
}

}  // namespace rex::cli::posture_option_test
