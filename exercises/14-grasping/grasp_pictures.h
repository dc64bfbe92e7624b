#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "course/film_files.h"
#include "exercise.h"

// The objects of main(), and how it draws and films fingers on them. Sums and products are written out:
// Eigen's expressions would cost most of the time in which main.cpp compiles.

inline constexpr double kPi = std::numbers::pi;
inline const rex::Color kBlue{0.1f, 0.35f, 0.65f}, kRed{0.8f, 0.25f, 0.1f}, kGrey{0.62f, 0.64f, 0.67f},
    kBlack{0, 0, 0};
inline const std::vector<rex::Color> kFingerColors{
    {0, 0.45f, 0.7f}, {0.85f, 0.37f, 0}, {0, 0.62f, 0.45f}, {0.8f, 0.47f, 0.65f}};

inline const rex::Color& fingerColor(std::size_t finger) {
  return kFingerColors[finger % kFingerColors.size()];
}

// p + s d
inline Eigen::Vector2d ahead(const Eigen::Vector2d& p, double s, const Eigen::Vector2d& d) {
  return {p[0] + s * d[0], p[1] + s * d[1]};
}

inline Eigen::Vector3d ahead(const Eigen::Vector3d& p, double s, const Eigen::Vector3d& d) {
  return {p[0] + s * d[0], p[1] + s * d[1], p[2] + s * d[2]};
}

