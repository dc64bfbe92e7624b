#include "estimation/fast_slam_unknown_association.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/fast_slam_internal.h"
#include "estimation/gaussian.h"
#include "estimation/pose_edge_internal.h"

namespace rex {
namespace {

constexpr int kFree = -1;

void requireCosts(const Eigen::MatrixXd& cost) {
  if (cost.rows() > cost.cols())
    throw Error({.what = "costs of an assignment",
                 .found = fmt::format("{} rows and {} columns", cost.rows(), cost.cols()),
                 .wanted = "at least as many columns as rows"});
  for (Eigen::Index j = 0; j < cost.cols(); ++j)
    for (Eigen::Index i = 0; i < cost.rows(); ++i)
      if (!std::isfinite(cost(i, j)))
        throw Error({.what = fmt::format("cost of row {} and column {}", i, j),
                     .found = fmt::format("{:g}", cost(i, j)),
                     .wanted = "a finite number"});
}

}  // namespace

std::vector<int> cheapestAssignment(const Eigen::MatrixXd& cost) {
  requireCosts(cost);
  const Eigen::Index columns = cost.cols();
  Eigen::VectorXd ofRow = Eigen::VectorXd::Zero(cost.rows()), ofColumn = Eigen::VectorXd::Zero(columns);
  std::vector<int> rowOf(static_cast<std::size_t>(columns), kFree);
  const auto row = [&](Eigen::Index column) -> int& { return rowOf[static_cast<std::size_t>(column)]; };
  for (int first = 0; first < cost.rows(); ++first) {
    // Dijkstra over reduced costs, which are never negative, from a new row to the nearest free column.
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(columns, std::numeric_limits<double>::infinity());
    std::vector<Eigen::Index> from(static_cast<std::size_t>(columns), kFree);
    std::vector<bool> isDone(static_cast<std::size_t>(columns), false);
    Eigen::Index last = kFree;
    double reached = 0;
    for (int i = first; i != kFree; i = row(last)) {
      Eigen::Index nearest = kFree;
      for (Eigen::Index j = 0; j < columns; ++j) {
        if (isDone[static_cast<std::size_t>(j)]) continue;
        const double through = reached + cost(i, j) - ofRow[i] - ofColumn[j];
        if (through < distance[j]) {
          distance[j] = through;
          from[static_cast<std::size_t>(j)] = last;
        }
        if (nearest == kFree || distance[j] < distance[nearest]) nearest = j;
      }
      last = nearest;
      reached = distance[last];
      isDone[static_cast<std::size_t>(last)] = true;
    }
    ofRow[first] += reached;
    for (Eigen::Index j = 0; j < columns; ++j) {
      if (!isDone[static_cast<std::size_t>(j)] || j == last) continue;
      ofColumn[j] -= reached - distance[j];
      ofRow[row(j)] += reached - distance[j];
    }
    while (last != kFree) {  // each column of the path takes the row of the one before
      const Eigen::Index before = from[static_cast<std::size_t>(last)];
      row(last) = before == kFree ? first : row(before);
      last = before;
    }
  }
  std::vector<int> columnOf(static_cast<std::size_t>(cost.rows()));
  for (Eigen::Index j = 0; j < columns; ++j)
    if (row(j) != kFree) columnOf[static_cast<std::size_t>(row(j))] = static_cast<int>(j);
  return columnOf;
}

namespace {

constexpr int kNew = -1;

}  // namespace

FastSlamUnknownAssociation::FastSlamUnknownAssociation(const Eigen::Vector3d& pose,
                                                       const LandmarkSensor& sensor,
                                                       const UnnamedFastSlamOptions& options)
    : sensor_(sensor), options_(options) {
  internal::requireFastSlam(pose, sensor, options.particles, options.threshold);
  requirePositive("association gate", options.gate);
  newLandmark_ = internal::relativeLogNormal<2>(Eigen::Vector2d::Zero(), sensor.W) - 0.5 * options.gate;
  poses_ = pose.replicate(1, options.particles);
  weights_.setConstant(options.particles, 1.0 / options.particles);
  maps_.resize(static_cast<std::size_t>(options.particles));
}

Eigen::Vector3d FastSlamUnknownAssociation::meanPose() const {
  return internal::meanPoseOf(poses_, weights_);
}

std::vector<LandmarkBelief> FastSlamUnknownAssociation::landmarks(int particle) const {
  internal::requireParticle(particle, weights_.size());
  std::vector<LandmarkBelief> landmarks;
  for (const Landmark& one : maps_[static_cast<std::size_t>(particle)]) landmarks.push_back(one.belief);
  return landmarks;
}

std::vector<MappedLandmark> FastSlamUnknownAssociation::map(double least) const {
  std::map<int, MappedLandmark> byOrigin;
  const auto forAll = [this](const auto& visit) {
    for (std::size_t k = 0; k < maps_.size(); ++k)
      for (const Landmark& one : maps_[k]) visit(one, weights_[static_cast<Eigen::Index>(k)]);
  };
  const MappedLandmark none{{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()}, 0};
  forAll([&](const Landmark& one, double weight) {
    MappedLandmark& sum = byOrigin.try_emplace(one.origin, none).first->second;
    sum.position.mean += weight * one.belief.mean;
    sum.probability += weight;
  });
  for (auto& [origin, sum] : byOrigin) sum.position.mean /= sum.probability;
  forAll([&](const Landmark& one, double weight) {
    MappedLandmark& sum = byOrigin.at(one.origin);
    const Eigen::Vector2d offset = one.belief.mean - sum.position.mean;
    sum.position.covariance +=
        (weight / sum.probability) * (one.belief.covariance + offset * offset.transpose());
  });
  std::vector<MappedLandmark> map;
  for (auto& [origin, sum] : byOrigin)
    if (sum.probability >= least) map.push_back(std::move(sum));
  return map;
}

// For each observation the number of its landmark, or kNew: the likeliest of all that give different
// observations different landmarks.
std::vector<int> FastSlamUnknownAssociation::associate(const Map& map, const Eigen::Vector3d& pose,
                                                       const Eigen::Matrix3d& P,
                                                       std::span<const Eigen::Vector2d> ys) const {
  const auto count = static_cast<Eigen::Index>(ys.size()), known = static_cast<Eigen::Index>(map.size());
  // The last columns are new landmarks.
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(count, known + count, -newLandmark_);
  for (Eigen::Index i = 0; i < known; ++i) {
    const LandmarkBelief& belief = map[static_cast<std::size_t>(i)].belief;
    const LandmarkView view = landmarkView(sensor_, pose, belief.mean);
    const Eigen::Matrix2d S = internal::sightingCovariance(sensor_, view, P, belief);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Vector2d error = innovation(sensor_, ys[static_cast<std::size_t>(k)], view.y);
      const double likelihood = internal::relativeLogNormal<2>(error, S);
      // Beyond the gate it is never chosen: a new landmark is cheaper.
      cost(k, i) = likelihood > newLandmark_ ? -likelihood : 1 - newLandmark_;
    }
  }
  std::vector<int> partners = cheapestAssignment(cost);
  for (int& partner : partners)
    if (partner >= known) partner = kNew;
  return partners;
}

