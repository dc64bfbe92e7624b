#include "course/live_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/base64.h"
#include "base/error.h"
#include "course/pictures.h"
#include "course/simulator.h"
#include "live/live_page.h"
#include "live/live_scene.h"
#include "live/live_server.h"
#include "live/open_browser.h"
#include "render/glb.h"
#include "render/picture.h"
#include "render/report.h"

namespace rex {
namespace {

using LiveClock = std::chrono::steady_clock;
using ViewJson = nlohmann::ordered_json;
using std::chrono::microseconds;

constexpr microseconds kFrameTime{33333};
constexpr std::size_t kMostRecorded = 900;
constexpr std::size_t kMostControls = 64;
constexpr double kFarthest = 1000;  // metres that a handle goes

// Students' programs have no command line: this is their boundary. REX_LIVE=1 serves without a terminal, 0
// never.
bool isServed() {
  const char* choice = std::getenv("REX_LIVE");
  if (choice != nullptr && *choice != '\0') return *choice != '0';
  return ::isatty(STDOUT_FILENO) == 1;
}

/// What the pages say about the program, one line each: the title, then names and texts.
struct ViewAbout {
  std::string title{};
  std::vector<std::pair<std::string, std::string>> facts{};
};

// `rex demo` sets it.
ViewAbout aboutOr(const std::string& name) {
  const char* said = std::getenv("REX_LIVE_ABOUT");
  if (said == nullptr || *said == '\0') return {name};
  std::istringstream lines(said);
  ViewAbout about;
  std::getline(lines, about.title);
  for (std::string key, text; std::getline(lines, key, '\t') && std::getline(lines, text);)
    about.facts.emplace_back(key, text);
  return about;
}

}  // namespace

struct LiveView::Parts {
  struct Control {
    std::string kind, name;
    double low = 0, high = 1, value = 0;
    int pressed = 0;
    Eigen::Vector3d at = Eigen::Vector3d::Zero(), normal = at;  // of a handle
    Series curve{};                                             // of a plot, and
    std::vector<double> moments{};                              // when the film shows each point
    std::string xLabel{};
  };

  std::string name{};
  ViewAbout page{};
  std::unique_ptr<LiveServer> server{};
  std::optional<PrivateFolder> folder{};  // while the browser reads it
  bool hasWaited = false, isPaused = false;
  LiveClock::time_point shown{};
  int version = 0;
  const Model* model = nullptr;  // of the simulator shown last; only compared
  std::size_t shapes = 0;
  std::string poses{};
  std::map<std::string, int> offered{};        // pieces, by how many of these have them:
  std::deque<std::set<std::string>> recent{};  // the last pictures
  ViewJson q = ViewJson::array();
  std::vector<Control> controls{};
  Film film{};
  std::size_t stride = 1, count = 0;
  std::optional<Picture> last{};
  Eigen::Vector3d view = kDefaultView;

  Control& control(const std::string& kind, const std::string& called) {
    for (Control& one : controls)
      if (one.kind == kind && one.name == called) return one;
    if (controls.size() >= kMostControls)
      throw Error({.what = kind + " '" + called + "'",
                   .found = fmt::format("{} others on the page", controls.size()),
                   .wanted = "fewer"});
    controls.push_back({.kind = kind, .name = called});
    return controls.back();
  }

  // Opens a browser, unless REX_LIVE=1 asks for the address only.
  void invite() {
    const char* choice = std::getenv("REX_LIVE");
    try {
      if (choice == nullptr || *choice == '\0') folder.emplace(std::filesystem::temp_directory_path());
      const std::string more = bringToUser(*server, folder ? &*folder : nullptr);
      if (!more.empty()) fmt::print("{}\n", more);
    } catch (const Error& error) {
      fmt::print(stderr, "no browser is opened: {}\n", error.what());
    }
  }

