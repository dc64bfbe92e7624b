#include "grading/evidence.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "render/draw_film.h"
#include "render/png.h"
#include "render/report.h"

namespace rex::grading {
namespace {

constexpr int kWidth = 640, kHeight = 480;

Series seriesOf(const std::string& label, const Eigen::VectorXd& y, bool wanted) {
  Series series{.label = label, .size = wanted ? 1. : 2., .dashed = wanted};
  if (wanted) series.color = Color{.2f, .22f, .26f};
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    series.x.push_back(static_cast<double>(i));
    series.y.push_back(y[i]);
  }
  return series;
}

// The frame that is shown at that time.
const Frame& frameAt(const Film& film, double time) {
  const auto later =
      std::find_if(film.begin(), film.end(), [&](const Frame& frame) { return frame.time > time; });
  return later == film.begin() ? *later : *(later - 1);
}

void drawMoment(const Evidence& evidence, const std::filesystem::path& file) {
  Renderer renderer({.width = kWidth, .height = kHeight});
  const Camera camera = framing(evidence.film, evidence.view, static_cast<double>(kWidth) / kHeight);
  writePng(drawStill({frameAt(evidence.film, evidence.moment)}, camera, renderer), file);
}

}  // namespace

Figure comparison(const std::string& title, const Eigen::Ref<const Eigen::MatrixXd>& got,
                  const Eigen::Ref<const Eigen::MatrixXd>& wanted) {
  constexpr std::size_t kMost = 4;
  if (got.rows() > got.cols()) return comparison(title, got.transpose().eval(), wanted.transpose().eval());
  const Eigen::VectorXd error = (got - wanted).cwiseAbs().rowwise().maxCoeff();
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(got.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](auto a, auto b) { return error[a] > error[b]; });
  rows.resize(std::min(rows.size(), kMost));
  std::sort(rows.begin(), rows.end());
  Figure figure{.title = title, .xLabel = "number in the row", .yLabel = "value"};
  for (const Eigen::Index row : rows) {
    const std::string name = got.rows() > 1 ? fmt::format("row {}, ", row) : "";
    figure.series.push_back(seriesOf(name + "got", got.row(row).transpose(), false));
    figure.series.push_back(seriesOf(name + "wanted", wanted.row(row).transpose(), true));
  }
  return figure;
}

EvidenceFiles writeEvidence(const Evidence& evidence, const std::string& id, const std::string& title,
                            const std::filesystem::path& folder) {
  EvidenceFiles files;
  if (evidence.figures.empty() && evidence.film.empty()) return files;
  std::filesystem::create_directories(folder);
  files.picture = id + ".png";
  if (evidence.figures.empty())
    drawMoment(evidence, folder / files.picture);
  else
    writeFigure(evidence.figures.front(), folder / files.picture);
  if (evidence.film.empty()) return files;
  files.replay = id + ".html";
  Report report{.title = title, .film = evidence.film, .view = evidence.view, .start = evidence.moment};
  for (const Figure& figure : evidence.figures) report.figures.push_back({figure, figure.title});
  writeReport(report, folder / files.replay);
  return files;
}

}  // namespace rex::grading