inline double inner(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Of length one.
inline Eigen::Vector3d unit(const Eigen::Vector3d& a) {
  return ahead({0, 0, 0}, 1 / std::sqrt(inner(a, a)), a);
}

// At right angles to both, of length one.
inline Eigen::Vector3d upright(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return unit({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
}

// A plate with a dent, counter-clockwise, its centre of mass near the origin.
inline std::vector<Eigen::Vector2d> plate() {
  return {{-0.08, -0.042}, {0.05, -0.05}, {0.085, 0.005}, {0.035, 0.045}, {0.005, 0.018}, {-0.06, 0.055}};
}

inline constexpr double kPlateLength = 0.0895;  // of its farthest corner from the origin

// The finger so many metres along the outline, from the first corner.
inline PlanarFinger fingerAt(const std::vector<Eigen::Vector2d>& corners, double way, double friction) {
  for (std::size_t i = 0;; i = (i + 1) % corners.size()) {
    const Eigen::Vector2d side = ahead(corners[(i + 1) % corners.size()], -1, corners[i]);
    const double size = std::hypot(side[0], side[1]);
    if (way <= size)
      return {ahead(corners[i], way / size, side), {-side[1] / size, side[0] / size}, friction};
    way -= size;
  }
}

inline rex::Region regionOf(const std::vector<Eigen::Vector2d>& corners, const rex::Color& color) {
  rex::Region region;
  region.color = color;
  for (const Eigen::Vector2d& corner : corners) {
    region.x.push_back(corner[0]);
    region.y.push_back(corner[1]);
  }
  return region;
}

inline void addPoint(rex::Figure& figure, const std::string& label, const rex::Color& color,
                     const std::vector<double>& at) {
  rex::Series point;
  point.label = label;
  point.x = {at[0]};
  point.y = {at[1]};
  if (at.size() > 2) point.z = {at[2]};
  point.style = rex::SeriesStyle::kPoints;
  point.marker = rex::Marker::kPlus;
  point.size = 2;
  point.color = color;
  figure.series.push_back(std::move(point));
}

// The object, and the directions into which each finger can push.
inline rex::Figure conesFigure(const std::string& title, const std::vector<Eigen::Vector2d>& corners,
                               const std::vector<PlanarFinger>& fingers) {
  rex::Figure figure;
  figure.title = title;
  figure.xLabel = "x [m]";
  figure.yLabel = "y [m]";
  figure.xRange = {-0.11, 0.11};
  figure.yRange = {-0.08, 0.08};
  figure.equalAxes = true;
  figure.legend = rex::Legend::kOutside;
  figure.width = 950;
  figure.height = 600;
  figure.regions.push_back(regionOf(corners, kGrey));
  constexpr double kCone = 0.025;  // m that a newton is long
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const PlanarFinger& finger = fingers[i];
    const double side = kCone * finger.friction;
    const Eigen::Vector2d across(-finger.normal[1], finger.normal[0]);
    const Eigen::Vector2d inside = ahead(finger.p, kCone, finger.normal);
    const Eigen::Vector2d from = ahead(finger.p, -0.8 * kCone, finger.normal);
    figure.regions.push_back(
        regionOf({finger.p, ahead(inside, side, across), ahead(inside, -side, across)}, fingerColor(i)));
    rex::Series body;
    body.label = "finger " + std::to_string(i + 1);
    body.x = {from[0], finger.p[0]};
    body.y = {from[1], finger.p[1]};
    body.size = 3;
    body.color = fingerColor(i);
    figure.series.push_back(std::move(body));
  }
  addPoint(figure, "center", kBlack, {0, 0});
  return figure;
}

inline void addLine(rex::Figure& figure, const std::vector<Eigen::Vector3d>& points, const rex::Color& color,
                    double size, const std::string& label = "") {
  rex::Series series;
  series.label = label;
  series.size = size;
  series.color = color;
  for (const Eigen::Vector3d& p : points) {
    series.x.push_back(p[0]);
    series.y.push_back(p[1]);
    series.z.push_back(p[2]);
  }
  figure.series.push_back(std::move(series));
}

// The ball around zero, as circles of latitude and longitude.
inline void addBall(rex::Figure& figure, double radius) {
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

// How many planes (one normal per column, with its offset) two points lie in; those that are the same count
// once.
inline int planesThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::MatrixXd& normals,
                         const Eigen::VectorXd& offsets) {
  std::vector<Eigen::Vector3d> planes;
  for (Eigen::Index f = 0; f < offsets.size(); ++f) {
    const Eigen::Vector3d normal(normals(0, f), normals(1, f), normals(2, f));
    bool isNew =
        std::abs(inner(normal, a) - offsets[f]) < 1e-9 && std::abs(inner(normal, b) - offsets[f]) < 1e-9;
    for (const Eigen::Vector3d& known : planes) isNew = isNew && inner(known, normal) < 1 - 1e-9;
    if (isNew) planes.push_back(normal);
  }
  return static_cast<int>(planes.size());
}

// A hull in space by its planes: an edge of it lies in two of them. A cross is where the nearest plane is
// nearest to zero.
inline rex::Figure hullFigure(const std::string& title, const Eigen::MatrixXd& points,
                              const Eigen::MatrixXd& normals, const Eigen::VectorXd& offsets) {
  rex::Figure figure;
  figure.title = title;
  figure.xLabel = "fx [N]";
  figure.yLabel = "fy [N]";
  figure.zLabel = "torque / length [N]";
  figure.equalAxes = true;
  figure.legend = rex::Legend::kTopRight;
  figure.width = 900;
  figure.height = 700;
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    corners.emplace_back(points(0, i), points(1, i), points(2, i));
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t other = 0; other < i; ++other)
      if (planesThrough(corners[i], corners[other], normals, offsets) > 1)
        addLine(figure, {corners[i], corners[other]}, kGrey, 1.5);
  for (std::size_t k = 0; k + 1 < corners.size(); k += 2) {
    addLine(figure, {corners[k], corners[k + 1]}, fingerColor(k / 2), 1.5,
            "wrenches of finger " + std::to_string(k / 2 + 1));
    figure.series.back().style = rex::SeriesStyle::kLinesPoints;
    figure.series.back().marker = rex::Marker::kCircle;
  }
  Eigen::Index nearest = 0;
  for (Eigen::Index f = 0; f < offsets.size(); ++f)
    if (offsets[f] < offsets[nearest]) nearest = f;
  if (offsets.size() > 0 && offsets[nearest] > 0)
    addPoint(figure, "nearest point of a face", kBlack,
             {offsets[nearest] * normals(0, nearest), offsets[nearest] * normals(1, nearest),
              offsets[nearest] * normals(2, nearest)});
  return figure;
}

// A mesh of corners, three for each triangle, flat.
inline rex::TriangleMesh meshOf(const std::vector<Eigen::Vector3d>& corners) {
  const auto inFloats = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3f(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  };
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<rex::TriangleMesh::Triangle> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const Eigen::Vector3d normal =
        upright(ahead(corners[i + 1], -1, corners[i]), ahead(corners[i + 2], -1, corners[i]));
    const auto first = static_cast<std::uint32_t>(i);
    triangles.push_back({first, first + 1, first + 2});
    for (std::size_t k = i; k < i + 3; ++k) {
      positions.push_back(inFloats(corners[k]));
      normals.push_back(inFloats(normal));
    }
  }
  return {positions, normals, triangles};
}

// A point of a ball, pushed out and bent to a point of a stone, 10 cm long.
inline Eigen::Vector3d onStone(const Eigen::Vector3d& ball) {
  const Eigen::Vector3d p = unit(ball);
  return {0.05 * p[0] + 0.008 * p[1] * p[2], 0.036 * p[1] + 0.01 * p[0] * p[0],
          0.031 * p[2] * (1 + 0.25 * p[0])};
}

// A stone of 80 triangles: those of an icosahedron, each cut in four.
inline std::vector<Eigen::Vector3d> stone() {
  const double g = std::numbers::phi;
  std::vector<Eigen::Vector3d> balls;
  for (const double a : {1., -1.})
    for (const double b : {g, -g}) {
      balls.emplace_back(0, a, b);
      balls.emplace_back(a, b, 0);
      balls.emplace_back(b, 0, a);
    }
  const auto near = [&](std::size_t i, std::size_t j) {
    const Eigen::Vector3d way = ahead(balls[i], -1, balls[j]);
    return inner(way, way) < 4.1;
  };
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t first = 0; first < balls.size(); ++first)
    for (std::size_t second = 0; second < first; ++second)
      for (std::size_t third = 0; third < second; ++third) {
        if (!near(first, second) || !near(second, third) || !near(third, first)) continue;
        const Eigen::Vector3d& c = balls[third];
        const bool isLeft = inner(upright(ahead(balls[second], -1, balls[first]), ahead(c, -1, balls[first])),
                                  balls[first]) > 0;
        const Eigen::Vector3d &a = balls[isLeft ? first : second], &b = balls[isLeft ? second : first];
        const Eigen::Vector3d ab = ahead(a, 1, b), bc = ahead(b, 1, c), ca = ahead(c, 1, a);
        for (const Eigen::Vector3d& p : {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca})
          corners.push_back(onStone(p));
      }
  return corners;
}

