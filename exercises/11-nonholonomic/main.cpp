#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

#include "car_pictures.h"
#include "exercise.h"
#include "planning/dubins.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

Eigen::Vector3d velocityOf(const CarModel& car, const Eigen::Vector3d& q, double speed, double steering) {
  // TODO: slide 4:48. What does its third line say about a car that stands?
  notUsedYet(car, q, speed, steering);
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d driven(const CarModel& car, const Eigen::Vector3d& q, const Drive& drive) {
  // TODO: the car drives on a circle, or in many small steps with velocityOf().
  notUsedYet(car, drive);
  return q;
}

bool canFollow(const CarModel& car, const std::vector<Eigen::Vector3d>& path) {
  // TODO: between two poses lies an arc. Which direction has its chord, and how large is its radius?
  notUsedYet(car, path);
  return true;
}

double poseDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // TODO: slide 4:59, a), and then with x and y.
  notUsedYet(a, b);
  return 0;
}

double angleDistance(double a, double b) {
  // TODO: slide 4:59, b). What if one angle is 7 turns?
  notUsedYet(a, b);
  return 0;
}

bool isFree(const CarModel& car, const Eigen::Vector3d& q, const std::vector<Block>& blocks) {
  // TODO: do two rectangles overlap? It is not enough to look at their corners.
  notUsedYet(car, q, blocks);
  return true;
}

// TODO: you may want a function that tests the whole way of a drive.

std::optional<Drive> driveTowards(const CarModel& car, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& target, double seconds,
                                  const std::vector<Block>& blocks, Rng& rng) {
  // TODO: which of 20 random controls leads nearest to the target, with nothing in its way?
  notUsedYet(car, from, target, seconds, blocks, rng);
  return {};
}

std::vector<CarNode> growTree(const CarModel& car, const World& world, Rng& rng) {
  std::vector<CarNode> tree{{world.start, -1, {}}};
  // TODO: slide 4:58. Aim at the goal now and then.
  notUsedYet(car, rng);
  return tree;
}

std::optional<std::array<double, 3>> dubinsLengths(DubinsWord word, const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& to, double radius) {
  // TODO: where are the centres of the first and of the last circle, and how far apart?
  notUsedYet(word, from, to, radius);
  return {};
}

DubinsWay shortestDubins(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  DubinsWay best;
  // TODO: ask for all six.
  notUsedYet(from, to, radius);
  return best;
}

// TODO: what else parking needs: curves and parts of a way as your own functions.

std::vector<Drive> park(const CarModel& car, const World& lot) {
  // TODO: a way out of the space, driven backward, is a way in.
  notUsedYet(car, lot);
  return {};
}

Eigen::Vector4d rigVelocity(const Rig& rig, const Eigen::Vector4d& q, double speed, double steering) {
  Eigen::Vector4d velocity = Eigen::Vector4d::Zero();
  // TODO: where is the axle of the trailer, how does it move, and in which direction can it?
  notUsedYet(rig, q, speed, steering);
  return velocity;
}

double hitchGrowth(const Rig& rig, double speed) {
  // TODO: the equation of the angle between car and trailer, near zero.
  notUsedYet(rig, speed);
  return 0;
}

