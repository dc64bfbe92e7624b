#include "course/replay.h"

#include <utility>

#include "course/film.h"
#include "course/gl_choice.h"
#include "course/simulator.h"
#include "render/report.h"

namespace rex {

void writeReplay(const Simulator& simulator, const std::string& name, const PictureOptions& options,
                 const std::vector<Figure>& figures, std::optional<int> most) {
  Report report{.title = options.caption.empty() ? name : options.caption,
                .film = filmOf(simulator, options, most),
                .view = options.view,
                .still = {.width = options.width, .height = options.height, .gl = glChoice()}};
  if (report.film.empty()) report.film = filmOf(simulator, {simulator.getJointAngles()}, options);
  for (Figure figure : figures) {
    figure.width = 560, figure.height = 360;  // a column next to the robot: a smaller figure has larger texts
    report.figures.push_back({.figure = std::move(figure)});
  }
  writeReport(report, name + ".html");
}

}  // namespace rex
