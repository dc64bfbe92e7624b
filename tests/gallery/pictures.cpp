#include "gallery/pictures.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "base/rng.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "kinematics/inverse_kinematics.h"
#include "kinematics/jacobians.h"
#include "render/contact_sheet.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "support/paths.h"

namespace rex::gallery {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 560, kHeight = 420;  // pixels
constexpr Color kOrange{0.84f, 0.37f, 0.0f}, kBlue{0.0f, 0.45f, 0.7f}, kGreen{0.0f, 0.62f, 0.45f},
    kRed{0.80f, 0.10f, 0.12f}, kGrey{0.62f, 0.64f, 0.67f}, kSand{0.78f, 0.66f, 0.50f};

Image drawn(const Picture& picture, const Vector3d& direction = kDefaultView, int height = kHeight) {
  const double aspect = static_cast<double>(kWidth) / height;
  return Renderer({.width = kWidth, .height = height})
      .draw(picture, framing(bounds(picture), direction, aspect));
}

Image drawnForSlide(const Picture& picture, const Bounds& shown, const Vector3d& direction) {
  return Renderer({.width = kSlideWidth, .height = kSlideHeight})
      .draw(picture, framing(shown, direction, 4. / 3));
}

Model robot(const std::string& name) {
  return compile(
      readScene(sourcePath("data/robots") / (name + (name == "humanoid" ? "/humanoid.urdf" : ".ors"))).spec);
}

// The postures of a robot whose body goes once around a circle in front of it.
std::vector<Eigen::VectorXd> circling(const Model& model, BodyId hand, const Vector3d& middle, double radius,
                                      int count) {
  Eigen::VectorXd q = model.initialPositions();
  std::vector<Eigen::VectorXd> postures;
  for (int t = -40; t < count; ++t) {
    const double angle = 2 * std::numbers::pi * std::max(t, 0) / (count - 1);
    const Vector3d wanted = middle + radius * Vector3d(std::cos(angle), 0, std::sin(angle));
    const BodyPoses poses = forwardKinematics(model, q);
    const Eigen::Matrix3Xd J = positionJacobian(model, poses, hand, Vector3d::Zero());
    q += inverseKinematicsStep(J, wanted - poses[hand].p, 1e-4);
    if (t >= 0) postures.push_back(q);
  }
  return postures;
}

Image motion() {
  const Model model = robot("man");
  const BodyId hand = model.body("handR");
  const Vector3d middle(-0.2, -0.4, 1.1);
  const auto postures = circling(model, hand, middle, 0.2, 100);
  Picture picture = scenePicture(model, forwardKinematics(model, postures.back()));
  Polyline way{.color = kOrange, .width = 3};
  for (const auto& q : postures) way.points.push_back(forwardKinematics(model, q)[hand].p);
  picture.polylines.push_back(way);
  picture.pointSets.push_back({.points = {middle}, .color = kRed, .size = 9});
  picture.labels.push_back({.text = "target", .p_WQ = middle});
  picture.captions.push_back({.text = "the right hand on a circle"});
  return drawn(picture);
}

Image views() {
  const Model model = robot("humanoid");
  const Picture picture = scenePicture(model, forwardKinematics(model, model.initialPositions()));
  constexpr int kView = 420;
  Renderer renderer({.width = kView, .height = kView});
  const std::array<std::pair<const char*, Vector3d>, 3> cameras = {
      {{"from the front", {1, 0, 0.25}}, {"from the left", {0, 1, 0.25}}, {"from above", {0.001, 0, 1}}}};
  std::vector<KeyFrame> frames;
  for (const auto& [name, direction] : cameras)
    frames.push_back({renderer.draw(picture, framing(bounds(picture), direction, 1)), name});
  return contactSheet(frames);
}

// A closed band around a tube, two materials: what a mesh file may hold.
TriangleMesh ring(double radius, double tube, int around, int across) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto vertex = [&](int i, int k) {
    return static_cast<std::uint32_t>((i % around) * across + k % across);
  };
  for (int i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * i / around;
    for (int k = 0; k < across; ++k) {
      const double v = 2 * std::numbers::pi * k / across;
      const Vector3d n(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
      normals.push_back(n.cast<float>());
      positions.push_back((radius * Vector3d(std::cos(u), std::sin(u), 0) + tube * n).cast<float>());
      triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
      triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
    }
  }
  const auto half = static_cast<std::uint32_t>(triangles.size() / 2);
  return {positions,
          normals,
          triangles,
          {{.color = Eigen::Vector4f(0.84f, 0.37f, 0.f, 1), .firstTriangle = 0, .triangleCount = half},
           {.color = Eigen::Vector4f(0.0f, 0.45f, 0.7f, 1), .firstTriangle = half, .triangleCount = half}}};
}

Image shapes() {
  Picture picture;
  const auto add = [&](const Shape& shape, const Vector3d& p, const Color& color, const char* name,
                       const Vector3d& turn = Vector3d::Zero()) {
    picture.solids.push_back({shape, {expSO3(turn), p}, color, name});
    const bool inFront = p.y() < 0.5;
    picture.labels.push_back(
        {.text = name,
         .p_WQ = inFront ? Vector3d(p.x() - 0.2, p.y() - 0.4, 0) : Vector3d(p.x() - 0.25, p.y(), 0.85)});
  };
  add({ShapeType::kBox, {0.4, 0.4, 0.5}, 0}, {-1.5, 0, 0.25}, kSand, "box");
  add({ShapeType::kRoundedBox, {0.45, 0.45, 0.5}, 0.1}, {-0.75, 0, 0.25}, kGreen, "rounded box");
  add({.type = ShapeType::kSphere, .radius = 0.28}, {0, 0, 0.28}, kRed, "sphere");
  add({ShapeType::kCapsule, {0, 0, 0.4}, 0.15}, {0.75, 0, 0.35}, kBlue, "capsule");
  add({ShapeType::kCylinder, {0, 0, 0.55}, 0.2}, {1.5, 0, 0.275}, kGrey, "cylinder");
  add({.type = ShapeType::kMesh, .mesh = ring(0.28, 0.1, 64, 24)}, {-1.1, 1.1, 0.38}, kGrey, "mesh",
      {std::numbers::pi / 2, 0, 0});
  add({.type = ShapeType::kPointCloud,
       .mesh = TriangleMesh(
           [] {
             Rng rng(1);
             std::vector<Eigen::Vector3f> points;
             for (int i = 0; i < 1500; ++i)
               points.push_back(
                   (0.35 * rng.normalVector(3).normalized() + Vector3d(0, 0, 0.35)).cast<float>());
             return points;
           }(),
           {}, {})},
      {0, 1.1, 0}, kBlue, "point cloud");
  add({.type = ShapeType::kSphere, .radius = 0.3}, {1.1, 1.1, 0.3}, {0.1f, 0.6f, 0.5f, 0.4f}, "translucent");
  return drawn(picture, {0.1, -2, 0.75}, 300);
}

Image frames() {
  const Model model = robot("pegArm");
  const Eigen::VectorXd q = Vector3d(0.2, 0.35, 0.35);
  const BodyPoses poses = forwardKinematics(model, q);
  Picture picture = scenePicture(model, poses);
  for (Solid& solid : picture.solids) solid.color.a = 0.6f;
  picture.ground.visible = false;
  const BodyId peg = model.body("peg");
  const Eigen::Matrix3Xd J = positionJacobian(model, poses, peg, Vector3d::Zero());
  for (const Joint& joint : model.joints()) picture.axes.push_back({.X_WF = poses[joint.child], .size = 0.2});
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    picture.arrows.push_back({.from = poses[peg].p,
                              .to = poses[peg].p + 0.6 * J.col(k),
                              .color = {1.0f, 0.6f, 0.0f},
                              .radius = 0.012});
    picture.labels.push_back(
        {.text = "J" + std::to_string(k + 1), .p_WQ = poses[peg].p + 0.65 * J.col(k), .scale = 2.5});
  }
  return drawnForSlide(picture, bounds(picture), {2, -0.6, 0.5});
}