  // What the page asked for; anything else is not for us.
  void hear(microseconds atMost) {
    if (!server) return;
    for (const std::string& message : server->takeMessages(atMost)) {
      const ViewJson events = ViewJson::parse(message, nullptr, false);
      if (!events.is_array()) continue;
      for (const ViewJson& event : events)
        if (event.is_object() && event.contains("do") && event["do"].is_string()) obey(event);
    }
  }

  void obey(const ViewJson& event) {
    const std::string what = event["do"].get<std::string>();
    if (what == "go on") isPaused = false;
    if (what == "pause") isPaused = true;
    if (!event.contains("name") || !event["name"].is_string()) return;
    for (Control& one : controls) {
      if (one.kind != what || one.name != event["name"].get<std::string>()) continue;
      if (what == "button") ++one.pressed;
      if (what == "slider" && event.contains("value") && event["value"].is_number())
        one.value = std::clamp(event["value"].get<double>(), one.low, one.high);
      if (what == "handle" && event.contains("to")) moveTo(event["to"], one.at);
    }
  }

  static void moveTo(const ViewJson& to, Eigen::Vector3d& at) {
    if (!to.is_array() || to.size() != 3) return;
    if (!std::ranges::all_of(to, [](const ViewJson& one) { return one.is_number(); })) return;
    for (std::size_t i = 0; i < 3; ++i)
      at[static_cast<Eigen::Index>(i)] = std::clamp(to[i].get<double>(), -kFarthest, kFarthest);
  }

  // The last points of a curve, [[x, y], ...]: a slow page misses pictures, but no peaks.
  static ViewJson newest(const Series& curve) {
    constexpr std::size_t kMost = 40;
    ViewJson points = ViewJson::array();
    for (std::size_t k = curve.x.size() - std::min(kMost, curve.x.size()); k < curve.x.size(); ++k)
      points.push_back({curve.x[k], curve.y[k]});
    return points;
  }

  void publish() {
    if (!server || version == 0) return;
    ViewJson asked = ViewJson::array();
    for (const Control& one : controls)
      asked.push_back({{"kind", one.kind},
                       {"name", one.name},
                       {"low", one.low},
                       {"high", one.high},
                       {"value", one.value},
                       {"points", newest(one.curve)},
                       {"xLabel", one.xLabel},
                       {"at", {one.at.x(), one.at.y(), one.at.z()}},
                       {"normal", {one.normal.x(), one.normal.y(), one.normal.z()}}});
    const ViewJson frame = {
        {"version", version}, {"q", q}, {"poses", poses}, {"asked", asked}, {"paused", isPaused}};
    server->publish(frame.dump(-1, ' ', false, ViewJson::error_handler_t::replace));
  }

  // Pictures change often, but most of their meshes do not: each piece is offered once, and withdrawn when
  // the pictures of the last five seconds did without it. Small ones are no request of their own.
  void offer(const std::string& glb, ViewJson about) {
    constexpr std::size_t kKept = 150, kSmall = 512;
    const LivePieces cut = splitGlb(glb);
    ViewJson list = ViewJson::array();
    std::set<std::string> names;
    for (const LivePiece& piece : cut.pieces) {
      const bool isSmall = piece.bytes.size() <= kSmall;
      list.push_back({piece.at, isSmall ? "" : piece.name, isSmall ? base64(piece.bytes) : ""});
      if (!isSmall && names.insert(piece.name).second && ++offered[piece.name] == 1)
        server->offer(piece.name, {"application/octet-stream", piece.bytes});
    }
    recent.push_back(std::move(names));
    if (recent.size() > kKept) {
      for (const std::string& old : recent.front())
        if (--offered[old] == 0) server->withdraw(old), offered.erase(old);
      recent.pop_front();
    }
    about["gltf"] = cut.json, about["pieces"] = list;
    server->offer("scene.json",
                  {"application/json", about.dump(-1, ' ', false, ViewJson::error_handler_t::replace)});
    ++version;
  }

