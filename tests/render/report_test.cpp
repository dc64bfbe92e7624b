#include "render/report.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "base/base64.h"
#include "base/process.h"
#include "render/glb.h"
#include "render/image.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/fresh_folder.h"
#include "support/needs_gnuplot.h"
#include "support/needs_osmesa.h"

namespace rex::report_test {

namespace fs = std::filesystem;

Report rollingBall() {
  Report report{.title = "A ball", .still = {.width = 160, .height = 120}};
  for (int k = 0; k < 5; ++k) {
    Picture picture;
    picture.solids = {
        {{.type = ShapeType::kSphere, .radius = 0.2}, translation(0.1 * k, 0, 0.2), {1, 0, 0}, "ball"}};
    report.film.push_back({0.1 * k, picture});
  }
  return report;
}

// A tent of two colours, open below and at its ends. Turned inside out, it looks the same.
TriangleMesh tent(bool insideOut = false) {
  const float n = std::sqrt(0.5f), side = insideOut ? -n : n;
  std::vector<TriangleMesh::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  if (insideOut)
    for (TriangleMesh::Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
  std::vector<Eigen::Vector3f> normals(4, {0, -side, side});
  normals.insert(normals.end(), 4, {0, side, side});
  return {{{0, -0.3f, 0},
           {0.5f, -0.3f, 0},
           {0.5f, 0, 0.3f},
           {0, 0, 0.3f},
           {0, 0, 0.3f},
           {0.5f, 0, 0.3f},
           {0.5f, 0.3f, 0},
           {0, 0.3f, 0}},
          normals,
          triangles,
          {{.firstTriangle = 0, .triangleCount = 2},
           {.color = Eigen::Vector4f(0.2f, 0.4f, 0.8f, 1), .firstTriangle = 2, .triangleCount = 2}}};
}

// Points on a screw.
TriangleMesh cloud() {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 150; ++i)
    points.push_back(
        Eigen::Vector3d(0.15 * std::cos(0.3 * i), 0.15 * std::sin(0.3 * i), 0.003 * i).cast<float>());
  return {points, {}, {}};
}

// A fan of lines that do not touch.
LineSet fan(double turn) {
  LineSet lines{.color = {0.5f, 0.2f, 0.6f}, .width = 2};
  for (int i = 0; i < 24; ++i) {
    const double angle = turn + 2 * std::numbers::pi * i / 24;
    const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.2);
    lines.segments.emplace_back(0.1 * along, 0.35 * along);
  }
  return lines;
}

// One of everything, most of it moving; some things change their look or come and go.
Picture everythingAt(int k) {
  const double t = k / 15.;
  Picture picture;
  picture.solids = {
      {{ShapeType::kBox, {0.5, 0.4, 0.6}, 0}, translation(0.5, 0, 0.3), {0.75f, 0.63f, 0.48f}, "box"},
      {{.type = ShapeType::kSphere, .radius = 0.2},
       translation(0.5, 0, 0.8 + 0.2 * std::sin(t)),
       {0.85f, 0.45f, 0.2f},
       "\"ball\"\n\xff"},
      {{ShapeType::kCapsule, {0, 0, 0.5}, 0.1},
       translation(-0.5, -0.3, 0.4) * rotation(t, {0, 1, 0.3}),
       {0.22f, 0.45f, 0.7f},
       "capsule"},
      {{ShapeType::kCylinder, {0, 0, 0.4}, 0.15},
       translation(-0.1, 0.5, 0.2),
       {0.2f, 0.6f, 0.4f, k < 30 ? 1.f : 0.4f},
       "cylinder"},
      {{ShapeType::kRoundedBox, {0.3, 0.3, 0.3}, 0.06},
       translation(1.1, 0.2, 0.15),
       {0.6f, 0.3f, 0.5f},
       "rounded"},
      {{.type = ShapeType::kMarker, .extent = {0.2, 0.2, 0.2}}, translation(0, 0, 1.1), {}, "marker"}};
  picture.solids.push_back(
      {{.type = ShapeType::kMesh, .mesh = tent()}, translation(0.35, -0.65, 0), {0.9f, 0.7f, 0.2f}, "tent"});
  picture.solids.push_back({{.type = ShapeType::kPointCloud, .mesh = cloud()},
                            translation(-0.9, 0, 0) * rotation(t, {0, 0, 1}),
                            {0.3f, 0.3f, 0.3f},
                            "cloud"});
  if (k % 20 < 10)
    picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.1},
                              translation(1, -0.6, 0.1),
                              {0.9f, 0.2f, 0.2f},
                              "guest"});
  Polyline trace;
  for (int i = 0; i <= k; ++i)
    trace.points.emplace_back(0.9 * std::cos(0.1 * i), 0.9 * std::sin(0.1 * i), 0.01 * i);
  picture.polylines = {
      trace, {{{-1, -1, 0}, {1.3, -1, 0}, {1.3, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}, {0.35f, 0.45f, 0.55f}, 1.5}};
  PointSet particles{.size = 5};
  for (int i = 0; i < 200; ++i)
    particles.points.emplace_back(-0.8 + 0.02 * std::sqrt(i) * std::cos(2.4 * i + t),
                                  0.6 + 0.02 * std::sqrt(i) * std::sin(2.4 * i + t), 0.05);
  picture.pointSets = {particles};
  picture.axes = {{translation(-0.8, -0.8, 0) * rotation(t, {0, 0, 1}), 0.3, "A"}};
  picture.arrows = {
      {{0, -0.6, 0}, {0.3 * std::cos(t), -0.6 + 0.3 * std::sin(t), 0.5}, {0.84f, 0.37f, 0}, 0.02}};
  picture.ellipsoids = {{translation(-0.8, 0.6, 0.05), {0.35 + 0.1 * std::sin(t), 0.35, 0.05}},
                        {translation(0.5, 0.6, 0.5) * rotation(t, {0, 0, 1}), {0.3, 0, 0.2}}};
  picture.lineSets = {fan(0.2 * t)};
  picture.labels = {{"<b>rounded</b>", {1.1, 0.2, 0.35}}};
  picture.captions = {{"All that a picture can show,\nin two lines"},
                      {k < 30 ? "first half" : "second half", Corner::kBottomRight}};
  return picture;
}

