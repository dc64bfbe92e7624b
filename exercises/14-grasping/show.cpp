#include "show.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include "course/film.h"
#include "geometry/facet_hull.h"
#include "grasping/quality.h"

using namespace rex;

namespace {

std::string text(const char* format, double number) {
  char all[32];
  std::snprintf(all, sizeof all, format, number);
  return all;
}

constexpr double kPi = std::numbers::pi;
const Color kBlue{0.1f, 0.35f, 0.65f}, kRed{0.8f, 0.25f, 0.1f}, kGrey{0.62f, 0.64f, 0.67f}, kBlack{0, 0, 0};
const std::vector<Color> kFingerColors{
    {0, 0.45f, 0.7f}, {0.85f, 0.37f, 0}, {0, 0.62f, 0.45f}, {0.8f, 0.47f, 0.65f}};

const Color& fingerColor(std::size_t finger) { return kFingerColors[finger % kFingerColors.size()]; }

// A plate with a dent, counter-clockwise, its centre of mass near the origin.
std::vector<Eigen::Vector2d> plate() {
  return {{-0.08, -0.042}, {0.05, -0.05}, {0.085, 0.005}, {0.035, 0.045}, {0.005, 0.018}, {-0.06, 0.055}};
}

constexpr double kPlateLength = 0.0895;  // distance of its farthest corner from the origin [m]

// The finger `way` metres along the outline, from the first corner.
PlanarFinger fingerAt(const std::vector<Eigen::Vector2d>& corners, double way, double friction) {
  for (std::size_t i = 0;; i = (i + 1) % corners.size()) {
    const std::size_t next = (i + 1) % corners.size();
    const Eigen::Vector2d side = corners[next] - corners[i];
    const double size = side.norm();
    if (way <= size) return {corners[i] + way / size * side, {-side[1] / size, side[0] / size}, friction};
    way -= size;
  }
}

void addPoint(Figure& figure, const std::string& label, const Color& color, const Eigen::VectorXd& at) {
  figure.series.push_back(dots(at, {.label = label, .marker = Marker::kPlus, .size = 2, .color = color}));
  if (at.size() > 2) figure.series.back().z = {at[2]};
}

// The object, and the directions into which each finger can push.
Figure conesFigure(const std::string& title, const std::vector<Eigen::Vector2d>& corners,
                   const std::vector<PlanarFinger>& fingers) {
  Figure figure = planeFigure({.title = title,
                               .xRange = AxisRange{-0.11, 0.11},
                               .yRange = AxisRange{-0.08, 0.08},
                               .legend = Legend::kOutside,
                               .regions = {within(corners, {.color = kGrey})},
                               .width = 950,
                               .height = 600});
  constexpr double kCone = 0.025;  // length of a newton [m]
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const PlanarFinger& finger = fingers[i];
    const double side = kCone * finger.friction;
    const Eigen::Vector2d across(-finger.normal[1], finger.normal[0]);
    const Eigen::Vector2d inside = finger.p + kCone * finger.normal;
    const Eigen::Vector2d from = finger.p - 0.8 * kCone * finger.normal;
    const std::vector<Eigen::Vector2d> cone{finger.p, inside + side * across, inside - side * across};
    figure.regions.push_back(within(cone, {.color = fingerColor(i)}));
    figure.series.push_back(through(
        {from, finger.p}, {.label = "finger " + std::to_string(i + 1), .size = 3, .color = fingerColor(i)}));
  }
  addPoint(figure, "centre", kBlack, Eigen::Vector2d::Zero());
  return figure;
}

void addLine(Figure& figure, const std::vector<Eigen::Vector3d>& points, const Color& color, double size,
             const std::string& label = "") {
  figure.series.push_back(through(points, {.label = label, .size = size, .color = color}));
  for (const Eigen::Vector3d& p : points) figure.series.back().z.push_back(p[2]);
}

// The ball around zero, as circles of latitude and longitude.
void addBall(Figure& figure, double radius) {
  for (int k = 0; k < 14; ++k) {
    std::vector<Eigen::Vector3d> circle;
    const double up = kPi * (k - 2.5) / 6, turn = kPi * (k - 6) / 8;
    for (int i = 0; i <= 48; ++i) {
      const double c = radius * std::cos(2 * kPi * i / 48), s = radius * std::sin(2 * kPi * i / 48);
      if (k < 6)
        circle.emplace_back(std::cos(up) * c, std::cos(up) * s, radius * std::sin(up));
      else
        circle.emplace_back(std::cos(turn) * c, std::sin(turn) * c, s);
    }
    addLine(figure, circle, kRed, 0.6, k == 0 ? "largest ball around zero" : "");
  }
}

