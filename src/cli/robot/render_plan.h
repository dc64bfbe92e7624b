#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/robot/scene_option.h"
#include "cli/robot/view_option.h"
#include "render/renderer.h"

namespace rex::cli {

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
  std::string gl{};             ///< auto, osmesa or egl
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
[[nodiscard]] RenderPlan planOf(const RenderOptions& options, Facing facing = Facing::kMinusY);

/// "view: front (from +x)" for the requested cameras; empty if there are none.
[[nodiscard]] std::string viewsOf(const RenderPlan& plan);

/// The meaning of `--gl NAME`; an empty name is auto. Throws UsageError naming the choices and their
/// packages.
[[nodiscard]] GlBackend backendOf(const std::string& name);

}  // namespace rex::cli
