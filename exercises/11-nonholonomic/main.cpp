#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

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

constexpr double kPi = std::numbers::pi;
const Color kGround{0.15f, 0.3f, 0.5f}, kAccent{0.8f, 0.25f, 0.1f}, kSoft{0.6f, 0.7f, 0.8f};

const std::array kWords{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"};
const std::array<Color, 6> kWordColors{Color{0, 0.45f, 0.7f},  Color{0.85f, 0.37f, 0},
                                       Color{0, 0.62f, 0.45f}, Color{0.8f, 0.47f, 0.65f},
                                       Color{0.9f, 0.62f, 0},  Color{0.34f, 0.71f, 0.91f}};

using Poses = std::vector<Eigen::Vector3d>;

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

// A rectangle around p, from `back` behind to `front` before it.
Series outline(const Eigen::Vector3d& p, double back, double front, double width, const Color& color) {
  Series series{.size = 0.5, .color = color};
  const double c = std::cos(p[2]), s = std::sin(p[2]);
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
    const double ahead = x < 0 ? -back : front, left = y * width / 2;
    series.x.push_back(p[0] + c * ahead - s * left);
    series.y.push_back(p[1] + s * ahead + c * left);
  }
  return series;
}

Series outline(const CarModel& car, const Eigen::Vector3d& q, const Color& color) {
  return outline(q, car.back, car.front, car.width, color);
}

Series line(const std::string& label, const Poses& poses, const Color& color, double size) {
  Series series{.label = label, .size = size, .color = color};
  for (const Eigen::Vector3d& q : poses) {
    series.x.push_back(q[0]);
    series.y.push_back(q[1]);
  }
  return series;
}

Figure seenFromAbove(const std::string& title, const std::vector<Block>& blocks) {
  Figure figure{.title = title,
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .equalAxes = true,
                .legend = Legend::kNone,
                .width = 1000,
                .height = 560};
  for (const Block& block : blocks) {
    const Series edge = outline(block.middle, block.length / 2, block.length / 2, block.width, {});
    figure.regions.push_back({.x = edge.x, .y = edge.y});
  }
  return figure;
}

// The world of main(): a room with things in it, 24 m x 16 m.
World room() {
  return {.start = {3, 3, 0},
          .goal = {20, 12.5, kPi / 2},
          .blocks = {{{12, -0.2, 0}, 24.8, 0.4},
                     {{12, 16.2, 0}, 24.8, 0.4},
                     {{-0.2, 8, kPi / 2}, 16.8, 0.4},
                     {{24.2, 8, kPi / 2}, 16.8, 0.4},
                     {{8.5, 8, 0.4}, 8, 2},
                     {{16, 4.5, 1.2}, 7, 1.5},
                     {{15.5, 13, 0}, 1.5, 6}},
          .lower = {0, 0},
          .upper = {24, 16}};
}

// A street with cars at its kerb and one space; the other side is a wall, `width` away from that row.
World street(double width, double slot) {
  World lot{
      .start = {-6, 3.6, 0}, .goal = {-1.3, 0, 0}, .blocks = {}, .lower = {-14, -1.2}, .upper = {14, width}};
  for (const double side : {-1., 1.})
    for (const double next : {0., 5.})
      lot.blocks.push_back({{side * (slot / 2 + 2.1 + next), 0, 0}, 4.2, 1.75});
  lot.blocks.push_back({{0, -1.4, 0}, 28, 0.4});
  lot.blocks.push_back({{0, width + 0.2, 0}, 28, 0.4});
  return lot;
}

World bays() {
  World lot{.start = {-9, 5, 0},
            .goal = {0, -1.3, kPi / 2},
            .blocks = {},
            .lower = {-13, -2.5},
            .upper = {13, 8.5}};
  for (const int i : {-4, -3, -2, -1, 1, 2, 3, 4}) lot.blocks.push_back({{2.6 * i, 0, kPi / 2}, 4.2, 1.75});
  lot.blocks.push_back({{0, -2.7, 0}, 26, 0.4});
  lot.blocks.push_back({{0, 8.7, 0}, 26, 0.4});
  return lot;
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

std::string text(const std::vector<double>& numbers) {
  std::string all;
  for (const double number : numbers) all += std::to_string(number) + ' ';
  return all;
}

std::string box(const std::string& head, const std::vector<double>& place, double heading,
                const std::vector<double>& size, const std::string& look) {
  return head + "=<T t(" + text(place) + ") r(" + text({heading}) + " 0 0 1)> type=ST_ssBox size=[" +
         text(size) + " 0.05] " + look + " }\n";
}

// A scene with a car, its front wheels and a trailer: 6 joint angles, or 5 without the trailer.
Simulator filmSet(const CarModel& car, const World& world, double hitchLength = 0) {
  const std::string paint = "color=[.90 .58 .18]", dark = "color=[.2 .22 .27]";
  const double low = -car.back, length = car.front + car.back, axle = car.width / 2 - 0.15;
  std::string scene =
      box("shape ground (world) { rel",
          {(world.lower.x() + world.upper.x()) / 2, (world.lower.y() + world.upper.y()) / 2, -0.1}, 0,
          {world.upper.x() - world.lower.x(), world.upper.y() - world.lower.y(), 0.1}, "color=[.62 .64 .66]");
  for (const Block& block : world.blocks) {
    const bool isCar = block.width > 1 && block.length > 4 && block.length < 5;
    const std::vector<double> middle{block.middle[0], block.middle[1]};
    scene += box("shape (world) { rel", {middle[0], middle[1], isCar ? 0.55 : 0.15}, block.middle[2],
                 {block.length, block.width, isCar ? 0.6 : 0.3},
                 isCar ? "color=[.35 .45 .6]" : "color=[.45 .47 .5]");
    if (isCar)
      scene += box("shape (world) { rel", {middle[0], middle[1], 1.05}, block.middle[2],
                   {block.length * 0.5, block.width * 0.9, 0.5}, "color=[.55 .63 .74]");
  }
  const auto wheel = [&](double x, double y) {
    return "rel=<T t(" + text({x, y, 0.3}) + ") d(90 1 0 0)> type=ST_cylinder size=[0 0 0.2 0.3] " + dark +
           " }\n";
  };
  scene += "body car { }\njoint (world car) { type=transXYPhi }\n";
  scene += box("shape (car) { rel", {low + length / 2, 0, 0.55}, 0, {length, car.width, 0.5}, paint);
  scene += box("shape (car) { rel", {low + 0.45 * length, 0, 1.05}, 0, {0.5 * length, 0.9 * car.width, 0.5},
               paint);
  for (const double y : {-axle, axle}) {
    const std::string name = y < 0 ? "right" : "left";
    scene += "shape (car) { " + wheel(0, y) + "body " + name + " { }\nshape (" + name + ") { " + wheel(0, 0);
    scene += "joint (car " + name + ") { type=hingeZ A=<T t(" + text({car.wheelbase, y, 0}) + ")> }\n";
  }
  if (hitchLength > 0) {
    scene += "body trailer { }\njoint (car trailer) { type=hingeZ }\n";
    scene += box("shape (trailer) { rel", {-hitchLength - 0.3, 0, 0.9}, 0, {hitchLength, car.width, 1.2},
                 "color=[.8 .8 .78]");
    scene += box("shape (trailer) { rel", {-hitchLength / 2, 0, 0.4}, 0, {hitchLength, 0.15, 0.15}, dark);
    for (const double y : {-axle, axle}) scene += "shape (trailer) { " + wheel(-hitchLength, y);
  }
  return Simulator(SimulatorDescription{.sceneName = "car", .sceneText = scene, .q = {}});
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
