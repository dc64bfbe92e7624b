#pragma once

#include "course/simulator.h"
#include "legacy/array.h"

namespace rex::legacy {

/// course/simulator.h with arrays: what is asked for comes back in the first argument. Points and vectors of
/// a body may be given by pointer, or not at all.
class Simulator {
 public:
  explicit Simulator(const char* sceneFile) : simulator_(sceneFile) {}

  uint getJointDimension() const { return static_cast<uint>(simulator_.getJointDimension()); }
  void getJointAngles(arr& q) const { q = arr(simulator_.getJointAngles()); }
  void setJointAngles(const arr& q) { simulator_.setJointAngles(q.vector()); }
  void getJointAnglesAndVels(arr& q, arr& qdot) const;
  void setJointAnglesAndVels(const arr& q, const arr& qdot);

  void kinematicsPos(arr& y, const char* body, const arr* rel = nullptr) const;
  void jacobianPos(arr& J, const char* body, const arr* rel = nullptr) const;
  void kinematicsVec(arr& y, const char* body, const arr* vec = nullptr) const;
  void jacobianVec(arr& J, const char* body, const arr* vec = nullptr) const;
  void kinematicsCOM(arr& y) const { y = arr(Eigen::VectorXd(simulator_.kinematicsCOM())); }
  void jacobianCOM(arr& J) const { J = arr(simulator_.jacobianCOM()); }
  void kinematicsContacts(arr& y) const { y = arr(simulator_.kinematicsContacts()); }
  void jacobianContacts(arr& J) const { J = arr(simulator_.jacobianContacts()); }
  void setContactMargin(double margin) { simulator_.setContactMargin(margin); }
  void reportProxies() const { simulator_.reportProxies(); }

  void getDynamics(arr& M, arr& F) const;
  double getEnergy() const { return simulator_.getEnergy(); }
  void stepDynamics(const arr& u, double tau) { simulator_.stepDynamics(u.vector(), tau); }
  void setDynamicSimulationNoise(double noise) { simulator_.setDynamicSimulationNoise(noise); }
  void setDynamicsSimulationNoise(double noise) { simulator_.setDynamicSimulationNoise(noise); }
  void setDynamicGravity(bool gravity) { simulator_.setDynamicGravity(gravity); }
  void anchorKinematicChainIn(const char* body) { simulator_.anchorKinematicChainIn(body); }

  /// Draws the posture into watch-01.png, watch-02.png and so on, up to watch-20.png; says once that later
  /// calls draw nothing. There is no window, so that nothing waits.
  void watch(bool pause = true, const char* text = nullptr);

  /// The simulator behind, for films and replays.
  const rex::Simulator& simulator() const { return simulator_; }

 private:
  rex::Simulator simulator_;
};

}  // namespace rex::legacy
