#include "estimation/grid_slam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/fast_slam_internal.h"
#include "estimation/gaussian.h"
#include "estimation/pose_edge_internal.h"
#include "estimation/range_scan_internal.h"
#include "estimation/resampling.h"
#include "estimation/scan_matching.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

constexpr double kAnywhere = 0.05;  // share of rays that end anywhere
constexpr double kWiden = 1.5;      // of the proposal, whose target is only roughly Gaussian

void requireGridSlam(const GridSlamOptions& options) {
  requireCount("particles", options.particles, 1);
  requireCount("draws around a match", options.draws, 1);
  requirePositive("deviation of the end points of rays", options.deviation, kMetres);
  internal::requireThreshold(options.threshold);
  if (!(options.temper >= 1) || !std::isfinite(options.temper))
    throw Error(
        {.what = "temper of the rays", .found = fmt::format("{:g}", options.temper), .wanted = "1 or more"});
}

// The points, and others on straight lines between neighbours: rays far away meet a wall only here and there.
std::vector<Eigen::Vector2d> filledGaps(const Eigen::Matrix2Xd& points, double step) {
  constexpr double kMaxGap = 0.6;  // metres; more is not one wall
  std::vector<Eigen::Vector2d> filled;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    if (k > 0) {
      const Eigen::Vector2d from = points.col(k - 1), way = points.col(k) - from;
      const int parts = way.norm() > kMaxGap ? 1 : static_cast<int>(std::ceil(way.norm() / step));
      for (int i = 1; i < parts; ++i) filled.emplace_back(from + way * i / parts);
    }
    filled.emplace_back(points.col(k));
  }
  return filled;
}

}  // namespace

// The logarithm of how likely a pose is, up to a constant: by the scan and the map, and by the motion. End
// points near those of earlier rays are likely; those where nothing is known can be anywhere, those in free
// space are unlikely.
struct GridSlam::Target {
  Target(const GridSlamOptions& options, double maxRange, const Eigen::Matrix2Xd& ends,
         const Eigen::Matrix3d& noise)
      : points(ends),
        motion(noise),
        height((1 - kAnywhere) / (options.deviation * std::sqrt(2 * std::numbers::pi))),
        floor(kAnywhere / maxRange),
        unknown(std::log(1 / maxRange)),
        sharpness(-0.5 / (options.deviation * options.deviation)) {}

  double ofPoint(const Eigen::Vector2d& p) const {
    const OccupancyMap& map = particle->map;
    const Eigen::Vector2d local = p - map.origin();
    const Eigen::Vector2i cell = (local / map.cellSize()).array().floor().cast<int>();
    if (!map.contains(cell[0], cell[1])) return unknown;
    const Hits* nearest = nullptr;
    double squared = std::numeric_limits<double>::infinity();
    for (int y = std::max(cell[1] - 1, 0); y <= std::min(cell[1] + 1, map.height() - 1); ++y)
      for (int x = std::max(cell[0] - 1, 0); x <= std::min(cell[0] + 1, map.width() - 1); ++x) {
        const Hits& hits = particle->hits[static_cast<std::size_t>(y * map.width() + x)];
        if (map.logOdds(x, y) < 0 || hits.count == 0) continue;
        const double here = (local - hits.sum.cast<double>() / hits.count).squaredNorm();
        if (here >= squared) continue;
        squared = here;
        nearest = &hits;
      }
    if (nearest == nullptr) return map.logOdds(cell[0], cell[1]) == 0 ? unknown : std::log(floor);
    if (nearest->normal.x() != 0 || nearest->normal.y() != 0) {  // along a wall, rays end anywhere
      const double away =
          nearest->normal.cast<double>().dot(local - nearest->sum.cast<double>() / nearest->count);
      squared = away * away;
    }
    return std::log(height * std::exp(sharpness * squared) + floor);
  }

  double logLikelihood(const Eigen::Vector3d& x) const {
    const Eigen::Matrix2d R = internal::planarRotation(x[2]);
    double sum = 0;
    for (const auto& point : points.colwise()) sum += ofPoint(R * point + x.head<2>());
    return sum;
  }

  double operator()(const Eigen::Vector3d& x) const {
    Eigen::Vector3d error = x - predicted;
    error[2] = wrapAngle(error[2]);
    return logLikelihood(x) - 0.5 * motion.matrixL().solve(error).squaredNorm();
  }

  const Eigen::Matrix2Xd& points;  // in the frame of the scanner
  Eigen::LLT<Eigen::Matrix3d> motion;
  double height, floor, unknown, sharpness;
  const Particle* particle = nullptr;
  Eigen::Vector3d predicted = Eigen::Vector3d::Zero();
};

