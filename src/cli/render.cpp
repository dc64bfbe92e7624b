#include <algorithm>
#include <charconv>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "cli/commands.h"
#include "cli/posture_option.h"
#include "cli/terminal.h"
#include "cli/view_option.h"
#include "geometry/rotation.h"
#include "render/contact_sheet.h"
#include "render/draw_film.h"
#include "render/glb.h"
#include "render/make_frame_sink.h"
#include "render/png.h"
#include "render/renderer.h"
#include "render/report.h"
#include "render/scene_picture.h"
#include "scene/ors_reader.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kRate = 30;  // frames per second

enum class Product { kPicture, kFilm, kModel, kPage };

// No ending: a folder of pictures.
Product productOf(const fs::path& out) {
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

struct Size {
  int width = 0, height = 0;
};

Size parseSize(const std::string& text) {
  Size size;
  const char* const end = text.data() + text.size();
  const auto [x, first] = std::from_chars(text.data(), end, size.width);
  if (first == std::errc() && x != end && *x == 'x') {
    const auto [last, second] = std::from_chars(x + 1, end, size.height);
    if (second == std::errc() && last == end) return size;
  }
  throw UsageError({.what = "--size", .found = "'" + text + "'", .wanted = "WIDTHxHEIGHT, such as 640x480"});
}

template <typename Value>
Value choose(const char* option, const std::string& name,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [known, value] : choices) {
    if (name == known) return value;
    names.push_back(known);
  }
  throw UsageError({.what = option,
                    .found = "'" + name + "'",
                    .wanted = fmt::format("{}", fmt::join(names, ", ")),
                    .nearest = nearestNames(name, names)});
}

Model load(const Project& project, const fs::path& scene) {
  const fs::path own = project.root / "data" / "robots" / scene;
  const bool isOwn = !scene.has_parent_path() && !fs::exists(scene) && fs::exists(own);
  SceneFile file = readOrs(isOwn ? own : scene);
  for (const Diagnostic& one : file.notes) note(toString(one));
  return compile(file.spec);
}

Motion motionOf(const Model& model, const RenderOptions& options) {
  if (!options.motion.empty()) return readMotion(model, options.motion, kRate);
  std::vector<Eigen::VectorXd> keys;
  for (const std::string& text : options.postures) keys.push_back(parsePosture(model, text));
  if (keys.empty()) keys.push_back(model.initialPositions());
  return moveThrough(model, keys, options.seconds, kRate);
}

Film filmOf(const Model& model, const Motion& motion, const RenderOptions& options) {
  Film film;
  std::vector<Polyline> traces(options.traces.size());
  for (std::size_t i = 0; i < motion.postures.size(); ++i) {
    const BodyPoses poses = forwardKinematics(model, motion.postures[i]);
    film.push_back({motion.times[i], pictureOf(model, poses)});
    Picture& picture = film.back().picture;
    if (!options.caption.empty()) picture.captions.push_back({.text = options.caption});
    for (std::size_t k = 0; k < traces.size(); ++k)
      traces[k].points.push_back(poses[model.body(options.traces[k])].p);
    if (i > 0) picture.polylines.insert(picture.polylines.end(), traces.begin(), traces.end());
  }
  settleGround(film);
  return film;
}

// One turn around a scene that stands still.
std::vector<Camera> walkAround(const Film& film, const View& view, double aspect, int count) {
  Bounds box = bounds(film);
  const Eigen::Vector3d middle = box.center(), half = box.high - middle;
  const double reach = half.head<2>().norm();  // as wide from all sides
  box.include(middle - Eigen::Vector3d(reach, reach, half.z()));
  box.include(middle + Eigen::Vector3d(reach, reach, half.z()));
  const Camera start = view.camera(box, aspect);
  std::vector<Camera> cameras(static_cast<std::size_t>(count), start);
  for (int i = 0; i < count; ++i) {
    const Pose X_turn{rotationAboutAxis(2 * std::numbers::pi * i / count, Eigen::Vector3d::UnitZ()), {}};
    cameras[static_cast<std::size_t>(i)].X_WC = {X_turn.R * start.X_WC.R,
                                                 middle + X_turn.R * (start.X_WC.p - middle)};
  }
  return cameras;
}

// Draws moments as the options ask for, the pictures of several cameras side by side.
class Studio {
 public:
  Studio(const RenderOptions& options, const Film& film, AntiAliasing antiAliasing)
      : size_(parseSize(options.size)),
        show_(choose<Show>(
            "--show", options.show,
            {{"color", Show::kColor}, {"depth", Show::kDepth}, {"segmentation", Show::kSegmentation}})),
        scene_(bounds(film)),
        renderer_({.width = size_.width,
                   .height = size_.height,
                   .antiAliasing = antiAliasing,
                   .gl = {.backend = glBackendFromName(options.gl)}}) {
    for (const std::string& text : options.cameras) views_.push_back({text, View(text)});
    if (views_.empty()) views_.push_back({"", View("default")});
    note(renderer_.describe());
  }

