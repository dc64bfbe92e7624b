// Chapter 7: Graph SLAM loop by loop. Odometry drifts (orange); each time the robot recognises a place, an
// edge closes a loop (violet) and the optimized graph (blue) snaps to the true way (grey). A button doubts
// closures that fit badly.
// Slides: 7:45
// Formula: min_x Σ_ij e_ijᵀ Ω_ij e_ij, e_ij = z_ij - (x_j seen from x_i)
// Try: The pose graph moves to the true path at each closure. Set "wrong closures" to 0.5 and press "from
// the start"; then press "doubt closures".
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/pose_graph.h"
#include "render/picture.h"

using namespace rex;

namespace {

Eigen::Isometry2d frameOf(const Eigen::Vector3d& pose) {
  return Eigen::Isometry2d(Eigen::Translation2d(pose.head<2>()) * Eigen::Rotation2Dd(pose[2]));
}

Eigen::Vector3d poseOf(const Eigen::Isometry2d& frame) {
  return {frame.translation().x(), frame.translation().y(), Eigen::Rotation2Dd(frame.linear()).angle()};
}

Eigen::Vector3d compose(const Eigen::Vector3d& a, const Eigen::Vector3d& d) {
  const Eigen::Vector2d p = a.head<2>() + Eigen::Rotation2Dd(a[2]) * d.head<2>();
  return {p.x(), p.y(), a[2] + d[2]};
}

Polyline lineOf(const Eigen::Matrix3Xd& poses, const Color& color, double z, double width) {
  Polyline line{.color = color, .width = width};
  for (const auto& x : poses.colwise()) line.points.push_back({x[0], x[1], z});
  return line;
}

}  // namespace

int main() {
  LiveView view("loops");
  view.lookFrom({0, -0.25, 1});
  Rng rng(4);
  PlanarPoseGraph graph;
  Eigen::Matrix3Xd truth, odometry;
  bool doubts = false;
  const auto settle = [&] {
    optimize(graph, {.kernel = doubts ? RobustKernel::kGemanMcClure : RobustKernel::kNone, .kernelSize = 3});
  };
  for (int t = 0, age = 0; t <= 240 || view.isWatched(); ++t, ++age) {
    const double drift = view.slider("drift of odometry", 0, 0.02, 0.005),
                 closure = view.slider("noise of closures", 0.01, 1, 0.05);
    const double wrong = view.slider("wrong closures", 0, 1, 0);
    if (view.button("doubt closures")) {
      doubts = !doubts;
      graph.poses = odometry;
      if (age > 0) settle();
    }
    if (view.button("from the start") || age == 0 || age > 300)
      graph = {}, age = 0, truth = odometry = Eigen::Matrix3Xd::Zero(3, 1), graph.poses = truth;
    if (age > 0 && age <= 240) {  // a figure of eight, twice
      const int n = static_cast<int>(truth.cols()) - 1;
      const double s = age * 6.283185307179586 / 120;
      const Eigen::Vector3d next(8 * std::sin(s), 4 * std::sin(2 * s),
                                 std::atan2(8 * std::cos(2 * s), 8 * std::cos(s)));
      if (n == 0) truth(2, 0) = odometry(2, 0) = graph.poses(2, 0) = std::atan2(8., 8.);
      const Eigen::Vector3d step = poseOf(frameOf(truth.col(n)).inverse() * frameOf(next)) +
                                   drift * Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal() + 0.3);
      for (Eigen::Matrix3Xd* all : {&truth, &odometry, &graph.poses}) all->conservativeResize(3, n + 2);
      truth.col(n + 1) = next, odometry.col(n + 1) = compose(odometry.col(n), step),
                    graph.poses.col(n + 1) = compose(graph.poses.col(n), step);
      const double sure = 1 / (drift * drift + 1e-4);
      graph.edges.push_back({n, n + 1, step, sure * Eigen::Matrix3d::Identity()});
      if (age % 15 == 0)
        for (int i = 0; i + 30 < n; i += 3)
          if ((truth.col(i) - next).head<2>().norm() < 0.8) {
            const int to = rng.uniform() < wrong ? static_cast<int>(rng.uniform(0, n)) : i;
            if (to == n + 1) break;
            const Eigen::Vector3d seen =
                poseOf(frameOf(truth.col(i)).inverse() * frameOf(next)) + closure * rng.normalVector(3);
            graph.edges.push_back({to, n + 1, seen, Eigen::Matrix3d::Identity() / (closure * closure)});
            settle();
            break;
          }
    }
    Picture picture{.ground = {.visible = false}};
    if (truth.cols() > 1) {
      picture.polylines = {lineOf(truth, {0.6f, 0.6f, 0.6f}, 0, 6),
                           lineOf(odometry, kDeadReckoningColor, 0.02, 2.5),
                           lineOf(graph.poses, kEstimateColor, 0.04, 3.5)};
      LineSet closures{.color = kScanColor, .width = 4};
      for (const PlanarEdge& e : graph.edges)
        if (e.to != e.from + 1)
          closures.segments.push_back({{graph.poses(0, e.from), graph.poses(1, e.from), 0.06},
                                       {graph.poses(0, e.to), graph.poses(1, e.to), 0.06}});
      if (!closures.segments.empty()) picture.lineSets.push_back(closures);
      picture.captions.push_back({.text = "closed loops: " + std::to_string(closures.segments.size()) +
                                          (doubts ? ", doubted where they fit badly" : ", all believed"),
                                  .scale = 1.5});
      view.plot("error of odometry [m]", t / 30., (odometry - truth).topRows<2>().colwise().norm().mean());
      view.plot("error of the graph [m]", t / 30.,
                (graph.poses - truth).topRows<2>().colwise().norm().mean());
    }
    picture.polylines.push_back(
        {.points = {{-11, -7, 0}, {11, -7, 0}, {11, 7, 0}, {-11, 7, 0}, {-11, -7, 0}}, .color = kTruthColor});
    view.show(picture);
  }
}
