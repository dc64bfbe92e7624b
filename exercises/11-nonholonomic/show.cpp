#include "show.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "car_pictures.h"
#include "planning/car_curves.h"
#include "planning/control_tree.h"
#include "systems/mobile_bases.h"

using namespace rex;

namespace {

const std::array kWords{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"};
const std::array<Color, 6> kWordColors{Color{0, 0.45f, 0.7f},  Color{0.85f, 0.37f, 0},
                                       Color{0, 0.62f, 0.45f}, Color{0.8f, 0.47f, 0.65f},
                                       Color{0.9f, 0.62f, 0},  Color{0.34f, 0.71f, 0.91f}};

// The poses of a car along its way, `every` metres apart.
Poses along(const CarModel& car, Eigen::Vector3d q, const std::vector<Drive>& drives, double every) {
  Poses poses{q};
  for (const Drive& drive : drives) {
    const int parts = std::max(1, static_cast<int>(std::abs(drive.speed) * drive.seconds / every + 0.5));
    for (int i = 1; i <= parts; ++i)
      poses.push_back(driven(car, q, {drive.speed, drive.steering, drive.seconds * i / parts}));
    q = poses.back();
  }
  return poses;
}

// A tree as one line that goes along every branch and back.
void goAround(const CarModel& car, const std::vector<CarNode>& tree,
              const std::vector<std::vector<std::size_t>>& children, std::size_t at, Poses& around) {
  for (const std::size_t child : children[at]) {
    const Poses edge = along(car, tree[at].q, {tree[child].by}, 0.3);
    around.insert(around.end(), edge.begin(), edge.end());
    goAround(car, tree, children, child, around);
    around.insert(around.end(), edge.rbegin(), edge.rend());
  }
}

std::vector<Drive> drivesOf(const CarModel& car, const DubinsWay& way) {
  const char* letters = kWords[static_cast<std::size_t>(way.word)];
  std::vector<Drive> pieces;
  for (std::size_t i = 0; i < 3; ++i)
    pieces.push_back({1,
                      letters[i] == 'S'   ? 0
                      : letters[i] == 'L' ? car.maxSteering
                                          : -car.maxSteering,
                      way.lengths[i]});
  return pieces;
}

double lengthOf(const DubinsWay& way) { return way.lengths[0] + way.lengths[1] + way.lengths[2]; }

struct Reversing {
  std::vector<double> way, hitch, offset;
  std::vector<Eigen::Vector4d> states;
  std::vector<double> steering;
};

// To four poses, one beside the other: forward only by your curve, and both ways by the library's.
void showReverse(const CarModel& car, double radius) {
  const std::pair<const char*, Eigen::Vector3d> poses[] = {
      {"behind", {-3, 0, 0}}, {"beside", {0, 3, 0}}, {"turned", {2, 0, kPi}}, {"far", {9, 4, 0.6}}};
  Figure figure = seenFromAbove("Dubins (blue) and Reeds-Shepp (red)", {});
  figure.height = 320;
  double shift = 0;
  for (const auto& [name, pose] : poses) {
    const Eigen::Vector3d from(shift, 0, 0), to = from + pose;
    const DubinsWay forward = shortestDubins(from, to, radius);
    const Curve both = reedsSheppCurve(from, to, radius);
    Poses way;
    for (int i = 0; i <= 200; ++i) way.push_back(both.pose(both.length() * i / 200));
    figure.series.insert(figure.series.end(), {outline(car, from, kSoft), outline(car, to, kSoft),
                                               through(along(car, from, drivesOf(car, forward), 0.1),
                                                       {.size = 2, .color = kGround}),
                                               through(way, {.size = 2, .color = kAccent})});
    char text[64];
    std::snprintf(text, sizeof text, "%s: %.1f m, %.1f m", name, lengthOf(forward), both.length());
    figure.notes.push_back({text, shift - 8, 13});
    shift += 24;
  }
  figure.yRange = AxisRange(-5, 15);
  plot("reverse", figure);
}

// A tree of controls of the library for car and trailer; `isFree` is yours.
void showRig(const Rig& rig, const World& world) {
  using Kind = SpacePart::Kind;
  const CarModel trailer{.front = rig.hitchLength - 0.8, .back = 0.9, .width = rig.car.width};
  const auto axle = [&](const VectorArg& q) -> Eigen::Vector3d {
    return {q[0] - rig.hitchLength * std::cos(q[3]), q[1] - rig.hitchLength * std::sin(q[3]), q[3]};
  };
  const SpacePart angle{.kind = Kind::kChord, .weight = 2};
  const Space space({{.lower = world.lower.x(), .upper = world.upper.x()},
                     {.lower = world.lower.y(), .upper = world.upper.y()},
                     angle,
                     angle});
  const CarWithTrailer model{{rig.car.wheelbase, rig.car.maxSteering}, rig.hitchLength};
  const Eigen::Vector2d most(1, rig.car.maxSteering);
  const PathProblem problem{
      .space = space,
      .allValid = eachColumn([&](const VectorArg& q) {
        return std::abs(std::remainder(q[2] - q[3], 2 * kPi)) < 1 &&
               isFree(rig.car, q.head<3>(), world.blocks) && isFree(trailer, axle(q), world.blocks);
      }),
      .start = Eigen::Vector4d(world.start[0], world.start[1], world.start[2], world.start[2]),
      .goal = Eigen::Vector4d(world.goal[0], world.goal[1], world.goal[2], world.goal[2])};
  Rng rng(1);
  const ControlPath plan =
      growControlTree(controlSystem(motionModel(model), space, -most, most), problem,
                      {.shortest = 0.5, .longest = 3, .checkEvery = 0.2, .tolerance = 1}, rng);
  Figure figure = seenFromAbove("With a trailer: the library's tree of controls", world.blocks);
  figure.series = {dots(plan.found.trees.at(0).nodes, {.size = 0.4, .color = kSoft})};
  const auto draw = [&](const Eigen::VectorXd& q) {
    figure.series.push_back(outline(trailer, axle(q), kSoft));
    figure.series.push_back(outline(rig.car, q.head<3>(), kGround));
  };
  draw(problem.start);
  for (std::size_t i = 0; i < plan.controls.size(); ++i) {
    const auto& [u, seconds] = plan.controls[i];
    const Eigen::Vector4d from = plan.found.path.col(static_cast<Eigen::Index>(i));
    Series way{.size = 2, .color = kAccent};
    for (double s = 0; s <= seconds; s += 0.05) {
      const Eigen::Vector4d q = driveTrailer(model, from, u, s);
      way.add(q[0], q[1]);
    }
    figure.series.push_back(way);
    if (i % 4 == 3 || i + 1 == plan.controls.size()) draw(driveTrailer(model, from, u, seconds));
  }
  plot("rig", figure);
}

// 30 m backward at 1 m/s, or until the rig folds up.
Reversing reverse(const Rig& rig, Eigen::Vector4d q, bool feedback) {
  Reversing run;
  constexpr double kStep = 0.01;
  for (int i = 0; i <= 3000 && std::abs(q[2] - q[3]) < 1.5; ++i) {
    const double steering = feedback ? reverseSteering(rig, q) : 0;
    run.way.push_back(kStep * i);
    run.hitch.push_back(q[2] - q[3]);
    run.offset.push_back(q[1] - rig.hitchLength * std::sin(q[3]));
    run.states.push_back(q);
    run.steering.push_back(steering);
    q += kStep * rigVelocity(rig, q, -1, steering);
  }
  return run;
}

}  // namespace

void showDrives(const CarModel& car, double seconds) {
  const Eigen::Vector3d start = Eigen::Vector3d::Zero();
  if (driven(car, start, {1, 0, seconds}) == start) return nothingYet("driving");
  Figure figure = seenFromAbove("Five steering angles, and small steps with your velocity", {});
  Series steps{.style = SeriesStyle::kPoints, .marker = Marker::kCircle, .color = Color{0, 0, 0}};
  for (const double share : {0., .25, .5, .75, 1.}) {
    const double steering = car.minSteering + share * (car.maxSteering - car.minSteering);
    figure.series.push_back(
        through(along(car, start, {{1, steering, seconds}}, 0.1), {.size = 1.5, .color = kAccent}));
    Eigen::Vector3d q = start;
    for (int i = 0; i < 1000 * seconds; ++i) {
      q += 0.001 * velocityOf(car, q, 1, steering);
      if (i % 1000 != 999) continue;
      steps.add(q[0], q[1]);
    }
    figure.series.push_back(outline(car, driven(car, start, {1, steering, seconds}), kSoft));
  }
  figure.series.push_back(steps);
  figure.series.push_back(outline(car, start, kGround));
  plot("drives", figure);

  const auto answer = [&](const Eigen::Vector3d& second) {
    return canFollow(car, {start, second}) ? "yes" : "no";
  };
  std::printf("Can a car follow? 1 m ahead: %s (should be yes), 1 m to the side: %s (no)\n",
              answer({1, 0, 0}), answer({0, 1, 0}));
}

void showTree(const CarModel& car, const World& world) {
  Rng rng(22);
  const std::vector<CarNode> tree = growTree(car, world, rng);
  if (tree.size() < 2) return nothingYet("the tree");
  std::vector<std::vector<std::size_t>> children(tree.size());
  for (std::size_t i = 1; i < tree.size(); ++i)
    children[static_cast<std::size_t>(tree[i].parent)].push_back(i);
  std::vector<Drive> way;
  for (std::size_t i = tree.size() - 1; i > 0; i = static_cast<std::size_t>(tree[i].parent))
    way.insert(way.begin(), tree[i].by);
  Poses around{world.start};
  goAround(car, tree, children, 0, around);
  Figure figure =
      seenFromAbove("A tree of controls, " + std::to_string(tree.size()) + " nodes", world.blocks);
  figure.series = {through(around, {.size = 0.6, .color = kSoft}),
                   through(along(car, world.start, way, 0.1), {.size = 2, .color = kAccent}),
                   outline(car, world.start, kGround), outline(car, world.goal, kAccent)};
  plot("tree", figure);
}

void showDubins(const CarModel& car, double radius) {
  const Eigen::Vector3d start = Eigen::Vector3d::Zero();
  if (lengthOf(shortestDubins(start, {14, 3, 0}, radius)) == 0) return nothingYet("Dubins curves");
  Figure fan = seenFromAbove("Shortest paths forward to twelve headings at two positions", {});
  fan.legend = Legend::kOutside;
  std::set<DubinsWord> named;
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(14, 3, 0), Eigen::Vector3d(-4, -3, 0)}) {
    for (int turn = 0; turn < 12; ++turn) {
      const DubinsWay way = shortestDubins(start, place + Eigen::Vector3d(0, 0, kPi / 6 * turn), radius);
      const auto word = static_cast<std::size_t>(way.word);
      fan.series.push_back(
          through(along(car, start, drivesOf(car, way), 0.1),
                  {.label = named.insert(way.word).second ? kWords[word] : "", .color = kWordColors[word]}));
    }
  }
  fan.series.push_back(outline(car, start, {0, 0, 0}));
  plot("fan", fan);
  Figure lengths{.title = "Lengths of the six words to the pose (5, 3, heading)",
                 .xLabel = "heading at the goal [rad]",
                 .yLabel = "length [m]",
                 .legend = Legend::kOutside};
  std::array<Series, 6> words;
  Series library{.label = "library's", .dashed = true, .color = Color{0, 0, 0}},
      yours{.label = "yours", .size = 5, .color = Color{1, 0.85f, 0.3f}};
  for (int i = 0; i <= 400; ++i) {
    const Eigen::Vector3d to(5, 3, -kPi + 2 * kPi * i / 400);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto way = dubinsLengths(static_cast<DubinsWord>(k), start, to, radius);
      if (!way) continue;
      words[k].add(to[2], (*way)[0] + (*way)[1] + (*way)[2]);
    }
    for (Series* series : {&library, &yours}) series->x.push_back(to[2]);
    yours.y.push_back(lengthOf(shortestDubins(start, to, radius)));
    library.y.push_back(dubinsLength(start, to, radius));
  }
  lengths.series.push_back(yours);
  for (std::size_t k = 0; k < 6; ++k) {
    words[k].label = kWords[k];
    words[k].color = kWordColors[k];
    words[k].style = SeriesStyle::kPoints;
    words[k].marker = Marker::kDot;
    if (!words[k].x.empty()) lengths.series.push_back(words[k]);
  }
  lengths.series.push_back(library);
  plot("dubins", lengths);
  showReverse(car, radius);
}

