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

/// What an observation of one landmark did.
struct LandmarkUpdate {
  int landmark = 0;
  bool isNew = false;
  double squaredInnovation = 0;  ///< NIS, chi-square of 2 degrees when consistent; 0 for a new landmark
};

/// When an observation without a name belongs to a known landmark: NIS bounds, chi-square of 2 degrees.
struct AssociationGates {
  double same = 9.21;  ///< 99 %: nearer than this it is the likeliest such landmark
  double different =
      18.42;  ///< 99.99 %: farther than this from all it is a new one; between both it is left out
};

/// Kalman SLAM: one Gaussian of the pose and all landmarks, 3 + 2 N numbers, along tangents. Slide 7:38;
/// exercise 12.13. A landmark enters when it is first seen; its size grows then. An observation by name of
/// a known landmark does not allocate.
class EkfSlam {
 public:
  /// Throws Error for a pose that is not a Gaussian of three numbers and a sensor whose W is not definite.
  EkfSlam(const Gaussian& pose, const LandmarkSensor& sensor);

  int landmarks() const { return landmarks_; }
  [[nodiscard]] Gaussian pose() const;
  /// Throws Error for a landmark that is not there.
  [[nodiscard]] Gaussian landmark(int i) const;
  /// Pose and all landmarks.
  [[nodiscard]] Gaussian joint() const;

  /// Throws Error for a transition without functions, and values that are not finite.
  void predict(const PoseTransition& transition);
  /// An observation of a landmark that is known by name; the next number, landmarks(), is a new one. Throws
  /// Error for another, an observation that is not finite, and where rounding leaves a covariance that is not
  /// one, of the innovation or after it: nothing has changed then.
  LandmarkUpdate observe(int landmark, const Eigen::Vector2d& y);
  /// Observations without names, of different landmarks each: the likeliest pairs first. Empty where one is
  /// too far from all landmarks to be one of them and too near to be new, and where another took the landmark
  /// it is near to. Throws as the above, where those taken before stay, and Error unless 0 < same <=
  /// different.
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
