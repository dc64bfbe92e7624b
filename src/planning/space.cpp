#include "planning/space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

using Kind = SpacePart::Kind;

void requireSound(const SpacePart& part, std::size_t i) {
  requirePositive(fmt::format("weight of part {} of a space", i), part.weight);
  const bool hasRange = std::isfinite(part.lower) && std::isfinite(part.upper) && part.lower <= part.upper;
  if (part.kind == Kind::kLine && !hasRange)
    throw Error({.what = fmt::format("bounds of part {} of a space", i),
                 .found = fmt::format("{:g} and {:g}", part.lower, part.upper),
                 .wanted = "finite bounds, the lower one first"});
}

double turn(double from, double to) {
  const double way = to - from;
  return std::abs(way) <= std::numbers::pi ? way : std::remainder(way, 2 * std::numbers::pi);
}

// Half the angle between two rotations, which is the arc between the quaternions.
double halfTurn(const Quaternion& a, const Quaternion& b) {
  const double minus = (a - b).norm(), plus = (a + b).norm();
  return 2 * std::atan2(std::min(minus, plus), std::max(minus, plus));
}

double squaredDistance(const SpacePart& part, const double* a, const double* b) {
  switch (part.kind) {
    case Kind::kLine:
      return (*a - *b) * (*a - *b);
    case Kind::kCircle:
      return turn(*a, *b) * turn(*a, *b);
    case Kind::kChord:
      return 2 - 2 * std::cos(*a - *b);
    case Kind::kQuaternion: {
      double minus = 0, plus = 0;
      for (int i = 0; i < 4; ++i) {
        minus += (a[i] - b[i]) * (a[i] - b[i]);
        plus += (a[i] + b[i]) * (a[i] + b[i]);
      }
      return std::min(minus, plus);
    }
  }
  return 0;
}

}  // namespace

Space::Space(std::vector<SpacePart> parts) : parts_(std::move(parts)) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    requireSound(parts_[i], i);
    size_ += coordinateCount(parts_[i].kind);
  }
}

Space Space::box(const VectorArg& lower, const VectorArg& upper) {
  requireSize("upper bounds of a space", upper.size(), lower.size());
  std::vector<SpacePart> parts;
  for (Eigen::Index i = 0; i < lower.size(); ++i) parts.push_back({.lower = lower[i], .upper = upper[i]});
  return Space(std::move(parts));
}

Space Space::se2(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, double headingWeight) {
  Space space = box(lower, upper);
  space.parts_.push_back({.kind = Kind::kCircle, .weight = headingWeight});
  return Space(std::move(space.parts_));
}

Space Space::se3(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double rotationWeight) {
  Space space = box(lower, upper);
  space.parts_.push_back({.kind = Kind::kQuaternion, .weight = rotationWeight});
  return Space(std::move(space.parts_));
}

double Space::distance(const VectorArg& a, const VectorArg& b) const {
  requireSize("configuration", a.size(), size_);
  requireSize("configuration", b.size(), size_);
  double sum = 0;
  Eigen::Index i = 0;
  for (const SpacePart& part : parts_) {
    sum += part.weight * part.weight * squaredDistance(part, a.data() + i, b.data() + i);
    i += coordinateCount(part.kind);
  }
  return std::sqrt(sum);
}

double Space::wayLength(const VectorArg& a, const VectorArg& b) const {
  requireSize("configuration", a.size(), size_);
  requireSize("configuration", b.size(), size_);
  double sum = 0;
  Eigen::Index i = 0;
  for (const SpacePart& part : parts_) {
    const double length = part.kind == Kind::kLine         ? b[i] - a[i]
                          : part.kind == Kind::kQuaternion ? halfTurn(a.segment<4>(i), b.segment<4>(i))
                                                           : turn(a[i], b[i]);
    sum += part.weight * part.weight * length * length;
    i += coordinateCount(part.kind);
  }
  return std::sqrt(sum);
}

void Space::interpolate(const VectorArg& a, const VectorArg& b, double t,
                        Eigen::Ref<Eigen::VectorXd> out) const {
  requireSize("configuration", a.size(), size_);
  requireSize("configuration", b.size(), size_);
  requireSize("configuration", out.size(), size_);
  Eigen::Index i = 0;
  for (const SpacePart& part : parts_) {
    if (part.kind == Kind::kQuaternion) {
      const Quaternion from = a.segment<4>(i), to = b.segment<4>(i);
      const double cosine = from.dot(to), sign = cosine < 0 ? -1 : 1;
      const double half = std::acos(std::min(1., std::abs(cosine)));
      // Nearly equal rotations: the sines would cancel, and the straight line is the arc.
      const bool isSmall = half < 1e-6;
      const double x = isSmall ? 1 - t : std::sin((1 - t) * half) / std::sin(half);
      const double y = isSmall ? t : std::sin(t * half) / std::sin(half);
      out.segment<4>(i) = (x * from + sign * y * to).normalized();
    } else if (part.kind == Kind::kLine) {
      out[i] = (1 - t) * a[i] + t * b[i];
    } else {
      out[i] = a[i] + t * turn(a[i], b[i]);
    }
    i += coordinateCount(part.kind);
  }
}

void Space::sample(Rng& rng, Eigen::Ref<Eigen::VectorXd> out) const {
  requireSize("configuration", out.size(), size_);
  Eigen::Index i = 0;
  for (const SpacePart& part : parts_) {
    if (part.kind == Kind::kQuaternion)
      out.segment<4>(i) =
          rng.normalVector(4).normalized();  // uniform, as normals have no preferred direction
    else if (part.kind == Kind::kLine)
      out[i] = rng.uniform(part.lower, part.upper);
    else
      out[i] = rng.uniform(-std::numbers::pi, std::numbers::pi);
    i += coordinateCount(part.kind);
  }
}

Eigen::MatrixXd unrolled(const Space& space, Eigen::MatrixXd path) {
  requireSize("configurations of a path", path.rows(), space.size());
  for (Eigen::Index k = 1; k < path.cols(); ++k) {
    Eigen::Index i = 0;
    for (const SpacePart& part : space.parts()) {
      if (part.kind == Kind::kQuaternion) {
        if (path.col(k - 1).segment<4>(i).dot(path.col(k).segment<4>(i)) < 0) path.col(k).segment<4>(i) *= -1;
      } else if (part.kind != Kind::kLine) {
        path(i, k) = path(i, k - 1) + turn(path(i, k - 1), path(i, k));
      }
      i += coordinateCount(part.kind);
    }
  }
  return path;
}

void Space::require(std::string_view what, const VectorArg& q) const {
  requireSize(what, q.size(), size_);
  requireFinite(what, q);
  const auto refuse = [&](Eigen::Index i, const std::string& wanted) {
    throw Error({.what = fmt::format("{}: number {}", what, i),
                 .found = fmt::format("{:g}", q[i]),
                 .wanted = wanted});
  };
  Eigen::Index i = 0;
  for (const SpacePart& part : parts_) {
    if (part.kind == Kind::kLine && q[i] < part.lower)
      refuse(i, fmt::format("at least {:g}: it is {:g} below", part.lower, part.lower - q[i]));
    if (part.kind == Kind::kLine && q[i] > part.upper)
      refuse(i, fmt::format("at most {:g}: it is {:g} above", part.upper, q[i] - part.upper));
    if (part.kind == Kind::kQuaternion && std::abs(q.segment<4>(i).norm() - 1) > 1e-6)
      refuse(i, fmt::format("a unit quaternion: its length is {:g}", q.segment<4>(i).norm()));
    i += coordinateCount(part.kind);
  }
}

}  // namespace rex
