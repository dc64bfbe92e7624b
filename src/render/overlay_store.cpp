#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "render/overlay_store_internal.h"
#include "render/picture_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kEndless = 1e6;  // pixels: no round end

// The appearance of lines or discs of one kind.
struct Stroke {
  Stroke(double halfWidthInPixels, const Color& c) : halfWidth(halfWidthInPixels), reach(halfWidth + 0.5) {
    const auto byte = [](float x) { return static_cast<std::uint8_t>(std::clamp(x, 0.f, 1.f) * 255 + 0.5f); };
    color = {byte(c.r), byte(c.g), byte(c.b), byte(c.a)};
  }

  double halfWidth;
  double reach;  // half the width of its quads
  std::array<std::uint8_t, 4> color{};
};

// A point of the picture: pixels (x right, y down) and normalised depth.
struct Vertex2 {
  Vector2d at;
  double depth;
};

class OverlayBuilder {
 public:
  OverlayBuilder(const Camera& camera, int width, int height, std::vector<OverlayVertex>& mesh)
      : camera_(camera),
        X_CW_(camera.X_WC.inverse()),
        width_(width),
        height_(height),
        focal_(height / (2 * std::tan(camera.verticalFov / 2))),
        mesh_(mesh) {}

  void addLine(const std::vector<Vector3d>& points, const Stroke& stroke) {
    run_.clear();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      Vector3d a = X_CW_ * points[i], b = X_CW_ * points[i + 1];
      const bool endsInside = inFront(b);
      if (!clipToFront(a, b)) continue;
      if (run_.empty()) run_.push_back(seen(a));
      // Steps below half a pixel have no useful direction.
      const Vertex2 next = seen(b);
      const bool last = !endsInside || i + 2 == points.size();
      const bool moved = (next.at - run_.back().at).norm() > 0.5;
      if (moved || (last && run_.size() == 1)) run_.push_back(next);
      if (last) addRun(stroke), run_.clear();
    }
  }

  void addSegment(const Vector3d& from, const Vector3d& to, const Stroke& stroke) {
    Vector3d a = X_CW_ * from, b = X_CW_ * to;
    if (!clipToFront(a, b)) return;
    const Vertex2 start = seen(a), end = seen(b);
    if (misses(start.at.cwiseMin(end.at), start.at.cwiseMax(end.at), stroke.reach)) return;
    const Vector2d along = direction(start, end);
    addPiece(start, end, along, endOf(along, nullptr, -1, stroke.reach),
             endOf(along, nullptr, 1, stroke.reach), stroke);
  }

  void addDisc(const Vector3d& p_WQ, const Stroke& stroke) {
    const Vector3d p_CQ = X_CW_ * p_WQ;
    if (!inFront(p_CQ)) return;
    const Vertex2 middle = seen(p_CQ);
    if (misses(middle.at, middle.at, stroke.reach)) return;
    for (int k = 0; k < 4; ++k) {
      const Vector2d offset(k & 1 ? stroke.reach : -stroke.reach, k & 2 ? stroke.reach : -stroke.reach);
      addCorner(middle.at + offset, middle.depth, offset, 0, 0, stroke);
    }
  }

  void addAxes(const Pose& X_WF, double from, double to) {
    for (int i = 0; i < 3; ++i) {
      const Vector3d axis = X_WF.R.col(i);
      addSegment(X_WF.p + from * axis, X_WF.p + to * axis, Stroke(kAxisWidth / 2, kAxisColors[i]));
    }
  }

  void addCloud(const Solid& solid) {
    const Stroke stroke(kCloudPointRadius, solid.color);
    for (const Eigen::Vector3f& point : solid.shape.mesh.positions())
      addDisc(solid.X_WS * Vector3d(point.cast<double>()), stroke);
  }

 private:
  bool inFront(const Vector3d& p_C) const { return -p_C.z() >= camera_.nearPlane; }

  // Clips a line at the near plane; false if nothing of it is left.
  bool clipToFront(Vector3d& a, Vector3d& b) const {
    const bool startsInside = inFront(a), endsInside = inFront(b);
    if (!startsInside && !endsInside) return false;
    if (!startsInside) a = atNearPlane(b, a);
    if (!endsInside) b = atNearPlane(a, b);
    return true;
  }

  Vector3d atNearPlane(const Vector3d& inside, const Vector3d& outside) const {
    const double share = (-camera_.nearPlane - inside.z()) / (outside.z() - inside.z());
    Vector3d point = inside + share * (outside - inside);
    point.z() = -camera_.nearPlane;
    return point;
  }

  Vertex2 seen(const Vector3d& p_C) const {
    const double near = camera_.nearPlane, far = camera_.farPlane;
    const double depth = std::max(-0.99 * p_C.z(), near), scale = focal_ / p_C.z();
    return {{width_ / 2.0 - scale * p_C.x(), height_ / 2.0 + scale * p_C.y()},
            (far + near - 2 * far * near / depth) / (far - near)};
  }

  bool misses(const Vector2d& low, const Vector2d& high, double reach) const {
    return high.x() < -reach || high.y() < -reach || low.x() > width_ + reach || low.y() > height_ + reach;
  }

  static Vector2d direction(const Vertex2& from, const Vertex2& to) {
    const Vector2d step = to.at - from.at;
    return step.norm() > 0 ? step.normalized() : Vector2d(1, 0);
  }

  void addCorner(const Vector2d& at, double depth, const Vector2d& offset, float first, float last,
                 const Stroke& stroke) {
    mesh_.push_back({{static_cast<float>(2 * at.x() / width_ - 1),
                      static_cast<float>(1 - 2 * at.y() / height_), static_cast<float>(depth)},
                     {static_cast<float>(offset.x()), static_cast<float>(offset.y())},
                     first,
                     last,
                     static_cast<float>(stroke.halfWidth),
                     stroke.color});
  }

  // The shape of one end of a segment of a polyline: its corners lie at `cap` + `side` and `cap` - `side`,
  // relative to its point.
  struct End {
    Vector2d side, cap;
    bool round;
  };

  // Segments share their corners, so that a translucent line has no darker joints. At a sharp turn, or
  // without a neighbour, a segment ends with a round cap. `outward` is 1 at the end of a segment, -1 at its
  // start.
  static End endOf(const Vector2d& along, const Vector2d* neighbour, double outward, double reach) {
    constexpr double kSharpest = 0.5;  // cosine of half the turn
    if (neighbour != nullptr) {
      const Vector2d bisector = (along + *neighbour).normalized();
      const double cosine = bisector.dot(along);
      if (cosine > kSharpest)
        return {reach / cosine * Vector2d(-bisector.y(), bisector.x()), Vector2d::Zero(), false};
    }
    return {reach * Vector2d(-along.y(), along.x()), outward * reach * along, true};
  }

  void addRun(const Stroke& stroke) {
    directions_.clear();
    for (std::size_t i = 0; i + 1 < run_.size(); ++i) directions_.push_back(direction(run_[i], run_[i + 1]));
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const Vector2d* before = i > 0 ? &directions_[i - 1] : nullptr;
      const Vector2d* after = i + 1 < directions_.size() ? &directions_[i + 1] : nullptr;
      addPiece(run_[i], run_[i + 1], directions_[i], endOf(directions_[i], before, -1, stroke.reach),
               endOf(directions_[i], after, 1, stroke.reach), stroke);
    }
  }

  void addPiece(const Vertex2& from, const Vertex2& to, const Vector2d& along, const End& start,
                const End& end, const Stroke& stroke) {
    const double length = (to.at - from.at).norm();
    const auto first = static_cast<float>(start.round ? 0 : -kEndless);
    const auto last = static_cast<float>(end.round ? length : kEndless);
    for (const bool atEnd : {false, true}) {
      for (const double side : {-1., 1.}) {
        const Vector2d shift =
            atEnd ? Vector2d(end.cap + side * end.side) : Vector2d(start.cap + side * start.side);
        const Vertex2& point = atEnd ? to : from;
        addCorner(point.at + shift, point.depth,
                  {(atEnd ? length : 0) + shift.dot(along), side * stroke.reach}, first, last, stroke);
      }
    }
  }

  const Camera& camera_;
  Pose X_CW_;
  int width_, height_;
  double focal_;  // pixels
  std::vector<OverlayVertex>& mesh_;
  std::vector<Vertex2> run_;
  std::vector<Vector2d> directions_;
};

}  // namespace