Image particles() {
  Rng rng(7);
  Picture picture;
  const std::array<Vector3d, 3> landmarks = {Vector3d(1.2, 0.8, 0.15), {-0.6, 1.3, 0.15}, {-1.1, -0.5, 0.15}};
  const std::array<double, 3> turns = {0.4, 1.2, -0.6};
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::Matrix3d R = rotationAboutAxis(turns[i], Vector3d::UnitZ());
    const Eigen::Matrix3d covariance = R * Vector3d(0.02, 0.004, 0.003).asDiagonal() * R.transpose();
    picture.ellipsoids.push_back(covarianceEllipsoid(landmarks[i], covariance, 2));
    picture.solids.push_back({.shape = {.type = ShapeType::kSphere, .radius = 0.05},
                              .X_WS = {.p = landmarks[i]},
                              .color = kOrange});
    picture.labels.push_back({.text = "landmark " + std::to_string(i + 1),
                              .p_WQ = landmarks[i] + Vector3d(-0.2, -0.3, -0.15),
                              .scale = 2});
  }
  PointSet samples{.color = kBlue, .size = 5};
  for (int i = 0; i < 800; ++i) {
    const Eigen::VectorXd n = rng.normalVector(2);
    const double bend = 0.35 * n[0];
    samples.points.emplace_back(0.55 * std::sin(bend) + 0.06 * n[1] - 0.1,
                                -0.3 + 0.55 * (1 - std::cos(bend)) + 0.06 * n[1], 0.02);
  }
  picture.pointSets.push_back(samples);
  // The car is above the points, which would show through it.
  picture.solids.push_back(
      {.shape = {.extent = {0.24, 0.13, 0.06}}, .X_WS = {.p = {-0.1, -0.3, 0.2}}, .color = kGrey});
  picture.arrows.push_back(
      {.from = {-0.1, -0.3, 0.25}, .to = {0.3, -0.3, 0.25}, .color = kRed, .radius = 0.015});
  picture.labels.push_back({.text = "car and its heading", .p_WQ = {0.35, -0.35, 0.25}, .scale = 2});
  picture.captions.push_back({.text = "800 particles; landmarks within 2 standard deviations", .scale = 2});
  return drawnForSlide(picture, bounds(picture), {0.6, -2, 1.6});
}

