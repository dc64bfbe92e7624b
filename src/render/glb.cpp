#include "render/glb.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "geometry/rotation.h"
#include "render/frame_sink_internal.h"
#include "render/glb_writer_internal.h"
#include "render/own_ground_internal.h"
#include "render/picture_internal.h"
#include "render/text_internal.h"

namespace rex::internal {

/// What one thing is at one moment, and where.
struct GlbState {
  int mesh = -1;
  GlbExtras extras{};
  Pose pose{};
  Eigen::Vector3d scale{1, 1, 1};
};

/// A thing through all moments of a film; none where it is not there.
using GlbTrack = std::vector<std::optional<GlbState>>;

/// Puts things that move into a file. `times` are seconds, one per moment; `parent` is their node.
class GlbTracks {
 public:
  GlbTracks(GlbWriter& writer, std::vector<float> times, int parent);

  /// Adds a node for each mesh with its extras that the track has, and moves, shows and hides it.
  void add(const std::string& name, const GlbTrack& track);

 private:
  void move(int node, const std::vector<GlbState>& way);
  void blink(int node, const std::vector<bool>& shown);

  GlbWriter* writer_;
  std::vector<float> times_;
  int parent_;
};

namespace {

// The track without gaps: an absent item waits where it was, or where it will appear.
std::vector<GlbState> withoutGaps(const GlbTrack& track) {
  const auto first = std::find_if(track.begin(), track.end(), [](const auto& s) { return s.has_value(); });
  std::vector<GlbState> way;
  GlbState last = **first;
  for (const std::optional<GlbState>& state : track) way.push_back(last = state.value_or(last));
  return way;
}

template <class Keys>
bool areConstant(const Keys& keys) {
  return std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return key == keys.front(); });
}

// Neighbouring quaternions have the same sign, because a viewer would otherwise take the long way between
// them.
std::vector<Eigen::Vector4f> rotationKeys(const std::vector<GlbState>& way) {
  std::vector<Eigen::Vector4f> keys;
  Quaternion last(1, 0, 0, 0);
  for (const GlbState& state : way) {
    Quaternion q = quaternionFromRotation(state.pose.R).normalized();
    if (q.dot(last) < 0) q = -q;
    last = q;
    keys.push_back(Eigen::Vector4d(q[1], q[2], q[3], q[0]).cast<float>());
  }
  return keys;
}

}  // namespace

GlbTracks::GlbTracks(GlbWriter& writer, std::vector<float> times, int parent)
    : writer_(&writer), times_(std::move(times)), parent_(parent) {}

void GlbTracks::add(const std::string& name, const GlbTrack& track) {
  std::map<std::pair<int, GlbExtras>, std::vector<bool>> forms;
  for (std::size_t k = 0; k < track.size(); ++k) {
    if (!track[k]) continue;
    const auto form = forms.try_emplace({track[k]->mesh, track[k]->extras}, track.size(), false).first;
    form->second[k] = true;
  }
  if (forms.empty()) return;
  const std::vector<GlbState> way = withoutGaps(track);
  const auto hasSize = [](const GlbState& state) { return state.scale != Eigen::Vector3d::Ones(); };
  const bool sized = std::any_of(way.begin(), way.end(), hasSize);
  for (const auto& [form, shown] : forms) {
    GlbNode node{.name = name,
                 .parent = parent_,
                 .mesh = form.first,
                 .pose = way[0].pose,
                 .scale = way[0].scale,
                 .extras = form.second};
    const bool always = std::find(shown.begin(), shown.end(), false) == shown.end();
    const Eigen::Vector3d atFirst = Eigen::Vector3d::Constant(shown[0] ? 1 : 0);
    // If the item has a scale of its own, the scale of a parent node hides it.
    if (!always && sized) node.parent = writer_->addNode({.name = name, .parent = parent_, .scale = atFirst});
    if (!always && !sized) node.scale = atFirst;
    const int index = writer_->addNode(node);
    move(index, way);
    if (!always) blink(sized ? node.parent : index, shown);
  }
}

void GlbTracks::move(int node, const std::vector<GlbState>& way) {
  std::vector<Eigen::Vector3f> places, scales;
  for (const GlbState& state : way) {
    places.push_back(state.pose.p.cast<float>());
    scales.push_back(state.scale.cast<float>());
  }
  const std::vector<Eigen::Vector4f> turns = rotationKeys(way);
  const auto animate = [&](GlbPath path, const auto& keys) {
    if (areConstant(keys)) return;
    writer_->animate(node, path, writer_->addTimes(times_), writer_->addKeys(keys), false);
  };
  animate(GlbPath::kTranslation, places);
  animate(GlbPath::kRotation, turns);
  animate(GlbPath::kScale, scales);
}

