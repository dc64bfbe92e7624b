#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "car_pictures.h"
#include "course/film.h"
#include "grading/evidence.h"
#include "overlaps.h"
#include "planning/car_curves.h"
#include "systems/car.h"

// What the checks show if cars are not where they should be.

/// Adds one of several outlines in the same style; only the first has a label.
inline void addOutline(rex::Figure& figure, std::string& label, const CarModel& car, const Eigen::Vector3d& q,
                       const rex::Series& look) {
  rex::Series body = outline(car, q, look.color.value_or(rex::Color{}));
  body.label = std::exchange(label, "");
  body.size = look.size;
  body.dashed = look.dashed;
  figure.series.push_back(std::move(body));
}

inline void addOutline(rex::Figure& figure, const CarModel& car, const Eigen::Vector3d& q,
                       const rex::Series& look) {
  std::string label = look.label;
  addOutline(figure, label, car, q, look);
}

inline rex::Figure carFigure(const std::string& title, const std::vector<Block>& blocks) {
  rex::Figure figure = seenFromAbove(title, blocks);
  figure.legend = rex::Legend::kOutside;
  return figure;
}

/// Where a car starts, and where drives lead it: solid outlines for got, a dashed one for wanted.
inline rex::grading::Evidence endsSeen(const CarModel& car, const Eigen::Vector3d& start,
                                       const Eigen::Vector3d& got, const Poses& wanted) {
  rex::Figure figure = carFigure("Where a drive leads", {});
  addOutline(figure, car, start, {.label = "start", .size = 1, .color = kSoft});
  figure.series.push_back(rex::through(wanted, rex::grading::wantedCurve("")));
  addOutline(figure, car, got, {.label = "got", .size = 2, .color = rex::grading::kGotColor});
  addOutline(figure, car, wanted.back(), rex::grading::wantedCurve("wanted"));
  return {.figures = {figure}};
}

/// A sequence of poses, one of which may not follow from the one before.
inline rex::grading::Evidence pathSeen(const std::string& title, const CarModel& car, const Poses& path,
                                       std::size_t broken) {
  rex::Figure figure = carFigure(title, {});
  figure.series.push_back(rex::through(path, {.label = "poses",
                                              .style = rex::SeriesStyle::kLinesPoints,
                                              .marker = rex::Marker::kDot,
                                              .color = rex::grading::kGotColor}));
  for (const Eigen::Vector3d& q : path) figure.series.push_back(outline(car, q, kSoft));
  if (broken > 0 && broken < path.size())
    addOutline(figure, car, path[broken], rex::grading::wrongCurve("cannot follow from the one before"));
  return {.figures = {figure}};
}

/// A car among blocks, and the answer that was wanted.
inline rex::grading::Evidence placeSeen(const std::string& title, const CarModel& car,
                                        const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
  rex::Figure figure = carFigure(title, blocks);
  addOutline(figure, car, q, {.label = "car", .size = 2, .color = rex::grading::kGotColor});
  return {.figures = {figure}};
}

/// The poses of some drives one after another, every few centimetres, with the steering angle of each.
inline constexpr double kPoseSpacing = 0.08;  // metres, at most
struct DrivenWay {
  Poses poses{};
  std::vector<double> steering{};
  std::size_t wrong = 0;  ///< the first pose with something wrong; 0: none
  std::string why{};
};