// How many planes (one normal per column, with its offset) two points lie in; identical planes count once.
int planesThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::MatrixXd& normals,
                  const Eigen::VectorXd& offsets) {
  std::vector<Eigen::Vector3d> planes;
  for (Eigen::Index f = 0; f < offsets.size(); ++f) {
    const Eigen::Vector3d normal = normals.col(f);
    bool isNew = std::abs(normal.dot(a) - offsets[f]) < 1e-9 && std::abs(normal.dot(b) - offsets[f]) < 1e-9;
    for (const Eigen::Vector3d& known : planes) isNew = isNew && known.dot(normal) < 1 - 1e-9;
    if (isNew) planes.push_back(normal);
  }
  return static_cast<int>(planes.size());
}

// A hull in space by its planes: an edge of it lies in two of them. A cross is where the nearest plane is
// nearest to zero.
Figure hullFigure(const std::string& title, const Eigen::MatrixXd& points) {
  const FacetHull hull = facetHull(points);
  const Eigen::MatrixXd& normals = hull.normals;
  const Eigen::VectorXd& offsets = hull.offsets;
  Figure figure{.title = title,
                .xLabel = "fx [N]",
                .yLabel = "fy [N]",
                .zLabel = "torque / length [N]",
                .equalAxes = true,
                .legend = Legend::kTopRight,
                .width = 900,
                .height = 700};
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index i = 0; i < points.cols(); ++i) corners.emplace_back(points.col(i));
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t other = 0; other < i; ++other)
      if (planesThrough(corners[i], corners[other], normals, offsets) > 1)
        addLine(figure, {corners[i], corners[other]}, kGrey, 1.5);
  for (std::size_t k = 0; k + 1 < corners.size(); k += 2) {
    addLine(figure, {corners[k], corners[k + 1]}, fingerColor(k / 2), 1.5,
            "wrenches of finger " + std::to_string(k / 2 + 1));
    figure.series.back().style = SeriesStyle::kLinesPoints;
    figure.series.back().marker = Marker::kCircle;
  }
  addPoint(figure, "zero", kRed, Eigen::Vector3d::Zero());
  Eigen::Index nearest = 0;
  for (Eigen::Index f = 0; f < offsets.size(); ++f)
    if (offsets[f] < offsets[nearest]) nearest = f;
  if (offsets.size() > 0 && offsets[nearest] > 0)
    addPoint(figure, "nearest point of a face", kBlack,
             Eigen::VectorXd(offsets[nearest] * normals.col(nearest)));
  return figure;
}

// A mesh of corners, three for each triangle, flat.
TriangleMesh meshOf(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const Eigen::Vector3d normal =
        (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]).normalized();
    const auto first = static_cast<std::uint32_t>(i);
    triangles.push_back({first, first + 1, first + 2});
    for (std::size_t k = i; k < i + 3; ++k) {
      positions.push_back(corners[k].cast<float>());
      normals.push_back(normal.cast<float>());
    }
  }
  return {positions, normals, triangles};
}

// A point of a ball, pushed out and bent to a point of a stone, 10 cm long.
Eigen::Vector3d onStone(const Eigen::Vector3d& ball) {
  const Eigen::Vector3d p = ball.normalized();
  return {0.05 * p[0] + 0.008 * p[1] * p[2], 0.036 * p[1] + 0.01 * p[0] * p[0],
          0.031 * p[2] * (1 + 0.25 * p[0])};
}

