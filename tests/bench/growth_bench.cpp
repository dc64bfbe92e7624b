// How times grow with the size n of a problem: the exponent p of the power n^p that fits them best.
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.h"
#include "bench/robots.h"
#include "bench/row.h"
#include "estimation/ekf_slam.h"
#include "estimation/particle_filter.h"
#include "estimation/pose_graph.h"
#include "estimation/street_graph.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "planning/nearest_neighbors.h"

namespace rex::bench {
namespace {

using Sizes = std::vector<int>;

// The slope of the line that fits the logarithms of n and of the smallest of three times.
Measurement exponent(const Sizes& sizes, const std::function<Measurement(int n)>& at) {
  return [=] {
    Eigen::VectorXd x(sizes.size()), y(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const Measurement measure = at(sizes[i]);
      double smallest = measure();
      for (int repetition = 1; repetition < 3; ++repetition) smallest = std::min(smallest, measure());
      x[static_cast<Eigen::Index>(i)] = std::log(sizes[i]);
      y[static_cast<Eigen::Index>(i)] = std::log(smallest);
    }
    x.array() -= x.mean();
    return x.dot(y) / x.squaredNorm();
  };
}

Measurement links(int n) {
  Rng rng(1);
  SceneSpec spec = randomChain(n, rng);
  const auto model = std::make_shared<const Model>(compile(spec));
  return timed([model, q = Eigen::VectorXd(rng.uniformVector(model->nq(), -2, 2)),
                poses = BodyPoses()]() mutable { forwardKinematics(*model, q, poses); });
}

// Boxes that lie side by side.
Measurement shapes(int n) {
  SceneSpec spec;
  addGround(spec);
  for (int i = 0; i < n; ++i)
    addLoose(spec, "box" + std::to_string(i), 1, boxShape(.2, .2, .2),
             {.p = {.5 * (i % 10), .5 * (i / 10), .1}});
  const auto world = std::make_shared<PhysicsWorld>(compile(spec));
  for (int i = 0; i < 50; ++i) world->step(1e-3);
  return timed([world] { world->step(1e-3); });
}

Measurement poses(int n) {
  Rng rng(1);
  return timed([graph = test::streets(n, 0.05, rng)] {
    PlanarPoseGraph moved = graph;
    static_cast<void>(optimize(moved));
  });
}

Measurement landmarks(int n) {
  Rng rng(2);
  const auto slam = std::make_shared<EkfSlam>(
      Gaussian{Eigen::Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity()}, LandmarkSensor{});
  for (int i = 0; i < n; ++i) slam->observe(i, 20 * Eigen::Vector2d(rng.normalVector(2)));
  return timed([slam, n, i = 0]() mutable {
    i = (i + 1) % n;
    slam->observe(i, slam->landmark(i).mean);
  });
}

Measurement particles(int n) {
  const auto rng = std::make_shared<Rng>(3);
  const Gaussian start{Eigen::Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity()};
  const auto filter = std::make_shared<ParticleFilter>(
      sampledParticles(start, n, *rng), ParticleFilterOptions{.resampling = Resampling::kSystematic});
  const Propose propose = motionProposal(
      {.g = [](const Eigen::VectorXd& x) { return x; }, .W = 1e-3 * Eigen::Matrix3d::Identity()});
  const Weigh weigh =
      observationWeights({.g = [](const Eigen::VectorXd& x) { return x; }, .W = Eigen::Matrix3d::Identity()},
                         Eigen::Vector3d::Zero());
  return timed([=] { static_cast<void>(filter->step(propose, weigh, *rng)); });
}

Measurement points(int n) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(7);
  const Space space = Space::box(-ones, ones);
  const auto tree = std::make_shared<NearestNeighbors>(space);
  const auto rng = std::make_shared<Rng>(4);
  Eigen::VectorXd q(7);
  for (int i = 0; i < n; ++i) {
    space.sample(*rng, q);
    tree->add(q);
  }
  return timed([=]() mutable {
    space.sample(*rng, q);
    static_cast<void>(tree->nearest(q));
  });
}

Row row(const std::string& name, const Sizes& sizes, const std::function<Measurement(int)>& at,
        double expected) {
  return {.name = "growth-" + name,
          .ours = exponent(sizes, at),
          .peerName = "limit",
          .peer = [=] { return expected; },
          .target = 1,
          .unit = "",
          .repetitions = 1};
}

}  // namespace

std::vector<Row> growthRows() {
  return {row("fk-links", {10, 30, 100, 300}, links, 1.1),
          row("physics-boxes", {20, 60, 200}, shapes, 1.2),
          row("pose-graph-poses", {1000, 3000, 10000}, poses, 1.3),
          row("ekf-slam-landmarks", {125, 250, 500}, landmarks, 2.1),
          row("particles", {1000, 10000, 100000}, particles, 1.1),
          row("nearest-points", {1000, 10000, 100000}, points, 0.8)};
}

}  // namespace rex::bench