void showParking(const std::string& name, const std::string& title, const CarModel& car, const World& lot) {
  const std::vector<Drive> plan = park(car, lot);
  if (plan.empty()) return nothingYet(name + ".png and its film");
  Poses bodies = along(car, lot.start, plan, 0.7);
  Figure figure = seenFromAbove(title, lot.blocks);
  for (const Eigen::Vector3d& q : bodies) figure.series.push_back(outline(car, q, kSoft));
  figure.series.push_back(through(along(car, lot.start, plan, 0.05), {.size = 1.5, .color = kAccent}));
  figure.series.push_back(outline(car, lot.start, kGround));
  figure.series.push_back(outline(car, bodies.back(), kAccent));
  plot(name, figure);
  Simulator S = filmSet(car, lot);
  S.clearRecording();
  Eigen::Vector3d q = lot.start;
  const auto show = [&](double steering) {
    Eigen::VectorXd all(5);
    all << q, steering, steering;
    S.setJointAngles(all);
  };
  show(0);
  for (const Drive& drive : plan)
    for (const Poses way = along(car, q, {drive}, 0.05); const Eigen::Vector3d& next : way) {
      q = next;
      show(drive.steering);
    }
  const PictureOptions look{.caption = title, .view = {-0.3, -0.8, 1}};
  writeVideo(S, name, look, 240);
  writeContactSheet(S, name + "_sheet", look, 6, 240);
  if (name == "street") writeReplay(S, name, look, {figure});
}

