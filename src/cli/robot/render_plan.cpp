#include "cli/robot/render_plan.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/text.h"
#include "cli/option_table_internal.h"
#include "geometry/rotation.h"
#include "render/film.h"

namespace rex::cli {

namespace {

using Eigen::Vector3d;

struct KnownView {
  const char* name;
  Vector3d direction;
};

// For a robot that faces -y. Slightly from above, as one looks at a robot.
const std::array<KnownView, 5> kViews = {{{"front", {0, -1, 0.25}},
                                          {"back", {0, 1, 0.25}},
                                          {"left", {1, 0, 0.25}},
                                          {"right", {-1, 0, 0.25}},
                                          {"top", {0, 0, 1}}}};

// A quarter turn takes a robot that faces -y to one that faces +x.
Vector3d turned(const Vector3d& v, Facing facing) {
  return facing == Facing::kMinusY ? v : Vector3d(-v.y(), v.x(), v.z());
}

// The axis nearest to a direction, such as "+x".
std::string axisOf(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return fmt::format("{}{}", direction[axis] < 0 ? '-' : '+', "xyz"[axis]);
}

std::optional<Vector3d> pointIn(std::string_view text) {
  const std::vector<std::string_view> fields = splitAt(text, ',');
  if (fields.size() != 3) return {};
  Vector3d point;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number = parseNumber<double>(fields[static_cast<std::size_t>(i)]);
    if (!number) return {};
    point[i] = *number;
  }
  return point;
}

}  // namespace

Facing sceneFacing(const std::filesystem::path& file) {
  return endingOf(file) == ".ors" ? Facing::kMinusY : Facing::kPlusX;
}

View::View(const std::string& text, Facing facing) : label_(text) {
  if (text == "default") return;
  std::vector<std::string> names = {"default"};
  for (const KnownView& view : kViews) {
    names.emplace_back(view.name);
    if (text == view.name) {
      direction_ = turned(view.direction, facing);
      label_ = fmt::format("{} (from {})", text, axisOf(direction_));
      return;
    }
  }
  const std::size_t at = text.find('@');
  const auto first = pointIn(text.substr(0, at));
  if (first && at == std::string::npos && first->norm() > 0) {
    direction_ = *first;
    return;
  }
  const auto second = at == std::string::npos ? std::nullopt : pointIn(text.substr(at + 1));
  if (!first || !second || *first == *second)
    throw UsageError({.what = "--camera",
                      .found = "'" + text + "'",
                      .wanted = "default, front, back, left, right, top, a direction x,y,z, or eye and "
                                "target x,y,z@x,y,z",
                      .nearest = nearestNames(text, names)});
  hasEye_ = true;
  eye_ = *first;
  target_ = *second;
  direction_ = eye_ - target_;
}

Camera View::camera(const Bounds& bounds, double aspect) const {
  return hasEye_ ? lookAt(eye_, target_) : framing(bounds, direction_, aspect);
}

namespace {

Camera turnedCamera(const Camera& camera, const Vector3d& p_WT, double angle) {
  Camera result = camera;
  const Eigen::Matrix3d R = rotationAboutAxis(angle, Vector3d::UnitZ());
  result.X_WC = {R * camera.X_WC.R, p_WT + R * (camera.X_WC.p - p_WT)};
  return result;
}

// Widths of lines and texts are pixels of the usual picture; they grow with a larger one.
Picture enlarged(Picture picture, const RendererOptions& renderer) {
  const double factor = std::min(renderer.width / 640., renderer.height / 480.);  // kPictureSize
  if (factor <= 1) return picture;
  for (Polyline& line : picture.polylines) line.width *= factor;
  for (LineSet& lines : picture.lineSets) lines.width *= factor;
  for (PointSet& points : picture.pointSets) points.size *= factor;
  for (Label& label : picture.labels) label.scale *= factor;
  for (Caption& caption : picture.captions) caption.scale *= factor;
  return picture;
}

}  // namespace

