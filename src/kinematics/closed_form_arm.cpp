#include "kinematics/closed_form_arm.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/rotation.h"
#include "kinematics/closed_form_arm_internal.h"
#include "kinematics/forward_kinematics.h"

namespace rex::internal {
namespace {

// The cosine of k pi / 4.
double cosineOf(int k) {
  constexpr double kHalf = std::numbers::sqrt2 / 2;
  constexpr std::array<double, 8> kCosines{1, kHalf, 0, -kHalf, -1, -kHalf, 0, kHalf};
  return kCosines[static_cast<std::size_t>(k % 8)];
}

double wrappedAngle(double x) {
  return x - 2 * std::numbers::pi * std::nearbyint(x / (2 * std::numbers::pi));
}

double valueOf(std::span<const double> a, double x) {
  double sum = 0;
  for (std::size_t i = a.size(); i-- > 0;) sum = sum * x + a[i];
  return sum;
}

// The root between two places with values of opposite signs, by Newton's steps inside the bracket.
double bracketedRoot(std::span<const double> a, double low, double high) {
  const bool isRising = valueOf(a, low) < 0;
  double x = 0.5 * (low + high);
  for (int i = 0; i < 200; ++i) {
    double value = 0, slope = 0;
    for (std::size_t k = a.size(); k-- > 0;) {
      slope = slope * x + value;
      value = value * x + a[k];
    }
    if (value == 0) return x;
    ((value < 0) == isRising ? low : high) = x;
    const double next = x - value / slope;
    const double last = x;
    x = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(x - last) <= 2e-16 * std::abs(x) || x == low || x == high) return x;
  }
  return x;
}

// Between the places where the slope changes its sign, the graph is monotonous.
Angles rootsBetweenTurns(std::span<const double> a, double tolerance) {
  const std::size_t degree = a.size() - 1;
  Angles roots;
  if (degree == 0) return roots;
  if (a[degree] == 0) return rootsBetweenTurns(a.first(degree), tolerance);
  if (degree == 1) {
    roots.add(-a[0] / a[1]);
    return roots;
  }
  std::array<double, 4> slope{};
  for (std::size_t i = 1; i <= degree; ++i) slope[i - 1] = static_cast<double>(i) * a[i];
  const Angles turns = rootsBetweenTurns(std::span(slope).first(degree), 0);
  double bound = 0;
  for (std::size_t i = 0; i < degree; ++i) bound = std::max(bound, std::abs(a[i] / a[degree]));
  double low = -bound - 1;
  for (int k = 0; k <= turns.count; ++k) {
    const double high = k < turns.count ? turns.angle[static_cast<std::size_t>(k)] : bound + 1;
    const double below = valueOf(a, low), above = valueOf(a, high);
    const bool touchesLow = k > 0 && std::abs(below) <= tolerance;
    const bool touchesHigh = k < turns.count && std::abs(above) <= tolerance;
    if (touchesHigh)
      roots.add(high);
    else if (!touchesLow && (below < 0) != (above < 0))
      roots.add(bracketedRoot(a, low, high));
    low = high;
  }
  return roots;
}

}  // namespace

Angles rootsOfLine(double a, double b, double d, double least) {
  Angles result;
  const double size = std::hypot(a, b);
  if (size <= least) return result;
  constexpr double kRounding = 1e-12;
  const double cosine = d / size;
  if (std::abs(cosine) > 1 + kRounding) return result;
  const double middle = std::atan2(b, a), half = std::acos(std::clamp(cosine, -1., 1.));
  result.add(wrappedAngle(middle + half));
  if (half > 0 && half < std::numbers::pi) result.add(wrappedAngle(middle - half));
  return result;
}