// A stone of 80 triangles: those of an icosahedron, each cut in four.
std::vector<Eigen::Vector3d> stone() {
  const double g = std::numbers::phi;
  std::vector<Eigen::Vector3d> balls;
  for (const double a : {1., -1.})
    for (const double b : {g, -g}) {
      balls.emplace_back(0, a, b);
      balls.emplace_back(a, b, 0);
      balls.emplace_back(b, 0, a);
    }
  const auto near = [&](std::size_t i, std::size_t j) { return (balls[i] - balls[j]).squaredNorm() < 4.1; };
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t first = 0; first < balls.size(); ++first)
    for (std::size_t second = 0; second < first; ++second)
      for (std::size_t third = 0; third < second; ++third) {
        if (!near(first, second) || !near(second, third) || !near(third, first)) continue;
        const Eigen::Vector3d& c = balls[third];
        const bool isLeft = ((balls[second] - balls[first]).cross(c - balls[first])).dot(balls[first]) > 0;
        const Eigen::Vector3d &a = balls[isLeft ? first : second], &b = balls[isLeft ? second : first];
        const Eigen::Vector3d ab = a + b, bc = b + c, ca = c + a;
        for (const Eigen::Vector3d& p : {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca})
          corners.push_back(onStone(p));
      }
  return corners;
}

// A finger in the middle of every second triangle.
std::vector<Finger> fingersEverywhere(const std::vector<Eigen::Vector3d>& corners, double friction) {
  std::vector<Finger> fingers;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 6) {
    const Eigen::Vector3d &a = corners[i], &b = corners[i + 1], &c = corners[i + 2];
    const Eigen::Vector3d middle = (a + b + c) / 3;
    fingers.push_back({middle, (c - a).cross(b - a).normalized(), friction});
  }
  return fingers;
}

// The friction cone of a finger, outside of the object, from where it pushes.
Solid coneSolid(const Finger& finger, const Color& color) {
  constexpr double kSize = 0.02;  // m
  const Eigen::Vector3d& inward = finger.normal;
  const Eigen::Vector3d a =
      inward.cross(Eigen::Vector3d::Unit(std::abs(inward[2]) < 0.9 ? 2 : 0)).normalized();
  const Eigen::Vector3d b = a.cross(inward), top = finger.p - kSize * inward;
  const auto rim = [&](int k) {
    const double angle = 2 * kPi * k / 24, radius = kSize * finger.friction;
    return Eigen::Vector3d(top + radius * (std::cos(angle) * a + std::sin(angle) * b));
  };
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 24; ++k)
    for (const Eigen::Vector3d& p : {finger.p, rim(k), rim(k + 1), top, rim(k + 1), rim(k)})
      corners.push_back(p);
  Solid solid;
  solid.shape.type = ShapeType::kMesh;
  solid.shape.mesh = meshOf(corners);
  solid.color = color;
  return solid;
}

// For each finger, whether it is kept.
std::vector<bool> marksOf(std::size_t fingers, const std::vector<int>& kept) {
  std::vector<bool> isKept(fingers, false);
  for (const int finger : kept) isKept[static_cast<std::size_t>(finger)] = true;
  return isKept;
}

// Adds a frame to the film: the turning stone and its fingers. Those before `at` that are not kept have
// vanished; the one at `at` is red if it is not kept either.
void addMoment(Film& film, const std::vector<Solid>& solids, const std::vector<bool>& isKept,
               std::size_t at) {
  constexpr int kRate = 20;
  Frame& frame = film.emplace_back();
  frame.time = static_cast<double>(film.size() - 1) / kRate;
  frame.picture.ground.visible = false;
  frame.picture.solids = solids;
  std::size_t left = 0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    Solid& solid = frame.picture.solids[k];
    solid.X_WS = rotation(0.4 * frame.time, {0, 0, 1});
    if (k == 0) continue;
    const bool goes = !isKept[k - 1];
    if (goes && k - 1 == at) solid.color = kRed;
    if (goes && k - 1 < at) solid.color.a = 0;
    if (!goes || k - 1 >= at) ++left;
  }
  frame.picture.captions.emplace_back().text = std::to_string(left) + " fingers";
}

// Fingers that are not kept turn red and vanish, one after the other, while the stone turns.
Film filmOfDeletion(const std::vector<Eigen::Vector3d>& corners, const std::vector<Finger>& fingers,
                    const std::vector<int>& kept) {
  const std::vector<bool> isKept = marksOf(fingers.size(), kept);
  std::vector<Solid> solids(1);
  solids[0].shape.type = ShapeType::kMesh;
  solids[0].shape.mesh = meshOf(corners);
  solids[0].color = {0.72f, 0.7f, 0.66f};
  for (std::size_t k = 0; k < fingers.size(); ++k)
    solids.push_back(coneSolid(fingers[k], isKept[k] ? kBlue : kGrey));
  const std::vector<bool> all(fingers.size(), true);
  Film film;
  for (int i = 0; i < 20; ++i) addMoment(film, solids, all, 0);
  if (kept.empty()) return film;
  for (std::size_t k = 0; k < fingers.size(); ++k)
    for (int i = 0; !isKept[k] && i < 8; ++i) addMoment(film, solids, isKept, k);
  for (int i = 0; i < 90; ++i) addMoment(film, solids, isKept, fingers.size());
  return film;
}

