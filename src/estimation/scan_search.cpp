#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "estimation/pose_edge_internal.h"
#include "estimation/scan_checks_internal.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

constexpr double kMostMetres = 20;
constexpr double kCell = 0.1;   // metres; the step of the grid in x and y
constexpr double kTurn = 0.05;  // radians
constexpr std::size_t kStarts = 4;

Eigen::Vector2i cellOf(const Eigen::Vector2d& p) { return (p / kCell).array().floor().cast<int>(); }

// How near the reference is to each cell around it: 2 in a cell of it, 1 in those next to it, else 0.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Eigen::Matrix2Xd& points)
      : lower_(cellOf(points.rowwise().minCoeff()).array() - 1),
        cells_(Eigen::ArrayXXi::Zero(cellOf(points.rowwise().maxCoeff())[0] + 2 - lower_[0],
                                     cellOf(points.rowwise().maxCoeff())[1] + 2 - lower_[1])) {
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const Eigen::Vector2i cell = cellOf(points.col(k)) - lower_;
      auto around = cells_.block<3, 3>(cell[0] - 1, cell[1] - 1);
      around = around.max(1);
      cells_(cell[0], cell[1]) = 2;
    }
  }

  // Adds to scores(x, y) the value of the cell + (x - steps, y - steps).
  void addTo(Eigen::ArrayXXi& scores, const Eigen::Vector2i& cell, int steps) const {
    const Eigen::Vector2i corner = cell - lower_ - Eigen::Vector2i::Constant(steps);
    const Eigen::Vector2i size(static_cast<int>(cells_.rows()), static_cast<int>(cells_.cols()));
    const Eigen::Vector2i first = corner.cwiseMax(0),
                          last = (corner + Eigen::Vector2i::Constant(2 * steps + 1)).cwiseMin(size);
    const Eigen::Vector2i count = last - first, at = first - corner;
    if (count[0] > 0 && count[1] > 0)
      scores.block(at[0], at[1], count[0], count[1]) += cells_.block(first[0], first[1], count[0], count[1]);
  }

 private:
  Eigen::Vector2i lower_;
  Eigen::ArrayXXi cells_;
};

struct Trial {
  Eigen::Vector3d motion;
  int score = 0;
};

bool areNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).head<2>().norm() < 4 * kCell && std::abs(wrapAngle(a[2] - b[2])) < 3 * kTurn;
}

// Keeps the best trials that are not near a better one.
void add(std::vector<Trial>& best, const Trial& trial) {
  if (best.size() == kStarts && trial.score <= best.back().score) return;
  for (const Trial& other : best)
    if (other.score >= trial.score && areNear(other.motion, trial.motion)) return;
  std::erase_if(best, [&](const Trial& other) { return areNear(other.motion, trial.motion); });
  const auto isBetter = [](const Trial& a, const Trial& b) { return a.score > b.score; };
  best.insert(std::upper_bound(best.begin(), best.end(), trial, isBetter), trial);
  if (best.size() > kStarts) best.pop_back();
}

std::vector<Trial> bestTrials(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                              const Eigen::Vector3d& guess, const SearchWindow& window) {
  const Neighbourhood neighbourhood(reference);
  const int turns = static_cast<int>(std::ceil(window.heading / kTurn)),
            steps = static_cast<int>(std::ceil(window.position / kCell));
  std::vector<Trial> best;
  Eigen::ArrayXXi scores(2 * steps + 1, 2 * steps + 1);
  for (int turn = -turns; turn <= turns; ++turn) {
    const Eigen::Matrix2d R = internal::planarRotation(guess[2] + turn * kTurn);
    scores.setZero();
    for (Eigen::Index k = 0; k < moving.cols(); ++k)
      neighbourhood.addTo(scores, cellOf(R * moving.col(k) + guess.head<2>()), steps);
    for (int y = -steps; y <= steps; ++y)
      for (int x = -steps; x <= steps; ++x)
        add(best,
            {guess + Eigen::Vector3d(x * kCell, y * kCell, turn * kTurn), scores(x + steps, y + steps)});
  }
  return best;
}

void requireWindow(const SearchWindow& window) {
  if (window.position >= 0 && window.position <= kMostMetres && window.heading >= 0 &&
      window.heading <= std::numbers::pi)
    return;
  throw Error({.what = "window of a search",
               .found = fmt::format("{:g} m, {:g} rad", window.position, window.heading),
               .wanted = fmt::format("0 to {:g} m and 0 to pi", kMostMetres)});
}

}  // namespace

ScanMatch searchAlignment(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                          const Eigen::Vector3d& guess, const SearchWindow& window,
                          const ScanMatchOptions& options) {
  internal::requireScans(reference, moving, guess, options);
  requireWindow(window);
  ScanMatch best = alignScans(reference, moving, guess, options);
  if (reference.cols() < 3 || moving.cols() < 3) return best;
  int iterations = best.iterations;
  for (const Trial& trial : bestTrials(reference, moving, guess, window)) {
    const ScanMatch match = alignScans(reference, moving, trial.motion, options);
    iterations += match.iterations;
    if (match.overlap > best.overlap) best = match;
  }
  best.iterations = iterations;
  return best;
}

}  // namespace rex