Angles rootsOfSecondOrder(const std::array<double, 8>& values, double tolerance) {
  // As a polynomial in the tangent of half the angle from a place that is opposite to the largest value, so
  // that no root is infinite.
  const auto isSmaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto opposite = std::max_element(values.begin(), values.end(), isSmaller) - values.begin();
  const double largest = std::abs(values[static_cast<std::size_t>(opposite)]);
  if (!(largest > 0)) return {};
  double constant = 0, c1 = 0, s1 = 0, c2 = 0, s2 = 0;
  for (int k = 0; k < 8; ++k) {
    const double value = values[static_cast<std::size_t>((opposite + 4 + k) % 8)] / 8;
    constant += value;
    c1 += 2 * value * cosineOf(k);
    s1 += 2 * value * cosineOf(k + 6);
    c2 += 2 * value * cosineOf(2 * k);
    s2 += 2 * value * cosineOf(2 * k + 6);
  }
  const std::array<double, 5> a{constant + c1 + c2, 2 * s1 + 4 * s2, 2 * constant - 6 * c2, 2 * s1 - 4 * s2,
                                constant - c1 + c2};
  Angles result = rootsBetweenTurns(a, tolerance * largest);
  const double start = static_cast<double>((opposite + 4) % 8) * std::numbers::pi / 4;
  for (int k = 0; k < result.count; ++k) {
    double& one = result.angle[static_cast<std::size_t>(k)];
    one = wrappedAngle(start + 2 * std::atan(one));
  }
  return result;
}

}  // namespace rex::internal

namespace rex {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using internal::Angles;

constexpr double kAlike = 1e-9;      // of directions and, times the arm's size, of points
constexpr double kTouching = 1e-12;  // of graphs that touch zero, relative to their largest value
constexpr double kExact = 1e-10;

// Faster than std::remainder().
double wrapped(double angle) {
  return angle - 2 * std::numbers::pi * std::nearbyint(angle / (2 * std::numbers::pi));
}

Vector3d turned(const Vector3d& axis, double angle, const Vector3d& v) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * axis.cross(v) + (1 - c) * axis.dot(v) * axis;
}

Matrix3d turn(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// The angle about an axis that turns v towards w. Empty if one of them lies along the axis.
std::optional<double> angleBetween(const Vector3d& axis, const Vector3d& v, const Vector3d& w, double least) {
  const Vector3d across = axis.cross(v);
  const double sine = across.dot(w), cosine = v.dot(w) - axis.dot(v) * axis.dot(w);
  if (across.norm() <= least || axis.cross(w).norm() <= least) return std::nullopt;
  return std::atan2(sine, cosine);
}

bool areParallel(const Vector3d& a, const Vector3d& b) { return a.cross(b).norm() < kAlike; }

// The points of two lines that are nearest to each other; of parallel ones, those nearest to a's point.
std::pair<Vector3d, Vector3d> nearestPoints(const Vector3d& a, const Vector3d& atA, const Vector3d& b,
                                            const Vector3d& atB) {
  const Vector3d normal = a.cross(b), between = atB - atA;
  if (normal.norm() < kAlike) return {atA, atB - b * b.dot(between)};
  const double squared = normal.squaredNorm();
  return {atA + a * between.cross(b).dot(normal) / squared, atB + b * between.cross(a).dot(normal) / squared};
}

// v as a complex number in the plane across an axis, whose first direction is `x`.
std::complex<double> across(const Vector3d& axis, const Vector3d& x, const Vector3d& v) {
  return {x.dot(v), axis.cross(x).dot(v)};
}

// The values of a sum of second order at the multiples of pi / 4.
template <class Function>
Angles rootsOf(const Function& function) {
  std::array<double, 8> values;
  for (std::size_t k = 0; k < 8; ++k) values[k] = function(static_cast<double>(k) * std::numbers::pi / 4);
  return internal::rootsOfSecondOrder(values, kTouching);
}

// Where a sum of first order is zero.
template <class Function>
Angles rootsOfFirst(const Function& function, double least) {
  const double at0 = function(0), at1 = function(std::numbers::pi / 2), at2 = function(std::numbers::pi);
  const double constant = 0.5 * (at0 + at2);
  return internal::rootsOfLine(0.5 * (at0 - at2), at1 - constant, -constant, least);
}

}  // namespace