  // For somebody to open the page, once; then until it is time for the next picture.
  void waitForTurn() {
    if (!server) return;
    if (!hasWaited) {
      hasWaited = true;
      publish();
      for (int k = 0; k < 300 && server->viewers() == 0; ++k) hear(std::chrono::milliseconds(100));
    }
    while (server->viewers() > 0 && LiveClock::now() < shown + kFrameTime)
      hear(std::chrono::duration_cast<microseconds>(shown + kFrameTime - LiveClock::now()));
    hear(microseconds(0));
    if (isPaused) stayPaused();
    shown = LiveClock::now();
  }

  // Until somebody presses "Go on", as long as a page is open. One that is loaded again is away for a moment.
  void stayPaused() {
    publish();
    for (int away = 0; isPaused && away < 30;) {
      hear(std::chrono::milliseconds(100));
      away = server->viewers() > 0 ? 0 : away + 1;
    }
    isPaused = false;
    publish();
  }

  // A point of a curve for the replay; long curves become coarser.
  void keepPoint(Control& plot, double x, double y) const {
    constexpr std::size_t kMostPoints = 4000;
    Series& curve = plot.curve;
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    if (curve.x.size() >= kMostPoints)
      for (std::vector<double>* all : {&curve.x, &curve.y, &plot.moments}) {
        for (std::size_t k = 0; 2 * k < all->size(); ++k) (*all)[k] = (*all)[2 * k];
        all->resize(all->size() / 2);
      }
    curve.x.push_back(x), curve.y.push_back(y);
    plot.moments.push_back(static_cast<double>(count) / 30);
  }

  // A few hundred lines are as many as the eye tells apart.
  static std::vector<std::pair<double, double>> marksOf(const Control& plot) {
    const std::size_t step = 1 + plot.moments.size() / 400;
    std::vector<std::pair<double, double>> marks;
    for (std::size_t k = 0; k < plot.moments.size(); k += step)
      marks.emplace_back(plot.moments[k], plot.curve.x[k]);
    return marks;
  }

  std::vector<ReportFigure> figures() const {
    std::vector<ReportFigure> all;
    for (const Control& one : controls)
      if (one.curve.x.size() > 1)
        all.push_back({.figure = {.xLabel = one.xLabel,
                                  .yLabel = one.name,
                                  .series = {one.curve},
                                  .width = 420,
                                  .height = 230},
                       .marks = marksOf(one)});
    return all;
  }

  // Without gnuplot there are no curves.
  void write() const {
    Report report{.title = page.title,
                  .film = film,
                  .view = view,
                  .figures = figures(),
                  .facts = page.facts,
                  .still = {.width = 640, .height = 480, .gl = glChoice()}};
    try {
      writeReport(report, name + ".html");
    } catch (const std::exception& error) {
      if (report.figures.empty()) throw;
      fmt::print(stderr, "{}.html has no curves: {}\n", name, error.what());
      report.figures.clear();
      writeReport(report, name + ".html");
    }
  }

  // Evenly, so that a long run takes no more memory than a short one.
  void record(Picture picture) {
    if (count % stride == 0) {
      if (film.size() >= kMostRecorded) {
        for (std::size_t k = 0; 2 * k < film.size(); ++k) film[k] = std::move(film[2 * k]);
        film.resize((film.size() + 1) / 2);
        stride *= 2;
      }
      if (count % stride == 0) film.push_back({.time = static_cast<double>(count) / 30, .picture = picture});
    }
    ++count;
    last = std::move(picture);
  }
};

LiveView::LiveView(const std::string& name) : parts_(std::make_unique<Parts>()) {
  parts_->name = name;
  parts_->page = aboutOr(name);
  if (!isServed()) return;
  parts_->server = std::make_unique<LiveServer>(LiveServerOptions{});
  offerLivePage(*parts_->server);
  fmt::print("{}\nopen this page; the program waits for it half a minute\n", parts_->server->url());
  parts_->invite();
  std::fflush(stdout);
}

LiveView::LiveView(const Simulator& simulator, const std::string& name) : LiveView(name) { show(simulator); }

LiveView::~LiveView() {
  parts_->server.reset();
  if (!parts_->last) return;
  try {
    const double end = static_cast<double>(parts_->count - 1) / 30;
    if (parts_->film.back().time < end) parts_->film.push_back({.time = end, .picture = *parts_->last});
    settleGround(parts_->film);
    parts_->write();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}.html was not written: {}\n", parts_->name, error.what());
  }
}

