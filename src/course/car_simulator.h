#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "base/rng.h"

namespace rex {

/// The constants of a CarSimulator. Noises are standard deviations (erratum 30), in metres and radians.
struct CarOptions {
  double tau = 1;                 ///< seconds per step
  double wheelbase = 2;           ///< L, metres
  double dynamicsNoise = 0.03;    ///< of x, y and heading, added in each step
  double observationNoise = 0.5;  ///< of both numbers of a landmark; with rangeBearing, of the distance
  bool rangeBearing = false;      ///< observe (distance, bearing) rather than (ahead, left)
  double bearingNoise = 0.02;
  double maxRange = std::numeric_limits<double>::infinity();  ///< landmarks farther away are not seen
  double fieldOfView = 6.283185307179586;  ///< centred on the heading; no landmark outside it is seen
};

/// Whether the car at x = (x, y, heading) would see a landmark: in range and in its field of view.
[[nodiscard]] bool isInView(const CarOptions& options, const Eigen::Vector3d& x,
                            const Eigen::Vector2d& landmark);

/// The car of exercises 12.9 and 12.13, with the names of the script: state (x, y, heading), control u = (v,
/// phi), and landmarks that it observes in its own frame. Methods throw Error for vectors of the wrong size
/// and for numbers that are not finite.
class CarSimulator {
 public:
  /// A car at (0, 0, 0) among `landmarks` landmarks, whose coordinates are normal with standard deviation
  /// 10. Their positions and the noise come from separate streams of the seed, so neither reveals the
  /// other. Throws Error for options out of range and a negative count.
  explicit CarSimulator(std::uint64_t seed = 0, int landmarks = 2, const CarOptions& options = {});
  /// A car with a known map but no true state. Methods that need the truth throw Error.
  CarSimulator(const Eigen::Matrix2Xd& landmarks, const CarOptions& options);
  /// A car that knows only the number of landmarks, as for mapping. Methods that need the truth or
  /// the positions of the landmarks throw Error; methods that are given landmarks do not. Throws as the
  /// first constructor does.
  [[nodiscard]] static CarSimulator withoutPlaces(int landmarks, const CarOptions& options = {});

  const CarOptions& options() const { return options_; }
  int countLandmarks() const { return static_cast<int>(landmarks_.cols()); }
  [[nodiscard]] const Eigen::Matrix2Xd& getLandmarks() const;
  void setLandmarks(const Eigen::Matrix2Xd& landmarks);

  /// One Euler step with the heading at its start (slide 4:48, erratum 10), then noise.
  void step(const Eigen::VectorXd& u);
  /// The true state.
  [[nodiscard]] Eigen::Vector3d getState() const;
  void setState(const Eigen::VectorXd& x);

  /// The state after a step without noise, and its Jacobian with respect to the state before it: I + tau
  /// [[0,0,-v sin], [0,0,v cos], [0,0,0]] (erratum 30).
  [[nodiscard]] Eigen::VectorXd getMeanStateAfterStep(const Eigen::VectorXd& x,
                                                      const Eigen::VectorXd& u) const;
  [[nodiscard]] Eigen::MatrixXd getStateJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const;

  /// The noisy observation of all landmarks from the true state: 2 numbers for each.
  [[nodiscard]] Eigen::VectorXd getRealNoisyObservation();
  void getRealNoisyObservation(Eigen::VectorXd& y) { y = getRealNoisyObservation(); }
  /// The landmarks that are in range and in view now.
  [[nodiscard]] std::vector<int> getVisibleLandmarks() const;

  /// The observation at x without noise.
  [[nodiscard]] Eigen::VectorXd getMeanObservationAtState(const Eigen::VectorXd& x) const;
  void getMeanObservationAtState(Eigen::VectorXd& y, const Eigen::VectorXd& x) const {
    y = getMeanObservationAtState(x);
  }
  /// dy/dx, 2 N x 3.
  [[nodiscard]] Eigen::MatrixXd getObservationJacobianAtState(const Eigen::VectorXd& x) const;
  void getObservationJacobianAtState(Eigen::MatrixXd& C, const Eigen::VectorXd& x) const {
    C = getObservationJacobianAtState(x);
  }
  [[nodiscard]] Eigen::MatrixXd getObservationJacobian(const Eigen::VectorXd& x) const {
    return getObservationJacobianAtState(x);
  }
  /// The observation as y = C l + c, where l stacks all landmarks: C is 2 N x 2 N, c has 2 N numbers.
  /// Throws Error with rangeBearing, because that observation is not linear in the landmarks.
  void getLinearObservationModelAtState(Eigen::MatrixXd& C, Eigen::VectorXd& c,
                                        const Eigen::VectorXd& x) const;

  /// The observation at x without noise of other landmarks, stacked as 2 N numbers.
  [[nodiscard]] Eigen::VectorXd getMeanObservationAtStateAndLandmarks(const Eigen::VectorXd& x,
                                                                      const Eigen::VectorXd& landmarks) const;
  void getMeanObservationAtStateAndLandmarks(Eigen::VectorXd& y, const Eigen::VectorXd& x,
                                             const Eigen::VectorXd& landmarks) const {
    y = getMeanObservationAtStateAndLandmarks(x, landmarks);
  }
  /// dy/d(x, landmarks), 2 N x (3 + 2 N).
  [[nodiscard]] Eigen::MatrixXd getObservationJacobianAtStateAndLandmarks(
      const Eigen::VectorXd& x, const Eigen::VectorXd& landmarks) const;
  void getObservationJacobianAtStateAndLandmarks(Eigen::MatrixXd& J, const Eigen::VectorXd& x,
                                                 const Eigen::VectorXd& landmarks) const {
    J = getObservationJacobianAtStateAndLandmarks(x, landmarks);
  }

 private:
  void requireTruth(const char* method) const;
  void requirePlaces(const char* method) const;

  CarOptions options_;
  Eigen::Matrix2Xd landmarks_;
  bool hasPlaces_ = true;
  std::optional<Eigen::Vector3d> state_;
  Rng rng_;
};

}  // namespace rex