// Grown from a start towards random points, outside of a ball, until it is at the goal.
struct RandomTree {
  LineSet edges{.color = {0.2f, 0.45f, 0.35f, 0.85f}, .width = 2.5};
  Polyline path{.color = kOrange, .width = 7};
};

RandomTree randomTree(const Vector3d& start, const Vector3d& goal) {
  constexpr double kStep = 0.08, kBias = 0.02;  // metres; the share of steps towards the goal
  Rng rng(3);
  std::vector<Vector3d> nodes = {start};
  std::vector<std::size_t> parents = {0};
  RandomTree tree;
  while ((nodes.back() - goal).norm() > kStep) {
    const Vector3d random(rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2), rng.uniform(0, 1.6));
    const Vector3d target = rng.uniform(0, 1) < kBias ? goal : random;
    const auto nearest = std::min_element(nodes.begin(), nodes.end(), [&](const auto& a, const auto& b) {
      return (a - target).squaredNorm() < (b - target).squaredNorm();
    });
    const Vector3d from = *nearest, to = from + kStep * (target - from).normalized();
    if ((to - Vector3d(0, 0, 0.8)).norm() < 0.5) continue;
    parents.push_back(static_cast<std::size_t>(nearest - nodes.begin()));
    tree.edges.segments.emplace_back(from, to);
    nodes.push_back(to);
  }
  tree.path.points = {goal};
  for (std::size_t i = nodes.size() - 1;; i = parents[i]) {
    tree.path.points.push_back(nodes[i]);
    if (i == 0) return tree;
  }
}

Image tree() {
  const Vector3d start(-1, -1, 0.1), goal(1, 0.9, 1.4);
  const RandomTree grown = randomTree(start, goal);
  Picture picture{.polylines = {grown.path}, .lineSets = {grown.edges}};
  picture.solids.push_back({.shape = {.type = ShapeType::kSphere, .radius = 0.48},
                            .X_WS = {.p = {0, 0, 0.8}},
                            .color = kRed,
                            .name = "obstacle"});
  picture.pointSets.push_back({.points = {start, goal}, .color = kOrange, .size = 22});
  picture.labels.push_back({.text = "start", .p_WQ = start, .scale = 2.5});
  picture.labels.push_back({.text = "goal", .p_WQ = goal, .scale = 2.5});
  return drawnForSlide(picture, bounds(picture), {0.7, -2, 0.9});
}

Image sensors() {
  const Model model = robot("man");
  const Picture picture = scenePicture(model, forwardKinematics(model, model.initialPositions()));
  constexpr int kSize = 300;
  Renderer renderer({.width = kSize, .height = kSize});
  const Camera camera = framing(bounds(picture), kDefaultView, 1);
  const DepthImage depth = renderer.drawDepth(picture, camera);
  return contactSheet({{renderer.draw(picture, camera), "colour"},
                       {depthColors(depth), "depth"},
                       {segmentationColors(renderer.drawSegmentation(picture, camera)), "segmentation"}});
}

