#include "cli/robot/render_plan.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/text.h"
#include "cli/option_value_internal.h"
#include "render/draw_film.h"

namespace rex::cli {
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
  if (name.empty()) return Show::kColor;
  return choose<Show>(
      "--show", name,
      {{"color", Show::kColor}, {"depth", Show::kDepth}, {"segmentation", Show::kSegmentation}});
}

AntiAliasing antiAliasingOf(const std::string& name, Product product) {
  if (name.empty()) return product == Product::kFilm ? kFilmAntiAliasing : AntiAliasing::kMsaa4;
  return choose<AntiAliasing>(
      "--aa", name,
      {{"none", AntiAliasing::kNone}, {"fxaa", AntiAliasing::kFxaa}, {"msaa4", AntiAliasing::kMsaa4}});
}

double secondsOf(const RenderOptions& options, double fallback) {
  constexpr double kShortest = 0.04, kLongest = 600;
  if (!options.seconds) return fallback;
  const double seconds = *options.seconds;
  if (seconds >= kShortest && seconds <= kLongest) return seconds;
  throw UsageError({.what = "--duration",
                    .found = fmt::format("{:g}", seconds),
                    .wanted = fmt::format("{:g} to {:g} seconds", kShortest, kLongest)});
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

RenderPlan planOf(const RenderOptions& options, Facing facing) {
  RenderPlan plan{.product = productOf(options.out), .show = showOf(options.show)};
  const std::string usualSize = plan.product == Product::kPage ? "800x600" : "640x480";
  const auto [width, height] = sizeOf(options.size.empty() ? usualSize : options.size);
  plan.renderer = {.width = width,
                   .height = height,
                   .antiAliasing = antiAliasingOf(options.antiAliasing, plan.product),
                   .gl = {.backend = backendOf(options.gl)}};
  for (const std::string& text : options.cameras) {
    const View view(text, facing);
    plan.views.push_back({view.label(), view});
  }
  if (plan.views.empty()) plan.views.push_back({"default", View("default")});
  plan.seconds = secondsOf(options, plan.seconds);
  requireMeaning(options, plan);
  return plan;
}

std::string viewsOf(const RenderPlan& plan) {
  std::vector<std::string> names;
  for (const auto& [name, view] : plan.views)
    if (name != "default") names.push_back(name);
  if (names.empty()) return {};
  return fmt::format("{}: {}", names.size() == 1 ? "view" : "views", join(names, "; "));
}

GlBackend backendOf(const std::string& name) {
  try {
    return glBackendFromName(name.empty() ? "auto" : name);
  } catch (const Error& error) {
    throw UsageError(error.parts());
  }
}

}  // namespace rex::cli
