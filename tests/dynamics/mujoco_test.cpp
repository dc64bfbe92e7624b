// A second opinion: MuJoCo reads the same .urdf files by its own reader and computes the same dynamics.
#include <gtest/gtest.h>

#ifdef REX_WITH_MUJOCO

#include <algorithm>
#include <sstream>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "base/rng.h"
#include "bench/mujoco_model.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "formats/urdf_reader.h"
#include "geometry/rotation.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::mujoco_test {

using Eigen::VectorXd;

constexpr double kTolerance = 1e-9;

// For the robot that has none.
constexpr const char* kInertial = R"(<inertial>
  <origin xyz="0.02 -0.03 0.05" rpy="0.1 0.2 0.3"/><mass value="1.5"/>
  <inertia ixx="0.01" iyy="0.012" izz="0.015" ixy="0.001" ixz="-0.002" iyz="0.0005"/>
</inertial>)";

void eraseElements(std::string& xml, const std::string& tag) {
  const std::string end = "</" + tag + ">";
  for (std::size_t at; (at = xml.find("<" + tag)) != std::string::npos;)
    xml.erase(at, xml.find(end, at) + end.size() - at);
}

std::string attribute(const std::string& xml, const std::string& name, const std::string& otherwise) {
  const std::string begin = " " + name + "=\"";
  const std::size_t at = xml.find(begin);
  if (at == std::string::npos) return otherwise;
  return xml.substr(at + begin.size(), xml.find('"', at + begin.size()) - at - begin.size());
}

double number(const std::string& xml, const std::string& name) {
  return std::stod(attribute(xml, name, "0"));
}

Eigen::Vector3d threeNumbers(const std::string& text) {
  std::istringstream input(text);
  Eigen::Vector3d numbers;
  input >> numbers.x() >> numbers.y() >> numbers.z();
  return numbers;
}

// The same inertia by its principal axes, repaired as our reader does: none below 0.
std::string principalInertial(const std::string& xml) {
  const auto entry = [&](const char* name) { return number(xml, name); };
  const Eigen::Matrix3d I{{entry("ixx"), entry("ixy"), entry("ixz")},
                          {entry("ixy"), entry("iyy"), entry("iyz")},
                          {entry("ixz"), entry("iyz"), entry("izz")}};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(I);
  Eigen::Matrix3d axes = principal.eigenvectors();
  axes.col(0) *= axes.determinant();
  const Eigen::Vector3d rpy = threeNumbers(attribute(xml, "rpy", "0 0 0"));
  const Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(0);
  const Eigen::Matrix3d R = rotationFromRollPitchYaw(rpy) * axes;
  const Eigen::Vector3d turn = rollPitchYawFromRotation(R);
  return fmt::format(R"(<inertial><origin xyz="{}" rpy="{} {} {}"/><mass value="{}"/>)"
                     R"(<inertia ixx="{}" iyy="{}" izz="{}" ixy="0" ixz="0" iyz="0"/></inertial>)",
                     attribute(xml, "xyz", "0 0 0"), turn.x(), turn.y(), turn.z(),
                     attribute(xml, "value", ""), moments.x(), moments.y(), moments.z());
}

// The robot as MuJoCo shall read it. Left to itself it finds principal axes to 1e-6 rad only, and merges
// links that no joint parts.
std::string forMujoco(std::string xml) {
  const std::string begin = "<inertial>", end = "</inertial>";
  for (std::size_t at = 0; (at = xml.find(begin, at)) != std::string::npos; ++at) {
    const std::size_t size = xml.find(end, at) + end.size() - at;
    xml.replace(at, size, principalInertial(xml.substr(at, size)));
  }
  return xml.insert(xml.find("</robot>"), "<mujoco><compiler fusestatic='false'/></mujoco>");
}

// The robot without shapes, whose meshes MuJoCo would ask for, and with masses.
std::string bareRobot(const std::filesystem::path& file) {
  std::string xml = fileText(file);
  eraseElements(xml, "visual");
  eraseElements(xml, "collision");
  const bool hasMasses = xml.find("<inertial>") != std::string::npos;
  for (std::size_t at = 0; !hasMasses && (at = xml.find("<link ", at)) != std::string::npos;)
    xml.insert(at = xml.find('>', at) + 1, kInertial);
  return xml;
}