std::optional<ClosedFormArm> ClosedFormArm::of(const Model& model, BodyId tip, std::string* why) {
  const auto none = [&](std::string reason) {
    if (why != nullptr) *why = std::move(reason);
    return std::nullopt;
  };
  if (static_cast<int>(tip) < 0 || static_cast<std::size_t>(tip) >= model.bodies().size())
    throw Error({.what = "body of the tip", .found = fmt::format("number {}", static_cast<int>(tip))});
  std::vector<JointId> chain;
  for (BodyId at = tip; at != kWorld; at = model[at].parent)
    if (const JointId joint = model[at].joint; joint != kNoJoint && model[joint].nq > 0)
      chain.push_back(joint);
  if (chain.size() != 6) return none(fmt::format("{} joints move the tip, not six", chain.size()));
  ClosedFormArm arm;
  arm.nq_ = model.nq();
  Eigen::VectorXd q = model.initialPositions();
  for (std::size_t i = 0; i < 6; ++i) {
    arm.joints_[i] = chain[5 - i];
    const Joint& joint = model[arm.joints_[i]];
    if (joint.type != JointType::kHinge) return none(fmt::format("joint '{}' is no hinge", joint.name));
    if (joint.mimics) return none(fmt::format("joint '{}' mimics another", joint.name));
    arm.qIndex_[i] = joint.qIndex;
    arm.lower_[i] = model.lowerLimits()[joint.qIndex];
    arm.upper_[i] = model.upperLimits()[joint.qIndex];
    q[joint.qIndex] = 0;
  }
  const BodyPoses poses = forwardKinematics(model, q);
  arm.X_WT0_ = poses[tip];
  for (std::size_t i = 0; i < 6; ++i) {
    const Joint& joint = model[arm.joints_[i]];
    const Pose X_WF = poses[joint.parent] * joint.X_PF;
    arm.axis_[i] = (X_WF.R * joint.axis).normalized();
    arm.at_[i] = X_WF.p;
  }
  for (std::size_t i = 0; i + 1 < 6; ++i) {
    const auto [a, b] = nearestPoints(arm.axis_[i], arm.at_[i], arm.axis_[i + 1], arm.at_[i + 1]);
    arm.size_ += (a - b).norm() + (arm.at_[i + 1] - b).norm();
  }
  if (!(arm.size_ > 0)) return none("all axes meet in a point");
  const Axes axes = arm.axis_, points = arm.at_;
  for (const Kind kind : {Kind::kWrist, Kind::kParallel})
    for (const bool isReversed : {false, true}) {
      arm.kind_ = kind;
      arm.orient(axes, points, isReversed);
      if (kind == Kind::kWrist ? arm.meetAtEnd() : arm.areParallelInTheMiddle()) return arm;
    }
  return none("neither three of its axes meet at an end, nor three in the middle are parallel");
}

// From its tip to the world, an arm turns the other way round about the same axes.
void ClosedFormArm::orient(const Axes& axes, const Axes& points, bool isReversed) {
  isReversed_ = isReversed;
  for (std::size_t i = 0; i < 6; ++i) {
    axis_[i] = isReversed ? Vector3d(-axes[5 - i]) : axes[i];
    at_[i] = isReversed ? points[5 - i] : points[i];
  }
}

// Whether the last three axes meet; if so, their points are where they do.
bool ClosedFormArm::meetAtEnd() {
  const auto [on4, center] = nearestPoints(axis_[3], at_[3], axis_[4], at_[4]);
  const double apart = (on4 - center).norm() + (at_[5] - center).cross(axis_[5]).norm();
  if (apart > kAlike * size_ || areParallel(axis_[3], axis_[4]) || areParallel(axis_[4], axis_[5]))
    return false;
  at_[3] = at_[4] = at_[5] = center;
  std::tie(at_[0], at_[1]) = nearestPoints(axis_[0], at_[0], axis_[1], at_[1]);
  return true;
}

// Whether the second to fourth axis are; if so, the points of the last two are the nearest to each other.
bool ClosedFormArm::areParallelInTheMiddle() {
  const std::array<bool, 5> isLikeNext{areParallel(axis_[0], axis_[1]), areParallel(axis_[1], axis_[2]),
                                       areParallel(axis_[2], axis_[3]), areParallel(axis_[3], axis_[4]),
                                       areParallel(axis_[4], axis_[5])};
  if (isLikeNext != std::array{false, true, true, false, false}) return false;
  std::tie(at_[4], at_[5]) = nearestPoints(axis_[4], at_[4], axis_[5], at_[5]);
  return true;
}