Studio::Studio(const RenderPlan& plan, const Bounds& scene)
    : plan_(plan), scene_(scene), renderer_(plan.renderer) {}

std::string Studio::describe() const {
  const std::string views = viewNames(plan_);
  return renderer_.describe() + (views.empty() ? "" : "; " + views);
}

Image Studio::draw(const Picture& picture, double angle) {
  const double aspect = static_cast<double>(plan_.renderer.width) / plan_.renderer.height;
  std::vector<KeyFrame> seen;
  for (const auto& [name, view] : plan_.views) {
    const Camera camera = view.camera(scene_, aspect);
    seen.push_back({drawFrom(picture, turnedCamera(camera, view.target(scene_), angle)), name});
  }
  return seen.size() == 1 ? seen.front().image : captionedSheet(seen);
}

Image Studio::drawFrom(const Picture& picture, const Camera& camera) {
  throwIfInterrupted();
  if (plan_.show == Show::kColor) {
    DrawnFrame drawn = renderer_.drawFrame(enlarged(picture, plan_.renderer), camera);
    sawSomething_ |= drawn.showsSomething;
    return std::move(drawn.image);
  }
  sawSomething_ = true;  // an empty depth or segmentation image is a valid result
  if (plan_.show == Show::kSegmentation)
    return segmentationColors(renderer_.drawSegmentation(picture, camera));
  const double distance = (scene_.center() - camera.X_WC.p).norm(), reach = scene_.radius();
  return depthColors(renderer_.drawDepth(picture, camera), std::max(0., distance - reach),
                     distance + 2 * reach);
}

void Studio::requireSomethingSeen() const {
  if (!sawSomething_)
    throw UsageError(
        {.what = "--camera", .found = "nothing of the scene in view", .wanted = "a view of the scene"});
}

Image captionedSheet(const std::vector<KeyFrame>& pictures) {
  constexpr int kNarrowest = 16;  // the least that a sheet accepts; it never widens a picture
  return contactSheet(pictures, {.pictureWidth = std::max(pictures.front().image.width, kNarrowest)});
}

Bounds turningBox(const Bounds& scene) {
  Bounds box = scene;
  const Vector3d middle = scene.center(), half = scene.high - middle;
  const double reach = half.head<2>().norm();
  box.include(middle - Vector3d(reach, reach, half.z()));
  box.include(middle + Vector3d(reach, reach, half.z()));
  return box;
}

