#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "estimation/gaussian.h"
#include "estimation/landmark_sensor.h"

namespace rex {

/// How a planar pose moves: x' ~ N(mean(x), noise), with the derivative of the mean.
struct PoseTransition {
  std::function<Eigen::Vector3d(const Eigen::Vector3d& x)> mean{};
  std::function<Eigen::Matrix3d(const Eigen::Vector3d& x)> jacobian{};
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
};

/// The effect of an observation of one landmark.
struct LandmarkUpdate {
  int landmark = 0;
  bool isNew = false;
  double squaredInnovation = 0;  ///< NIS, chi-square (2 degrees) if consistent; 0 for a new landmark
};

/// NIS bounds (chi-square with 2 degrees of freedom) for associating unnamed observations with landmarks.
struct AssociationGates {
  double same = 9.21;  ///< 99 %: below it, the observation belongs to the likeliest landmark
  double different =
      18.42;  ///< 99.99 %: above it for all landmarks, it is a new one; in between it is ignored
};

/// EKF SLAM: one Gaussian of the pose and all landmarks, of size 3 + 2 N, with linearised models. Slide
/// 7:38; exercise 12.13. A landmark is added when it is first seen. A named observation of a known landmark
/// does not allocate.
class EkfSlam {
 public:
  /// Throws Error for a pose that is not a Gaussian of size three and a sensor whose W is not definite.
  EkfSlam(const Gaussian& pose, const LandmarkSensor& sensor);

  int landmarks() const { return landmarks_; }
  [[nodiscard]] Gaussian pose() const;
  /// Throws Error for a landmark that does not exist.
  [[nodiscard]] Gaussian landmark(int i) const;
  /// Pose and all landmarks.
  [[nodiscard]] Gaussian joint() const;

  /// Throws Error for a transition without functions, and values that are not finite.
  void predict(const PoseTransition& transition);
  /// Updates with an observation of landmark number `landmark`; the next number, landmarks(), adds a new
  /// one. Throws Error for other numbers, an observation that is not finite, and if rounding makes the
  /// covariance of the innovation or of the result invalid; nothing has changed then.
  LandmarkUpdate observe(int landmark, const Eigen::Vector2d& y);
  /// Updates with unnamed observations, each of a different landmark; the likeliest pairs are taken first.
  /// The result is empty for an observation that is neither near enough to a landmark nor far enough to be
  /// new, or whose landmark was taken by another. Throws as above, keeping earlier updates, and unless 0 <
  /// same <= different.
  std::vector<std::optional<LandmarkUpdate>> observe(std::span<const Eigen::Vector2d> ys,
                                                     const AssociationGates& gates = {});

 private:
  struct Innovation {
    Eigen::Vector2d error;
    Eigen::Matrix2d S;
    LandmarkView view;
    double squared;
    double cost;  ///< -2 log likelihood, without its constant
  };
  [[nodiscard]] Eigen::Vector3d poseMean() const { return mean_.head<3>(); }
  [[nodiscard]] Innovation innovate(int landmark, const Eigen::Vector2d& y) const;
  void add(const Eigen::Vector2d& y);
  void update(int landmark, const Innovation& innovation);
  void requireVariances(int n) const;
  int size() const { return 3 + 2 * landmarks_; }

  LandmarkSensor sensor_;
  int landmarks_ = 0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;  // its lower triangle; room for more than size()
  Eigen::Matrix<double, Eigen::Dynamic, 2> gain_;
};

}  // namespace rex