// The first three angles put the centre of the wrist where it belongs: with f the wrist seen from the third
// axis, it is a1 + R2 f from the first one, whose length and height along the first axis are known (Pieper
// 1968).
void ClosedFormArm::addByWrist(const Pose& X, const Angles6& reference, std::vector<Angles6>& found) const {
  const Vector3d w = X * at_[3] - at_[0], a1 = at_[1] - at_[0], a2 = at_[2] - at_[1], a3 = at_[3] - at_[2];
  const Vector3d &h1 = axis_[0], &h2 = axis_[1], &h3 = axis_[2];
  const Vector3d x = h2.unitOrthogonal();
  const std::complex<double> A = across(h2, x, a1) / size_, H = across(h2, x, h1);
  struct Reach {
    Vector3d f;
    std::complex<double> F;
    double length, height;  // what A and H times the turned F must be
  };
  const auto reachAt = [&](double q3) {
    const Vector3d f = a2 + turned(h3, q3, a3);
    const double along = h2.dot(f);
    return Reach{f, across(h2, x, f),
                 (0.5 * (w.squaredNorm() - a1.squaredNorm() - f.squaredNorm()) - a1.dot(h2) * along) / size_,
                 h1.dot(w) - h1.dot(a1) - h1.dot(h2) * along};
  };
  const auto addArm = [&](double q3, double q2, int chosen = -1) {
    Angles6 arm;
    arm.chosen = chosen;
    arm.angle[1] = q2;
    arm.angle[2] = q3;
    const Vector3d g = a1 + turned(h2, q2, reachAt(q3).f);
    const auto q1 = angleBetween(h1, g, w, kAlike * size_);
    arm.angle[0] = q1.value_or(reference.angle[0]);
    if (!q1) arm.chosen = 0;
    const Matrix3d R = turn(h1, arm.angle[0]) * turn(h2, q2) * turn(h3, q3);
    addWrists(R.transpose() * X.R, arm, reference, found);
  };
  const double det = A.real() * H.imag() - A.imag() * H.real();
  if (std::abs(det) > kAlike) {
    const auto turnedReach = [&](const Reach& reach) {
      return std::complex<double>(reach.length * H.imag() - reach.height * A.imag(),
                                  reach.height * A.real() - reach.length * H.real()) /
             det;
    };
    const Angles elbows = rootsOf([&](double q3) {
      const Reach reach = reachAt(q3);
      return (std::norm(turnedReach(reach)) - std::norm(reach.F)) / (size_ * size_);
    });
    for (const double q3 : elbows) {
      const Reach reach = reachAt(q3);
      if (std::abs(reach.F) > kAlike * size_)
        addArm(q3, std::arg(turnedReach(reach)) - std::arg(reach.F));
      else
        addArm(q3, reference.angle[1], 1);
    }
    return;
  }
  // The first two axes meet or are parallel: a1 is across both, so that A or H is zero, and the equation
  // without the turned F depends on q3 alone.
  const bool isByLength = std::abs(A) > std::abs(H);
  const std::complex<double> D = isByLength ? A : H;
  const auto value = [&](const Reach& reach) { return isByLength ? reach.length : reach.height; };
  const auto rest = [&](double q3) {
    const Reach reach = reachAt(q3);
    return (isByLength ? reach.height : reach.length) / size_;
  };
  for (const double q3 : rootsOfFirst(rest, kAlike)) {
    const Reach reach = reachAt(q3);
    // Re(conj(D) F e^(i q2)) = value
    const std::complex<double> product = std::conj(D) * reach.F;
    for (const double q2 :
         internal::rootsOfLine(product.real(), -product.imag(), value(reach), kAlike * size_))
      addArm(q3, q2);
  }
}

// R4 R5 R6 = R.
void ClosedFormArm::addWrists(const Matrix3d& R, Angles6 arm, const Angles6& reference,
                              std::vector<Angles6>& found) const {
  const Vector3d &h4 = axis_[3], &h5 = axis_[4], &h6 = axis_[5];
  const Vector3d pointing = R * h6, u = h6.unitOrthogonal(), turnedU = R * u;
  const bool isSingular = h4.cross(pointing).norm() < kExact;
  if (isSingular && arm.chosen < 0) arm.chosen = 3;
  const double wanted = h4.dot(pointing), along = h4.dot(h5) * h5.dot(h6);
  for (const double q5 :
       internal::rootsOfLine(h4.dot(h6) - along, h4.dot(h5.cross(h6)), wanted - along, kAlike)) {
    // A root that only touches has half the digits.
    arm.angle[4] = isSingular ? angleBetween(h5, h6, wanted * h4, 0).value_or(q5) : q5;
    arm.angle[3] = isSingular
                       ? reference.angle[3]
                       : angleBetween(h4, turned(h5, q5, h6), pointing, 0).value_or(reference.angle[3]);
    const Vector3d v = turned(h5, -arm.angle[4], turned(h4, -arm.angle[3], turnedU));
    arm.angle[5] = std::atan2(h6.cross(u).dot(v), u.dot(v));
    found.push_back(arm);
  }
}

