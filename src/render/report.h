#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "render/figure.h"
#include "render/film.h"
#include "render/renderer.h"

namespace rex {

/// A figure with the line below it.
struct ReportFigure {
  Figure figure{};
  std::string caption{};
};

/// A motion to look at from all sides, with what was measured in it. Texts may hold any characters.
struct Report {
  std::string title{};
  Film film{};
  Eigen::Vector3d view = kDefaultView;  ///< direction of the camera at first, W, any length
  std::vector<ReportFigure> figures{};
  double start = 0;  ///< seconds into the film, where it stands until it is played; played at once if 0
  std::vector<std::pair<std::string, std::string>> facts{};  ///< rows of a table: name and value
  /// Of the picture at `start` where nothing can be played; what can be has the same background.
  RendererOptions still{.width = 800, .height = 600};
};

/// The report as one HTML page that needs nothing else, neither files nor network: the film plays and turns,
/// with its figures beside it; where the browser has no WebGL or runs no scripts there is a picture of it.
/// The title is the headline, and captions equal to it are left out. Throws Error as glbOf(), Renderer,
/// drawStill() and writeFigure().
[[nodiscard]] std::string reportPage(const Report& report);

/// reportPage() into a file, which appears whole or not at all. Throws Error naming the path.
void writeReport(const Report& report, const std::filesystem::path& path);

}  // namespace rex