void showTrailer(const Rig& rig, const Eigen::Vector4d& start) {
  if (rigVelocity(rig, start, -1, 0).isZero()) return nothingYet("the trailer");
  const Reversing straight = reverse(rig, start, false), steered = reverse(rig, start, true);
  Series law{.label = "exp(rate t)", .dashed = true, .color = Color{0, 0, 0}};
  for (const double t : straight.way) {
    law.add(t, 0.01 * std::exp(hitchGrowth(rig, -1) * t));
    if (law.y.back() > 1.5) break;
  }
  Figure angles{.title = "Backward with a trailer, at 1 m/s",
                .xLabel = "time [s]",
                .yLabel = "angle between car and trailer [rad]",
                .series = {{.label = "wheels straight", .x = straight.way, .y = straight.hitch},
                           {.label = "with feedback", .x = steered.way, .y = steered.hitch},
                           law}};
  plot("hitch", angles);
  Figure above = seenFromAbove("Backward along the x axis, from right to left; red: with feedback", {});
  above.horizontalLines = {{0, ""}};
  for (const Reversing* run : {&straight, &steered}) {
    const Color& color = run == &straight ? kSoft : kAccent;
    for (std::size_t i = 0; i < run->states.size(); i += 500) {
      const Eigen::Vector4d& q = run->states[i];
      above.series.push_back(outline(rig.car, q.head<3>(), color));
      above.series.push_back(outline({q[0], q[1], q[3]}, rig.hitchLength + 0.9, -0.8, rig.car.width, color));
    }
  }
  plot("reversing", above);
  World road{.blocks = {}, .lower = {-22, -4}, .upper = {20, 4}};
  Simulator S = filmSet(rig.car, road, rig.hitchLength);
  S.clearRecording();
  for (std::size_t i = 0; i < steered.states.size(); i += 5) {
    const Eigen::Vector4d& q = steered.states[i];
    Eigen::VectorXd all(6);
    all << q.head<3>(), steered.steering[i], steered.steering[i], q[3] - q[2];
    S.setJointAngles(all);
  }
  const PictureOptions look{.caption = "Backward with a trailer", .view = {-0.2, -0.8, 0.8}};
  writeVideo(S, "trailer", look, 240);
  writeContactSheet(S, "trailer_sheet", look, 6, 240);
  showRig(rig, yard());
}
