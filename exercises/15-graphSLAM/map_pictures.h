#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "exercise.h"
#include "rooms.h"

// How main() draws maps and films them.

using Poses = std::vector<Eigen::Vector3d>;

inline const rex::Color kGrey{0.6f, 0.62f, 0.65f}, kBlue{0.1f, 0.35f, 0.65f}, kRed{0.84f, 0.3f, 0.05f},
    kBlack{0, 0, 0};

inline Eigen::Vector2d pointFrom(const Eigen::Vector3d& pose, const Eigen::Vector2d& p) {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  return {pose[0] + c * p.x() - s * p.y(), pose[1] + s * p.x() + c * p.y()};
}

/// All points of all scans, seen from where the poses are.
inline rex::Series cloud(const std::string& label, const Poses& poses, const std::vector<Points>& scans,
                         const rex::Color& color) {
  Points points;
  for (std::size_t k = 0; k < poses.size(); ++k)
    for (const Eigen::Vector2d& p : scans[k]) points.push_back(pointFrom(poses[k], p));
  return rex::dots(points, {.label = label, .size = 0.35, .color = color});
}

inline rex::Series pathSeries(const std::string& label, const Poses& poses, const rex::Color& color,
                              bool dashed = false) {
  return rex::through(poses, {.label = label, .size = 1.5, .dashed = dashed, .color = color});
}

inline rex::Figure planOf(const std::string& title) {
  return rex::planeFigure({.title = title, .legend = rex::Legend::kOutside, .width = 1000, .height = 600});
}

/// Adds loops as thin lines from pose to pose.
inline void addLoops(rex::Figure& figure, const PoseMap& map, const Poses& poses, const rex::Color& color) {
  for (const MeasuredEdge& edge : map.edges)
    if (edge.isLoop) {
      const Eigen::Vector3d &a = poses[static_cast<std::size_t>(edge.from)],
                            &b = poses[static_cast<std::size_t>(edge.to)];
      figure.series.push_back({.x = {a[0], b[0]}, .y = {a[1], b[1]}, .size = 0.5, .color = color});
    }
}

inline std::string numbers(const std::vector<double>& values) {
  std::string all;
  for (const double value : values) all += std::to_string(value) + ' ';
  return all;
}

/// A scene with a small disc for each pose, and a pillar for every sixth point of what was seen from it.
/// Three joint angles for each pose.
inline rex::Simulator sceneOf(const std::vector<Points>& scans) {
  std::string scene =
      "shape ground (world) { rel=<T t(9 6 -0.1)> type=ST_box size=[21 15 0.1] color=[.85 .86 .87] }\n";
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(scans.size());
    const std::string body = "pose" + std::to_string(k);
    const std::string color = "color=[" + numbers({0.1 + 0.75 * share, 0.35, 0.65 - 0.55 * share}) + "] }\n";
    scene += "body " + body + " { }\njoint (world " + body + ") { type=transXYPhi }\n";
    scene += "shape (" + body + ") { type=ST_cylinder size=[0 0 0.3 0.15] " + color;
    for (std::size_t i = 0; i < scans[k].size(); i += 6)
      scene += "shape (" + body + ") { rel=<T t(" + numbers({scans[k][i].x(), scans[k][i].y(), 0.25}) +
               ")> type=ST_box size=[0.1 0.1 0.5] " + color;
  }
  return rex::Simulator(rex::SimulatorDescription{.sceneName = "map", .sceneText = scene, .q = {}});
}

inline Eigen::VectorXd anglesOf(const Poses& poses) {
  Eigen::VectorXd q(3 * static_cast<Eigen::Index>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) q.segment<3>(3 * static_cast<Eigen::Index>(k)) = poses[k];
  return q;
}

/// The map as it changes from step to step, and a while after the last.
inline void filmOf(const std::string& name, const std::vector<Points>& scans,
                   const std::vector<Poses>& steps) {
  rex::Simulator S = sceneOf(scans);
  S.setJointAngles(anglesOf(steps.front()));
  S.clearRecording();
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    const Eigen::VectorXd from = anglesOf(steps[k]);
    Eigen::VectorXd way = anglesOf(steps[k + 1]) - from;
    for (Eigen::Index i = 2; i < way.size(); i += 3) way[i] = std::remainder(way[i], 2 * std::numbers::pi);
    for (int share = 1; share <= 30; ++share) S.setJointAngles(from + share / 30. * way);
  }
  for (int rest = 0; rest < 20; ++rest) S.setJointAngles(anglesOf(steps.back()));
  const rex::PictureOptions look{.caption = "Adjusting the map, step by step", .view = {-0.1, -0.7, 1}};
  const int frames = 30 * static_cast<int>(steps.size()) - 10;
  rex::writeVideo(S, name, look, frames);
  rex::writeContactSheet(S, name + "_sheet", look, 6, frames);
}