std::string between(const std::string& page, const std::string& before, const std::string& after) {
  const std::size_t from = page.find(before) + before.size();
  return page.substr(from, page.find(after, from) - from);
}

// The bytes between two marks of a page, from base 64 as coreutils read it.
std::string embedded(const std::string& page, const std::string& before, const std::string& after) {
  const std::size_t start = page.find(before);
  if (start == std::string::npos) return "no " + before;
  const std::size_t from = start + before.size();
  return runProcess({"base64", "--decode"},
                    {.input = page.substr(from, page.find(after, from) - from), .outputLimit = 1u << 24})
      .output;
}

// All of the page but what is embedded: tags and texts.
std::string withoutScripts(const std::string& page) {
  std::string rest;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = page.find("<script", at);
    rest += page.substr(at, open - at);
    if (open == std::string::npos) return rest;
    at = page.find("</script>", open);
  }
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Base64, FollowsTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Report, HoldsTheFilmAndItsPicture) {
  REX_NEEDS_OSMESA();
  const Report report = rollingBall();
  const std::string page = reportPage(report);
  EXPECT_TRUE(embedded(page, "id=\"film\">", "</script>") == toGlb(report.film, report.view));
  const fs::path still = freshFolder("report-still") / "still.png";
  std::ofstream(still, std::ios::binary) << embedded(page, "data:image/png;base64,", "\"");
  const Camera camera = framing(report.film, report.view, 4. / 3);
  EXPECT_EQ(readPng(still), Renderer(report.still).draw(report.film[0].picture, camera));
}

// Where nothing can be played, too; between two frames the earlier one is shown.
TEST(Report, ShowsTheMomentWhereItStands) {
  REX_NEEDS_OSMESA();
  Report report = rollingBall();
  report.start = 0.25;
  const fs::path still = freshFolder("report-start") / "still.png";
  std::ofstream(still, std::ios::binary) << embedded(reportPage(report), "data:image/png;base64,", "\"");
  const Camera camera = framing(report.film, report.view, 4. / 3);
  EXPECT_EQ(readPng(still), Renderer(report.still).draw(report.film[2].picture, camera));
}

// The page is left for scripts/check-replay.
TEST(Report, PlaysEverythingThatAPictureCanShow) {
  REX_NEEDS_OSMESA();
  Report report{.title = "All that a picture can show", .facts = {{"particles", "200"}}};
  for (int k = 0; k < 60; ++k) report.film.push_back({k / 15., everythingAt(k)});
  const std::string page = reportPage(report);
  std::ofstream(freshFolder("report-everything") / "everything.html", std::ios::binary) << page;
  const std::string glb = embedded(page, "id=\"film\">", "</script>");
  for (const char* name :
       {"box", R"(\"ball\" ?)", "guest", "marker", "tent", "cloud", "lines 0", "polyline 1", "points 0",
        "axes A", "arrow 0", "ellipsoid 0", "ellipsoid 1", "label 0", "caption 1"})
    EXPECT_THAT(glb, testing::HasSubstr("\"name\":\"" + std::string(name) + "\""));
}