// The robot on a joint that lets its root move freely.
std::string floating(std::string xml, const std::string& root) {
  xml.insert(xml.find("</robot>"),
             "<link name='world'/><joint name='base' type='floating'>"
             "<parent link='world'/><child link='" +
                 root + "'/></joint>");
  return xml;
}

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

// MuJoCo's robot in a state of ours. It knows no joints that mimic: P takes our velocities to all of its.
class MujocoRobot {
 public:
  MujocoRobot(const std::string& xml, const Model& ours)
      : model_(bench::loadMujoco(xml)), data_(mj_makeData(model_.get())), ours_(ours) {
    model_->opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_PASSIVE;
    model_->opt.enableflags |= mjENBL_ENERGY;
    P_ = Eigen::MatrixXd::Zero(model_->nv, ours.nv());
    for (const Joint& joint : ours.joints()) {
      if (joint.nv > 0)
        P_.block(dof(joint), joint.vIndex, joint.nv, joint.nv).diagonal().setConstant(joint.ratio);
    }
  }

  int nv() const { return model_->nv; }

  void set(const VectorXd& q, const VectorXd& v) {
    for (const Joint& joint : ours_.joints()) {
      if (joint.nv == 0) continue;
      double* at = data_->qpos + model_->jnt_qposadr[id(joint)];
      if (joint.nq == 1)
        *at = joint.ratio * q[joint.qIndex] + joint.offset;
      else
        std::copy_n(q.data() + joint.qIndex, joint.nq, at);
    }
    Eigen::Map<VectorXd>(data_->qvel, nv()) = P_ * v;
    mj_forward(model_.get(), data_.get());
  }
  VectorXd inverseDynamics(const VectorXd& a) {
    Eigen::Map<VectorXd>(data_->qacc, nv()) = P_ * a;
    VectorXd u(nv());
    mj_rne(model_.get(), data_.get(), 1, u.data());
    return P_.transpose() * u;
  }
  Eigen::MatrixXd massMatrix() {
    Eigen::MatrixXd M(nv(), nv());  // symmetric, so that rows or columns first is the same
    mj_fullM(model_.get(), M.data(), data_->qM);
    return P_.transpose() * M * P_;
  }
  // For robots without joints that mimic.
  VectorXd forwardDynamics(const VectorXd& u) {
    Eigen::Map<VectorXd>(data_->qfrc_applied, nv()) = P_ * u;
    mj_forward(model_.get(), data_.get());
    return P_.transpose() * Eigen::Map<VectorXd>(data_->qacc, nv());
  }
  Energy energy() const { return {.kinetic = data_->energy[1], .potential = data_->energy[0]}; }

 private:
  int id(const Joint& joint) const {
    const int found = mj_name2id(model_.get(), mjOBJ_JOINT, joint.name.c_str());
    EXPECT_GE(found, 0) << "MuJoCo has no joint " << joint.name;
    return found;
  }
  int dof(const Joint& joint) const { return model_->jnt_dofadr[id(joint)]; }

  bench::MujocoModel model_;
  std::unique_ptr<mjData, DataDeleter> data_;
  const Model& ours_;
  Eigen::MatrixXd P_;
};

void expectNear(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs, const char* what) {
  ASSERT_EQ(ours.rows(), theirs.rows()) << what;
  EXPECT_LE((ours - theirs).cwiseAbs().maxCoeff(), kTolerance * theirs.cwiseAbs().maxCoeff()) << what;
}

VectorXd randomPositions(Rng& rng, const Model& model) {
  VectorXd q = rng.normalVector(model.nq());
  for (const Joint& joint : model.joints())
    if (joint.type == JointType::kFree) q.segment<4>(joint.qIndex + 3).normalize();
  return q;
}