namespace {

// Without an ending, the result is a folder of pictures.
Product productOf(const std::filesystem::path& out) {
  const std::vector<std::string> known = {".png", ".mp4", ".webm", ".gif", ".glb", ".html"};
  const std::string ending = out.extension().string();
  if (ending == ".png") return Product::kPicture;
  if (ending == ".glb") return Product::kModel;
  if (ending == ".html") return Product::kPage;
  if (ending.empty() || std::find(known.begin(), known.end(), ending) != known.end()) return Product::kFilm;
  throw UsageError({.what = "-o " + out.string(),
                    .found = "the ending '" + ending + "'",
                    .wanted = ".png, .mp4, .webm, .gif, .glb, .html, or none for a folder of frames",
                    .nearest = nearestNames(ending, known)});
}

// Width and height, pixels.
std::pair<int, int> sizeOf(const std::string& text) {
  constexpr int kLargest = 8192;  // as Renderer
  const std::size_t x = std::min(text.find('x'), text.size());
  const int width = parseNumber<int>(text.substr(0, x)).value_or(0),
            height = parseNumber<int>(text.substr(std::min(x + 1, text.size()))).value_or(0);
  if (std::min(width, height) >= 1 && std::max(width, height) <= kLargest) return {width, height};
  throw UsageError({.what = "--size",
                    .found = "'" + text + "'",
                    .wanted = fmt::format("WIDTHxHEIGHT, 1 to {} pixels each, such as 640x480", kLargest)});
}

Show showOf(const std::string& name) {
  return choose<Show>(
      "--show", name.empty() ? kUsualShow : name,
      {{"color", Show::kColor}, {"depth", Show::kDepth}, {"segmentation", Show::kSegmentation}});
}

AntiAliasing antiAliasingOf(const std::string& name, Product product) {
  if (name.empty()) return product == Product::kFilm ? kFilmAntiAliasing : AntiAliasing::kMsaa4;
  return choose<AntiAliasing>(
      "--aa", name,
      {{"none", AntiAliasing::kNone}, {"fxaa", AntiAliasing::kFxaa}, {"msaa4", AntiAliasing::kMsaa4}});
}

void require(bool holds, const std::string& what, const std::string& wanted) {
  if (!holds) throw UsageError({.what = what, .wanted = wanted});
}

void requireMeaning(const RenderOptions& options, const RenderPlan& plan) {
  const std::string ending = options.out.extension().string();
  require(options.motion.empty() || options.postures.empty(), "--motion and --q", "only one of them");
  require(!options.seconds || options.postures.size() > 1, "--duration",
          "several --q, as it is the time from one to the next");
  require(options.traces.empty() || options.postures.size() > 1 || !options.motion.empty(), "--trace",
          "a motion: several --q, or --motion");
  if (plan.product == Product::kModel) {
    require(options.size.empty(), "--size", "a picture, film or page; a " + ending + " has no pixels");
    require(options.antiAliasing.empty(), "--aa", "a picture, film or page; a " + ending + " has no pixels");
  }
  if (plan.product == Product::kModel || plan.product == Product::kPage) {
    require(!options.scene.reading.textures, "--textures", "a picture or film; a " + ending + " has none");
    require(options.show.empty(), "--show", "a picture or film; a " + ending + " is seen in colour");
    require(options.cameras.size() <= 1, "--camera", "one, for the initial view of the " + ending + " file");
  }
  if (plan.show != Show::kColor) {
    require(options.caption.empty(), "--caption", "--show color; " + options.show + " shows no text");
    require(!options.scene.reading.textures, "--textures", "--show color; " + options.show + " has none");
    require(options.traces.empty(), "--trace", "--show color; " + options.show + " shows no lines");
    require(options.antiAliasing.empty(), "--aa", "--show color; " + options.show + " is not smoothed");
  }
}

}  // namespace

RenderPlan makeRenderPlan(const RenderOptions& options, Facing facing) {
  RenderPlan plan{.product = productOf(options.out), .show = showOf(options.show)};
  const char* usualSize = plan.product == Product::kPage ? kPageSize : kPictureSize;
  const auto [width, height] = sizeOf(options.size.empty() ? usualSize : options.size);
  plan.renderer = {.width = width,
                   .height = height,
                   .antiAliasing = antiAliasingOf(options.antiAliasing, plan.product),
                   .gl = {.backend = parseBackend(options.gl)}};
  for (const std::string& text : options.cameras) {
    const View view(text, facing);
    plan.views.push_back({view.label(), view});
  }
  if (plan.views.empty()) plan.views.push_back({"default", View("default")});
  plan.seconds = options.seconds.value_or(plan.seconds);
  requireMeaning(options, plan);
  return plan;
}

std::string viewNames(const RenderPlan& plan) {
  std::vector<std::string> names;
  for (const auto& [name, view] : plan.views)
    if (name != "default") names.push_back(name);
  if (names.empty()) return {};
  return fmt::format("{}: {}", names.size() == 1 ? "view" : "views", join(names, "; "));
}

GlBackend parseBackend(const std::string& name) {
  try {
    return glBackendFromName(name.empty() ? kUsualGl : name);
  } catch (const Error& error) {
    throw UsageError(error.parts());
  }
}

}  // namespace rex::cli
