// A second opinion: urdfdom reads the same robots, and KDL computes the same poses and Jacobians.
#include <gtest/gtest.h>

#ifdef REX_WITH_URDFDOM

#include <algorithm>
#include <filesystem>
#include <set>
#include <span>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "base/rng.h"
#include "formats/ors_reader.h"
#include "formats/urdf_reader.h"
#include "formats/urdf_writer.h"
#include "kinematics/jacobians.h"
#include "support/file_text.h"
#include "support/kdl_tree.h"
#include "support/nearest_inertia.h"
#include "support/random_scene.h"
#include "support/urdf_samples.h"
#include "support/urdfdom_robot.h"

namespace rex::urdf_peer_test {

constexpr double kTolerance = 1e-12;

void expectSame(const UrdfdomRobot& robot, const Model& model, const Eigen::VectorXd& q,
                const std::string& link) {
  KDL::Chain chain;
  ASSERT_TRUE(robot.tree.getChain(robot.root, link, chain)) << link;
  std::map<std::string, int> index;
  for (const Joint& joint : model.joints())
    if (joint.nq == 1 && !joint.mimics) index[joint.name] = joint.qIndex;

  std::vector<int> columns;
  std::vector<double> multipliers;
  KDL::JntArray chainQ(chain.getNrOfJoints());
  for (const KDL::Segment& segment : chain.segments) {
    if (segment.getJoint().getType() == KDL::Joint::Fixed) continue;
    const UrdfdomRobot::Follow& follow = robot.joints.at(segment.getJoint().getName());
    ASSERT_TRUE(index.contains(follow.target)) << follow.target;
    chainQ(static_cast<unsigned>(columns.size())) =
        follow.multiplier * q[index[follow.target]] + follow.offset;
    columns.push_back(index[follow.target]);
    multipliers.push_back(follow.multiplier);
  }

  const BodyPoses poses = forwardKinematics(model, q);
  const BodyId body = model.body(link);
  KDL::Frame frame;
  ASSERT_EQ(KDL::ChainFkSolverPos_recursive(chain).JntToCart(chainQ, frame), 0) << link;
  EXPECT_TRUE(isApprox(poses[body], poseFrom(frame), kTolerance)) << link;

  KDL::Jacobian chainJ(chain.getNrOfJoints());
  ASSERT_EQ(KDL::ChainJntToJacSolver(chain).JntToJac(chainQ, chainJ), 0) << link;
  Eigen::MatrixXd theirs = Eigen::MatrixXd::Zero(6, model.nv()), ours(6, model.nv());
  for (std::size_t i = 0; i < columns.size(); ++i)
    theirs.col(columns[i]) += multipliers[i] * chainJ.data.col(static_cast<Eigen::Index>(i));
  ours << positionJacobian(model, poses, body, Eigen::Vector3d::Zero()), angularJacobian(model, poses, body);
  EXPECT_TRUE(((ours - theirs).array().abs() <= kTolerance).all()) << link;
}

// urdfdom stops at the first entry of an inertia that is missing.
bool isIncomplete(const std::string& link, const Diagnostics& notes) {
  return std::any_of(notes.begin(), notes.end(), [&](const Diagnostic& note) {
    return note.message.starts_with("link '" + link + "': <inertia>: attribute");
  });
}

void expectSameInertias(const UrdfdomRobot& robot, const Model& model, const Diagnostics& notes) {
  int withMass = 0;
  for (const Body& body : model.bodies()) withMass += body.mass > 0;
  int compared = 0;
  for (const auto& [link, theirs] : robot.inertials) {
    const Body& ours = model[model.body(link)];
    EXPECT_EQ(ours.mass, theirs.mass) << link;
    if (theirs.mass == 0) continue;
    ++compared;
    EXPECT_EQ(ours.p_BBcm, theirs.X_BI.p) << link;
    if (isIncomplete(link, notes)) continue;
    const Eigen::Matrix3d I = theirs.X_BI.R * theirs.I * theirs.X_BI.R.transpose();
    const bool isSame = (ours.I_BBcm_B - I).cwiseAbs().maxCoeff() <= kTolerance;
    EXPECT_TRUE(isSame || isNearestInertia(ours.I_BBcm_B, I)) << link;
  }
  EXPECT_EQ(compared, withMass);
}

void expectSameRobot(const std::string& text) {
  const UrdfdomRobot robot = urdfdomRobot(text);
  const SceneFile file = parseUrdf(text, "robot.urdf");
  const Model model = compile(file.spec);
  expectSameInertias(robot, model, file.notes);
  ASSERT_EQ(robot.tree.getNrOfSegments() + (robot.root == "world" ? 0u : 1u), model.bodies().size() - 1);
  Rng rng(61);
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd q = 3 * rng.normalVector(model.nq());
    for (const Body& body : std::span(model.bodies()).subspan(1)) expectSame(robot, model, q, body.name);
  }
}

TEST(UrdfPeer, AgreesOnATrickyRobot) { expectSameRobot(kTrickyRobot); }

TEST(UrdfPeer, ReadsWhatWeWrite) {
  Rng rng(62);
  SceneSpec spec = randomScene(rng, 40);
  for (JointSpec& joint : spec.joints) {
    const bool hasPeer = positionCount(joint.type) < 3 || joint.type == JointType::kTranslation3;
    if (!hasPeer) joint.type = JointType::kHinge;
  }
  replaceCones(spec);
  expectSameRobot(writeUrdf(spec).text);
  expectSameRobot(writeUrdf(readOrs(sourcePath("data/robots/man.ors")).spec).text);
}

TEST(UrdfPeer, AgreesOnAllFiles) {
  const auto files = urdfFiles();
  if (files.empty()) GTEST_SKIP() << "no .urdf file in data/ and ../shared/data/urdf";
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.filename());
    expectSameRobot(fileText(file));
  }
}

// The robots that Debian's packages contain. Meshes are not read: many are in other packages or in none.
TEST(UrdfPeer, LoadsWhatUrdfdomLoadsOfDebian) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const char* folder : {"/usr/share/doc/dart/data", "/usr/share/morse/examples"})
    if (fs::exists(folder))
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".urdf") files.push_back(entry.path());
  if (files.empty()) GTEST_SKIP() << "install dart-doc and morse-simulator-doc to compare";
  std::set<std::string> refused;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    const std::string text = fileText(file);
    try {
      static_cast<void>(urdfdomRobot(text));
    } catch (const std::runtime_error&) {
      refused.insert(file.filename());
      continue;
    }
    expectSameRobot(text);
  }
  EXPECT_GE(files.size(), refused.size() + 10);
  // A joint to a link that is not there, no XML, and no robot.
  EXPECT_EQ(refused, (std::set<std::string>{"atlas_v3.urdf", "invalid.urdf", "testWorld.urdf"}));
}

}  // namespace rex::urdf_peer_test

#else

TEST(UrdfPeer, AgreesOnAllFiles) {
  GTEST_SKIP() << "install liborocos-kdl-dev and liburdfdom-dev to compare";
}

#endif