Eigen::MatrixXd wrenchesOnPlate(const std::vector<PlanarFinger>& fingers) {
  return planarWrenches(fingers, Eigen::Vector2d::Zero(), kPlateLength);
}

// Two fingers on opposite sides.
Eigen::MatrixXd oppositeWrenches(double friction) {
  return planarWrenches({{{-1, 0}, {1, 0}, friction}, {{1, 0}, {-1, 0}, friction}}, Eigen::Vector2d::Zero(),
                        1);
}

// A cube with half edges of 1 and a finger in the middle of each face.
Eigen::MatrixXd cubeWrenches(double friction, int edges) {
  std::vector<Finger> fingers;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1., -1.})
      fingers.push_back({side * Eigen::Vector3d::Unit(axis), -side * Eigen::Vector3d::Unit(axis), friction});
  return spatialWrenches(fingers, edges, Eigen::Vector3d::Zero(), 1);
}

std::vector<int> keptOnStone(const std::vector<Finger>& fingers) {
  constexpr int kEdges = 8;
  std::vector<int> owner;
  for (std::size_t k = 0; k < fingers.size() * kEdges; ++k) owner.push_back(static_cast<int>(k / kEdges));
  return keptFingers(spatialWrenches(fingers, kEdges, Eigen::Vector3d::Zero(), 0.05), owner);
}

}  // namespace

void showCone(double friction, int edges) {
  const Finger finger{{0, 0, 0}, {0, 0, 1}, friction};
  const Eigen::MatrixXd pyramid = pyramidEdges(finger, edges);
  if (pyramid.isZero()) return nothingYet("the pyramid");
  Figure figure{.title = "The friction cone, cut one newton along the normal: inside is yellow",
                .xLabel = "force along the surface, x [N]",
                .yLabel = "force along the surface, y [N]",
                .colorLabel = "inCone()",
                .equalAxes = true,
                .legend = Legend::kTopRight,
                .width = 700,
                .height = 600};
  const auto isInside = [&](double x, double y) { return inCone(finger, {x, y, 1}) ? 1. : 0.; };
  const AxisRange range{-1.4 * friction, 1.4 * friction};
  figure.heatMap = sampledHeatMap(isInside, range, range, 140, 140);
  figure.colorRange = {0, 1};
  Series edge{.label = "edges of the pyramid",
              .style = SeriesStyle::kLinesPoints,
              .marker = Marker::kDot,
              .color = kRed};
  for (Eigen::Index i = 0; i <= pyramid.cols(); ++i)
    edge.add(pyramid(0, i % pyramid.cols()), pyramid(1, i % pyramid.cols()));
  figure.series.push_back(edge);
  plot("pyramid", figure);
}

void showWrenches(double friction, const std::vector<double>& ways) {
  std::vector<PlanarFinger> fingers;
  for (const double way : ways) fingers.push_back(fingerAt(plate(), way, friction));
  const Eigen::MatrixXd W = wrenchesOnPlate(fingers);
  if (W.isZero()) return nothingYet("wrenches");
  plot("contacts", conesFigure("Three fingers, and the forces that they can exert", plate(), fingers));
  plot("wrenches", hullFigure("The hull of their wrenches", W));
}

void showVerdicts(const std::vector<double>& frictions) {
  for (const double friction : frictions) {
    const Verdict verdict = judged(cubeWrenches(friction, 8));
    if (!verdict.closed && verdict.proof.isZero()) return nothingYet("verdicts");
    std::printf("a cube with a finger on each face, friction %.1f: %s\n", friction,
                verdict.closed ? "closed" : "open");
    if (verdict.closed)
      std::printf("  smallest weight %.4f, largest %.4f\n", verdict.proof.minCoeff(),
                  verdict.proof.maxCoeff());
    else
      print("  nothing opposes the wrench", Eigen::MatrixXd(verdict.proof.transpose()));
  }
}