namespace {

// The nearest maximum, by steps along one coordinate after the other, from `step` on down.
template <class Target>
Eigen::Vector3d climbed(const Target& target, const Eigen::Vector3d& start, Eigen::Vector3d step) {
  constexpr int kHalvings = 5, kMost = 60;
  Eigen::Vector3d best = start;
  double value = target(best);
  for (int halvings = 0, rounds = 0; halvings < kHalvings && rounds < kMost; ++rounds) {
    bool isBetter = false;
    for (int k = 0; k < 3; ++k)
      for (const double way : {step[k], -step[k]}) {
        Eigen::Vector3d x = best;
        x[k] += way;
        const double there = target(x);
        if (there <= value) continue;
        best = x;
        value = there;
        isBetter = true;
        break;
      }
    if (isBetter) continue;
    step /= 2;
    ++halvings;
  }
  return best;
}

// A root of the information of a Gaussian like the target around its maximum: second differences of the
// likelihood over `step`, wide enough to see walls and not cells, and the information of the motion.
template <class Target>
Eigen::Matrix3d informationRoot(const Target& target, const Eigen::Vector3d& top,
                                const Eigen::Vector3d& step) {
  const auto at = [&](int i, double a, int j, double b) {
    Eigen::Vector3d x = top;
    x[i] += a * step[i];
    x[j] += b * step[j];
    return target.logLikelihood(x);
  };
  const double middle = target.logLikelihood(top);
  Eigen::Matrix3d H;
  for (int i = 0; i < 3; ++i) {
    H(i, i) = 2 * middle - at(i, 1, i, 0) - at(i, -1, i, 0);
    for (int j = 0; j < i; ++j)
      H(i, j) = H(j, i) = 0.25 * (at(i, 1, j, -1) + at(i, -1, j, 1) - at(i, 1, j, 1) - at(i, -1, j, -1));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(H);
  const Eigen::Matrix3d V = step.cwiseInverse().asDiagonal() * axes.eigenvectors();
  const Eigen::Matrix3d motion = target.motion.solve(Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d information =
      V * axes.eigenvalues().cwiseMax(0).asDiagonal() * V.transpose() + motion;
  return Eigen::LLT<Eigen::Matrix3d>(information).matrixL();
}

// Draws around the maximum, and keeps one by its importance: the target over the density of the draws.
template <class Target>
internal::PoseDraw drawnAroundMatch(const Target& target, const Eigen::Vector3d& step, int count, Rng& rng) {
  const Eigen::Vector3d top = climbed(target, target.predicted, step);
  const Eigen::Matrix3d root = informationRoot(target, top, step / 2);
  const double logScale = root.diagonal().array().log().sum() - 3 * std::log(kWiden);
  Eigen::Matrix3Xd poses(3, count);
  Eigen::VectorXd logWeights(count);
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d normal = rng.normalVector(3);
    poses.col(k) = top + kWiden * root.transpose().triangularView<Eigen::Upper>().solve(normal);
    logWeights[k] = target(poses.col(k)) + 0.5 * normal.squaredNorm() - logScale;
  }
  const double largest = logWeights.maxCoeff();
  const Eigen::VectorXd weights = (logWeights.array() - largest).exp();
  const int kept = resampled(weights, 1, Resampling::kMultinomial, rng).front();
  return {poses.col(kept), largest + std::log(weights.mean())};
}

}  // namespace

GridSlam::GridSlam(const Eigen::Vector3d& pose, const OccupancyMap& empty, const RangeScanner& scanner,
                   const VectorArg& ranges, const GridSlamOptions& options)
    : scanner_(scanner), options_(options) {
  requireGridSlam(options);
  Particle first{empty, {}, {}};
  first.hits.resize(static_cast<std::size_t>(empty.width()) * static_cast<std::size_t>(empty.height()));
  add(first, pose, ranges);
  particles_.assign(static_cast<std::size_t>(options.particles), first);
  weights_.setConstant(options.particles, 1.0 / options.particles);
}

void GridSlam::add(Particle& particle, const Eigen::Vector3d& pose, const VectorArg& ranges) const {
  OccupancyMap& map = particle.map;
  map.observe(scanner_, pose, ranges, options_.evidence);
  const Eigen::Matrix2d R = internal::planarRotation(pose[2]);
  const std::vector<Eigen::Vector2d> points = filledGaps(scanPoints(scanner_, ranges), map.cellSize());
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d local = R * point + pose.head<2>() - map.origin();
    const Eigen::Vector2i cell = map.cellAt(local + map.origin());
    if (!map.contains(cell[0], cell[1])) continue;
    Hits& hits = particle.hits[static_cast<std::size_t>(cell[1] * map.width() + cell[0])];
    hits.sum += local.cast<float>();
    hits.count += 1;
  }
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2i cell = map.cellAt(R * point + pose.head<2>());
    for (int y = cell[1] - 1; y <= cell[1] + 1; ++y)
      for (int x = cell[0] - 1; x <= cell[0] + 1; ++x) fitWall(particle, {x, y});
  }
  particle.path.push_back(pose);
}

