#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "course/film_files.h"
#include "exercise.h"

// The objects of main(), and how it draws and films fingers on them.

inline constexpr double kPi = std::numbers::pi;
inline const rex::Color kBlue{0.1f, 0.35f, 0.65f}, kRed{0.8f, 0.25f, 0.1f}, kGrey{0.62f, 0.64f, 0.67f},
    kBlack{0, 0, 0};
inline const std::vector<rex::Color> kFingerColors{
    {0, 0.45f, 0.7f}, {0.85f, 0.37f, 0}, {0, 0.62f, 0.45f}, {0.8f, 0.47f, 0.65f}};

// A plate with a dent, counter-clockwise, its centre of mass near the origin.
inline std::vector<Eigen::Vector2d> plate() {
  return {{-0.08, -0.042}, {0.05, -0.05}, {0.085, 0.005}, {0.035, 0.045}, {0.005, 0.018}, {-0.06, 0.055}};
}

inline constexpr double kPlateLength = 0.0895;  // of its farthest corner from the origin

// The finger so many metres along the outline, from the first corner.
inline PlanarFinger fingerAt(const std::vector<Eigen::Vector2d>& corners, double way, double friction) {
  for (std::size_t i = 0;; i = (i + 1) % corners.size()) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
    const double size = side.norm();
    if (way <= size) return {corners[i] + way / size * side, {-side.y() / size, side.x() / size}, friction};
    way -= size;
  }
}

inline rex::Region regionOf(const std::vector<Eigen::Vector2d>& corners, const rex::Color& color) {
  rex::Region region{.color = color};
  for (const Eigen::Vector2d& corner : corners) {
    region.x.push_back(corner.x());
    region.y.push_back(corner.y());
  }
  return region;
}

// The object, and the directions into which each finger can push.
inline rex::Figure conesFigure(const std::string& title, const std::vector<Eigen::Vector2d>& corners,
                               const std::vector<PlanarFinger>& fingers) {
  rex::Figure figure{.title = title,
                     .xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .equalAxes = true,
                     .legend = rex::Legend::kOutside,
                     .width = 1000,
                     .height = 600};
  figure.regions.push_back(regionOf(corners, kGrey));
  constexpr double kCone = 0.025;  // m that a newton is long
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const PlanarFinger& finger = fingers[i];
    const rex::Color& color = kFingerColors[i % kFingerColors.size()];
    const Eigen::Vector2d left = kCone * finger.friction *
                                 Eigen::Vector2d(-finger.normal.y(), finger.normal.x()),
                          ahead = kCone * finger.normal;
    figure.regions.push_back(regionOf({finger.p, finger.p + ahead + left, finger.p + ahead - left}, color));
    const Eigen::Vector2d from = finger.p - 0.8 * ahead;
    figure.series.push_back({.label = "finger " + std::to_string(i + 1),
                             .x = {from.x(), finger.p.x()},
                             .y = {from.y(), finger.p.y()},
                             .size = 3,
                             .color = color});
  }
  figure.series.push_back({.label = "center",
                           .x = {0},
                           .y = {0},
                           .style = rex::SeriesStyle::kPoints,
                           .marker = rex::Marker::kPlus,
                           .size = 2,
                           .color = kBlack});
  return figure;
}

inline void addLine(rex::Figure& figure, const std::vector<Eigen::Vector3d>& points, const rex::Color& color,
                    double size, const std::string& label = "") {
  rex::Series series{.label = label, .size = size, .color = color};
  for (const Eigen::Vector3d& p : points) {
    series.x.push_back(p.x());
    series.y.push_back(p.y());
    series.z.push_back(p.z());
  }
  figure.series.push_back(series);
}

