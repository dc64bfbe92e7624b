#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/rng.h"
#include "bench/arm_plans.h"
#include "bench/nanoflann_peer.h"
#include "bench/ompl_peer.h"
#include "bench/row.h"
#include "planning/dubins.h"
#include "planning/nearest_neighbors.h"
#include "planning/reeds_shepp.h"

namespace rex::bench {
namespace {

constexpr int kPoses = 1000;

std::vector<Eigen::Vector3d> randomPoses() {
  Rng rng(1);
  std::vector<Eigen::Vector3d> poses;
  for (int i = 0; i <= kPoses; ++i)
    poses.emplace_back(rng.uniform(-5, 5), rng.uniform(-5, 5),
                       rng.uniform(-std::numbers::pi, std::numbers::pi));
  return poses;
}

// The mean over ways from each pose to the next.
Measurement perWay(const std::shared_ptr<const std::vector<Eigen::Vector3d>>& poses,
                   const CurvePeer::Length& length) {
  if (!length) return {};
  const Measurement all = timed([=] {
    double sum = 0;
    for (std::size_t i = 0; i < kPoses; ++i) sum += length((*poses)[i], (*poses)[i + 1]);
    if (!(sum > 0)) throw std::logic_error("curves have no length");
  });
  return [all] { return all() / kPoses; };
}

void requireSame(const std::vector<Eigen::Vector3d>& poses, const CurvePeer::Length& a,
                 const CurvePeer::Length& b) {
  if (!b) return;
  for (std::size_t i = 0; i < kPoses; ++i)
    if (std::abs(a(poses[i], poses[i + 1]) - b(poses[i], poses[i + 1])) > 1e-9)
      throw std::logic_error("lengths of curves differ from ours");
}

constexpr Eigen::Index kQuestions = 200;

// Points and questions in a cube, and the tree of the points.
struct Neighbors {
  Eigen::MatrixXd points, questions;
  NearestNeighbors tree;

  Neighbors(int dimension, Eigen::Index count)
      : points(dimension, count),
        questions(dimension, kQuestions),
        tree(Space::box(Eigen::VectorXd::Constant(dimension, -1), Eigen::VectorXd::Ones(dimension))) {
    Rng rng(2);
    for (Eigen::Index k = 0; k < count + kQuestions; ++k) {
      auto q = k < count ? points.col(k) : questions.col(k - count);
      for (double& number : q) number = rng.uniform(-1, 1);
      if (k < count) tree.add(q);
    }
  }
};

Measurement perOne(Eigen::Index count, const std::function<void()>& all) {
  return [measured = timed(all), count] { return measured() / static_cast<double>(count); };
}

// The nearest of points in a cube: the mean over many questions.
Row nearestRow(const std::string& name, int dimension, Eigen::Index count, double target) {
  const auto known = std::make_shared<const Neighbors>(dimension, count);
  const auto ours = [=](Eigen::Index k) { return known->tree.nearest(known->questions.col(k)); };
  const NeighborPeer peer = nanoflannPeer(known->points, known->questions);
  for (Eigen::Index k = 0; k<kQuestions; k += count> 1000 ? 20 : 1) {
    int nearest = 0;
    (known->points.colwise() - known->questions.col(k)).colwise().squaredNorm().minCoeff(&nearest);
    if (ours(k) != nearest) throw std::logic_error("the nearest point is another");
    if (peer.nearest && peer.nearest(k) != nearest)
      throw std::logic_error("nanoflann's nearest point is another");
  }
  const auto perQuestion = [](const std::function<int(Eigen::Index)>& ask) -> Measurement {
    if (!ask) return {};
    return perOne(kQuestions, [=] {
      long sum = 0;
      for (Eigen::Index k = 0; k < kQuestions; ++k) sum += ask(k);
      if (sum == 0) throw std::logic_error("all questions have the same answer");
    });
  };
  return {name, perQuestion(ours), "nanoflann", perQuestion(peer.nearest), target};
}

// A point is added and the nearest of those that are there is asked for, as in a search.
Row growingRow(const std::string& name, int dimension, Eigen::Index count, double target) {
  const auto known = std::make_shared<const Neighbors>(dimension, count);
  const auto grow = [=] {
    NearestNeighbors tree(
        Space::box(Eigen::VectorXd::Constant(dimension, -1), Eigen::VectorXd::Ones(dimension)));
    int sum = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      tree.add(known->points.col(k));
      sum += tree.nearest(known->questions.col(k % kQuestions));
    }
    return sum;
  };
  const NeighborPeer peer = nanoflannPeer(known->points, known->questions);
  if (peer.grow && peer.grow() != grow()) throw std::logic_error("nanoflann's nearest points are others");
  return {name, perOne(count, grow), "nanoflann", peer.grow ? perOne(count, peer.grow) : Measurement{},
          target};
}

// A seed is soon done or takes long: medians need many.
Row connectRow(const std::string& name, const ArmPlan& plan, const ContactScene& scene, double target,
               int seeds) {
  return {name, ourConnect(plan), "OMPL+FCL", omplConnect(scene, plan), target, "ms", seeds, true};
}

}  // namespace

std::vector<Row> planningRows() {
  const auto poses = std::make_shared<const std::vector<Eigen::Vector3d>>(randomPoses());
  const auto dubins = [](const auto& from, const auto& to) { return dubinsLength(from, to, 1); };
  const auto reedsShepp = [](const auto& from, const auto& to) { return reedsSheppLength(from, to, 1); };
  const CurvePeer ompl = omplCurvePeer();
  const ContactScene scene;
  requireSame(*poses, dubins, ompl.dubins);
  requireSame(*poses, reedsShepp, ompl.reedsShepp);
  return {{"dubins", perWay(poses, dubins), "OMPL", perWay(poses, ompl.dubins), 0.3},
          {"reeds-shepp", perWay(poses, reedsShepp), "OMPL", perWay(poses, ompl.reedsShepp), 0.3},
          nearestRow("nearest-7d", 7, 1000, 0.79),
          nearestRow("nearest-3d-100k", 3, 100000, 1),
          nearestRow("nearest-7d-100k", 7, 100000, 1),
          nearestRow("nearest-12d-100k", 12, 100000, 1),
          growingRow("nearest-7d-growing", 7, 1000, 0.6),
          connectRow("rrt-connect-tip", tipInHole(scene), scene, 0.1, 201),
          connectRow("rrt-connect-peg", pegInHole(scene), scene, 0.25, 41)};
}

}  // namespace rex::bench
