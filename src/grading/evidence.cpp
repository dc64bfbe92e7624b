#include "grading/evidence.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "render/film.h"
#include "render/image.h"
#include "render/report.h"
#include "render/text.h"

namespace rex::grading {
namespace {

// For any colour vision, as those of a figure are.
constexpr std::array<Color, 4> kRowColors{
    {kGotColor, {0.84f, 0.37f, 0.0f}, {0.0f, 0.62f, 0.45f}, {0.80f, 0.47f, 0.65f}}};
constexpr Color kPale{0.0f, 0.62f, 0.45f, 0.4f}, kPaleLine{0.0f, 0.62f, 0.45f};

bool isSame(const Solid& a, const Solid& b) {
  constexpr double kTolerance = 1e-9;
  return a.name == b.name && isApprox(a.X_WS, b.X_WS, kTolerance);
}

void appendSolids(std::vector<Solid>& to, const std::vector<Solid>& solids) {
  const std::size_t count = to.size();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (i < count && isSame(to[i], solids[i])) continue;
    to.push_back(solids[i]);
    to.back().color = kPale;
  }
}

template <class Part>
void append(std::vector<Part>& to, const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    to.push_back(part);
    to.back().color = kPaleLine;
  }
}

}  // namespace

Series gotCurve(std::string label, std::vector<double> x, std::vector<double> y) {
  return {.label = std::move(label), .x = std::move(x), .y = std::move(y), .size = 2.5, .color = kGotColor};
}

Series wantedCurve(std::string label, std::vector<double> x, std::vector<double> y) {
  return {
      .label = std::move(label), .x = std::move(x), .y = std::move(y), .dashed = true, .color = kWantedColor};
}

Series wrongCurve(std::string label, std::vector<double> x, std::vector<double> y) {
  return {.label = std::move(label), .x = std::move(x), .y = std::move(y), .size = 2, .color = kWrongColor};
}

Series wrongPoint(std::string label, double x, double y) {
  return {.label = std::move(label),
          .x = {x},
          .y = {y},
          .style = SeriesStyle::kPoints,
          .marker = Marker::kCircle,
          .size = 2.5,
          .color = kWrongColor};
}

Guide wrongFrom(double time) { return {.at = time, .label = "it goes wrong here", .color = kWrongColor}; }

Picture withWanted(Picture got, const Picture& wanted) {
  appendSolids(got.solids, wanted.solids);
  append(got.polylines, wanted.polylines);
  append(got.lineSets, wanted.lineSets);
  append(got.pointSets, wanted.pointSets);
  append(got.arrows, wanted.arrows);
  got.captions.push_back({.text = "wanted: pale green", .color = kPaleLine});
  return got;
}

Film withWanted(const Film& got, const Film& wanted) {
  if (got.empty() || wanted.empty()) return got;
  Film film = got.size() < wanted.size() ? wanted : got;
  for (std::size_t i = 0; i < film.size(); ++i)
    film[i].picture =
        withWanted(got[std::min(i, got.size() - 1)].picture, wanted[std::min(i, wanted.size() - 1)].picture);
  return film;
}

