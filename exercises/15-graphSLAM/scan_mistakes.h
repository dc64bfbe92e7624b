#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "graph_mistakes.h"
#include "map_pictures.h"
#include "scan_checks.h"

// What the checks of scans ask about if a usual mistake explains a wrong value.

inline std::vector<int> nearestOnes(const Points& targets, const Points& moved, double most) {
  std::vector<int> numbers;
  for (const Eigen::Vector2d& p : moved) {
    double least = most;
    int nearest = -1;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double distance = (targets[i] - p).norm();
      if (distance > least) continue;
      least = distance;
      nearest = static_cast<int>(i);
    }
    numbers.push_back(nearest);
  }
  return numbers;
}

inline Points pointsFrom(const Eigen::Vector3d& motion, const Points& points) {
  Points moved;
  for (const Eigen::Vector2d& p : points) moved.push_back(pointFrom(motion, p));
  return moved;
}

/// What could have led to wrong partners, if anything: to be asked if some are wrong.
inline std::string questionAboutPartners(const ScanPair& pair, const std::vector<int>& got, double most) {
  const auto isGot = [&](const Eigen::Vector3d& motion, double reach) {
    return nearestOnes(pair.reference, pointsFrom(motion, pair.moving), reach) == got;
  };
  const Eigen::Vector3d& motion = pair.guess;
  if (isGot(motion, 1e9)) return "Is maxDistance left out?";
  if (isGot(motion, std::sqrt(most))) return "Is the squared distance compared with maxDistance itself?";
  if (isGot({0, 0, 0}, most)) return "Are the points not moved?";
  if (isGot(relative(motion, {0, 0, 0}), most))
    return "Are the points moved the other way, from the reference to the moving scan?";
  if (isGot({motion[0], motion[1], 0}, most)) return "Are the points not rotated?";
  if (isGot({motion[0], motion[1], -motion[2]}, most)) return "Are the points rotated the wrong way?";
  if (isGot({0, 0, motion[2]}, most)) return "Are the points rotated, but not shifted?";
  return "";
}

inline double squaresOf(const Points& from, const Points& to, const Eigen::Vector3d& motion) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) sum += (pointFrom(motion, from[i]) - to[i]).squaredNorm();
  return sum;
}

inline Eigen::Vector2d meanOf(const Points& points) {
  Eigen::Vector2d sum(0, 0);
  for (const Eigen::Vector2d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The motion with this heading that takes mean to mean, or turns by another heading before it does.
inline Eigen::Vector3d betweenMeans(const Points& from, const Points& to, double heading, double turned) {
  const Eigen::Vector2d shift = meanOf(to) - pointFrom({0, 0, turned}, meanOf(from));
  return {shift.x(), shift.y(), heading};
}

/// With the means on each other, the sum of squares is a cosine of the heading: three values tell where it is
/// least.
inline Eigen::Vector3d bestOf(const Points& from, const Points& to) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const auto at = [&](double heading) {
    return squaresOf(from, to, betweenMeans(from, to, heading, heading));
  };
  const double zero = at(0), quarter = at(kQuarter), half = at(2 * kQuarter), middle = (zero + half) / 2;
  const double best = std::atan2(middle - quarter, middle - zero);
  return betweenMeans(from, to, best, best);
}

inline void checkMotion(rex::grading::Check& check, const Points& from, const Points& to,
                        const Eigen::Vector3d& got, const Eigen::Vector3d& wanted) {
  const auto near = [&](Eigen::Vector3d motion) {
    motion[2] = wanted[2] + byTurns(motion[2] - wanted[2]);
    return motion;
  };
  const double heading = wanted[2];
  check.near(
      "motion of bestMotion", near(got), wanted, 1e-5,
      {{"Is it the motion from `to` to `from`?", near(relative(wanted, {0, 0, 0}))},
       {"Is the mean of `from` rotated the wrong way?", near(betweenMeans(from, to, heading, -heading))},
       {"Are the points only shifted?", near(betweenMeans(from, to, 0, 0))}},
      "m, rad");
}

/// How well scans fit by a motion: root mean square distance from partners within `reach`, and their share.
struct Fit {
  double residual = 0, overlap = 0;
};

inline Fit fitOf(const ScanPair& pair, const Eigen::Vector3d& motion, double reach) {
  double count = 0, squares = 0;
  for (const Eigen::Vector2d& p : pair.moving) {
    const Eigen::Vector2d at = pointFrom(motion, p);
    double nearest = 1e9;
    for (const Eigen::Vector2d& q : pair.reference) nearest = std::min(nearest, (q - at).norm());
    if (nearest > reach) continue;
    squares += nearest * nearest;
    ++count;
  }
  return {std::sqrt(squares / std::max(count, 1.)), count / static_cast<double>(pair.moving.size())};
}

/// One more round from a motion: partners within 0.3 m and the best motion for them.
inline Eigen::Vector3d oneMoreRound(const ScanPair& pair, const Eigen::Vector3d& motion) {
  Points from, to;
  const std::vector<int> numbers = nearestOnes(pair.reference, pointsFrom(motion, pair.moving), 0.3);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const int partner = numbers[k];
    if (partner < 0) continue;
    from.push_back(pair.moving[k]);
    to.push_back(pair.reference[static_cast<std::size_t>(partner)]);
  }
  return from.size() < 3 ? motion : bestOf(from, to);
}

/// What could have led to a motion that is too far off, if anything.
inline std::string questionAboutMotion(const ScanPair& pair, const Eigen::Vector3d& got) {
  if ((got - pair.guess).norm() < 1e-9) return "Is it the guess?";
  const Eigen::Vector3d more = relative(got, oneMoreRound(pair, got));
  if (more.norm() > 0.01)
    return "Are partners looked for until nothing changes? One more round would change the motion.";
  return "";
}
