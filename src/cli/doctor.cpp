#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/process.h"
#include "cli/commands.h"
#include "cli/terminal.h"
#include "grading/private_folder.h"
#include "render/figure.h"
#include "render/png.h"
#include "render/renderer.h"
#include "render/report.h"
#include "render/video_sink.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// One thing that was tried.
struct Finding {
  std::string name;
  bool works = false;
  std::string text;  // what works, or why it does not
};

// Tries something that says what it found, or throws.
Finding tryOut(const std::string& name, const std::function<std::string()>& attempt) {
  try {
    return {name, true, attempt()};
  } catch (const std::exception& error) {
    return {name, false, error.what()};
  }
}

[[noreturn]] void fail(const std::string& what) { throw Error({.what = what}); }

std::string firstLineOf(const std::vector<std::string>& command) {
  const ProcessResult result = runProcess(command, {.timeout = 20});
  if (!result.started) throw Error({.what = command[0] + " is not installed"});
  if (!result.ok()) throw Error({.what = command[0] + " does not work", .found = harmless(result.error)});
  return harmless(result.output.substr(0, result.output.find('\n')));
}

// A red ball on the left and a blue box on the right, above the ground.
constexpr Color kRed{0.9f, 0.1f, 0.1f}, kBlue{0.1f, 0.2f, 0.9f};
const Eigen::Vector3d kBall(-0.6, 0, 0.5), kBox(0.6, 0, 0.5);

Picture testPicture() {
  return {
      .solids = {{.shape = {.type = ShapeType::kSphere, .radius = 0.4}, .X_WS = {.p = kBall}, .color = kRed},
                 {.shape = {.extent = {0.6, 0.6, 0.6}}, .X_WS = {.p = kBox}, .color = kBlue}}};
}

// Draws the test picture and looks at what should be where; the picture ends up in `folder`.
Image testImage(GlBackend backend, const fs::path& folder, std::string& description) {
  const Camera camera = lookAt({0, -4, 1.5}, {0, 0, 0.4});
  Renderer renderer({.width = 320, .height = 240, .gl = {.backend = backend}});
  description = renderer.describe();
  Image image = renderer.draw(testPicture(), camera);
  writePng(image, folder / "test.png");
  if (readPng(folder / "test.png") != image) fail("the test picture is not the same after it was written");
  const auto colorAt = [&](const Eigen::Vector3d& p) {
    const auto at = project(camera, p, image.width, image.height);
    return image.at(static_cast<int>(at->x), static_cast<int>(at->y));
  };
  const auto ball = colorAt(kBall), box = colorAt(kBox);
  const bool isRed = ball[0] > 2 * ball[1] && ball[0] > 2 * ball[2];
  const bool isBlue = box[2] > 2 * box[0] && box[2] > 2 * box[1];
  if (!isRed || !isBlue) fail("the test picture is wrong: no red ball or blue box where they should be");
  return image;
}

std::vector<Finding> tryBackends(const DoctorOptions& options, const fs::path& folder) {
  std::vector<Finding> findings;
  std::optional<Image> first;
  for (const std::string name : {"osmesa", "egl"}) {
    if (options.gl != "auto" && options.gl != name) continue;
    findings.push_back(tryOut("OpenGL by " + name, [&] {
      std::string description;
      const Image image = testImage(glBackendFromName(name), folder, description);
      if (first && *first != image) fail(description + ": its pixels differ from those of the other backend");
      const char* same = first ? ", the same pixels" : "";
      first = image;
      return description + "; test picture as expected" + same;
    }));
  }
  return findings;
}

Finding tryFigures(const fs::path& folder) {
  return tryOut("figures", [&] {
    const std::string version = firstLineOf({"gnuplot", "--version"});
    const Figure figure{
        .title = "test", .xLabel = "x [m]", .yLabel = "y [m]", .series = {{.y = {0, 1, 0.5, 2}}}};
    writeFigure(figure, folder / "test-figure.svg");
    writeFigure(figure, folder / "test-figure.png");
    static_cast<void>(readPng(folder / "test-figure.png"));
    return version + "; PNG and SVG";
  });
}

Finding tryVideos(const fs::path& folder) {
  return tryOut("videos", [&] {
    const std::string version = firstLineOf({"ffmpeg", "-version"});
    for (const char* ending : {".mp4", ".webm", ".gif"}) {
      VideoSink sink(folder / (std::string("test") + ending));
      for (int i = 0; i < 5; ++i) {
        Image frame(64, 48);
        frame.rgb.assign(frame.rgb.size(), static_cast<std::uint8_t>(40 * i));
        sink.add(frame);
      }
      sink.finish();
    }
    return version.substr(0, version.find(" Copyright")) + "; .mp4, .webm and .gif";
  });
}

Finding tryReplays(const fs::path& folder) {
  return tryOut("replays", [&] {
    writeReport({.title = "test", .film = {{0, testPicture()}}}, folder / "test.html");
    return fmt::format("a page of {} KiB", fs::file_size(folder / "test.html") / 1024);
  });
}

void sayAll(const std::vector<Finding>& findings) {
  constexpr std::size_t kColumn = 26;
  for (const Finding& finding : findings) {
    const std::string state = finding.works ? paint(Colour::kGreen, "works ") : paint(Colour::kRed, "fails ");
    say(fmt::format("{:<18}  {}{}", finding.name, state, wrap(finding.text, kColumn, kColumn)));
  }
}

void sayJson(const std::vector<Finding>& findings) {
  nlohmann::json rows = nlohmann::json::array();
  for (const Finding& finding : findings)
    rows.push_back({{"name", finding.name}, {"works", finding.works}, {"text", finding.text}});
  say(nlohmann::json{{"findings", rows}}.dump(2));
}

}  // namespace

ExitCode doctor(const Project&, const DoctorOptions& options) {
  static_cast<void>(glBackendFromName(options.gl));
  const grading::PrivateFolder folder(fs::temp_directory_path());
  std::vector<Finding> findings = tryBackends(options, folder.path());
  findings.push_back(tryFigures(folder.path()));
  findings.push_back(tryVideos(folder.path()));
  findings.push_back(tryReplays(folder.path()));
  options.json ? sayJson(findings) : sayAll(findings);
  for (const Finding& finding : findings)
    if (!finding.works) return ExitCode::kGraderFault;
  return ExitCode::kFull;
}

}  // namespace rex::cli