void showMap(double friction) {
  if (epsilonOf(oppositeWrenches(friction)) == 0) return nothingYet("epsilon");
  double around = 0;
  const std::vector<Eigen::Vector2d> corners = plate();
  Figure figure{.title = "Two fingers, friction " + text("%.1f", friction) + ": where to put them",
                .xLabel = "first finger, along the outline [m]",
                .yLabel = "second finger, along the outline [m]",
                .colorLabel = "epsilon [N]",
                .equalAxes = true,
                .legend = Legend::kNone,
                .width = 800,
                .height = 700};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const Eigen::Vector2d side = corners[next] - corners[i];
    around += side.norm();
    if (i + 1 == corners.size()) break;
    figure.verticalLines.push_back({.at = around, .color = kGrey});
    figure.horizontalLines.push_back({.at = around, .color = kGrey});
  }
  const auto quality = [&](double a, double b) {
    return epsilonOf(wrenchesOnPlate({fingerAt(corners, a, friction), fingerAt(corners, b, friction)}));
  };
  figure.heatMap = sampledHeatMap(quality, {0, around}, {0, around}, 150, 150);
  figure.colorRange = {0, std::max(0.1, figure.heatMap->values.maxCoeff())};
  plot("map", figure);
}

void showFriction() {
  if (epsilonOf(oppositeWrenches(.8)) == 0) return;
  Figure figure{.title = "What friction does", .xLabel = "friction [1]", .yLabel = "epsilon [N]"};
  Series two{.label = "two fingers, yours", .size = 5, .color = Color{1, 0.85f, 0.3f}},
      law{.label = "mu / sqrt(2 + mu^2)", .dashed = true, .color = kBlack},
      cube{.label = "cube, 8 edges, yours", .size = 5, .color = Color{0.6f, 0.8f, 1}},
      cubeLaw{.label = "mu sqrt(2/3)", .dashed = true, .color = kBlue},
      coarse{.label = "cube, 4 edges, yours", .style = SeriesStyle::kPoints, .color = kRed};
  for (int i = 1; i <= 20; ++i) {
    const double mu = 0.04 * i;
    for (Series* series : {&two, &law, &cube, &cubeLaw, &coarse}) series->x.push_back(mu);
    two.y.push_back(epsilonOf(oppositeWrenches(mu)));
    law.y.push_back(mu / std::sqrt(2 + mu * mu));
    cubeLaw.y.push_back(mu * std::sqrt(2. / 3));
    for (const int edges : {4, 8}) {
      const Eigen::MatrixXd W = cubeWrenches(mu, edges);
      const Eigen::VectorXd direction = graspQuality(W).weakest;
      (edges == 4 ? coarse : cube).y.push_back(direction.size() > 0 ? reachAlong(W, direction) : 0);
    }
  }
  figure.series = {two, law, cube, cubeLaw, coarse};
  plot("friction", figure);
}

void showDeletion(const std::vector<double>& frictions) {
  for (const double friction : frictions) {
    const std::vector<Finger> fingers = fingersEverywhere(stone(), friction);
    const std::vector<int> kept = keptOnStone(fingers);
    if (kept.empty()) return nothingYet("fewer fingers");
    std::printf("a stone, friction %.2f: %zu of %zu fingers are kept\n", friction, kept.size(),
                fingers.size());
    if (friction == frictions.back())
      writeFilm(filmOfDeletion(stone(), fingers, kept), "deletion",
                {.camera = lookAt({0.075, -0.195, 0.0975}, {0, 0, 0})});
  }
}

void showGrasp(double friction, int count) {
  const std::vector<PlanarFinger> fingers =
      bestGrasp(plate(), Eigen::Vector2d::Zero(), kPlateLength, friction, count);
  if (fingers.empty()) return nothingYet("a good grasp");
  const Eigen::MatrixXd W = wrenchesOnPlate(fingers);
  const double yours = epsilonOf(W);
  std::printf("three fingers on the plate: epsilon %.6f N, by the library %.6f N\n", yours,
              graspQuality(W).epsilon);
  const std::string title =
      "Three fingers, friction " + text("%.1f", friction) + ": epsilon = " + text("%.3f", yours) + " N";
  plot("cones", conesFigure(title, plate(), fingers));
  Figure figure = hullFigure("The hull of the wrenches of three fingers", W);
  if (yours > 0) addBall(figure, yours);
  plot("hull", figure);
}