void GlbTracks::blink(int node, const std::vector<bool>& shown) {
  std::vector<float> times;
  std::vector<Eigen::Vector3f> scales;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (k > 0 && shown[k] == shown[k - 1]) continue;
    times.push_back(times_[k]);
    scales.push_back(Eigen::Vector3f::Constant(shown[k] ? 1 : 0));
  }
  writer_->animate(node, GlbPath::kScale, writer_->addTimes(times), writer_->addKeys(scales), true);
}

}  // namespace rex::internal

namespace rex {
namespace {

using Eigen::Vector3d;
using internal::GlbExtras;
using internal::GlbState;
using internal::GlbTrack;

std::vector<float> timesOf(const Film& film) {
  std::vector<float> times;
  for (const Frame& frame : film) {
    const auto time = static_cast<float>(frame.time - film.front().time);
    const std::size_t k = times.size();
    if (!std::isfinite(time) || (k > 0 && !(time > times.back())))
      throw Error({.what = fmt::format("frame {} of a film", k),
                   .found = fmt::format("time {}", frame.time) +
                            (k > 0 ? fmt::format(" after {}", film[k - 1].time) : ""),
                   .wanted = "finite seconds that increase from frame to frame, even in single precision"});
    times.push_back(time);
  }
  return times;
}

std::vector<double> listOf(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string hex(const Color& color) {
  const auto part = [](float c) { return static_cast<int>(std::lround(255 * std::clamp(c, 0.f, 1.f))); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(color.r), part(color.g), part(color.b));
}

bool looksLike(const Solid& a, const Solid& b) {
  return a.shape.type == b.shape.type && a.shape.extent == b.shape.extent &&
         a.shape.radius == b.shape.radius && a.shape.mesh == b.shape.mesh && a.color == b.color;
}

class FilmWriter {
 public:
  FilmWriter(const Film& film, const Bounds& scene, const Camera& camera)
      : film_(film), scene_(scene), meshes_(writer_), tracks_(writer_, timesOf(film), addRoot(camera)) {
    writer_.addCamera(camera, kRoot);
    addGround();
    addSolids();
    addArrows();
    addEllipsoids();
    addPoints(&Picture::lineSets, "lines");
    addPoints(&Picture::polylines, "polyline");
    addPoints(&Picture::pointSets, "points");
    addAxes();
    addTexts();
  }

  std::string bytes() const { return writer_.bytes(); }

 private:
  static constexpr int kRoot = 0;
  using State = std::optional<GlbState>;

  // Our z is up, glTF's y. `target` is the point that the camera looks at and orbits.
  int addRoot(const Camera& camera) {
    const Vector3d ahead = -camera.X_WC.R.col(2);
    const Vector3d target = camera.X_WC.p + ahead * ahead.dot(scene_.center() - camera.X_WC.p);
    const Vector3d light = film_[0].picture.toLight.normalized();
    return writer_.addNode({.name = "world",
                            .pose = rotation(-std::numbers::pi / 2, Vector3d::UnitX()),
                            .extras = {.numbers = {{"target", listOf(target)},
                                                   {"low", listOf(scene_.low)},
                                                   {"high", listOf(scene_.high)},
                                                   {"toLight", listOf(light)}}}});
  }

  // Calls nameOf(item, index) and stateOf(item) for the items with the same index in all pictures of the
  // film.
  template <class Item, class NameOf, class StateOf>
  void addAll(const std::vector<Item> Picture::*list, const NameOf& nameOf, const StateOf& stateOf) {
    std::size_t most = 0;
    for (const Frame& frame : film_) most = std::max(most, (frame.picture.*list).size());
    for (std::size_t i = 0; i < most; ++i) {
      GlbTrack track;
      std::string name;
      for (const Frame& frame : film_) {
        const std::vector<Item>& items = frame.picture.*list;
        track.push_back(i < items.size() ? stateOf(items[i]) : std::nullopt);
        if (name.empty() && i < items.size()) name = nameOf(items[i], i);
      }
      tracks_.add(name, track);
    }
  }

  void addGround() {
    GlbTrack track(film_.size());
    for (std::size_t k = 0; k < film_.size(); ++k) {
      const Ground& ground = film_[k].picture.ground;
      const std::optional<double> height = internal::checkerHeight(film_[k].picture, scene_);
      if (!height) continue;
      const double half = std::max(6 * scene_.radius(), 4 * ground.cell);
      const Color mixed{(ground.light.r + ground.dark.r) / 2, (ground.light.g + ground.dark.g) / 2,
                        (ground.light.b + ground.dark.b) / 2};
      track[k] = GlbState{.mesh = meshes_.plane(half, mixed),
                          .extras = {.numbers = {{"cell", {ground.cell}}},
                                     .texts = {{"light", hex(ground.light)}, {"dark", hex(ground.dark)}}},
                          .pose = translation(scene_.center().x(), scene_.center().y(), *height)};
    }
    tracks_.add("ground", track);
  }

  void addSolids() {
    const Solid* last = nullptr;
    int mesh = -1;
    const auto nameOf = [](const Solid& solid, std::size_t i) {
      return solid.name.empty() ? fmt::format("solid {}", i) : internal::singleLine(solid.name);
    };
    addAll(&Picture::solids, nameOf, [&](const Solid& solid) -> State {
      if (last == nullptr || !looksLike(solid, *last))
        mesh = solid.color.a > 0 ? meshes_.ofShape(solid.shape, solid.color) : -1;
      last = &solid;
      if (mesh < 0) return std::nullopt;
      const bool isSphere = solid.shape.type == ShapeType::kSphere;
      return GlbState{
          .mesh = mesh, .pose = solid.X_WS, .scale = Vector3d::Constant(isSphere ? solid.shape.radius : 1)};
    });
  }

  // Calls partOf(colour, form) for a part of each arrow, in the frame whose z axis runs along the arrow.
  template <class PartOf>
  void addArrowPart(const PartOf& partOf) {
    const auto named = [](const Arrow&, std::size_t i) { return fmt::format("arrow {}", i); };
    addAll(&Picture::arrows, named, [&](const Arrow& arrow) -> State {
      const Vector3d along = arrow.to - arrow.from;
      if (!(along.norm() > 0)) return std::nullopt;
      GlbState part = partOf(arrow.color, internal::ArrowForm(along.norm(), arrow.radius));
      part.pose = Pose{rotationBetween(Vector3d::UnitZ(), along), arrow.from} * part.pose;
      return part;
    });
  }

  void addArrows() {
    addArrowPart([&](const Color& color, const internal::ArrowForm& form) {
      return GlbState{.mesh = meshes_.shaft(color), .scale = {form.radius, form.radius, form.shaft}};
    });
    addArrowPart([&](const Color& color, const internal::ArrowForm& form) {
      return GlbState{.mesh = meshes_.head(color),
                      .pose = translation(0, 0, form.shaft),
                      .scale = {form.headRadius, form.headRadius, form.head}};
    });
  }

  void addEllipsoids() {
    const auto named = [](const Ellipsoid&, std::size_t i) { return fmt::format("ellipsoid {}", i); };
    addAll(&Picture::ellipsoids, named, [&](const Ellipsoid& ellipsoid) -> State {
      if (ellipsoid.radii.isZero(0)) return std::nullopt;
      return GlbState{.mesh = meshes_.ball(ellipsoid.color),
                      .pose = ellipsoid.X_WE,
                      .scale = internal::drawnRadii(ellipsoid.radii)};
    });
  }

  template <class Item>
  static std::vector<Eigen::Vector3f> pointsOf(const Item& item) {
    std::vector<Eigen::Vector3f> points;
    for (const Vector3d& point : item.points) points.push_back(point.cast<float>());
    return points;
  }
  static std::vector<Eigen::Vector3f> pointsOf(const LineSet& lines) {
    std::vector<Eigen::Vector3f> points;
    for (const auto& [from, to] : lines.segments)
      points.push_back(from.cast<float>()), points.push_back(to.cast<float>());
    return points;
  }
  static bool isDrawn(const LineSet& lines) { return !lines.segments.empty(); }
  static bool isDrawn(const Polyline& line) { return line.points.size() > 1; }
  static bool isDrawn(const PointSet& set) { return !set.points.empty(); }
  int meshOf(const LineSet& lines, int points) { return meshes_.lines(points, lines.color, lines.width); }
  int meshOf(const Polyline& line, int points) { return meshes_.line(points, line.color, line.width); }
  int meshOf(const PointSet& set, int points) { return meshes_.points(points, set.color, set.size); }

  // The points of an item throughout the film, as accessors. A list that is the start of another, as in a
  // growing trace, shares its data.
  template <class Item>
  void addAccessors(const std::vector<const Item*>& items, std::map<const Item*, int>& accessors) {
    std::vector<std::pair<const Item*, std::vector<Eigen::Vector3f>>> lists;
    for (const Item* item : items) lists.emplace_back(item, pointsOf(*item));
    std::stable_sort(lists.begin(), lists.end(),
                     [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
    std::vector<std::vector<Eigen::Vector3f>> stores;
    for (const auto& [item, points] : lists) {
      const auto& known = points;  // a structured binding cannot be captured
      auto store = std::find_if(stores.begin(), stores.end(), [&](const auto& longer) {
        return std::equal(known.begin(), known.end(), longer.begin());
      });
      if (store == stores.end()) store = stores.insert(stores.end(), points);
      accessors[item] = writer_.addVertices(*store, points.size());
    }
  }

  template <class Item>
  void addPoints(const std::vector<Item> Picture::*list, const char* kind) {
    std::vector<std::vector<const Item*>> drawn;  // by index
    for (const Frame& frame : film_) {
      const std::vector<Item>& items = frame.picture.*list;
      drawn.resize(std::max(drawn.size(), items.size()));
      for (std::size_t i = 0; i < items.size(); ++i)
        if (isDrawn(items[i])) drawn[i].push_back(&items[i]);
    }
    std::map<const Item*, int> accessors;
    for (const auto& items : drawn) addAccessors(items, accessors);
    const auto named = [&](const Item&, std::size_t i) { return fmt::format("{} {}", kind, i); };
    addAll(list, named, [&](const Item& item) -> State {
      if (!isDrawn(item)) return std::nullopt;
      return GlbState{.mesh = meshOf(item, accessors.at(&item))};
    });
  }

  void addAxes() {
    addAll(
        &Picture::axes,
        [](const Axes& axes, std::size_t) { return "axes " + internal::singleLine(axes.name); },
        [&](const Axes& axes) -> State {
          GlbState state{.mesh = meshes_.axes(axes.size), .pose = axes.X_WF};
          if (!axes.name.empty()) state.extras.texts["label"] = internal::singleLine(axes.name);
          state.extras.numbers["below"] = {10};
          return state.mesh < 0 ? State() : state;
        });
  }

  void addTexts() {
    const auto label = [](const Label&, std::size_t i) { return fmt::format("label {}", i); };
    addAll(&Picture::labels, label, [](const Label& item) -> State {
      return GlbState{
          .extras = {.numbers = {{"textScale", {item.scale}}},
                     .texts = {{"label", internal::singleLine(item.text)}, {"color", hex(item.color)}}},
          .pose = {.p = item.p_WQ}};
    });
    const auto caption = [](const Caption&, std::size_t i) { return fmt::format("caption {}", i); };
    addAll(&Picture::captions, caption, [](const Caption& item) -> State {
      const bool right = item.corner == Corner::kTopRight || item.corner == Corner::kBottomRight;
      const bool bottom = item.corner == Corner::kBottomLeft || item.corner == Corner::kBottomRight;
      return GlbState{.extras = {.numbers = {{"textScale", {item.scale}}},
                                 .texts = {{"caption", internal::singleLines(item.text)},
                                           {"corner", std::string(bottom ? "bottom " : "top ") +
                                                          (right ? "right" : "left")},
                                           {"color", hex(item.color)}}}};
    });
  }

  const Film& film_;
  const Bounds& scene_;
  internal::GlbWriter writer_;
  internal::GlbMeshes meshes_;
  internal::GlbTracks tracks_;
};

}  // namespace

std::string toGlb(const Film& film, const Vector3d& view) {
  if (film.empty()) throw Error({.what = "a film to replay", .found = "no frames", .wanted = "at least one"});
  for (const Frame& frame : film) requireDrawable(frame.picture);
  const Bounds scene = bounds(film);
  return FilmWriter(film, scene, framing(scene, view, 4. / 3)).bytes();
}

void writeGlb(const Film& film, const std::filesystem::path& path, const Vector3d& view) {
  internal::writeWhole(path, toGlb(film, view));
}

}  // namespace rex
