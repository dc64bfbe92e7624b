#pragma once

#include <string>

#include <Eigen/Core>

namespace rex {

/// How one step of a walker ended.
enum class StepStatus {
  kStepped,       ///< the swing foot came down in front, and the legs swapped roles
  kFellForward,   ///< the hip reached the ground downhill
  kFellBackward,  ///< the hip reached the ground uphill
  kFootStuck,     ///< the rear foot does not lift off but pushes against the ground, contrary to slide 11:22
  kTimeLimit      ///< none of these in time
};

/// One step of a walker, and how it ended. States are (stance angle, swing angle, their rates).
struct WalkerStep {
  StepStatus status = StepStatus::kTimeLimit;
  double time = 0;                     ///< seconds from its start to the impact or fall
  Eigen::Vector4d before{0, 0, 0, 0};  ///< just before the impact, or at the end
  Eigen::Vector4d after{0, 0, 0, 0};   ///< just after the impact, if kStepped
  std::string message{};               ///< for example "fell forward after 0.62 s"
};

/// The same with the derivative of `after` with respect to the start (4 x 4, from the variational equation,
/// including the change of the impact time); zero unless kStepped.
struct WalkerStepJacobian {
  WalkerStep step{};
  Eigen::Matrix4d J = Eigen::Matrix4d::Zero();
};

/// Two straight legs without knees that walk passively down a slope: slides 11:19 to 11:22; Goswami,
/// Thuilot, Espiau 1998, A study of the passive gait of a compass-like biped robot. Each leg is a point
/// mass `a` above its foot and `b` below the hip. A state is x = (theta_s, theta_ns, their rates) of the
/// stance and the swing leg, rad and rad/s, from the vertical, counter-clockwise. Downhill is to the right,
/// so the stance angle decreases. As in the paper, the swing foot may pass below the ground until it is in
/// front, and the stance foot is pinned: see groundForce(). All functions throw Error for lengths, masses
/// or g that are not positive (a and legMass may be zero), a slope outside (-1, 1), and states that are not
/// finite.
struct CompassGait {
  double a = 0.5, b = 0.5;             ///< metres
  double legMass = 5;                  ///< m of each leg, kg; 0: the limit of a vanishing mass
  double hipMass = 10;                 ///< mH, kg
  double slope = 0.05235987755982989;  ///< radians, downhill; 3 degrees
  double g = 9.8;                      ///< m/s^2

  /// x' during stance (slide 11:20).
  [[nodiscard]] Eigen::Vector4d derivative(const Eigen::Vector4d& x) const;
  /// Its exact derivative with respect to x.
  [[nodiscard]] Eigen::Matrix4d derivativeJacobian(const Eigen::Vector4d& x) const;
  /// Kinetic and potential energy, joules; the latter is zero at the stance foot.
  [[nodiscard]] double energy(const Eigen::Vector4d& x) const;
  /// The force of the ground on the stance foot, N: downhill along the slope, and normal to it. Where the
  /// second entry is negative, a real foot would lift off.
  [[nodiscard]] Eigen::Vector2d groundForce(const Eigen::Vector4d& x) const;

  /// The state just after the swing foot landed without bouncing or slipping, with swapped legs. The
  /// angular momenta of the whole robot about that foot and of the rear leg about the hip are conserved
  /// (slide 11:22).
  [[nodiscard]] Eigen::Vector4d impact(const Eigen::Vector4d& x) const;
  /// Its exact derivative with respect to x.
  [[nodiscard]] Eigen::Matrix4d impactJacobian(const Eigen::Vector4d& x) const;

  /// Simulates from a state just after an impact to the state just after the next one, for at most
  /// `timeLimit` seconds.
  [[nodiscard]] WalkerStep step(const Eigen::Vector4d& x, double timeLimit = 10) const;
  [[nodiscard]] WalkerStepJacobian stepJacobian(const Eigen::Vector4d& x, double timeLimit = 10) const;
};

/// The simplest walking model: all mass in the hip, feet of vanishing mass, legs of length 1 and g = 1.
/// Garcia, Chatterjee, Ruina, Coleman 1998. Its theta is theta_s + slope, its phi theta_s - theta_ns.
[[nodiscard]] CompassGait simplestWalker(double slope);

}  // namespace rex