namespace {

constexpr int kWidth = 640, kHeight = 480;

std::vector<double> valuesOf(const Eigen::VectorXd& y) { return {y.begin(), y.end()}; }

// The frame shown at that time.
const Frame& frameAt(const Film& film, double time) {
  const auto later =
      std::find_if(film.begin(), film.end(), [&](const Frame& frame) { return frame.time > time; });
  return later == film.begin() ? *later : *(later - 1);
}

Image momentOf(const Evidence& evidence) {
  Renderer renderer({.width = kWidth, .height = kHeight});
  const Camera camera = framing(evidence.film, evidence.view, static_cast<double>(kWidth) / kHeight);
  return drawStill({frameAt(evidence.film, evidence.moment)}, camera, renderer);
}

// The words of a text in lines that are at most so many pixels wide.
std::vector<std::string> linesOf(const std::string& text, int width) {
  std::vector<std::string> lines{""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || textSize(longer).width <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

Image withHeading(const Image& image, const std::string& text) {
  constexpr int kMargin = 12;
  const std::vector<std::string> lines = linesOf(text, image.width - 2 * kMargin);
  const int lineHeight = textSize("").height;
  const int heading = lineHeight * static_cast<int>(lines.size()) + 2 * kMargin;
  Image whole(image.width, heading + image.height);
  std::fill(whole.rgb.begin(), whole.rgb.end(), std::uint8_t{255});
  std::copy(image.rgb.begin(), image.rgb.end(), whole.pixel(0, heading));
  for (std::size_t k = 0; k < lines.size(); ++k)
    drawText(whole, lines[k], kMargin, kMargin + lineHeight * static_cast<int>(k), kWrongColor);
  return whole;
}

// The images side by side on white, in a picture as high as the tallest.
Image inARow(const std::vector<Image>& images) {
  int width = 0, height = 0;
  for (const Image& image : images) {
    width += image.width;
    height = std::max(height, image.height);
  }
  Image row(width, height);
  std::fill(row.rgb.begin(), row.rgb.end(), std::uint8_t{255});
  int left = 0;
  for (const Image& image : images) {
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.pixel(0, y), 3 * image.width, row.pixel(left, y));
    left += image.width;
  }
  return row;
}

Image drawingOf(const std::vector<Figure>& figures, const std::filesystem::path& scratch) {
  std::vector<Image> images;
  for (const Figure& figure : figures) {
    writeFigure(figure, scratch);
    images.push_back(readPng(scratch));
  }
  return inARow(images);
}

}  // namespace

Figure comparison(const std::string& title, const Eigen::Ref<const Eigen::MatrixXd>& got,
                  const Eigen::Ref<const Eigen::MatrixXd>& wanted) {
  if (got.rows() != wanted.rows() || got.cols() != wanted.cols())
    throw Error({.what = "comparison: " + title,
                 .found = fmt::format("{} x {} numbers", got.rows(), got.cols()),
                 .wanted = fmt::format("{} x {}", wanted.rows(), wanted.cols())});
  if (got.rows() > got.cols()) return comparison(title, got.transpose().eval(), wanted.transpose().eval());
  // Of thousands of columns, those around the worst one: more would hide each other.
  constexpr Eigen::Index kMostColumns = 400;
  Eigen::Index worstRow = 0, worstColumn = 0;
  (got - wanted).cwiseAbs().maxCoeff(&worstRow, &worstColumn);
  const Eigen::Index columns = std::min(got.cols(), kMostColumns);
  const Eigen::Index first = std::clamp<Eigen::Index>(worstColumn - columns / 2, 0, got.cols() - columns);
  std::vector<double> entries(static_cast<std::size_t>(columns));
  std::iota(entries.begin(), entries.end(), static_cast<double>(first));
  const Eigen::VectorXd error = (got - wanted).cwiseAbs().rowwise().maxCoeff();
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(got.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](auto a, auto b) { return error[a] > error[b]; });
  rows.resize(std::min(rows.size(), kRowColors.size()));
  std::sort(rows.begin(), rows.end());
  Figure figure{.title = title, .xLabel = "entry", .yLabel = "value"};
  for (const Eigen::Index row : rows) {
    const std::string name = got.rows() > 1 ? fmt::format("row {}, ", row) : "";
    figure.series.push_back(gotCurve(name + "got", entries, valuesOf(got.row(row).segment(first, columns))));
    figure.series.push_back(
        wantedCurve(name + "wanted", entries, valuesOf(wanted.row(row).segment(first, columns))));
    if (got.rows() > 1)  // both curves of a row have its colour
      for (Series& one : std::span(figure.series).last(2))
        one.color = kRowColors[figure.series.size() / 2 - 1];
  }
  if (figure.series.size() > 2) figure.legend = Legend::kOutside;
  return figure;
}

EvidenceFiles writeEvidence(const Evidence& evidence, const std::string& id, const EvidenceText& text,
                            const std::filesystem::path& folder) {
  EvidenceFiles files;
  if (evidence.figures.empty() && evidence.film.empty()) return files;
  std::filesystem::create_directories(folder);
  files.picture = id + ".png";
  const std::filesystem::path picture = folder / files.picture;
  const Image drawn = evidence.figures.empty() ? momentOf(evidence) : drawingOf(evidence.figures, picture);
  writePng(withHeading(drawn, text.failure), picture);
  if (evidence.film.empty()) return files;
  files.replay = id + ".html";
  Report report{.title = text.title, .film = evidence.film, .view = evidence.view, .start = evidence.moment};
  for (const Figure& figure : evidence.figures) report.figures.push_back({figure, figure.title});
  writeReport(report, folder / files.replay);
  return files;
}

}  // namespace rex::grading
