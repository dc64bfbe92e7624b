#include "cli/robot/view_film.h"

#include <csignal>
#include <utility>

#include <unistd.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/text_file.h"
#include "cli/robot/motion_files.h"
#include "cli/robot/posture_option.h"

namespace rex::cli {

ViewFilm::~ViewFilm() {
  if (!painter_.joinable()) return;
  isEnding_ = true;
  ::pthread_kill(painter_.native_handle(), SIGTERM);  // held there, until drawing asks for it
  painter_.join();
}

std::string ViewFilm::draw() {
  if (table_.empty()) return "There is no recording yet.";
  const std::lock_guard lock(mutex_);
  if (isBusy_) return "A film is being drawn.";
  isBusy_ = true;
  if (painter_.joinable()) painter_.join();
  painter_ = std::thread([this, table = table_] {
    Drawn made;
    try {
      made = drawn(table);
    } catch (const std::exception& error) {
      made = {.text = error.what()};
    } catch (const Interrupted& stop) {
      if (!isEnding_) ::kill(::getpid(), stop.signal);  // it comes once, and the owner waits for it, too
    }
    const std::lock_guard held(mutex_);
    drawn_ = std::move(made), isBusy_ = false;
  });
  return "The film is being drawn.";
}

std::optional<ViewFilm::Drawn> ViewFilm::takeDrawn() {
  const std::lock_guard lock(mutex_);
  return std::exchange(drawn_, std::nullopt);
}

ViewFilm::Drawn ViewFilm::drawn(const std::string& table) const {
  const std::filesystem::path motion = folder_ / "motion.csv", out = folder_ / "film.mp4";
  writeTextFile(motion, table);
  std::filesystem::remove(out);
  const Motion moved = readMotion(model_, motion, kVideoRate);
  const std::filesystem::path written = writeMotionFilm(
      {model_, moved, {}, {}, ""}, makeRenderPlan({.motion = motion, .out = out}, facing_), out);
  if (written != out)
    return {.text = "There is no ffmpeg here to make films (apt-get install ffmpeg). The replay needs none."};
  return {.text = "The film is ready: film.mp4, below \"Record\".", .bytes = readTextFile(out)};
}

}  // namespace rex::cli
