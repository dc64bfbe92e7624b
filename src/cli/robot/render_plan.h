#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/robot/scene_option.h"
#include "cli/robot/view_option.h"
#include "render/renderer.h"

namespace rex::cli {

/// Raw option strings, empty if not given. RenderPlan is what they mean.
struct RenderOptions {
  SceneOption scene{};
  std::vector<std::string> postures{};  ///< see parsePosture(); several: the motion through them
  std::filesystem::path motion{};       ///< see readMotion()
  std::optional<double> seconds{};      ///< from each posture to the next
  std::vector<std::string> cameras{};   ///< see View; several: side by side
  std::vector<std::string> traces{};    ///< bodies whose way is drawn
  std::string caption{};
  std::string size{};           ///< WIDTHxHEIGHT
  std::string show{};           ///< color, depth or segmentation
  std::string antiAliasing{};   ///< none, fxaa or msaa4
  std::string gl{};             ///< auto, osmesa or egl
  std::filesystem::path out{};  ///< its ending says what is made
};

/// What `rex render` makes: a still, a film or its frames, a .glb, or an .html page.
enum class Product { kPicture, kFilm, kModel, kPage };

/// What its pixels show.
enum class Show { kColor, kDepth, kSegmentation };

struct NamedView {
  std::string name;  ///< its label
  View view;
};

/// What the options of `rex render` mean. Whether they fit the scene is not known yet.
struct RenderPlan {
  Product product{};
  Show show{};
  RendererOptions renderer{};      ///< of a page: of its still
  std::vector<NamedView> views{};  ///< at least one
  double seconds = 2;              ///< from each posture to the next
};

/// Touches nothing; the scene's file may be a name, so `facing` says which way its robots look. Throws
/// UsageError for an option that cannot be read, is out of range, contradicts another, or means nothing for
/// what is made.
[[nodiscard]] RenderPlan planOf(const RenderOptions& options, Facing facing = Facing::kMinusY);

/// "view: front (from +x)" for cameras that were asked for; empty where none was.
[[nodiscard]] std::string viewsOf(const RenderPlan& plan);

/// What `--gl NAME` means; no name is auto. Throws UsageError naming the choices and their packages.
[[nodiscard]] GlBackend backendOf(const std::string& name);

}  // namespace rex::cli