// The ball around zero, as circles of latitude and longitude.
inline void addBall(rex::Figure& figure, double radius) {
  for (int k = 0; k < 14; ++k) {
    std::vector<Eigen::Vector3d> circle;
    for (int i = 0; i <= 48; ++i) {
      const double around = 2 * kPi * i / 48;
      const double up = kPi * (k - 2.5) / 6, turn = kPi * (k - 6) / 8;
      circle.push_back(k < 6 ? Eigen::Vector3d(std::cos(up) * std::cos(around),
                                               std::cos(up) * std::sin(around), std::sin(up))
                             : Eigen::Vector3d(std::cos(turn) * std::cos(around),
                                               std::sin(turn) * std::cos(around), std::sin(around)));
      circle.back() *= radius;
    }
    addLine(figure, circle, kRed, 0.6, k == 0 ? "largest ball around zero" : "");
  }
}

// A hull in space: each edge of it lies in two of its planes (one per column, with their offsets).
inline rex::Figure hullFigure(const std::string& title, const Eigen::MatrixXd& points,
                              const Eigen::MatrixXd& normals, const Eigen::VectorXd& offsets) {
  rex::Figure figure{.title = title,
                     .xLabel = "fx [N]",
                     .yLabel = "fy [N]",
                     .zLabel = "torque / length [N]",
                     .equalAxes = true,
                     .legend = rex::Legend::kTopRight,
                     .width = 900,
                     .height = 700};
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      std::vector<Eigen::Vector3d> planes;
      for (Eigen::Index f = 0; f < offsets.size(); ++f) {
        const Eigen::Vector3d normal = normals.col(f);
        bool isNew = std::abs(normal.dot(points.col(i)) - offsets[f]) < 1e-9 &&
                     std::abs(normal.dot(points.col(j)) - offsets[f]) < 1e-9;
        for (const Eigen::Vector3d& known : planes) isNew = isNew && (known - normal).norm() > 1e-6;
        if (isNew) planes.push_back(normal);
      }
      if (planes.size() > 1) addLine(figure, {points.col(i), points.col(j)}, kGrey, 1.5);
    }
  for (Eigen::Index k = 0; k + 1 < points.cols(); k += 2) {
    const auto finger = static_cast<std::size_t>(k / 2);
    addLine(figure, {points.col(k), points.col(k + 1)}, kFingerColors[finger % kFingerColors.size()], 1.5,
            "wrenches of finger " + std::to_string(finger + 1));
    figure.series.back().style = rex::SeriesStyle::kLinesPoints;
    figure.series.back().marker = rex::Marker::kCircle;
  }
  return figure;
}

// A mesh of corners, three for each triangle, flat.
inline rex::TriangleMesh meshOf(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<rex::TriangleMesh::Triangle> triangles;
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

// A stone of 80 triangles, 10 cm long: the corners of an icosahedron and the middles of its edges, pushed
// out and bent.
inline std::vector<Eigen::Vector3d> stone() {
  const double g = (1 + std::sqrt(5)) / 2;
  const auto bent = [](const Eigen::Vector3d& q) {
    const Eigen::Vector3d p = q.normalized();
    return Eigen::Vector3d(0.05 * p.x() + 0.008 * p.y() * p.z(), 0.036 * p.y() + 0.01 * p.x() * p.x(),
                           0.031 * p.z() * (1 + 0.25 * p.x()));
  };
  std::vector<Eigen::Vector3d> balls;
  for (const double a : {1., -1.})
    for (const double b : {g, -g}) balls.insert(balls.end(), {{0, a, b}, {a, b, 0}, {b, 0, a}});
  std::vector<Eigen::Vector3d> corners;
  const auto near = [&](std::size_t i, std::size_t j) { return (balls[i] - balls[j]).norm() < 2.1; };
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        Eigen::Vector3d a = balls[i], b = balls[j];
        const Eigen::Vector3d c = balls[k];
        if ((b - a).cross(c - a).dot(a) < 0) std::swap(a, b);
        const Eigen::Vector3d ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
        for (const Eigen::Vector3d& p : {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca})
          corners.push_back(bent(p));
      }
  return corners;
}

