#include <filesystem>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "cli/command_table.h"
#include "cli/numbers.h"
#include "cli/out_folder.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "cli/robot/robot_options_internal.h"
#include "render/contact_sheet.h"
#include "render/glb.h"
#include "render/image.h"
#include "render/report.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

Motion motionToDraw(const Model& model, const RenderOptions& options, double seconds) {
  if (!options.motion.empty()) return readMotion(model, options.motion, kVideoRate);
  std::vector<Eigen::VectorXd> keys;
  for (const std::string& text : options.postures) keys.push_back(parsePosture(model, text));
  if (keys.empty()) keys.push_back(model.initialPositions());
  return moveThrough(model, keys, seconds, kVideoRate);
}

// A still of a motion shows its key frames only.
MotionPictures picturesOf(const Model& model, const Motion& motion, const RenderOptions& options,
                          Product product) {
  if (!options.traces.empty() && motion.postures.size() == 1)
    throw UsageError({.what = "--trace", .found = "one posture", .wanted = "a motion"});
  std::vector<std::size_t> shown;
  if (product == Product::kPicture) shown = keyFrames(motion.postures.size(), ContactSheetOptions().pictures);
  // The title of a page is its caption.
  return {model, motion, shown, options.traces, product == Product::kPage ? "" : options.caption};
}

void writeStill(const MotionPictures& pictures, const RenderPlan& plan, const fs::path& out) {
  Studio studio(plan, pictures.framed());
  note(studio.describe());
  std::vector<KeyFrame> drawn;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    drawn.push_back({studio.draw(pictures.picture(i)), fmt::format("{:.2f} s", pictures.time(i))});
  const Image whole = drawn.size() == 1 ? drawn.front().image : captionedSheet(drawn);
  studio.requireSomethingSeen();
  throwIfInterrupted();
  writePng(whole, out);
}

// For products that no Studio describes.
void noteViews(const RenderPlan& plan) {
  if (const std::string views = viewNames(plan); !views.empty()) note(views);
}

}  // namespace

ExitCode render(const Project& project, const RenderOptions& options) {
  const Facing facing = sceneFacing(sceneFilePath(project, options.scene));
  requireGiven("--out", options.out.string(), "render");
  const RenderPlan plan = makeRenderPlan(options, facing);
  const Model model = loadScene(project, options.scene);
  const MotionPictures pictures =
      picturesOf(model, motionToDraw(model, options, plan.seconds), options, plan.product);
  if (pictures.bounds().isEmpty())
    throw UsageError({.what = model.name(), .found = "no shape to draw", .wanted = "a scene with shapes"});
  asWrongUse([&] { makeOutPlace(options.out); });
  fs::path written = options.out;
  switch (plan.product) {
    case Product::kPicture:
      writeStill(pictures, plan, options.out);
      break;
    case Product::kFilm:
      written = writeMotionFilm(pictures, plan, options.out);
      break;
    case Product::kModel:
      throwIfInterrupted();
      noteViews(plan);
      writeGlb(pictures.film(), options.out, plan.views.front().view.direction());
      break;
    case Product::kPage:
      noteViews(plan);
      writeReplay({.title = options.caption.empty() ? options.scene.file.stem().string() : options.caption,
                   .still = plan.renderer},
                  pictures, plan, 1, options.out);
      break;
  }
  say(shown(written));
  return ExitCode::kFull;
}

void addRender(CLI::App* command, Action& action) {
  const auto options = std::make_shared<RenderOptions>();
  command->footer(
      "Examples:\n  scripts/rex render man -o man.png\n"
      "  scripts/rex render man.ors --camera front --camera right --camera top -o views.png\n"
      "  scripts/rex render pegArm.ors --q 0,0,0 --q 0.5,-0.5,0.3 --trace peg -o swing.mp4\n"
      "  scripts/rex render man.ors --q 'upArmR>dnArmR=1.5' -o man.html\n\n"
      "The ending of FILE says what is made: .png (for a motion, its key frames); .mp4, .webm,\n"
      ".gif (for one posture, a walk around it); .glb; .html; or none for a folder of frames.\n"
      "The front of a robot is where it faces: -y in .ors files, +x in all others.");
  addSceneFile(command, "SCENE", options->scene.file);
  command->add_option("-o,--out", options->out, "what to make")->type_name("FILE");
  addReading(command, options->scene.reading);
  addRenderOptions(command, *options);
  addGl(command, options->gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return render(p, *options); }; });
}

}  // namespace rex::cli