Image edges() {
  Picture picture{
      .solids = {{.shape = {ShapeType::kCapsule, {0, 0, 0.5}, 0.1},
                  .X_WS = {expSO3(Vector3d(0.9, 0.3, 0)), {0, 0, 0.5}},
                  .color = kBlue},
                 {.shape = {.extent = {0.4, 0.4, 0.4}}, .X_WS = {.p = {0.5, 0.4, 0.2}}, .color = kSand}}};
  constexpr int kSmall = 75, kZoom = 4;
  std::vector<KeyFrame> frames;
  for (const auto& [name, mode] : {std::pair{"none", AntiAliasing::kNone},
                                   {"fxaa", AntiAliasing::kFxaa},
                                   {"msaa4", AntiAliasing::kMsaa4}}) {
    Renderer renderer({.width = kSmall, .height = kSmall, .antiAliasing = mode});
    const Image small = renderer.draw(picture, framing(bounds(picture), kDefaultView, 1));
    Image large(kZoom * kSmall, kZoom * kSmall);
    for (int y = 0; y < large.height; ++y)
      for (int x = 0; x < large.width; ++x)
        std::copy_n(small.pixel(x / kZoom, y / kZoom), 3, large.pixel(x, y));
    frames.push_back({large, name});
  }
  return contactSheet(frames);
}

Image keyFramesOfASwing() {
  const Model model = robot("man");
  const auto postures = circling(model, model.body("handR"), {-0.2, -0.4, 1.1}, 0.2, 60);
  constexpr int kSize = 420, kPerSecond = 20;
  const Bounds upperBody{.low = {-0.4, -0.5, 0.95}, .high = {0.4, 0.2, 1.65}};
  Renderer renderer({.width = kSize, .height = kSize});
  std::vector<KeyFrame> frames;
  Polyline trace{.color = kOrange, .width = 4};
  const std::vector<std::size_t> shown = keyFrames(postures.size(), 6);
  for (std::size_t i = 0; i < postures.size(); ++i) {
    const BodyPoses poses = forwardKinematics(model, postures[i]);
    trace.points.push_back(poses[model.body("handR")].p);
    if (std::find(shown.begin(), shown.end(), i) == shown.end()) continue;
    Picture picture = scenePicture(model, poses);
    if (i > 0) picture.polylines.push_back(trace);
    frames.push_back({renderer.draw(picture, framing(upperBody, {-0.5, -2, 0.4}, 1)),
                      fmt::format("{:.1f} s", static_cast<double>(i) / kPerSecond)});
  }
  return contactSheet(frames);
}

}  // namespace

std::vector<Drawing> pictures() {
  return {{"motion", "A robot and the path of its hand",
           "Inverse kinematics has moved the right hand around a circle. The picture shows shadows, the "
           "ground, a polyline, a labelled point and a caption.",
           motion},
          {"shapes", "All shapes",
           "Boxes, rounded boxes, spheres, capsules, cylinders, meshes with several materials, and point "
           "clouds: all can be translucent.",
           shapes},
          {"frames", "Frames and arrows",
           "Each arrow is a column of the position Jacobian: the velocity of the peg when one joint of the "
           "arm rotates at unit speed.",
           frames},
          {"particles", "Particles and covariances",
           "A filter's belief is drawn as particles (points) or normal distributions (translucent "
           "ellipsoids).",
           particles},
          {"tree", "A search tree",
           "A random tree, grown from the start, has reached the goal and found a path. Edges behind the "
           "obstacle remain faintly visible.",
           tree},
          {"views", "Several cameras", "One picture shows a robot from three sides.", views},
          {"sensors", "Depth and segmentation",
           "A depth camera measures metres, from near (yellow) to far (blue); the segmentation shows which "
           "solid is visible at each pixel.",
           sensors},
          {"edges", "Anti-aliasing",
           "A small picture, enlarged four times: without anti-aliasing, with FXAA, and with MSAA.", edges},
          {"key-frames", "Key frames of a motion", "A contact sheet shows a motion in print.",
           keyFramesOfASwing}};
}

}  // namespace rex::gallery