// Two ways to say the same, for scripts/check-replay: the pages have to look the same.
TEST(Report, ShowsTwinsThatABrowserCannotTell) {
  REX_NEEDS_OSMESA();
  const fs::path folder = freshFolder("report-twins");
  for (const bool second : {false, true}) {
    Report report{.title = "Twins", .still = {.width = 160, .height = 120}};
    for (int k = 0; k < 3; ++k) {
      Picture picture;
      picture.solids = {{{.type = ShapeType::kMesh, .mesh = tent(second)},
                         translation(0.2 * k, 0.8, 0) * rotation(0.6, {0, 0, 1}),
                         {0.9f, 0.7f, 0.2f},
                         "tent"}};
      const LineSet lines = fan(0.1 * k);
      if (second)
        for (const auto& [from, to] : lines.segments)
          picture.polylines.push_back({{from, to}, lines.color, lines.width});
      else
        picture.lineSets = {lines};
      report.film.push_back({1. * k, picture});
    }
    writeReport(report, folder / (second ? "second.html" : "first.html"));
  }
  EXPECT_NE(fileText(folder / "first.html"), fileText(folder / "second.html"));
}

TEST(Report, SaysItsTitleOnce) {
  REX_NEEDS_OSMESA();
  Report report = rollingBall();
  for (Frame& frame : report.film) frame.picture.captions = {{"A ball"}, {"It rolls", Corner::kBottomLeft}};
  const std::string page = reportPage(report);
  const std::string glb = embedded(page, "id=\"film\">", "</script>");
  EXPECT_EQ(count(glb, "\"caption\":"), 1);
  EXPECT_EQ(count(glb, "\"caption\":\"It rolls\""), 1);
  for (Frame& frame : report.film) frame.picture.captions.erase(frame.picture.captions.begin());
  EXPECT_TRUE(page == reportPage(report)) << "the picture shows it no more than the film";
}

TEST(Report, TellsTheBackgroundOfItsPicture) {
  REX_NEEDS_OSMESA();
  Report report = rollingBall();
  report.still.backgroundTop = {0.25f, 0.5f, 1};
  report.still.backgroundBottom = {0, 0.125f, 0.75f};
  EXPECT_EQ(between(reportPage(report), "class=\"stage\" ", " tabindex"),
            "data-top=\"0.25 0.5 1\" data-bottom=\"0 0.125 0.75\"");
}

TEST(Report, StandsWhereItIsToldToStart) {
  REX_NEEDS_OSMESA();
  Report report = rollingBall();
  EXPECT_THAT(reportPage(report), ::testing::HasSubstr("data-start=\"0\""));
  report.start = 0.75;
  EXPECT_THAT(reportPage(report), ::testing::HasSubstr("data-start=\"0.75\""));
}

TEST(Report, NeedsNothingElse) {
  REX_NEEDS_OSMESA();
  const std::string page = reportPage(rollingBall());
  const std::string tags = withoutScripts(page);
  EXPECT_EQ(tags.find("http:"), std::string::npos);
  EXPECT_EQ(tags.find("https:"), std::string::npos);
  EXPECT_EQ(tags.find("href"), std::string::npos);
  EXPECT_EQ(tags.find("url("), std::string::npos);
  EXPECT_EQ(tags.find("@import"), std::string::npos);
  EXPECT_EQ(tags.find("{{"), std::string::npos);
  EXPECT_EQ(count(tags, "src=\""), count(tags, "src=\"data:image/"));
  EXPECT_EQ(count(page, "<script src"), 0);
}

// The hash of a text as coreutils see it.
std::string sha256(const std::string& text) {
  std::string digits = runProcess({"sha256sum"}, {.input = text}).output.substr(0, 64), bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return "'sha256-" + base64(bytes) + "'";
}