bool isOverlay(const Solid& solid) {
  const ShapeType type = solid.shape.type;
  return type == ShapeType::kMarker || type == ShapeType::kPointCloud ||
         (usesMesh(type) && solid.shape.mesh.triangles().empty());
}

void makeOverlayMesh(const Picture& picture, const Camera& camera, int width, int height,
                     std::vector<OverlayVertex>& mesh) {
  mesh.clear();
  OverlayBuilder builder(camera, width, height, mesh);
  for (const LineSet& lines : picture.lineSets) {
    const Stroke stroke(lines.width / 2, lines.color);
    for (const auto& [from, to] : lines.segments) builder.addSegment(from, to, stroke);
  }
  for (const Polyline& line : picture.polylines)
    builder.addLine(line.points, Stroke(line.width / 2, line.color));
  for (const Axes& axes : picture.axes) builder.addAxes(axes.X_WF, 0, axes.size);
  for (const Solid& solid : picture.solids) {
    const double half = solid.shape.extent.x() / 2;
    if (solid.shape.type == ShapeType::kMarker) {
      builder.addAxes(solid.X_WS, -half, half);
    } else if (isOverlay(solid)) {
      builder.addCloud(solid);
    }
  }
  for (const PointSet& set : picture.pointSets) {
    const Stroke stroke(set.size / 2, set.color);
    for (const Vector3d& point : set.points) builder.addDisc(point, stroke);
  }
}