// A finger in the middle of every second triangle.
inline std::vector<Finger> fingersEverywhere(const std::vector<Eigen::Vector3d>& corners, double friction) {
  std::vector<Finger> fingers;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 6) {
    const Eigen::Vector3d &a = corners[i], &b = corners[i + 1], &c = corners[i + 2];
    const Eigen::Vector3d middle = ahead({0, 0, 0}, 1. / 3, ahead(ahead(a, 1, b), 1, c));
    fingers.push_back({middle, upright(ahead(c, -1, a), ahead(b, -1, a)), friction});
  }
  return fingers;
}

// The friction cone of a finger, outside of the object, from where it pushes.
inline rex::Solid coneSolid(const Finger& finger, const rex::Color& color) {
  constexpr double kSize = 0.02;  // m
  const Eigen::Vector3d& inward = finger.normal;
  const Eigen::Vector3d a =
      upright(inward, std::abs(inward[2]) < 0.9 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(1, 0, 0));
  const Eigen::Vector3d b = upright(a, inward), top = ahead(finger.p, -kSize, inward);
  const auto rim = [&](int k) {
    const double angle = 2 * kPi * k / 24, radius = kSize * finger.friction;
    return ahead(ahead(top, radius * std::cos(angle), a), radius * std::sin(angle), b);
  };
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 24; ++k)
    for (const Eigen::Vector3d& p : {finger.p, rim(k), rim(k + 1), top, rim(k + 1), rim(k)})
      corners.push_back(p);
  rex::Solid solid;
  solid.shape.type = rex::ShapeType::kMesh;
  solid.shape.mesh = meshOf(corners);
  solid.color = color;
  return solid;
}

// Which of them are kept.
inline std::vector<bool> marksOf(std::size_t fingers, const std::vector<int>& kept) {
  std::vector<bool> isKept(fingers, false);
  for (const int finger : kept) isKept[static_cast<std::size_t>(finger)] = true;
  return isKept;
}

// Adds a moment of the film: the stone, which turns, and its fingers behind it, of which those before `at`
// have gone unless they are kept; that at `at` is red if it goes next.
inline void addMoment(rex::Film& film, const std::vector<rex::Solid>& solids, const std::vector<bool>& isKept,
                      std::size_t at) {
  constexpr int kRate = 20;
  rex::Frame& frame = film.emplace_back();
  frame.time = static_cast<double>(film.size() - 1) / kRate;
  frame.picture.ground.visible = false;
  frame.picture.solids = solids;
  std::size_t left = 0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    rex::Solid& solid = frame.picture.solids[k];
    solid.X_WS = rex::rotation(0.4 * frame.time, {0, 0, 1});
    if (k == 0) continue;
    const bool goes = !isKept[k - 1];
    if (goes && k - 1 == at) solid.color = kRed;
    if (goes && k - 1 < at) solid.color.a = 0;
    if (!goes || k - 1 >= at) ++left;
  }
  frame.picture.captions.emplace_back().text = std::to_string(left) + " fingers";
}

// Fingers that are not kept turn red and vanish, one after the other, while the stone turns.
inline rex::Film filmOfDeletion(const std::vector<Eigen::Vector3d>& corners,
                                const std::vector<Finger>& fingers, const std::vector<int>& kept) {
  const std::vector<bool> isKept = marksOf(fingers.size(), kept);
  std::vector<rex::Solid> solids(1);
  solids[0].shape.type = rex::ShapeType::kMesh;
  solids[0].shape.mesh = meshOf(corners);
  solids[0].color = {0.72f, 0.7f, 0.66f};
  for (std::size_t k = 0; k < fingers.size(); ++k)
    solids.push_back(coneSolid(fingers[k], isKept[k] ? kBlue : kGrey));
  const std::vector<bool> all(fingers.size(), true);
  rex::Film film;
  for (int i = 0; i < 20; ++i) addMoment(film, solids, all, 0);
  if (kept.empty()) return film;
  for (std::size_t k = 0; k < fingers.size(); ++k)
    for (int i = 0; !isKept[k] && i < 8; ++i) addMoment(film, solids, isKept, k);
  for (int i = 0; i < 90; ++i) addMoment(film, solids, isKept, fingers.size());
  return film;
}

inline void writeDeletion(const std::string& name, const rex::Film& film) {
  rex::Shot shot;
  shot.camera = rex::lookAt({0.075, -0.195, 0.0975}, {0, 0, 0});
  rex::writeFilmVideo(film, shot, name, 20);
  rex::writeFilmSheet(film, shot, name + "_sheet.png", 6);
}
