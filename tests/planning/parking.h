#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "collision/contacts.h"
#include "formats/ors_reader.h"
#include "planning/robot_problem.h"
#include "systems/car.h"

namespace rex::parking {

/// A rectangle on the ground: its middle and heading, length and width.
struct Block {
  Eigen::Vector3d middle;
  double length, width;
};

inline constexpr Car kCar{.wheelbase = 2.6, .maxSteering = .6};
inline constexpr double kBehind = .8, kAhead = 3.4, kWidth = 1.8;  // of the rear axle, metres

/// A car among blocks, whose shapes are measured by the collision module.
struct Lot {
  std::vector<Block> blocks;
  Model model;
  ContactModel contacts;
  PathProblem problem;
};

inline Lot lotOf(const std::vector<Block>& blocks, const Eigen::Vector2d& lower, const Eigen::Vector2d& upper,
                 const Eigen::Vector3d& start, const Eigen::Vector3d& goal, double margin) {
  std::string scene = fmt::format(
      "body road {{ fixed }} body car {{ }} joint (road car) {{ type=transXYPhi limits=[{} {} {} {} -50 50] "
      "}}\n"
      "shape (car) {{ rel=<T t({} 0 .5)> type=ST_box size=[{} {} 1] contact }}\n",
      lower.x(), upper.x(), lower.y(), upper.y(), (kAhead - kBehind) / 2, kAhead + kBehind, kWidth);
  for (const Block& block : blocks)
    scene += fmt::format(
        "shape (world) {{ rel=<T t({} {} .5) r({} 0 0 1)> type=ST_box size=[{} {} 1] contact }}\n",
        block.middle[0], block.middle[1], block.middle[2], block.length, block.width);
  Model model = compile(parseOrs(scene, "lot.ors").spec);
  const ContactModel contacts(model);
  PathProblem problem = robotProblem(model, contacts, start, goal, margin, .05);
  problem.space = Space::se2(lower, upper);
  return {blocks, std::move(model), contacts, std::move(problem)};
}

/// A street with a kerb along y = 0 and another along y = 8, and two cars that leave a gap around x = 0.
inline Lot street(double gap, double margin = .05) {
  return lotOf({{{gap / 2 + 2.1, 1.1, 0}, 4.2, 1.8},
                {{-gap / 2 - 2.1, 1.1, 0}, 4.2, 1.8},
                {{0, -.15, 0}, 30, .3},
                {{0, 8.15, 0}, 30, .3}},
               {-12, 0}, {12, 8}, {-8, 4.5, 0}, {-1.3, 1.1, 0}, margin);
}

/// The second opinion: how far two rectangles are apart along the best of their four directions, negative in
/// overlap. It is at most their distance.
inline double separation(const Block& a, const Block& b) {
  double best = -std::numeric_limits<double>::infinity();
  for (const double angle : {a.middle[2], a.middle[2] + M_PI / 2, b.middle[2], b.middle[2] + M_PI / 2}) {
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    const auto half = [&](const Block& block) {
      const Eigen::Vector2d ahead(std::cos(block.middle[2]), std::sin(block.middle[2])),
          left(-ahead.y(), ahead.x());
      return block.length / 2 * std::abs(n.dot(ahead)) + block.width / 2 * std::abs(n.dot(left));
    };
    best = std::max(best, std::abs(n.dot((a.middle - b.middle).head<2>())) - half(a) - half(b));
  }
  return best;
}

/// Of the car at q from everything in the lot.
inline double separation(const Lot& lot, const Eigen::Vector3d& q) {
  constexpr double kMiddle = (kAhead - kBehind) / 2;
  const Block body{
      {q[0] + kMiddle * std::cos(q[2]), q[1] + kMiddle * std::sin(q[2]), q[2]}, kAhead + kBehind, kWidth};
  double least = std::numeric_limits<double>::infinity();
  for (const Block& block : lot.blocks) least = std::min(least, separation(body, block));
  return least;
}

}  // namespace rex::parking
