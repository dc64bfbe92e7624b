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

// How near the reference is to each cell around it: 2 in a cell of it, 1 in those beside, else 0.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Eigen::Matrix2Xd& points)
      : lower_(cellOf(points.rowwise().minCoeff()).array() - 1),
        width_(cellOf(points.rowwise().maxCoeff())[0] + 2 - lower_[0]),
        height_(cellOf(points.rowwise().maxCoeff())[1] + 2 - lower_[1]),
        cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0) {
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const Eigen::Vector2i cell = cellOf(points.col(k));
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          int& value = cells_[place(cell + Eigen::Vector2i(dx, dy) - lower_)];
          value = std::max(value, dx == 0 && dy == 0 ? 2 : 1);
        }
    }
  }

  static Eigen::Vector2i cellOf(const Eigen::Vector2d& p) { return (p / kCell).array().floor().cast<int>(); }

  int at(const Eigen::Vector2i& cell) const {
    const Eigen::Vector2i inside = cell - lower_;
    const bool isKnown = inside[0] >= 0 && inside[1] >= 0 && inside[0] < width_ && inside[1] < height_;
    return isKnown ? cells_[place(inside)] : 0;
  }

 private:
  std::size_t place(const Eigen::Vector2i& inside) const {
    return static_cast<std::size_t>(inside[1]) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(inside[0]);
  }

  Eigen::Vector2i lower_;
  int width_, height_;
  std::vector<int> cells_;
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
  std::vector<Eigen::Vector2i> cells(static_cast<std::size_t>(moving.cols()));
  for (int turn = -turns; turn <= turns; ++turn) {
    const double heading = guess[2] + turn * kTurn;
    const Eigen::Matrix2d R = internal::planarRotation(heading);
    for (std::size_t k = 0; k < cells.size(); ++k)
      cells[k] = Neighbourhood::cellOf(R * moving.col(static_cast<Eigen::Index>(k)) + guess.head<2>());
    for (int y = -steps; y <= steps; ++y)
      for (int x = -steps; x <= steps; ++x) {
        int score = 0;
        for (const Eigen::Vector2i& cell : cells) score += neighbourhood.at(cell + Eigen::Vector2i(x, y));
        add(best, {guess + Eigen::Vector3d(x * kCell, y * kCell, turn * kTurn), score});
      }
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
