#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "base/rng.h"

namespace rex {

/// The constants of a CarSimulator. Noises are standard deviations (errata 9.1b), metres and radians.
struct CarOptions {
  double tau = 1;                 ///< seconds per step
  double wheelbase = 2;           ///< L, metres
  double dynamicsNoise = 0.03;    ///< in x, y and heading, added in each step
  double observationNoise = 0.5;  ///< in both numbers of each landmark; of the distance with rangeBearing
  bool rangeBearing = false;      ///< observe (distance, bearing) rather than (ahead, left)
  double bearingNoise = 0.02;
  double maxRange = std::numeric_limits<double>::infinity();  ///< farther landmarks are not seen
  double fieldOfView = 6.283185307179586;  ///< nor those outside this angle around the heading
};

/// The car of exercises 12.9 and 12.13, with the names of the script: state (x, y, heading), control u = (v,
/// phi), and landmarks that it sees from its own frame. Methods throw Error for vectors of another size, and
/// for numbers that are not finite.
class CarSimulator {
 public:
  /// A car at (0, 0, 0) among `landmarks` of them, each coordinate normal with deviation 10. Places and noise
  /// come from separate streams of the seed: the ones do not tell the other. Throws Error for options out of
  /// range and a negative count.
  explicit CarSimulator(std::uint64_t seed = 0, int landmarks = 2, const CarOptions& options = {});
  /// Only what may be known of one: it has no state, so that what asks for the truth throws Error.
  CarSimulator(const Eigen::Matrix2Xd& landmarks, const CarOptions& options);
  /// Only what may be known of one whose map is to be found: how many landmarks there are. What asks for the
  /// truth or for their places throws Error; what is given landmarks does not. Throws as the first.
  [[nodiscard]] static CarSimulator withoutPlaces(int landmarks, const CarOptions& options = {});

  const CarOptions& options() const { return options_; }
  int countLandmarks() const { return static_cast<int>(landmarks_.cols()); }
  [[nodiscard]] const Eigen::Matrix2Xd& getLandmarks() const;
  void setLandmarks(const Eigen::Matrix2Xd& landmarks);

  /// One step of Euler with the heading before it (slide 4:48, errata 9), then noise.
  void step(const Eigen::VectorXd& u);
  /// The true state.
  [[nodiscard]] Eigen::Vector3d getState() const;
  void setState(const Eigen::VectorXd& x);

  /// Where the step leads without noise, and its derivative by the state: I + tau [[0,0,-v sin], [0,0,v cos],
  /// [0,0,0]] (errata 9.2a).
  [[nodiscard]] Eigen::VectorXd getMeanStateAfterStep(const Eigen::VectorXd& x,
                                                      const Eigen::VectorXd& u) const;
  [[nodiscard]] Eigen::MatrixXd getStateJacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const;

  /// What the car sees now of all landmarks, with noise: 2 numbers for each.
  [[nodiscard]] Eigen::VectorXd getRealNoisyObservation();
  void getRealNoisyObservation(Eigen::VectorXd& y) { y = getRealNoisyObservation(); }
  /// Which landmarks are in range and in view now.
  [[nodiscard]] std::vector<int> getVisibleLandmarks() const;

  /// What it would see at x without noise.
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
  /// y = C l + c of all landmarks l, stacked: 2 N x 2 N and 2 N numbers. Throws Error with rangeBearing,
  /// which is not linear in them.
  void getLinearObservationModelAtState(Eigen::MatrixXd& C, Eigen::VectorXd& c,
                                        const Eigen::VectorXd& x) const;

  /// The same with other landmarks, stacked as 2 N numbers.
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