OverlayStore::OverlayStore(const GlFunctions& gl) : gl_(&gl) {
  gl.GenVertexArrays(1, &vertexArray_);
  gl.GenBuffers(1, &vertices_);
  gl.GenBuffers(1, &indices_);
  gl.BindVertexArray(vertexArray_);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  const auto attribute = [&](GLuint index, GLint size, GLenum type, std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, sizeof(OverlayVertex),
                           reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, GL_FLOAT, offsetof(OverlayVertex, position));
  attribute(1, 2, GL_FLOAT, offsetof(OverlayVertex, offset));
  attribute(2, 3, GL_FLOAT, offsetof(OverlayVertex, first));
  attribute(3, 4, GL_UNSIGNED_BYTE, offsetof(OverlayVertex, color));
}

void OverlayStore::load(const Picture& picture, const Camera& camera, int width, int height) {
  makeOverlayMesh(picture, camera, width, height, mesh_);
  if (mesh_.empty()) return;
  gl_->BindVertexArray(vertexArray_);
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.size() * sizeof(mesh_[0])), mesh_.data(),
                  GL_STREAM_DRAW);
  if (mesh_.size() / 4 > indexedQuads_) growIndices();
}

void OverlayStore::draw() const {
  gl_->BindVertexArray(vertexArray_);
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh_.size() / 4 * 6), GL_UNSIGNED_INT, nullptr);
}

void OverlayStore::growIndices() {
  indexedQuads_ = std::max(mesh_.size() / 4, 2 * indexedQuads_);
  std::vector<std::uint32_t> indices;
  indices.reserve(6 * indexedQuads_);
  for (std::uint32_t quad = 0; quad < indexedQuads_; ++quad)
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(4 * quad + corner);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(indices[0])),
                  indices.data(), GL_STATIC_DRAW);
}

}  // namespace rex::internal
