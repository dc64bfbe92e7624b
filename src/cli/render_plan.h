#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/view_option.h"
#include "render/renderer.h"

namespace rex::cli {

/// What `rex render` makes: a still, a film or its frames, a .glb, or an .html page.
enum class Product { kPicture, kFilm, kModel, kPage };

/// What its pixels tell.
enum class Show { kColor, kDepth, kSegmentation };

struct NamedView {
  std::string name;
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

/// Touches nothing. Throws UsageError for an option that cannot be read, is out of range, contradicts
/// another, or means nothing for what is made.
[[nodiscard]] RenderPlan planOf(const RenderOptions& options);

/// What `--gl NAME` means; no name is auto. Throws UsageError naming the choices and their packages.
[[nodiscard]] GlBackend backendOf(const std::string& name);

}  // namespace rex::cli