bool LiveView::isWatched() {
  parts_->hear(microseconds(0));
  return parts_->server && parts_->server->viewers() > 0;
}

void LiveView::show(const Simulator& simulator) {
  Parts& parts = *parts_;
  const Eigen::VectorXd q = simulator.getJointAngles();
  const BodyPoses poses = forwardKinematics(simulator.model(), q);
  parts.record(scenePicture(simulator.model(), poses));
  if (!parts.server) return;
  if (parts.model != &simulator.model() || parts.shapes != simulator.model().shapes().size()) {
    parts.model = &simulator.model(), parts.shapes = simulator.model().shapes().size();
    ViewJson about = ViewJson::parse(liveDescription(simulator.model()));
    about["kind"] = "program", about["title"] = parts.page.title, about["facts"] = parts.page.facts;
    parts.offer(liveGlb(simulator.model(), poses), about);
  }
  parts.poses = posesText(poses);
  parts.q = std::vector<double>(q.begin(), q.end());
  parts.waitForTurn();
  parts.publish();
}

void LiveView::show(const Picture& picture) {
  Parts& parts = *parts_;
  parts.record(picture);
  if (!parts.server) return;
  parts.model = nullptr;
  const ViewJson about = {{"kind", "program"},
                          {"title", parts.page.title},
                          {"facts", parts.page.facts},
                          {"mass", 0},
                          {"bodies", ViewJson::array()},
                          {"shapes", ViewJson::array()},
                          {"coordinates", ViewJson::array()}};
  parts.offer(toGlb({{.picture = picture}}, parts.view), about);
  parts.poses.clear(), parts.q = ViewJson::array();
  parts.waitForTurn();
  parts.publish();
}

void LiveView::lookFrom(const Eigen::Vector3d& direction) { parts_->view = direction; }

double LiveView::slider(const std::string& name, double low, double high, double start) {
  if (!(low <= start && start <= high && std::isfinite(high - low)))
    throw Error({.what = "slider '" + name + "'",
                 .found = fmt::format("{:g} from {:g} to {:g}", start, low, high),
                 .wanted = "finite numbers in order"});
  const std::size_t before = parts_->controls.size();
  Parts::Control& one = parts_->control("slider", name);
  if (parts_->controls.size() > before) one.value = start;
  one.low = low, one.high = high;
  parts_->hear(microseconds(0));
  return one.value = std::clamp(one.value, low, high);
}

Eigen::Vector3d LiveView::handle(const std::string& name, const Eigen::Vector3d& start,
                                 const Eigen::Vector3d& normal) {
  if (!start.allFinite() || !normal.allFinite())
    throw Error({.what = "handle '" + name + "'",
                 .found = "a place or a normal that is not finite",
                 .wanted = "three numbers each"});
  const std::size_t before = parts_->controls.size();
  Parts::Control& one = parts_->control("handle", name);
  if (parts_->controls.size() > before) one.at = start;
  one.normal = normal;
  parts_->hear(microseconds(0));
  return one.at;
}

bool LiveView::button(const std::string& name) {
  Parts::Control& one = parts_->control("button", name);
  parts_->hear(microseconds(0));
  return std::exchange(one.pressed, 0) > 0;
}

void LiveView::plot(const std::string& name, double x, double y, const std::string& xLabel) {
  Parts::Control& one = parts_->control("plot", name);
  one.xLabel = xLabel;
  parts_->keepPoint(one, x, y);
}

void LiveView::pause() {
  if (!isWatched()) return;
  parts_->isPaused = true;
  parts_->stayPaused();
}

}  // namespace rex