TEST(Report, AllowsItsOwnScriptsOnly) {
  REX_NEEDS_OSMESA();
  const std::string page = reportPage(rollingBall());
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\">");
  EXPECT_THAT(policy, testing::StartsWith("default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(policy, testing::Not(testing::HasSubstr("unsafe")));
  EXPECT_THAT(policy, testing::HasSubstr("style-src " + sha256(between(page, "<style>", "</style>"))));
  EXPECT_THAT(policy, testing::HasSubstr(sha256(between(page, "<script>", "</script>"))));
  const ProcessResult library =
      runProcess({"gzip", "--decompress"},
                 {.input = embedded(page, "id=\"library\">", "</script>"), .outputLimit = 1u << 24});
  ASSERT_TRUE(library.ok()) << library.error;
  EXPECT_THAT(policy, testing::HasSubstr(sha256(library.output)));
  EXPECT_NE(library.output.find("GLTFLoader"), std::string::npos);
}

TEST(Report, ShowsTextAsText) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  const std::string nasty = "</script><script>alert(1)</script>\"'`\n&amp;{{film}}\xff\x01";
  const std::string shown =
      "&#60;/script&#62;&#60;script&#62;alert(1)&#60;/script&#62;&#34;&#39;&#96;\n&#38;amp;{{film}}? ";
  Report report = rollingBall();
  const int scripts = count(reportPage(report), "<script");
  report.title = nasty;
  report.facts = {{nasty, nasty}};
  report.film[0].picture.solids[0].name = nasty;
  for (Frame& frame : report.film) {
    frame.picture.labels = {{nasty, {0, 0, 0}}};
    frame.picture.captions = {{nasty}};
  }
  report.figures = {
      {.figure = {.title = nasty, .xLabel = nasty, .yLabel = nasty, .series = {{.y = {1, 2, 3}}}},
       .caption = nasty}};
  const std::string page = reportPage(report);
  EXPECT_EQ(count(page, "<script"), scripts);
  EXPECT_EQ(count(page, "alert(1)"), count(page, "alert(1)&#60;"));
  EXPECT_THAT(page, testing::HasSubstr("<title>" + shown + "</title>"));
  EXPECT_THAT(page, testing::HasSubstr("<h1>" + shown + "</h1>"));
  EXPECT_THAT(page, testing::HasSubstr("<th scope=\"row\">" + shown + "</th><td>" + shown + "</td>"));
  EXPECT_THAT(page, testing::HasSubstr("<figcaption>" + shown + "</figcaption>"));
  EXPECT_EQ(embedded(page, "id=\"film\">", "</script>").substr(0, 4), "glTF");
}

TEST(Report, MarksTheMomentInItsCurves) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  Report report = rollingBall();
  const Figure figure{
      .xLabel = "time [s]", .yLabel = "speed [m/s]", .series = {{.x = {1, 2, 3}, .y = {1, 2, 3}}}};
  report.figures = {{.figure = figure, .marks = {{0, 1}, {0.5, 2}, {1, 3}}},
                    {.figure = figure, .marks = {{0, 1}}}};
  const std::string page = reportPage(report);
  EXPECT_EQ(count(page, "data-marks="), 1) << "one moment alone spans no axis";
  EXPECT_THAT(page, testing::HasSubstr("data-marks=\"0.000 0.1900 0.500 0.5750 1.000 0.9600 \""));
  // The axes are where the marks think: gnuplot draws the border of 800 x 500 pixels from there.
  const std::string svg = embedded(page, "data:image/svg+xml;base64,", "\"");
  EXPECT_THAT(svg, testing::ContainsRegex("M152\\.[0-9]*,[0-9.]* L152\\."));
  EXPECT_THAT(svg, testing::ContainsRegex("[ L]76(7\\.9|8\\.0)"));
}

TEST(Report, ShowsFiguresAsTheyAreDrawn) {
  REX_NEEDS_OSMESA();
  REX_NEEDS_GNUPLOT();
  Report report = rollingBall();
  EXPECT_EQ(count(reportPage(report), "<figure>"), 0);
  const Figure figure{.title = "Speed",
                      .xLabel = "time [s]",
                      .yLabel = "speed [m/s]",
                      .series = {{.y = {1, 2, 3}}},
                      .width = 400,
                      .height = 300};
  report.figures = {{figure, "It rolls."}, {figure, ""}};
  const std::string page = reportPage(report);
  EXPECT_EQ(count(page, "<figure>"), 2);
  EXPECT_EQ(count(page, "<figcaption>"), 1);
  EXPECT_THAT(page, testing::HasSubstr("alt=\"Speed\" width=\"400\" height=\"300\""));
  const fs::path file = freshFolder("report-figure") / "speed.svg";
  writeFigure(figure, file);
  EXPECT_EQ(embedded(page, "data:image/svg+xml;base64,", "\""), fileText(file));
}

TEST(Report, GivesTheSameBytesTwiceAndWritesThem) {
  REX_NEEDS_OSMESA();
  const fs::path folder = freshFolder("report");
  writeReport(rollingBall(), folder / "ball.html");
  EXPECT_TRUE(fileText(folder / "ball.html") == reportPage(rollingBall()));
  EXPECT_REX_ERROR(writeReport(rollingBall(), folder / "missing" / "ball.html"),
                   "missing/ball.html': found No such");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1);
}

TEST(Report, RefusesWhatItCannotShow) {
  REX_NEEDS_OSMESA();
  EXPECT_REX_ERROR(reportPage({.title = "nothing"}), "a film to replay: found no frames");
  Report report = rollingBall();
  report.figures = {{.figure = {.title = "empty"}}};
  EXPECT_REX_ERROR(reportPage(report), "empty");
  report = rollingBall();
  report.still.height = 0;
  EXPECT_REX_ERROR(reportPage(report), "picture size");
}

}  // namespace rex::report_test