void FastSlamUnknownAssociation::move(Eigen::Index particle, const PoseTransition& transition,
                                      const Eigen::Matrix3d& root, std::span<const Eigen::Vector2d> ys,
                                      double& logWeight, Rng& rng) {
  Map& map = maps_[static_cast<std::size_t>(particle)];
  const Eigen::Vector3d predicted = transition.mean(poses_.col(particle));
  requireFinite("next pose", predicted);
  const internal::PoseNoise noise{transition.noise, root};
  std::vector<int> partners;
  std::vector<internal::LandmarkSeen> seen;
  if (options_.observedProposal) {
    partners = associate(map, predicted, transition.noise, ys);
    for (std::size_t k = 0; k < ys.size(); ++k)
      if (partners[k] != kNew) seen.push_back({&map[static_cast<std::size_t>(partners[k])].belief, ys[k]});
  }
  const auto [pose, drawn] = internal::drawPose(sensor_, predicted, noise, seen, rng);
  poses_.col(particle) = pose;
  logWeight += drawn;
  if (!options_.observedProposal) partners = associate(map, pose, Eigen::Matrix3d::Zero(), ys);
  const std::size_t known = map.size();
  for (std::size_t k = 0; k < ys.size(); ++k) {
    if (partners[k] == kNew) {
      map.push_back({internal::firstBelief(sensor_, pose, ys[k]), observations_ + static_cast<int>(k)});
      logWeight += newLandmark_;
    } else {
      Landmark& one = map[static_cast<std::size_t>(partners[k])];
      logWeight += internal::updateBelief(sensor_, pose, ys[k], one.belief);
      ++one.evidence;
    }
  }
  if (!options_.isInView) return;
  for (std::size_t i = 0; i < known; ++i)
    if (std::ranges::find(partners, static_cast<int>(i)) == partners.end())
      map[i].evidence -= options_.isInView(pose, map[i].belief.mean);
  std::erase_if(map, [](const Landmark& one) { return one.evidence < 0; });
}

FastSlamStep FastSlamUnknownAssociation::step(const PoseTransition& transition,
                                              std::span<const Eigen::Vector2d> ys, Rng& rng) {
  internal::requireTransition(
      transition, options_.observedProposal ? Definiteness::kPositive : Definiteness::kSemidefinite);
  for (const Eigen::Vector2d& y : ys) requireFinite("observation", y);
  FastSlamUnknownAssociation moved(*this);  // an exception changes nothing
  const Eigen::Matrix3d root = covarianceRoot(transition.noise);
  Eigen::VectorXd logWeights = weights_.array().log();
  for (Eigen::Index k = 0; k < weights_.size(); ++k) moved.move(k, transition, root, ys, logWeights[k], rng);
  moved.observations_ += static_cast<int>(ys.size());
  moved.weights_ = (logWeights.array() - logWeights.maxCoeff()).exp();
  moved.weights_ /= moved.weights_.sum();
  *this = std::move(moved);
  FastSlamStep report{.effectiveSize = effectiveSampleSize(weights_)};
  report.resampled = report.effectiveSize < options_.threshold * static_cast<double>(weights_.size());
  if (!report.resampled) return report;
  const std::vector<int> parents =
      resampled(weights_, static_cast<int>(weights_.size()), Resampling::kSystematic, rng);
  std::vector<Map> maps;
  for (const int parent : parents) maps.push_back(maps_[static_cast<std::size_t>(parent)]);
  maps_ = std::move(maps);
  poses_ = poses_(Eigen::all, parents).eval();
  weights_.setConstant(1.0 / static_cast<double>(weights_.size()));
  return report;
}

}  // namespace rex
