#pragma once

#ifdef REX_WITH_MUJOCO

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "base/rng.h"
#include "bench/mujoco_model.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/stepper.h"
#include "kinematics/forward_kinematics.h"
#include "scene/scene_spec.h"

namespace rex {

struct MujocoDataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// MuJoCo's model in postures of ours. Its joints come in the order of the file, each with coordinates of its
/// own: P takes our velocities to all of its.
class MujocoPeer {
 public:
  MujocoPeer(bench::MujocoModel theirs, const SceneSpec& spec, const Model& ours)
      : model_(std::move(theirs)), data_(mj_makeData(model_.get())), ours_(ours) {
    model_->opt.disableflags |= mjDSBL_CONSTRAINT;
    model_->opt.enableflags |= mjENBL_ENERGY;
    model_->opt.density = model_->opt.viscosity = 0;
    Eigen::Map<Eigen::Vector3d>(model_->opt.gravity) = earthGravity();
    for (const JointSpec& joint : spec.joints)
      if (joint.type != JointType::kRigid) joints_.push_back(jointOf(joint.name));
    EXPECT_EQ(static_cast<int>(joints_.size()), model_->njnt);
    P_ = Eigen::MatrixXd::Zero(model_->nv, ours.nv());
    for (int k = 0; k < model_->njnt; ++k) {
      const Joint& joint = *joints_.at(static_cast<std::size_t>(k));
      P_.block(model_->jnt_dofadr[k], joint.vIndex, joint.nv, joint.nv).diagonal().setConstant(joint.ratio);
    }
  }

  Eigen::VectorXd start() const {
    Eigen::VectorXd q(ours_.nq());
    for (int k = 0; k < model_->njnt; ++k) {
      const Joint& joint = *joints_[static_cast<std::size_t>(k)];
      if (!joint.mimics)
        q.segment(joint.qIndex, joint.nq) =
            Eigen::Map<const Eigen::VectorXd>(model_->qpos0 + model_->jnt_qposadr[k], joint.nq);
    }
    return q;
  }

  void set(const Eigen::VectorXd& q) { set(q, Eigen::VectorXd::Zero(ours_.nv())); }
  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    Eigen::Map<Eigen::VectorXd>(data_->qvel, model_->nv) = P_ * v;
    for (int k = 0; k < model_->njnt; ++k) {
      const Joint& joint = *joints_[static_cast<std::size_t>(k)];
      double* at = data_->qpos + model_->jnt_qposadr[k];
      for (int i = 0; i < joint.nq; ++i)
        at[i] = joint.nq == 1 ? joint.ratio * q[joint.qIndex] + joint.offset : q[joint.qIndex + i];
    }
    mj_forward(model_.get(), data_.get());
  }

  Eigen::MatrixXd massMatrix() const {
    Eigen::MatrixXd M(model_->nv, model_->nv);
    mj_fullM(model_.get(), M.data(), data_->qM);
    return P_.transpose() * M * P_;
  }
  // Of springs and dampers.
  Eigen::VectorXd passiveForces() const {
    return P_.transpose() * Eigen::Map<const Eigen::VectorXd>(data_->qfrc_passive, model_->nv);
  }
  // Without forces of joints but those of passiveForces().
  Eigen::VectorXd accelerations() const {
    return P_.transpose() * Eigen::Map<const Eigen::VectorXd>(data_->qacc, model_->nv);
  }
  // A force in W at the centre of mass, N, from the next set() on.
  void push(const std::string& body, const Eigen::Vector3d& force_W) {
    Eigen::Map<Eigen::Vector3d>(data_->xfrc_applied +
                                6 * mj_name2id(model_.get(), mjOBJ_BODY, body.c_str())) = force_W;
  }
  double potentialEnergy() const { return data_->energy[0]; }
  double kineticEnergy() const { return data_->energy[1]; }

  int bodies() const { return model_->nbody; }
  std::string name(int body) const {
    const char* const name = mj_id2name(model_.get(), mjOBJ_BODY, body);
    return name && *name ? name : "body";
  }
  double mass(int body) const { return model_->body_mass[body]; }
  Pose X_WB(int body) const {
    Pose X;
    X.p = Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body);
    X.R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * body);
    return X;
  }

 private:
  const Joint* jointOf(const std::string& name) const {
    const auto found = std::find_if(ours_.joints().begin(), ours_.joints().end(),
                                    [&](const Joint& joint) { return joint.name == name; });
    return &*found;
  }

  bench::MujocoModel model_;
  std::unique_ptr<mjData, MujocoDataDeleter> data_;
  const Model& ours_;
  std::vector<const Joint*> joints_;
  Eigen::MatrixXd P_;
};

inline Eigen::VectorXd randomPosture(Rng& rng, const Model& model) {
  Eigen::VectorXd q = rng.normalVector(model.nq());
  for (const Joint& joint : model.joints())
    if (joint.nq > joint.nv) q.segment<4>(joint.qIndex + joint.nq - 4).normalize();
  return q;
}

inline void expectNear(double ours, double theirs, double tolerance) {
  EXPECT_NEAR(ours, theirs, tolerance * std::max(1., std::abs(theirs)));
}

/// Compares the start, masses, poses, mass matrices, passive forces and energies in random postures.
inline void expectSame(bench::MujocoModel loaded, const SceneSpec& spec, double tolerance = 1e-9,
                       int postures = 5) {
  const Model model = compile(spec);
  MujocoPeer peer(std::move(loaded), spec, model);
  EXPECT_LT((model.initialPositions() - peer.start()).norm(), 1e-12);
  for (int body = 1; body < peer.bodies(); ++body)
    EXPECT_NEAR(model[model.body(peer.name(body))].mass, peer.mass(body), tolerance * peer.mass(body))
        << peer.name(body);
  Rng rng(83);
  for (int i = 0; i < postures; ++i) {
    const Eigen::VectorXd q = i == 0 ? model.initialPositions() : randomPosture(rng, model);
    const Eigen::VectorXd v = rng.normalVector(model.nv());
    peer.set(q, v);
    const BodyPoses poses = forwardKinematics(model, q);
    for (int body = 1; body < peer.bodies(); ++body)
      EXPECT_TRUE(isApprox(poses[model.body(peer.name(body))], peer.X_WB(body), 1e-9)) << peer.name(body);
    if (model.nv() == 0) continue;
    const Eigen::MatrixXd theirs = peer.massMatrix();
    EXPECT_LE((massMatrix(model, q) - theirs).cwiseAbs().maxCoeff(),
              tolerance * theirs.cwiseAbs().maxCoeff());
    // At such speeds friction is none.
    const Eigen::VectorXd forces = jointForces(model, q, v, {.friction = true, .frictionSpeed = 1e300});
    EXPECT_LE((forces - peer.passiveForces()).norm(), tolerance * peer.passiveForces().norm());
    expectNear(energy(model, q, v).potential, peer.potentialEnergy(), tolerance);
    expectNear(energy(model, q, v).kinetic, peer.kineticEnergy(), tolerance);
  }
}

inline void expectSame(const std::string& xml, const SceneSpec& spec, double tolerance = 1e-9) {
  expectSame(bench::loadMujoco(xml), spec, tolerance);
}

}  // namespace rex

#endif