// The line through the end points in the cells around, if they lie on one.
void GridSlam::fitWall(Particle& particle, const Eigen::Vector2i& cell) const {
  constexpr int kReach = 2;
  const OccupancyMap& map = particle.map;
  const auto at = [&](int x, int y) -> Hits& {
    return particle.hits[static_cast<std::size_t>(y * map.width() + x)];
  };
  if (!map.contains(cell[0], cell[1]) || at(cell[0], cell[1]).count == 0) return;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  Eigen::Matrix2f squares = Eigen::Matrix2f::Zero();
  float count = 0;
  const Eigen::Vector2f middle = at(cell[0], cell[1]).sum / at(cell[0], cell[1]).count;
  for (int y = std::max(cell[1] - kReach, 0); y <= std::min(cell[1] + kReach, map.height() - 1); ++y)
    for (int x = std::max(cell[0] - kReach, 0); x <= std::min(cell[0] + kReach, map.width() - 1); ++x) {
      if (map.logOdds(x, y) < 0 || at(x, y).count == 0) continue;
      const Eigen::Vector2f offset = at(x, y).sum / at(x, y).count - middle;
      sum += offset;
      squares += offset * offset.transpose();
      count += 1;
    }
  Eigen::Vector2f& normal = at(cell[0], cell[1]).normal;
  normal.setZero();
  if (count < 3) return;
  const Eigen::Matrix2f A = (squares - sum * sum.transpose() / count) / count;
  const float half = std::hypot(0.5f * (A(0, 0) - A(1, 1)), A(0, 1)), across = 0.5f * A.trace() - half;
  // Straight: thinner than a third of its length, and than what noise explains.
  if (9 * across > across + 2 * half || across > std::pow(static_cast<float>(options_.deviation), 2)) return;
  const float angle = 0.5f * std::atan2(2 * A(0, 1), A(0, 0) - A(1, 1));
  normal << -std::sin(angle), std::cos(angle);
}

GridSlamStep GridSlam::step(const PoseTransition& transition, const VectorArg& ranges, Rng& rng) {
  internal::requireTransition(transition,
                              options_.matchScans ? Definiteness::kPositive : Definiteness::kSemidefinite);
  const Eigen::Matrix2Xd points = scanPoints(scanner_, ranges);
  const internal::PoseNoise noise{transition.noise, covarianceRoot(transition.noise)};
  Target target(options_, scanner_.maxRange, points, transition.noise);
  const double radius =
      points.cols() == 0 ? scanner_.maxRange : std::sqrt(points.colwise().squaredNorm().mean());
  const double cell = particles_.front().map.cellSize();
  const Eigen::Vector3d step(cell, cell, cell / radius);
  std::vector<internal::PoseDraw> draws;
  for (const Particle& particle : particles_) {
    target.particle = &particle;
    target.predicted = transition.mean(particle.path.back());
    requireFinite("next pose", target.predicted);
    if (options_.matchScans) {
      draws.push_back(drawnAroundMatch(target, step, options_.draws, rng));
    } else {
      draws.push_back({target.predicted + noise.root * rng.normalVector(3), 0});
      draws.back().logWeight = target.logLikelihood(draws.back().pose);
    }
  }
  Eigen::VectorXd logWeights = weights_.array().log();
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    draws[k].logWeight /= options_.temper;
    add(particles_[k], draws[k].pose, ranges);
    particles_[k].logWeight += draws[k].logWeight;
    logWeights[static_cast<Eigen::Index>(k)] += draws[k].logWeight;
  }
  weights_ = (logWeights.array() - logWeights.maxCoeff()).exp();
  weights_ /= weights_.sum();
  GridSlamStep report{.effectiveSize = effectiveSampleSize(weights_)};
  report.resampled = report.effectiveSize < options_.threshold * static_cast<double>(weights_.size());
  if (report.resampled) resample(rng);
  return report;
}

void GridSlam::resample(Rng& rng) {
  const std::vector<int> parents =
      resampled(weights_, static_cast<int>(weights_.size()), Resampling::kSystematic, rng);
  std::vector<Particle> children;
  for (std::size_t k = 0; k < parents.size(); ++k) {  // maps are large: the last child takes its parent's
    Particle& parent = particles_[static_cast<std::size_t>(parents[k])];
    const bool isLast = k + 1 == parents.size() || parents[k + 1] != parents[k];
    children.push_back(isLast ? std::move(parent) : parent);
  }
  particles_ = std::move(children);
  weights_.setConstant(1.0 / static_cast<double>(weights_.size()));
}

Eigen::Matrix3Xd GridSlam::poses() const {
  Eigen::Matrix3Xd poses(3, weights_.size());
  for (std::size_t k = 0; k < particles_.size(); ++k)
    poses.col(static_cast<Eigen::Index>(k)) = particles_[k].path.back();
  return poses;
}

int GridSlam::likeliest() const {
  const auto best = std::ranges::max_element(particles_, {}, &Particle::logWeight);
  return static_cast<int>(best - particles_.begin());
}

const OccupancyMap& GridSlam::map(int particle) const {
  internal::requireParticle(particle, weights_.size());
  return particles_[static_cast<std::size_t>(particle)].map;
}

Eigen::Matrix3Xd GridSlam::path(int particle) const {
  internal::requireParticle(particle, weights_.size());
  const std::vector<Eigen::Vector3d>& poses = particles_[static_cast<std::size_t>(particle)].path;
  Eigen::Matrix3Xd path(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) path.col(static_cast<Eigen::Index>(i)) = poses[i];
  return path;
}

}  // namespace rex
