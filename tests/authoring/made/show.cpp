#include "show.h"

#include "render/report.h"

using namespace rex;

void showResult(const std::vector<double>& values, const std::vector<Eigen::Vector3d>& path) {
  const Figure figure{.title = "Result",
                      .xLabel = "step",
                      .yLabel = "value [1]",
                      .series = {{.label = "yours", .y = values}}};
  plot("result", figure);
  const Film film = makeFilm(static_cast<int>(path.size()), 0.5, [&](int k) {
    const Eigen::Vector3d& p = path[static_cast<std::size_t>(k)];
    return Picture{.polylines = {{.points = path}}, .axes = {{.X_WF = translation(p.x(), p.y(), p.z())}}};
  });
  writeReport({.title = "Result", .film = film, .figures = {{.figure = figure}}}, "result.html");
}
