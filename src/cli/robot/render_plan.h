#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/exit_code.h"
#include "cli/robot/scene_option.h"
#include "render/camera.h"
#include "render/contact_sheet.h"
#include "render/image.h"
#include "render/picture.h"
#include "render/renderer.h"

namespace rex::cli {

/// The axis of W that a robot faces: -y in .ors files, like the course's robots; +x in URDF and all other
/// formats, by the ROS convention (REP 103).
enum class Facing { kMinusY, kPlusX };

/// The facing that the extension of a scene's file implies.
[[nodiscard]] Facing sceneFacing(const std::filesystem::path& file);

/// The position of `--camera TEXT`: "front", "back", "left", "right" or "top" of a robot, or "default", the
/// same direction for all; "x,y,z", a direction from the scene; or "x,y,z@x,y,z", the eye and its target,
/// metres.
class View {
 public:
  /// Throws UsageError naming the nearest view, or what cannot be parsed.
  explicit View(const std::string& text, Facing facing = Facing::kMinusY);

  /// The text and, for a named view, the axis from which it looks: "front (from +x)".
  [[nodiscard]] const std::string& label() const { return label_; }

  /// The camera; views without an eye show all of `bounds`. Throws like framing() and lookAt().
  [[nodiscard]] Camera camera(const Bounds& bounds, double aspect) const;
  /// The point it looks at, in W, metres: the given target, else the centre of `bounds`.
  [[nodiscard]] Eigen::Vector3d target(const Bounds& bounds) const {
    return hasEye_ ? target_ : bounds.center();
  }
  /// From the target to the camera, in W, of any length.
  [[nodiscard]] Eigen::Vector3d direction() const { return direction_; }

 private:
  std::string label_;
  bool hasEye_ = false;
  Eigen::Vector3d direction_ = kDefaultView;
  Eigen::Vector3d eye_{0, 0, 0}, target_{0, 0, 0};
};

/// Defaults as a user would type them.
inline constexpr const char *kPictureSize = "640x480", *kPageSize = "800x600", *kUsualShow = "color",
                            *kUsualGl = "auto";

/// Raw option strings, empty if not given. RenderPlan is their interpretation.
struct RenderOptions {
  SceneOption scene{};
  std::vector<std::string> postures{};  ///< see parsePosture(); several: the motion through them
  std::filesystem::path motion{};       ///< see readMotion()
  std::optional<double> seconds{};      ///< from each posture to the next
  std::vector<std::string> cameras{};   ///< see View; several: side by side
  std::vector<std::string> traces{};    ///< bodies whose trace is drawn
  std::string caption{};
  std::string size{};           ///< WIDTHxHEIGHT
  std::string show{};           ///< color, depth or segmentation
  std::string antiAliasing{};   ///< none, fxaa or msaa4
  std::string gl = kUsualGl;    ///< auto, egl, osmesa or gpu
  std::filesystem::path out{};  ///< its extension says what is made
};

/// The product of `rex render`: a still, a film or its frames, a .glb, or an .html page.
enum class Product { kPicture, kFilm, kModel, kPage };

/// What the pixels show.
enum class Show { kColor, kDepth, kSegmentation };

struct NamedView {
  std::string name;  ///< its label
  View view;
};

/// The parsed options of `rex render`, not yet checked against the scene.
struct RenderPlan {
  Product product{};
  Show show{};
  RendererOptions renderer{};      ///< for a page: of its still
  std::vector<NamedView> views{};  ///< at least one
  double seconds = 2;              ///< from each posture to the next
};

/// Parses the options without accessing files. The scene's file may be just a name, so `facing` says which
/// way its robots face. Throws UsageError for an option that cannot be parsed, is out of range, contradicts
/// another, or has no effect on the product.
[[nodiscard]] RenderPlan makeRenderPlan(const RenderOptions& options, Facing facing = Facing::kMinusY);

/// "view: front (from +x)" for the requested cameras; empty if there are none.
[[nodiscard]] std::string viewNames(const RenderPlan& plan);

/// The meaning of `--gl NAME`; an empty name is auto. Throws UsageError naming the choices and their
/// packages.
[[nodiscard]] GlBackend parseBackend(const std::string& name);

/// Draws pictures of one scene according to a plan, with several cameras side by side. Lines, points and
/// texts grow with pictures larger than kPictureSize.
class Studio {
 public:
  /// `scene` bounds everything that will be seen. Throws Error like Renderer.
  Studio(const RenderPlan& plan, const Bounds& scene);

  /// The renderer and the views, on one line.
  [[nodiscard]] std::string describe() const;
  /// Draws a picture, with all cameras turned by `angle` (rad, counterclockwise) about the vertical through
  /// their targets. Throws Error like View::camera() and Renderer::drawFrame(), and Interrupted.
  [[nodiscard]] Image draw(const Picture& picture, double angle = 0);
  /// Whether any part of the scene has been visible so far; always true for depth and segmentation images.
  [[nodiscard]] bool sawSomething() const { return sawSomething_; }
  /// Throws UsageError unless sawSomething().
  void requireSomethingSeen() const;

 private:
  Image drawFrom(const Picture& picture, const Camera& camera);

  RenderPlan plan_;
  Bounds scene_;
  Renderer renderer_;
  bool sawSomething_ = false;
};

/// The pictures (at least one) in rows of three with their captions, at full size.
[[nodiscard]] Image captionedSheet(const std::vector<KeyFrame>& pictures);

/// The box that contains `scene` for any rotation about the vertical through its centre.
[[nodiscard]] Bounds turningBox(const Bounds& scene);

/// Makes what the options request. Throws like makeRenderPlan(), loadScene() and the functions that write
/// files.
ExitCode render(const Project& project, const RenderOptions& options);

}  // namespace rex::cli
