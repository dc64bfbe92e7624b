#include "live/live_recording.h"

#include <fmt/format.h>

#include "kinematics/forward_kinematics.h"
#include "render/report.h"
#include "render/scene_picture.h"
#include "scene/coordinate_names.h"

namespace rex {

std::string replayOf(const Model& model, const LiveRecording& recording) {
  Report report{.title = model.name()};
  for (std::size_t k = 0; k < recording.times.size(); ++k)
    report.film.push_back({.time = recording.times[k],
                           .picture = pictureOf(model, forwardKinematics(model, recording.postures[k]))});
  settleGround(report.film);
  if (recording.floor)
    for (Frame& frame : report.film) frame.picture.ground.height = *recording.floor;
  return reportPage(report);
}

std::string tableOf(const Model& model, const LiveRecording& recording) {
  std::string text = "time";
  for (const std::string& name : positionNames(model)) {
    text += ',';
    for (const char c : name) text += c == ',' || c == '\n' || c == '"' ? '_' : c;
  }
  text += '\n';
  for (std::size_t k = 0; k < recording.times.size(); ++k) {
    text += fmt::format("{}", recording.times[k] - recording.times.front());
    for (const double value : recording.postures[k]) text += fmt::format(",{}", value);
    text += '\n';
  }
  return text;
}

}  // namespace rex