  const View& firstView() const { return views_.front().view; }
  double aspect() const { return static_cast<double>(size_.width) / size_.height; }

  Image draw(const Picture& picture) {
    if (views_.size() == 1) return drawFrom(picture, firstView().camera(scene_, aspect()));
    std::vector<KeyFrame> pictures;
    for (const auto& [name, view] : views_)
      pictures.push_back({drawFrom(picture, view.camera(scene_, aspect())), name});
    const int count = static_cast<int>(pictures.size());
    return contactSheet(pictures,
                        {.pictures = count, .columns = std::min(count, 3), .pictureWidth = size_.width});
  }

  Image drawFrom(const Picture& picture, const Camera& camera) {
    if (show_ == Show::kSegmentation) return segmentationColors(renderer_.drawSegmentation(picture, camera));
    if (show_ == Show::kColor) return renderer_.draw(picture, camera);
    const double distance = (scene_.center() - camera.X_WC.p).norm(), reach = scene_.radius();
    return depthColors(renderer_.drawDepth(picture, camera), std::max(0., distance - reach),
                       distance + 2 * reach);
  }

 private:
  enum class Show { kColor, kDepth, kSegmentation };
  struct NamedView {
    std::string name;
    View view;
  };

  Size size_;
  Show show_;
  Bounds scene_;
  Renderer renderer_;
  std::vector<NamedView> views_;
};

View viewOf(const RenderOptions& options) {
  return View(options.cameras.empty() ? "default" : options.cameras.front());
}

AntiAliasing antiAliasingOf(const RenderOptions& options, bool isFilm) {
  if (options.antiAliasing.empty()) return isFilm ? kFilmAntiAliasing : AntiAliasing::kMsaa4;
  return choose<AntiAliasing>(
      "--aa", options.antiAliasing,
      {{"none", AntiAliasing::kNone}, {"fxaa", AntiAliasing::kFxaa}, {"msaa4", AntiAliasing::kMsaa4}});
}

// A film of one moment becomes a walk around it.
void drawFrames(Studio& studio, const Film& film, FrameSink& sink) {
  constexpr int kTurn = 120;  // frames
  if (film.size() == 1) {
    for (const Camera& camera : walkAround(film, studio.firstView(), studio.aspect(), kTurn)) {
      throwIfInterrupted();
      sink.add(studio.drawFrom(film[0].picture, camera));
    }
  } else {
    for (const Frame& frame : film) {
      throwIfInterrupted();
      sink.add(studio.draw(frame.picture));
    }
  }
  sink.finish();
}

// Of a motion: its key frames on one sheet.
void writeStill(const Film& film, const RenderOptions& options) {
  Studio studio(options, film, antiAliasingOf(options, false));
  if (film.size() == 1) return writePng(studio.draw(film[0].picture), options.out);
  std::vector<KeyFrame> pictures;
  for (const std::size_t i : keyFrames(film.size(), ContactSheetOptions().pictures))
    pictures.push_back({studio.draw(film[i].picture), fmt::format("{:.2f} s", film[i].time)});
  writePng(contactSheet(pictures), options.out);
}

// Without ffmpeg the frames go into a folder of that name.
fs::path writeFilm(const Film& film, const RenderOptions& options) {
  fs::path out = options.out;
  MadeSink made = makeFrameSink(out);
  if (!made.missing.empty()) {
    note(made.missing + "; the frames go into a folder instead");
    made = makeFrameSink(out.replace_extension());
  }
  Studio studio(options, film, antiAliasingOf(options, true));
  drawFrames(studio, film, *made.sink);
  return out;
}

}  // namespace

ExitCode render(const Project& project, const RenderOptions& options) {
  const Product product = productOf(options.out);
  if (!options.motion.empty() && !options.postures.empty())
    throw UsageError({.what = "--motion and --q", .wanted = "one of them"});
  const Model model = load(project, options.scene);
  const Film film = filmOf(model, motionOf(model, options), options);
  fs::path written = options.out;
  switch (product) {
    case Product::kPicture:
      writeStill(film, options);
      break;
    case Product::kFilm:
      written = writeFilm(film, options);
      break;
    case Product::kModel:
      writeGlb(film, options.out, viewOf(options).direction());
      break;
    case Product::kPage:
      writeReport({.title = options.caption.empty() ? model.name() : options.caption,
                   .film = film,
                   .view = viewOf(options).direction(),
                   .still = {.width = 800, .height = 600, .gl = {.backend = glBackendFromName(options.gl)}}},
                  options.out);
      break;
  }
  say(shown(written));
  return ExitCode::kFull;
}

}  // namespace rex::cli