inline DrivenWay drivenWay(const CarModel& car, const Eigen::Vector3d& start, const std::vector<Drive>& plan,
                           const std::vector<Block>& blocks) {
  constexpr double kLongest = 200;
  constexpr std::size_t kMostPoses = 10'000;
  DrivenWay way{.poses = {start}, .steering = {0}};
  const CarModel smaller = grown(car, -0.05);
  double length = 0;
  for (const Drive& drive : plan) {
    const double metres = std::abs(drive.speed) * drive.seconds;
    length += metres;
    if (!(length <= kLongest) || way.poses.size() > kMostPoses) break;  // senseless, or not a number
    const int count = std::max(1, static_cast<int>(std::ceil(metres / kPoseSpacing)));
    const Eigen::Vector3d from = way.poses.back();
    const bool isPossible = std::abs(drive.speed) <= 1 + 1e-9 && drive.steering <= car.maxSteering + 1e-9 &&
                            drive.steering >= car.minSteering - 1e-9;
    for (int i = 1; i <= count; ++i) {
      way.poses.push_back(rex::driveCar({car.wheelbase, 1.5}, from, {drive.speed, drive.steering},
                                        drive.seconds * i / count));
      way.steering.push_back(drive.steering);
      const bool isFree = !touches(smaller, way.poses.back(), blocks);
      if (way.wrong > 0 || (isFree && isPossible)) continue;
      way.wrong = way.poses.size() - 1;
      way.why = isPossible ? "touches something" : "beyond the limits of the car";
    }
  }
  return way;
}

/// The path of a car from above, with the pose at which something is wrong, and the wanted end.
inline rex::Figure wayFigure(const std::string& title, const CarModel& car, const World& world,
                             const DrivenWay& way) {
  rex::Figure figure = carFigure(title, world.blocks);
  for (std::size_t i = 0; i < way.poses.size(); i += 12)
    figure.series.push_back(outline(car, way.poses[i], kSoft));
  figure.series.push_back(rex::through(way.poses, rex::grading::gotCurve("got: the rear axle")));
  addOutline(figure, car, world.goal, rex::grading::wantedCurve("wanted at the end"));
  if (way.wrong > 0)
    addOutline(figure, car, way.poses[way.wrong], rex::grading::wrongCurve(way.why));
  else
    addOutline(figure, car, way.poses.back(), {.label = "got at the end", .size = 2, .color = kGround});
  return figure;
}

/// Parking as a film with a pale car on the goal, which opens where it goes wrong, or at the end.
inline rex::grading::Evidence parkingSeen(const CarModel& car, const World& lot,
                                          const std::vector<Drive>& plan) {
  const DrivenWay way = drivenWay(car, lot.start, plan, lot.blocks);
  const rex::Simulator S = filmSet(car, lot);
  const auto joints = [](const Eigen::Vector3d& q, double steering) {
    Eigen::VectorXd all(5);
    all << q, steering, steering;
    return all;
  };
  const std::size_t stride = 1 + way.poses.size() / 300;
  std::vector<Eigen::VectorXd> postures;
  std::size_t opening = 0;
  for (std::size_t i = 0; i < way.poses.size(); i += stride) {
    if (way.wrong == 0 || i <= way.wrong) opening = postures.size();
    postures.push_back(joints(way.poses[i], way.steering[i]));
  }
  rex::Film film =
      rex::grading::withWanted(rex::makeFilm(S, postures, {}), rex::makeFilm(S, {joints(lot.goal, 0)}, {}));
  for (std::size_t i = 0; i < film.size(); ++i)  // at 1 m/s
    film[i].time = kPoseSpacing * static_cast<double>(stride * i);
  const double moment = film[opening].time;
  return {.figures = {wayFigure("The way into the space", car, lot, way)},
          .film = std::move(film),
          .view = {-0.3, -0.8, 1},
          .moment = moment};
}

/// One drive among blocks, towards a target.
inline rex::grading::Evidence driveSeen(const CarModel& car, const Eigen::Vector3d& from,
                                        const Eigen::Vector3d& target, const Drive& drive,
                                        const std::vector<Block>& blocks) {
  World world{.start = from, .goal = target, .blocks = blocks, .lower = {}, .upper = {}};
  rex::Figure figure =
      wayFigure("One drive towards a target", car, world, drivenWay(car, from, {drive}, blocks));
  for (rex::Series& series : figure.series)
    if (series.label == "wanted at the end") series.label = "target";
  return {.figures = {figure}};
}