// A finger in the middle of every triangle but a few.
inline std::vector<Finger> fingersEverywhere(const std::vector<Eigen::Vector3d>& corners, double friction) {
  std::vector<Finger> fingers;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 6)
    fingers.push_back({(corners[i] + corners[i + 1] + corners[i + 2]) / 3,
                       -(corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]).normalized(),
                       friction});
  return fingers;
}

// The friction cone of a finger, outside of the object, from where it pushes.
inline rex::Solid coneSolid(const Finger& finger, const rex::Color& color) {
  const Eigen::Vector3d out = -finger.normal;
  const Eigen::Vector3d side = std::abs(out.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d a = out.cross(side).normalized(), b = out.cross(a);
  const Eigen::Vector3d top = finger.p + 0.02 * out;
  std::vector<Eigen::Vector3d> corners;
  const auto rim = [&](int k) {
    const double angle = 2 * kPi * k / 24;
    return Eigen::Vector3d(top + 0.02 * finger.friction * (std::cos(angle) * a + std::sin(angle) * b));
  };
  for (int k = 0; k < 24; ++k)
    for (const Eigen::Vector3d& p : {finger.p, rim(k), rim(k + 1), top, rim(k + 1), rim(k)})
      corners.push_back(p);
  return {.shape = {.type = rex::ShapeType::kMesh, .mesh = meshOf(corners)}, .color = color};
}

// Fingers that are not kept turn red and vanish, one after the other, while the stone turns.
inline rex::Film filmOfDeletion(const std::vector<Eigen::Vector3d>& corners,
                                const std::vector<Finger>& fingers, const std::vector<int>& kept) {
  constexpr int kFrames = 8, kRest = 90, kRate = 20;
  std::vector<bool> isKept(fingers.size(), false);
  for (const int finger : kept) isKept[static_cast<std::size_t>(finger)] = true;
  std::vector<rex::Solid> solids{
      {.shape = {.type = rex::ShapeType::kMesh, .mesh = meshOf(corners)}, .color = {0.72f, 0.7f, 0.66f}}};
  for (std::size_t k = 0; k < fingers.size(); ++k)
    solids.push_back(coneSolid(fingers[k], isKept[k] ? kBlue : kGrey));
  rex::Film film;
  // All before the finger `at` are decided, and `isDecided` says whether it turns red.
  const auto add = [&](std::size_t at, bool isDecided) {
    const double time = static_cast<double>(film.size()) / kRate;
    rex::Picture picture{.ground = {.visible = false}};
    std::size_t left = 0;
    for (std::size_t k = 0; k < solids.size(); ++k) {
      const bool isGone = k > 0 && k - 1 < at && !isKept[k - 1];
      if (k > 0 && !isGone) ++left;
      picture.solids.push_back(solids[k]);
      rex::Solid& solid = picture.solids.back();
      if (k > 0 && k - 1 == at && isDecided) solid.color = kRed;
      solid.X_WS = rex::rotation(0.4 * time, Eigen::Vector3d::UnitZ());
      if (isGone) solid.color.a = 0;
    }
    picture.captions.push_back({.text = std::to_string(left) + " fingers"});
    film.push_back({.time = time, .picture = picture});
  };
  for (int i = 0; i < 20; ++i) add(0, false);
  if (kept.empty()) return film;
  for (std::size_t k = 0; k < fingers.size(); ++k)
    for (int i = 0; !isKept[k] && i < kFrames; ++i) add(k, true);
  for (int i = 0; i < kRest; ++i) add(fingers.size(), false);
  return film;
}

inline void writeDeletion(const std::string& name, const rex::Film& film) {
  const rex::Shot shot{.camera = rex::lookAt({0.1, -0.26, 0.13}, {0, 0, 0}), .width = 640, .height = 480};
  rex::writeFilmVideo(film, shot, name, 20);
  rex::writeFilmSheet(film, shot, name + "_sheet.png", 6);
}
