#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grading/evidence.h"
#include "graph_checks.h"
#include "map_pictures.h"
#include "scan_checks.h"

// What the checks show if maps or scans are wrong.

/// A map beside the best one, with its loops, and what it cost from step to step.
inline rex::grading::Evidence mapSeen(const PoseMap& map, const Adjusted& got, double least) {
  if (got.poses.size() != map.poses.size()) return {};
  rex::Figure figure = planOf("The map");
  figure.series = {pathSeries("given: odometry", map.poses, kGrey)};
  addLoops(figure, map, got.poses, kRed);
  figure.series.push_back(rex::through(got.poses, rex::grading::gotCurve("got")));
  figure.series.push_back(rex::through(bestPoses(map), rex::grading::wantedCurve("wanted")));
  rex::Series costs = rex::grading::gotCurve("got");
  for (const double cost : got.costs) costs.add(static_cast<double>(costs.x.size()), std::max(cost, 1e-12));
  if (costs.y.empty()) return {.figures = {figure}};
  const double end = std::max(1., static_cast<double>(costs.x.size()) - 1);
  const double wanted = std::max(least, 1e-12);
  return {.figures = {figure,
                      {.title = "Its cost, step by step",
                       .xLabel = "step",
                       .yLabel = "cost",
                       .logY = true,
                       .series = {costs, rex::grading::wantedCurve("wanted at the end", {0, end},
                                                                   {wanted, wanted})}}}};
}

/// A walk with wrong loops, the returned poses, and the best ones without these loops.
struct JudgedWalk {
  StreetWalk walk{};
  Poses got{}, best{};
};

inline rex::grading::Evidence robustSeen(const JudgedWalk& judged) {
  const PoseMap& map = judged.walk.map;
  rex::Figure figure = planOf("A map with wrong loops");
  std::string label = "wrong loops";
  for (const auto& edge : map.edges) {
    const Eigen::Vector3d &a = judged.walk.truth[static_cast<std::size_t>(edge.from)],
                          &b = judged.walk.truth[static_cast<std::size_t>(edge.to)];
    if (!edge.isLoop || (a - b).head<2>().norm() < 1) continue;
    figure.series.push_back({.label = std::exchange(label, ""),
                             .x = {a[0], b[0]},
                             .y = {a[1], b[1]},
                             .size = 0.5,
                             .color = rex::grading::kWrongColor});
  }
  figure.series.push_back(rex::through(judged.got, rex::grading::gotCurve("got")));
  figure.series.push_back(rex::through(judged.best, rex::grading::wantedCurve("wanted: as without them")));
  return {.figures = {figure}};
}

/// One scan over another by the returned motion, and by the wanted one.
inline rex::grading::Evidence scansSeen(const std::string& title, const ScanPair& pair,
                                        const std::optional<Eigen::Vector3d>& got,
                                        const std::optional<Eigen::Vector3d>& wanted) {
  rex::Figure figure = planOf(title);
  const auto add = [&](const std::string& label, const Eigen::Vector3d& motion, const Points& scan,
                       const rex::Color& color) {
    figure.series.push_back(cloud(label, {motion}, {scan}, color));
    figure.series.back().size = .8;
  };
  add("reference", {0, 0, 0}, pair.reference, kGrey);
  if (wanted) add("moving, wanted", *wanted, pair.moving, rex::grading::kWantedColor);
  if (got) add("moving, got", *got, pair.moving, rex::grading::kGotColor);
  return {.figures = {figure}};
}

/// What is measured of pairs of scans, with the limit of its mean.
inline rex::grading::Evidence overPairs(const std::string& title, const std::string& unit,
                                        const std::vector<double>& values, double limit) {
  rex::Series series = rex::grading::gotCurve("got", {}, values);
  for (std::size_t k = 0; k < values.size(); ++k) series.x.push_back(static_cast<double>(k + 1));
  series.style = rex::SeriesStyle::kPoints;
  series.marker = rex::Marker::kDot;
  series.size = 2;
  return {.figures = {{.title = title,
                       .xLabel = "pair of scans",
                       .yLabel = unit,
                       .series = {series},
                       .horizontalLines = {{.at = limit, .label = "at most, on average"}}}}};
}

/// Points and their partners: got, and the nearest one if it differs.
inline rex::grading::Evidence partnersSeen(const ScanPair& pair, const std::vector<int>& got, double most) {
  if (got.size() != pair.moving.size()) return {};
  rex::grading::Evidence evidence = scansSeen("Partners of the moving points", pair, pair.guess, {});
  rex::Figure& figure = evidence.figures.front();
  std::string gotLabel = "partner, got", wantedLabel = "partner, wanted";
  for (std::size_t k = 0; k < got.size(); ++k) {
    const Eigen::Vector2d at = pointFrom(pair.guess, pair.moving[k]);
    int partner = -1;
    double least = most;
    for (std::size_t i = 0; i < pair.reference.size(); ++i) {
      const double distance = (pair.reference[i] - at).norm();
      if (distance > least) continue;
      least = distance;
      partner = static_cast<int>(i);
    }
    const auto join = [&](int to, rex::Series look) {
      if (to < 0 || to >= static_cast<int>(pair.reference.size())) return;
      const Points ends{at, pair.reference[static_cast<std::size_t>(to)]};
      figure.series.push_back(rex::through(ends, std::move(look)));
    };
    if (got[k] == partner) continue;
    join(got[k], rex::grading::wrongCurve(std::exchange(gotLabel, "")));
    join(partner, rex::grading::wantedCurve(std::exchange(wantedLabel, "")));
  }
  return evidence;
}

/// Points moved by the returned motion, and where they should be.
inline rex::grading::Evidence motionSeen(const Points& from, const Points& to, const Eigen::Vector3d& got) {
  Points moved;
  for (const Eigen::Vector2d& p : from) moved.push_back(pointFrom(got, p));
  rex::Figure figure = planOf("Points, moved by the motion");
  figure.series = {rex::dots(from, {.label = "points", .size = 1.5, .color = kGrey}),
                   rex::dots(moved, {.label = "moved, got", .size = 1.5, .color = rex::grading::kGotColor}),
                   rex::dots(to, {.label = "wanted",
                                  .marker = rex::Marker::kCircle,
                                  .size = 1.5,
                                  .color = rex::grading::kWantedColor})};
  return {.figures = {figure}};
}