/// A valid tree of drives, up to the node being checked; the edge to this node is thick, and red where it
/// goes wrong.
inline rex::grading::Evidence treeSeen(const CarModel& car, const World& world,
                                       const std::vector<CarNode>& tree, std::size_t node) {
  rex::Figure figure = carFigure("The tree", world.blocks);
  const std::size_t count = std::min(node + 1, tree.size());
  for (std::size_t i = 1; i < count; ++i) {
    const Eigen::Vector3d& from = tree[static_cast<std::size_t>(tree[i].parent)].q;
    const Poses edge = drivenWay(car, from, {tree[i].by}, {}).poses;
    figure.series.push_back(rex::through(edge, {.size = 0.5, .color = kSoft}));
  }
  addOutline(figure, car, world.start, {.label = "start", .size = 1, .color = kGround});
  addOutline(figure, car, world.goal, rex::grading::wantedCurve("goal"));
  if (node >= 1 && node < tree.size()) {
    const Eigen::Vector3d& from = tree[static_cast<std::size_t>(tree[node].parent)].q;
    const DrivenWay way = drivenWay(car, from, {tree[node].by}, world.blocks);
    figure.series.push_back(rex::through(way.poses, rex::grading::gotCurve("the edge being checked")));
    if (way.wrong > 0) addOutline(figure, car, way.poses[way.wrong], rex::grading::wrongCurve(way.why));
  }
  return {.figures = {figure}};
}

/// Pieces of a word from a pose, with the shortest path there as the wanted one, and both ends as arrows.
inline rex::grading::Evidence dubinsSeen(const std::string& title, const Poses& got,
                                         const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                         double radius, bool withShortest) {
  rex::Figure figure = carFigure(title, {});
  figure.series.push_back(rex::through(got, rex::grading::gotCurve("got")));
  if (withShortest) {
    const rex::Curve shortest = rex::dubinsCurve(from, to, radius);
    Poses poses;
    for (int part = 0; part <= 100; ++part) poses.push_back(shortest.pose(shortest.length() * part / 100));
    figure.series.push_back(rex::through(poses, rex::grading::wantedCurve("wanted: the shortest")));
  }
  rex::Arrows ends{.label = "start and goal", .color = rex::grading::kWantedColor};
  for (const Eigen::Vector3d& pose : {from, to})
    ends.add(pose.head<2>(), radius / 2 * Eigen::Vector2d(std::cos(pose[2]), std::sin(pose[2])));
  figure.arrows = {ends};
  return {.figures = {figure}};
}

/// A trailer that is pushed backward, as a film that opens in the last state; they are tau
/// seconds apart.
inline rex::grading::Evidence reversingSeen(const Rig& rig, const std::vector<Eigen::Vector4d>& states,
                                            double tau) {
  World road{.start = {}, .goal = {}, .blocks = {}, .lower = {-56, -5}, .upper = {8, 5}};
  const rex::Simulator S = filmSet(rig.car, road, rig.hitchLength);
  rex::Series axle = rex::grading::gotCurve("got: axle of the trailer");
  std::vector<Eigen::VectorXd> postures;
  const std::size_t stride = 1 + states.size() / 300;
  for (std::size_t i = 0; i < states.size(); i += stride) {
    const Eigen::Vector4d& q = states[i];
    Eigen::VectorXd all(6);
    all << q.head<3>(), 0, 0, q[3] - q[2];
    postures.push_back(all);
    axle.add(q[0] - rig.hitchLength * std::cos(q[3]), q[1] - rig.hitchLength * std::sin(q[3]));
  }
  rex::Film film = rex::makeFilm(S, postures, {.paths = {{{-56, 0, .02}, {8, 0, .02}}}});
  for (std::size_t i = 0; i < film.size(); ++i) film[i].time = tau * static_cast<double>(stride * i);
  const double moment = film.back().time;
  rex::Figure figure{.title = "Backward along a line", .xLabel = "x [m]", .yLabel = "y [m]"};
  figure.series = {axle, rex::grading::wantedCurve("wanted at the end", {axle.x.front(), -56}, {0, 0})};
  return {.figures = {figure}, .film = std::move(film), .view = {-0.2, -0.8, 0.8}, .moment = moment};
}
