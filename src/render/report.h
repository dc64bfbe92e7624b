#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/figure.h"
#include "render/film.h"
#include "render/renderer.h"

namespace rex {

/// A figure and the caption below it.
struct ReportFigure {
  Figure figure{};
  std::string caption{};
  /// Times of the film, in order, and the place along x that a line marks from each of them on. Empty: no
  /// line. The x axis must not be logarithmic.
  std::vector<std::pair<double, double>> marks{};
};

/// A motion to view from all sides, with figures and facts about it. Texts may hold any characters.
struct Report {
  std::string title{};
  Film film{};
  Eigen::Vector3d view = kDefaultView;  ///< initial direction of the camera, W, any length
  std::vector<ReportFigure> figures{};
  double start = 0;  ///< time at which the film waits until it is played, seconds; 0: it plays at once
  std::vector<std::pair<std::string, std::string>> facts{};  ///< rows of a table: name and value
  /// Settings for the picture at `start` shown if the film cannot play; the film has the same background.
  RendererOptions still{.width = 800, .height = 600};
};

/// The report as one self-contained HTML page, without other files or network: the film plays and can be
/// turned, with its figures beside it. A browser without WebGL or scripts shows a picture instead. The
/// title is the headline, and captions equal to it are left out. Throws Error as toGlb(), Renderer,
/// drawStill() and writeFigure().
[[nodiscard]] std::string reportPage(const Report& report);

/// Writes reportPage() to a file, which appears whole or not at all. Throws Error naming the path.
void writeReport(const Report& report, const std::filesystem::path& path);

}  // namespace rex