// Turns about the parallel axes change neither what h, their direction, is in their frames nor heights along
// it: two equations for q1 and q5.
void ClosedFormArm::addByParallels(const Pose& X, const Angles6& reference,
                                   std::vector<Angles6>& found) const {
  const Vector3d &h1 = axis_[0], &h = axis_[1], &h5 = axis_[4], &h6 = axis_[5];
  const Vector3d w = (X * at_[5] - at_[0]) / size_, lever = (at_[5] - at_[4]) / size_, pointing = X.R * h6;
  const double height = h.dot(at_[4] - at_[0]) / size_;
  // What the first side of both equations is at q1, and the second at q5.
  const auto first = [&](double q1) {
    const Vector3d turnedH = turned(h1, q1, h);
    return Eigen::Vector2d(turnedH.dot(w) - height, turnedH.dot(pointing));
  };
  const auto second = [&](double q5) {
    return Eigen::Vector2d(h.dot(turned(h5, q5, lever)), h.dot(turned(h5, q5, h6)));
  };
  const auto add = [&](double q1, double q5, int chosen = -1) {
    Angles6 arm;
    arm.angle[0] = q1;
    arm.angle[4] = q5;
    arm.chosen = chosen;
    addElbows(X, arm, reference, found);
  };
  // second(q5) = constant + B (cos q5, sin q5)
  const double pi = std::numbers::pi;
  const Eigen::Vector2d constant = 0.5 * (second(0) + second(pi));
  Eigen::Matrix2d B;
  B << second(0) - constant, second(pi / 2) - constant;
  if (std::abs(B.determinant()) > kAlike) {
    const Eigen::Matrix2d inverse = B.inverse();
    const auto direction = [&](double q1) -> Eigen::Vector2d { return inverse * (first(q1) - constant); };
    for (const double q1 : rootsOf([&](double x) { return direction(x).squaredNorm() - 1; })) {
      const Eigen::Vector2d y = direction(q1);
      add(q1, std::atan2(y[1], y[0]));
    }
    return;
  }
  // As where the last two axes meet: one equation, or a sum of both, is for q1 alone.
  const int row = B.row(0).norm() > B.row(1).norm() ? 0 : 1;
  if (B.row(row).norm() < kAlike) return;
  const double share = B.row(1 - row).dot(B.row(row)) / B.row(row).squaredNorm();
  const auto rest = [&](double q1) {
    const Eigen::Vector2d gap = first(q1) - constant;
    return gap[1 - row] - share * gap[row];
  };
  const bool isFree = std::max({std::abs(rest(0)), std::abs(rest(pi / 2)), std::abs(rest(pi))}) < kAlike;
  Angles shoulders = rootsOfFirst(rest, kAlike);
  if (isFree) shoulders.add(reference.angle[0]);
  for (const double q1 : shoulders)
    for (const double q5 :
         internal::rootsOfLine(B(row, 0), B(row, 1), first(q1)[row] - constant[row], kAlike))
      add(q1, q5, isFree ? 0 : -1);
}

void ClosedFormArm::addElbows(const Pose& X, Angles6 arm, const Angles6& reference,
                              std::vector<Angles6>& found) const {
  const Vector3d &h1 = axis_[0], &h = axis_[1], &h5 = axis_[4], &h6 = axis_[5];
  const Matrix3d R1 = turn(h1, arm.angle[0]);
  // R6^T R5^T h = R^T R1 h
  const Vector3d seen = X.R.transpose() * (R1 * h);
  const bool isSingular = h6.cross(seen).norm() < kExact;
  // A root that only touches has half the digits.
  if (isSingular) arm.angle[4] = angleBetween(h5, h6, seen.dot(h6) * h, 0).value_or(arm.angle[4]);
  if (!isSingular) {
    arm.angle[5] = angleBetween(h6, seen, turned(h5, -arm.angle[4], h), 0).value_or(reference.angle[5]);
    addPlanarTriples(X, arm, reference, found);
    return;
  }
  // Not at every angle of the last axis is the rest within reach: the nearest to the reference.
  constexpr int kTries = 32;
  if (arm.chosen < 0) arm.chosen = 5;
  const std::size_t before = found.size();
  for (int k = 0; k < kTries && found.size() == before; ++k) {
    const int steps = (k + 1) / 2 * (k % 2 == 0 ? 1 : -1);
    arm.angle[5] = reference.angle[5] + steps * 2 * std::numbers::pi / kTries;
    addPlanarTriples(X, arm, reference, found);
  }
}