void expectSameDynamics(const std::string& xml) {
  const Model model = compile(parseUrdf(xml, "robot.urdf").spec);
  if (model.nv() == 0) return;  // its root stands
  MujocoRobot mujoco(forMujoco(xml), model);
  const bool mimics = mujoco.nv() != model.nv();
  Rng rng(361);
  for (int i = 0; i < 10; ++i) {
    const VectorXd q = randomPositions(rng, model), v = 2 * rng.normalVector(model.nv());
    const VectorXd a = 5 * rng.normalVector(model.nv());
    mujoco.set(q, v);
    const VectorXd u = mujoco.inverseDynamics(a);
    const Eigen::MatrixXd M = mujoco.massMatrix();
    expectNear(inverseDynamics(model, q, v, a), u, "inverse dynamics");
    expectNear(massMatrix(model, q), M, "mass matrix");
    const VectorXd bias = mujoco.inverseDynamics(VectorXd::Zero(model.nv()));
    expectNear(biasForces(model, q, v), bias, "bias forces");
    const VectorXd theirs = mimics ? VectorXd(M.llt().solve(u - bias)) : mujoco.forwardDynamics(u);
    expectNear(forwardDynamics(model, q, v, u), theirs, "forward dynamics");
    expectNear(forwardDynamicsByMassMatrix(model, q, v, u), theirs, "forward dynamics by the mass matrix");
    EXPECT_NEAR(energy(model, q, v).kinetic, mujoco.energy().kinetic, kTolerance * mujoco.energy().kinetic);
    EXPECT_NEAR(energy(model, q, v).potential, mujoco.energy().potential,
                kTolerance * std::abs(mujoco.energy().potential));
  }
}

struct Sample {
  const char *file, *root;  // empty: MuJoCo moves no root without mass, and not the world
};

class MujocoDynamics : public testing::TestWithParam<Sample> {};

TEST_P(MujocoDynamics, Agree) {
  const std::filesystem::path file = sourcePath(GetParam().file);
  const bool isBeside = std::string(GetParam().file).starts_with("..");
  if (isBeside && !std::filesystem::exists(file)) GTEST_SKIP() << "no " << GetParam().file;
  const std::string xml = bareRobot(file);
  expectSameDynamics(xml);
  if (*GetParam().root) expectSameDynamics(floating(xml, GetParam().root));
}

// Of the sample data all but those with masses without inertia or impossible inertias, which MuJoCo refuses.
INSTANTIATE_TEST_SUITE_P(Robots, MujocoDynamics,
                         testing::Values(Sample{"data/robots/arm6dof/arm6dof.urdf", "base"},
                                         Sample{"data/robots/arm7dof/arm7dof.urdf", "base"},
                                         Sample{"data/robots/arm7offset/arm7offset.urdf", "base"},
                                         Sample{"data/robots/balancer/balancer.urdf", "chassis"},
                                         Sample{"data/robots/gripper/gripper.urdf", "body"},
                                         Sample{"data/robots/hand/hand.urdf", "palm"},
                                         Sample{"data/robots/humanoid/humanoid.urdf", "pelvis"},
                                         Sample{"data/robots/humanoid_hands/humanoid_hands.urdf", "pelvis"},
                                         Sample{"data/robots/quadruped/quadruped.urdf", "torso"},
                                         Sample{"../shared/data/urdf/panda_arm_hand.urdf", "panda_link0"},
                                         Sample{"../shared/data/urdf/go2_description.urdf", "base_link"},
                                         Sample{"../shared/data/urdf/bolt.urdf", "base_link"},
                                         Sample{"../shared/data/urdf/cartpole.urdf", ""},
                                         Sample{"../shared/data/urdf/diff_ring.urdf", ""},
                                         Sample{"../shared/data/urdf/kuka_iiwa.urdf", ""},
                                         Sample{"../shared/data/urdf/panda_spherized.urdf", "panda_link0"},
                                         Sample{"../shared/data/urdf/plate.urdf", "cube"}),
                         [](const auto& sample) { return std::filesystem::path(sample.param.file).stem(); });

}  // namespace rex::mujoco_test

#else

TEST(MujocoDynamics, Agree) { GTEST_SKIP() << "install libmujoco-dev to compare"; }

#endif