double reverseSteering(const Rig& rig, const Eigen::Vector4d& q) {
  // TODO: which heading should the trailer have beside the axis? Which angle at the hitch turns it there,
  // and which steering angle makes that?
  notUsedYet(rig, q);
  return 0;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

const std::array kWords{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"};
const std::array<Color, 6> kWordColors{Color{0, 0.45f, 0.7f},  Color{0.85f, 0.37f, 0},
                                       Color{0, 0.62f, 0.45f}, Color{0.8f, 0.47f, 0.65f},
                                       Color{0.9f, 0.62f, 0},  Color{0.34f, 0.71f, 0.91f}};

// The poses at which a car is every so many metres of its way.
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

void showTree() {
  const CarModel car;
  const World world = room();
  Rng rng(22);
  const std::vector<CarNode> tree = growTree(car, world, rng);
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
  figure.series = {line("", around, kSoft, 0.6), line("", along(car, world.start, way, 0.1), kAccent, 2),
                   outline(car, world.start, kGround), outline(car, world.goal, kAccent)};
  plot("tree", figure);
}

std::vector<Drive> drivesOf(const CarModel& car, const DubinsWay& way) {
  const char* letters = kWords[static_cast<std::size_t>(way.word)];
  std::vector<Drive> drives;
  for (std::size_t i = 0; i < 3; ++i)
    drives.push_back({1,
                      letters[i] == 'S'   ? 0
                      : letters[i] == 'L' ? car.maxSteering
                                          : -car.maxSteering,
                      way.lengths[i]});
  return drives;
}

// byLibrary(from, to, radius): the length of a Dubins curve [m].
void showDubins(double (*byLibrary)(const Eigen::Vector3d&, const Eigen::Vector3d&, double)) {
  const CarModel car;
  const double radius = car.wheelbase / std::tan(car.maxSteering);
  const Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Figure fan = seenFromAbove("Shortest ways forward to twelve headings at two places", {});
  fan.legend = Legend::kOutside;
  std::set<DubinsWord> named;
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(14, 3, 0), Eigen::Vector3d(-4, -3, 0)}) {
    for (int i = 0; i < 12; ++i) {
      const DubinsWay way = shortestDubins(start, place + Eigen::Vector3d(0, 0, kPi / 6 * i), radius);
      const auto word = static_cast<std::size_t>(way.word);
      fan.series.push_back(line(named.insert(way.word).second ? kWords[word] : "",
                                along(car, start, drivesOf(car, way), 0.1), kWordColors[word], 1));
    }
  }
  fan.series.push_back(outline(car, start, {0, 0, 0}));
  plot("fan", fan);
  Figure lengths{.title = "The six words to the pose (5, 3, heading)",
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
      words[k].x.push_back(to[2]);
      words[k].y.push_back((*way)[0] + (*way)[1] + (*way)[2]);
    }
    const DubinsWay best = shortestDubins(start, to, radius);
    for (Series* series : {&library, &yours}) series->x.push_back(to[2]);
    yours.y.push_back(best.lengths[0] + best.lengths[1] + best.lengths[2]);
    library.y.push_back(byLibrary(start, to, radius));
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
}

void showParking(const std::string& name, const std::string& title, const CarModel& car, const World& lot) {
  const std::vector<Drive> plan = park(car, lot);
  Poses bodies = along(car, lot.start, plan, 0.7);
  Figure figure = seenFromAbove(title, lot.blocks);
  for (const Eigen::Vector3d& q : bodies) figure.series.push_back(outline(car, q, kSoft));
  figure.series.push_back(line("", along(car, lot.start, plan, 0.05), kAccent, 1.5));
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

struct Reversing {
  std::vector<double> way, hitch, offset;
  std::vector<Eigen::Vector4d> states;
  std::vector<double> steering;
};

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

void showTrailer() {
  const Rig rig;
  const Eigen::Vector4d start(15, 1, 0.05, 0.04);
  const Reversing straight = reverse(rig, start, false), steered = reverse(rig, start, true);
  Series law{.label = "exp(rate t)", .dashed = true, .color = Color{0, 0, 0}};
  for (const double t : straight.way) {
    law.x.push_back(t);
    law.y.push_back(0.01 * std::exp(hitchGrowth(rig, -1) * t));
    if (law.y.back() > 1.5) break;
  }
  Figure angles{.title = "Backward with a trailer, at 1 m/s",
                .xLabel = "time [s]",
                .yLabel = "angle between car and trailer [rad]",
                .series = {{.label = "wheels straight", .x = straight.way, .y = straight.hitch},
                           {.label = "with feedback", .x = steered.way, .y = steered.hitch},
                           law}};
  plot("hitch", angles);
  Figure above = seenFromAbove("Backward along the x axis, from the right to the left", {});
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
}

}  // namespace

int main() {
  showTree();
  // Once your own curves work, the shortest ones lie on the library's.
  showDubins([](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
    return dubinsLength(from, to, radius);
  });
  showParking("street", "Into a space at the kerb", {}, street(7, 6.4));
  showParking("bay", "Backward into a bay", {}, bays());
  showParking("left", "The same street, turning left only", {.minSteering = 0}, street(10, 7.4));
  showTrailer();
}
