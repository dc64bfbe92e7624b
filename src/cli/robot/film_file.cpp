#include "cli/robot/film_file.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "base/interruption.h"
#include "cli/robot/studio.h"
#include "cli/terminal.h"
#include "render/make_frame_sink.h"

namespace rex::cli {
namespace {

// Without ffmpeg the frames go into a folder with the film's name.
MadeSink openSink(std::filesystem::path& out) {
  MadeSink made = makeFrameSink(out);
  if (made.missing.empty()) return made;
  note(made.missing + "; the frames go into a folder instead");
  return makeFrameSink(out.replace_extension());
}

}  // namespace

void requireFilmable(const Model& model) {
  if (std::ranges::any_of(model.shapes(), [](const ModelShape& one) { return one.visible; })) return;
  throw UsageError({.what = model.name(), .found = "no shape that a film can show", .wanted = "--no-film"});
}

std::filesystem::path writeFilm(const MotionPictures& pictures, const RenderPlan& plan,
                                std::filesystem::path out) {
  constexpr std::size_t kTurn = 120;  // frames
  const bool isWalk = pictures.size() == 1;
  const std::size_t count = isWalk ? kTurn : pictures.size();
  Studio studio(plan, isWalk ? turningBox(pictures.bounds()) : pictures.bounds());
  note(studio.describe());
  const Picture first = pictures.picture(0);  // a walk around the scene shows only this one
  const auto draw = [&](std::size_t i) {
    if (!isWalk) return studio.draw(pictures.picture(i));
    return studio.draw(first, 2 * std::numbers::pi * static_cast<double>(i) / kTurn);
  };
  for (std::size_t i = 0; i < count && !studio.sawSomething(); ++i) static_cast<void>(draw(i));
  studio.requireSomethingSeen();
  const MadeSink made = openSink(out);
  for (std::size_t i = 0; i < count; ++i) made.sink->add(draw(i));
  throwIfInterrupted();
  made.sink->finish();
  return out;
}

}  // namespace rex::cli
