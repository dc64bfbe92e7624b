#include <array>
#include <cmath>

#include "render/overlay_mesh_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A point of the picture: pixels (x right, y down) and normalised depth.
struct Vertex2 {
  Vector2d at;
  double depth;
};

class Builder {
 public:
  Builder(const Camera& camera, int width, int height)
      : camera_(camera), X_CW_(camera.X_WC.inverse()), width_(width), height_(height) {}

  void addLine(const Polyline& line) {
    std::vector<Vertex2> run;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      Vector3d a = X_CW_ * line.points[i], b = X_CW_ * line.points[i + 1];
      const bool startsInside = inFront(a), endsInside = inFront(b);
      if (!startsInside && !endsInside) continue;
      if (!startsInside) a = atNearPlane(b, a);
      if (!endsInside) b = atNearPlane(a, b);
      if (run.empty()) run.push_back(seen(a));
      // Steps below half a pixel have no useful direction.
      const Vertex2 next = seen(b);
      const bool last = !endsInside || i + 2 == line.points.size();
      const bool moved = (next.at - run.back().at).norm() > 0.5;
      if (moved || (last && run.size() == 1)) run.push_back(next);
      if (last) addRun(run, line.width / 2, line.color), run.clear();
    }
  }

  void addDisc(const Vector3d& p_WQ, double radius, const Color& color) {
    const Vector3d p_CQ = X_CW_ * p_WQ;
    if (!inFront(p_CQ)) return;
    const Vertex2 middle = seen(p_CQ);
    const double reach = radius + 1;
    std::array<OverlayVertex, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const Vector2d offset(k & 1 ? reach : -reach, k & 2 ? reach : -reach);
      corners[k] = corner({middle.at + offset, middle.depth}, offset, radius, color);
    }
    addQuad(corners);
  }

  std::vector<OverlayVertex> take() { return std::move(mesh_); }

 private:
  bool inFront(const Vector3d& p_C) const { return -p_C.z() >= camera_.nearPlane; }

  Vector3d atNearPlane(const Vector3d& inside, const Vector3d& outside) const {
    const double share = (-camera_.nearPlane - inside.z()) / (outside.z() - inside.z());
    Vector3d point = inside + share * (outside - inside);
    point.z() = -camera_.nearPlane;
    return point;
  }

  Vertex2 seen(const Vector3d& p_C) const {
    const double focal = height_ / (2 * std::tan(camera_.verticalFov / 2));
    const double near = camera_.nearPlane, far = camera_.farPlane;
    const double depth = std::max(-0.99 * p_C.z(), near);
    return {{width_ / 2.0 - focal * p_C.x() / p_C.z(), height_ / 2.0 + focal * p_C.y() / p_C.z()},
            (far + near - 2 * far * near / depth) / (far - near)};
  }

  OverlayVertex corner(const Vertex2& v, const Vector2d& offset, double halfWidth, const Color& color) const {
    return {{static_cast<float>(2 * v.at.x() / width_ - 1), static_cast<float>(1 - 2 * v.at.y() / height_),
             static_cast<float>(v.depth)},
            {static_cast<float>(offset.x()), static_cast<float>(offset.y()), static_cast<float>(halfWidth)},
            color};
  }

  void addQuad(const std::array<OverlayVertex, 4>& c) {
    mesh_.insert(mesh_.end(), {c[0], c[1], c[2], c[2], c[1], c[3]});
  }

  // A band around the run. Its pieces share their corners, so that a translucent line has no darker joints;
  // at a sharp turn it ends and starts again, both with a round cap.
  void addRun(const std::vector<Vertex2>& run, double halfWidth, const Color& color) {
    constexpr double kSharpest = 0.5;  // cosine of half the turn
    const double reach = halfWidth + 1;
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const Vector2d along = direction(run, i);
      const Vector2d across(-along.y(), along.x());
      std::array<OverlayVertex, 4> corners;
      for (int k = 0; k < 4; ++k) {
        const bool atEnd = (k & 2) != 0;
        const double side = k & 1 ? reach : -reach;
        const Vertex2& v = run[i + (atEnd ? 1 : 0)];
        const bool hasNeighbour = atEnd ? i + 2 < run.size() : i > 0;
        const Vector2d other = hasNeighbour ? direction(run, atEnd ? i + 1 : i - 1) : -along;
        const Vector2d bisector = (along + other).normalized();
        const double cosine = bisector.dot(along);
        if (hasNeighbour && cosine > kSharpest) {
          const Vector2d miter = Vector2d(-bisector.y(), bisector.x()) * (side / cosine);
          corners[k] = corner({v.at + miter, v.depth}, {0, side}, halfWidth, color);
        } else {
          const double cap = atEnd ? reach : -reach;
          corners[k] = corner({v.at + side * across + cap * along, v.depth}, {cap, side}, halfWidth, color);
        }
      }
      addCapped(corners, run[i], run[i + 1], across, halfWidth, color);
    }
  }

  // Caps need `along` = 0 between the two points, which one quad from cap to cap would not give.
  void addCapped(const std::array<OverlayVertex, 4>& corners, const Vertex2& from, const Vertex2& to,
                 const Vector2d& across, double halfWidth, const Color& color) {
    std::array<OverlayVertex, 4> body = corners;
    for (int end = 0; end < 2; ++end) {
      if (corners[2 * end].offset[0] == 0) continue;
      const Vertex2& v = end == 0 ? from : to;
      for (int k = 0; k < 2; ++k) {
        const double side = (k == 1 ? 1 : -1) * (halfWidth + 1);
        body[2 * end + k] = corner({v.at + side * across, v.depth}, {0, side}, halfWidth, color);
      }
      if (end == 0)
        addQuad({corners[0], corners[1], body[0], body[1]});
      else
        addQuad({body[2], body[3], corners[2], corners[3]});
    }
    addQuad(body);
  }

  static Vector2d direction(const std::vector<Vertex2>& run, std::size_t i) {
    const Vector2d step = run[i + 1].at - run[i].at;
    return step.norm() > 0 ? step.normalized() : Vector2d(1, 0);
  }

  const Camera& camera_;
  Pose X_CW_;
  int width_, height_;
  std::vector<OverlayVertex> mesh_;
};

}  // namespace

std::vector<OverlayVertex> makeOverlayMesh(const std::vector<Polyline>& lines,
                                           const std::vector<PointSet>& sets, const Camera& camera, int width,
                                           int height) {
  Builder builder(camera, width, height);
  for (const Polyline& line : lines) builder.addLine(line);
  for (const PointSet& set : sets)
    for (const Vector3d& point : set.points) builder.addDisc(point, set.size / 2, set.color);
  return builder.take();
}

}  // namespace rex::internal