// Three hinges in a plane, when all other angles are known.
void ClosedFormArm::addPlanarTriples(const Pose& X, const Angles6& arm, const Angles6& reference,
                                     std::vector<Angles6>& found) const {
  const Vector3d &h = axis_[1], &h6 = axis_[5];
  const Matrix3d R1 = turn(axis_[0], arm.angle[0]), R5 = turn(axis_[4], arm.angle[4]);
  const Matrix3d R234 = R1.transpose() * X.R * turn(h6, arm.angle[5]).transpose() * R5.transpose();
  const Vector3d u = h.unitOrthogonal();
  const double sum = std::atan2(h.cross(u).dot(R234 * u), u.dot(R234 * u));
  const Vector3d to = R1.transpose() * (X * at_[5] - at_[0]) - (at_[1] - at_[0]) -
                      turned(h, sum, at_[4] - at_[3] + R5 * (at_[5] - at_[4]));
  const Vector3d upper = at_[2] - at_[1], lower = at_[3] - at_[2];
  const double s3 = axis_[2].dot(h) > 0 ? 1 : -1, s4 = axis_[3].dot(h) > 0 ? 1 : -1;
  const double heights = h.dot(upper) * h.dot(lower);
  const double unit = size_ * size_;
  const Angles elbows = internal::rootsOfLine(
      (upper.dot(lower) - heights) / unit, upper.dot(h.cross(lower)) / unit,
      (0.5 * (to.squaredNorm() - upper.squaredNorm() - lower.squaredNorm()) - heights) / unit, kAlike);
  for (const double elbow : elbows) {
    Angles6 one = arm;
    const auto q2 = angleBetween(h, upper + turned(h, elbow, lower), to, kAlike * size_);
    one.angle[1] = q2.value_or(reference.angle[1]);
    if (!q2 && one.chosen < 0) one.chosen = 1;
    one.angle[2] = s3 * elbow;
    one.angle[3] = s4 * (sum - one.angle[1] - elbow);
    found.push_back(one);
  }
}

// Newton steps, where rounding near singular postures took digits. Whether the pose is exact.
bool ClosedFormArm::polish(const Pose& X, Angles6& arm) const {
  constexpr double kGood = 1e-12, kNear = 1e-3;
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0;; ++step) {
    std::array<Pose, 7> at;
    for (std::size_t i = 0; i < 6; ++i) {
      const Matrix3d R = turn(axis_[i], arm.angle[i]);
      at[i + 1].R = at[i].R * R;
      at[i + 1].p = at[i].p + at[i].R * (at_[i] - R * at_[i]);
    }
    // The twist about the origin that leads to X.
    const Matrix3d gap = X.R * at[6].R.transpose();
    Eigen::Matrix<double, 6, 1> error;
    error.head<3>() = 0.5 * Vector3d(gap(2, 1) - gap(1, 2), gap(0, 2) - gap(2, 0), gap(1, 0) - gap(0, 1));
    error.tail<3>() = X.p - gap * at[6].p;
    const double size = error.head<3>().norm() + (X.p - at[6].p + (X.R - at[6].R) * at_[5]).norm() / size_;
    if (!(size < kNear) || gap.trace() < 1) return false;
    if (size < kGood || step == 4 || !(size < last) || (size < kExact && arm.chosen >= 0))
      return size < kExact;
    last = size;
    Eigen::Matrix<double, 6, 6> J;
    for (std::size_t i = 0; i < 6; ++i) {
      const Vector3d axis = at[i].R * axis_[i];
      J.col(static_cast<Eigen::Index>(i)) << axis, (at[i].p + at[i].R * at_[i]).cross(axis);
    }
    const Eigen::Matrix<double, 6, 1> change = J.partialPivLu().solve(error);
    if (!(change.norm() < 0.1)) return size < kExact;
    for (std::size_t i = 0; i < 6; ++i) arm.angle[i] += change[static_cast<Eigen::Index>(i)];
  }
}

