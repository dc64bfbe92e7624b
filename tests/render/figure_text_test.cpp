// Texts of figures come from students and files. They appear as they are, and nothing in them is run.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/figure.h"
#include "render/figure_script_internal.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/needs_gnuplot.h"

namespace rex::figure_text_test {

namespace fs = std::filesystem;

Figure flat() {
  return {.title = "title",
          .xLabel = "x [m]",
          .yLabel = "y [m]",
          .colorLabel = "cost [1]",
          .series = {{.label = "series", .y = {0, 1}}},
          .verticalLines = {{.at = 1, .label = "upright"}},
          .horizontalLines = {{.at = 1, .label = "level"}},
          .ellipses = {{.label = "ellipse"}},
          .arrows = {{.label = "arrows", .x = {0}, .y = {0}, .dx = {1}, .dy = {1}}},
          .histograms = {{.label = "bars", .heights = {1, 2}}},
          .bands = {{.label = "band", .low = {0, 1}, .high = {1, 2}}},
          .regions = {{.label = "region", .x = {0, 1, 1}, .y = {0, 0, 1}}},
          .heatMap = HeatMap{.values = Eigen::MatrixXd::Identity(2, 2), .contours = 1},
          .notes = {{.text = "note"}, {.text = "far", .x = 3}}};
}

Figure deep() {
  return {.title = "title",
          .xLabel = "x [m]",
          .yLabel = "y [m]",
          .zLabel = "z [m]",
          .series = {{.label = "series", .x = {0, 1}, .y = {0, 1}, .z = {0, 1}}},
          .notes = {{.text = "note"}}};
}

using Places = std::vector<std::pair<std::string, std::function<std::string&(Figure&)>>>;

Places places() {
  return {{"title", [](Figure& f) -> std::string& { return f.title; }},
          {"xLabel", [](Figure& f) -> std::string& { return f.xLabel; }},
          {"yLabel", [](Figure& f) -> std::string& { return f.yLabel; }},
          {"colorLabel", [](Figure& f) -> std::string& { return f.colorLabel; }},
          {"series", [](Figure& f) -> std::string& { return f.series[0].label; }},
          {"vertical line", [](Figure& f) -> std::string& { return f.verticalLines[0].label; }},
          {"horizontal line", [](Figure& f) -> std::string& { return f.horizontalLines[0].label; }},
          {"ellipse", [](Figure& f) -> std::string& { return f.ellipses[0].label; }},
          {"arrows", [](Figure& f) -> std::string& { return f.arrows[0].label; }},
          {"histogram", [](Figure& f) -> std::string& { return f.histograms[0].label; }},
          {"band", [](Figure& f) -> std::string& { return f.bands[0].label; }},
          {"region", [](Figure& f) -> std::string& { return f.regions[0].label; }},
          {"note", [](Figure& f) -> std::string& { return f.notes[0].text; }},
          {"note at the right", [](Figure& f) -> std::string& { return f.notes[1].text; }}};
}

std::vector<std::string> hostileTexts(const fs::path& folder) {
  const std::string touch = "touch " + (folder / "owned").string();
  return {"`" + touch + "`",
          "' ; system('" + touch + "') ; '",
          "it's\nsystem('" + touch + "')\n!" + touch,
          "\"`" + touch + "`\" @m $(" + touch + ")",
          "\\' . system('" + touch + "') . \\'",
          "'@m \"@m\" '`" + touch + "`",
          std::string("a\0b", 3) + "\x01\x7f\xff\xc0\x1b[31m",
          "'",
          "''",
          "\\",
          "a\\",
          "\\n \\t \\042",
          "EOD\nunset key",
          "EOD",
          "# [2:*] $text[1] columnhead(1)",
          "\xc3\xa4\xce\xb8\xe2\x82\xac \xf0\x9f\xa4\x96",
          "<b>&amp;]]> %s %n {/Symbol a} _x^2"};
}

// As it stands in an SVG.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
  return result;
}

TEST(FigureText, RunsNothingWhereverItStands) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure-hostile");
  for (const std::string& text : hostileTexts(folder)) {
    Figure figure = flat();
    for (const auto& [name, place] : places()) place(figure) = text;
    EXPECT_NO_THROW(writeFigure(figure, folder / "a.png")) << text;
    EXPECT_NO_THROW(writeFigure(figure, folder / "a.svg")) << text;
    figure = deep();
    figure.title = figure.xLabel = figure.yLabel = figure.zLabel = figure.series[0].label = text;
    figure.notes[0].text = text;
    EXPECT_NO_THROW(writeFigure(figure, folder / "a.png")) << text;
    EXPECT_NO_THROW(writeFigure(figure, folder / "a.svg")) << text;
  }
  EXPECT_FALSE(fs::exists(folder / "owned"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 2);
}

TEST(FigureText, AppearsAsGivenInEveryPlace) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure-text");
  const std::string text = R"('it`s' "q" \n @m {a} _x^2 %s $(ls) <b>&amp; EOD)"
                           " \xce\xb8 ''";
  for (const auto& [name, place] : places()) {
    Figure figure = flat();
    place(figure) = text;
    writeFigure(figure, folder / "a.svg");
    EXPECT_THAT(fileText(folder / "a.svg"), testing::HasSubstr("<text>" + escaped(text) + "</text>")) << name;
  }
  Figure figure = deep();
  figure.zLabel = text;
  writeFigure(figure, folder / "a.svg");
  EXPECT_THAT(fileText(folder / "a.svg"), testing::HasSubstr("<text>" + escaped(text) + "</text>"));
}

TEST(FigureText, OfAFileNameIsOnlyAName) {
  REX_NEEDS_GNUPLOT();
  const fs::path folder = freshFolder("figure-name");
  const fs::path path = folder / "a`touch owned`'\"\n$(touch owned) |x.png";
  writeFigure(flat(), path);
  EXPECT_TRUE(fs::exists(path));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
}

// A text reaches gnuplot as one line of a data block, behind a mark, and nowhere else.
TEST(FigureText, StaysInTheBlockOfTexts) {
  Figure figure = flat();
  for (const auto& [name, place] : places()) place(figure) = "EVIL\nEOD\nEVIL";
  const std::string script = internal::figureScript(figure, "svg");
  std::istringstream lines(script.substr(script.find("$text << EOD\n")));
  std::string line;
  std::getline(lines, line);
  std::size_t texts = 0;
  while (std::getline(lines, line) && line != "EOD") {
    EXPECT_EQ(line, "|EVIL EOD EVIL");
    ++texts;
  }
  EXPECT_EQ(texts, places().size());
  while (std::getline(lines, line)) EXPECT_EQ(line.find("EVIL"), std::string::npos) << line;
}

}  // namespace rex::figure_text_test