std::vector<ClosedFormPosture> ClosedFormArm::postures(const Pose& X_WT, const VectorArg& reference,
                                                       const ClosedFormOptions& options) const {
  requireSize("reference posture", reference.size(), nq_);
  requireFinite("position of the tip", X_WT.p);
  if (!((X_WT.R * X_WT.R.transpose() - Matrix3d::Identity()).norm() < 1e-8) || X_WT.R.determinant() < 0)
    throw Error({.what = "orientation of the tip", .found = "no rotation matrix"});
  Pose X = X_WT * X_WT0_.inverse();
  if (isReversed_) X = X.inverse();
  const auto slot = [&](std::size_t i) { return isReversed_ ? 5 - i : i; };
  Angles6 near;
  for (std::size_t i = 0; i < 6; ++i) near.angle[i] = reference[qIndex_[slot(i)]];
  std::vector<Angles6> found, kept;
  found.reserve(8);
  if (kind_ == Kind::kWrist)
    addByWrist(X, near, found);
  else
    addByParallels(X, near, found);
  const auto isSame = [](const Angles6& a, const Angles6& b) {
    for (std::size_t i = 0; i < 6; ++i)
      if (!(std::abs(wrapped(a.angle[i] - b.angle[i])) < 1e-6)) return false;
    return true;
  };
  for (Angles6& one : found) {
    if (!polish(X, one)) continue;
    if (std::none_of(kept.begin(), kept.end(), [&](const Angles6& other) { return isSame(one, other); }))
      kept.push_back(one);
  }
  std::vector<ClosedFormPosture> result;
  result.reserve(kept.size());
  for (const Angles6& one : kept) {
    ClosedFormPosture posture{
        reference, one.chosen < 0 ? kNoJoint : joints_[slot(static_cast<std::size_t>(one.chosen))]};
    addTurns(posture, one, 0, options, result);
  }
  return result;
}

// The posture with joint i and those after it at each of their angles.
void ClosedFormArm::addTurns(ClosedFormPosture& posture, const Angles6& arm, std::size_t i,
                             const ClosedFormOptions& options, std::vector<ClosedFormPosture>& result) const {
  if (i == 6) {
    result.push_back(posture);
    return;
  }
  constexpr double kTurn = 2 * std::numbers::pi;
  const double plain = wrapped(arm.angle[isReversed_ ? 5 - i : i]);
  double& q = posture.q[qIndex_[i]];
  const double reference = q;
  const auto [first, last] = turnsWithin(i, plain);
  const bool isPlain = !options.withinLimits && (!options.listsTurns || first > last);
  if (isPlain) {
    q = plain;
    addTurns(posture, arm, i + 1, options, result);
  } else if (first <= last) {
    // The nearest to the reference, unless all are wanted.
    const double nearest = std::clamp(std::round((reference - plain) / kTurn), first, last);
    for (double k = options.listsTurns ? first : nearest; k <= (options.listsTurns ? last : nearest); ++k) {
      const double angle = plain + kTurn * k;
      q = options.withinLimits ? std::clamp(angle, lower_[i], upper_[i]) : angle;
      addTurns(posture, arm, i + 1, options, result);
    }
  }
  q = reference;
}

// The least and the largest number of full turns that lead within the limits of a joint; only the smallest
// where there are no two limits.
std::pair<double, double> ClosedFormArm::turnsWithin(std::size_t joint, double angle) const {
  constexpr double kTurn = 2 * std::numbers::pi, kRounding = 1e-9;
  const double first = std::ceil((lower_[joint] - kRounding - angle) / kTurn);
  const double last = std::floor((upper_[joint] + kRounding - angle) / kTurn);
  if (std::isfinite(first) && std::isfinite(last)) return {first, last};
  const double one = std::isfinite(first)  ? std::max(0., first)
                     : std::isfinite(last) ? std::min(0., last)
                                           : 0;
  return {one, one};
}

}  // namespace rex
