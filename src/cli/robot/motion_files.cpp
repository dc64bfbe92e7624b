#include "cli/robot/motion_files.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <numeric>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/interruption.h"
#include "cli/robot/render_plan.h"
#include "cli/terminal.h"
#include "render/picture.h"
#include "render/video_sink.h"

namespace rex::cli {

namespace {

namespace fs = std::filesystem;

std::string csvHead(const Model& model) {
  fmt::memory_buffer head;
  const auto out = std::back_inserter(head);
  fmt::format_to(out, "time");
  for (int i = 0; i < model.nq(); ++i) fmt::format_to(out, ",q{}", i);
  for (int i = 0; i < model.nv(); ++i) fmt::format_to(out, ",v{}", i);
  fmt::format_to(out, ",kinetic,potential,total\n");
  return fmt::to_string(head);
}

// The header has a fixed size, a multiple of 64 bytes, and gets the number of rows at the end.
std::string npyHead(long columns, long rows) {
  constexpr std::size_t kBefore = 10, kSize = 128;
  std::string words =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows, columns);
  words.resize(kSize - kBefore - 1, ' ');
  words += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(words.size() & 0xff);
  head += static_cast<char>(words.size() >> 8);
  return head + words;
}

template <class Visit>
void forEachNumber(const Moment& moment, const Visit& visit) {
  visit(moment.state.time);
  for (const double x : moment.state.q) visit(x);
  for (const double x : moment.state.v) visit(x);
  visit(moment.energy.kinetic);
  visit(moment.energy.potential);
  visit(moment.energy.total());
}

// The topmost folder of a path that does not exist yet; empty if all exist.
fs::path firstNew(fs::path folder) {
  fs::path missing;
  for (std::error_code ignored; !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    missing = folder;
  return missing;
}

[[noreturn]] void failToWrite(const fs::path& file, const std::string& why) {
  throw Error({.what = "cannot write " + file.string(), .found = why});
}

}  // namespace

MotionLog::MotionLog(const fs::path& file, LogFormat format, const Model& model)
    : file_(file),
      part_(fs::path(file).concat(".part")),
      format_(format),
      columns_(model.nq() + model.nv() + 4) {
  firstNew_ = firstNew(file.parent_path());
  std::error_code problem;
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path(), problem);
  if (problem) failToWrite(file, problem.message());
  out_.open(part_, std::ios::binary | std::ios::trunc);
  if (!out_) failToWrite(file, std::strerror(errno));
  write(format == LogFormat::kCsv ? csvHead(model) : npyHead(columns_, 0));
}

MotionLog::~MotionLog() {
  if (isFinished_) return;
  out_.close();
  std::error_code ignored;
  fs::remove(part_, ignored);
  if (firstNew_.empty()) return;
  for (fs::path folder = file_.parent_path(); fs::remove(folder, ignored) && folder != firstNew_;)
    folder = folder.parent_path();
}

void MotionLog::add(const Moment& moment) {
  std::string row;
  if (format_ == LogFormat::kCsv) {
    const auto out = std::back_inserter(row);
    forEachNumber(moment, [&](double x) { fmt::format_to(out, "{},", x); });
    row.back() = '\n';
  } else {
    static_assert(std::endian::native == std::endian::little);
    forEachNumber(moment, [&](double x) {
      const auto bytes = std::bit_cast<std::array<char, sizeof x>>(x);
      row.append(bytes.begin(), bytes.end());
    });
  }
  write(row);
  ++rows_;
}

void MotionLog::write(const std::string& bytes) {
  if (!out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    failToWrite(file_, std::strerror(errno));
}

void MotionLog::finish() {
  if (format_ == LogFormat::kNpy) {
    out_.seekp(0);
    write(npyHead(columns_, rows_));
  }
  out_.close();
  if (!out_) failToWrite(file_, std::strerror(errno));
  std::error_code problem;
  fs::rename(part_, file_, problem);
  if (problem) failToWrite(file_, problem.message());
  isFinished_ = true;
}

namespace {

BodyId tracedBody(const Model& model, const std::string& name) {
  try {
    return model.body(name);
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = "--trace: " + parts.what;
    throw UsageError(std::move(parts));
  }
}

}  // namespace

MotionPictures::MotionPictures(const Model& model, const Motion& motion,
                               const std::vector<std::size_t>& shown, const std::vector<std::string>& traces,
                               std::string caption)
    : model_(model), motion_(motion), shown_(shown), traces_(traces.size()), caption_(std::move(caption)) {
  if (shown_.empty()) {
    shown_.resize(motion_.postures.size());
    std::iota(shown_.begin(), shown_.end(), std::size_t{0});
  }
  std::vector<BodyId> traced;
  for (const std::string& name : traces) traced.push_back(tracedBody(model_, name));
  if (!traced.empty()) {
    for (const Eigen::VectorXd& q : motion_.postures) {
      const BodyPoses poses = forwardKinematics(model_, q);
      for (std::size_t k = 0; k < traced.size(); ++k) traces_[k].push_back(poses[traced[k]].p);
    }
  }
  double lowest = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    throwIfInterrupted();
    const Bounds box = rex::bounds(solidsAt(i));
    if (box.isEmpty()) continue;
    lowest = std::min(lowest, box.low.z());
    bounds_.include(box.low);
    bounds_.include(box.high);
    includeMoving(i);
  }
  ground_ = groundHeight(model_, forwardKinematics(model_, model_.initialPositions())).value_or(lowest);
  for (const auto& trace : traces_)
    for (const Eigen::Vector3d& point : trace) bounds_.include(point);
}

// Not by scenePicture(): it visits every vertex to find the height of the ground, which is known here.
Picture MotionPictures::solidsAt(std::size_t i) const {
  return {.solids = placedSolids(model_, forwardKinematics(model_, motion_.postures[shown_[i]]))};
}

void MotionPictures::includeMoving(std::size_t i) {
  const BodyPoses poses = forwardKinematics(model_, motion_.postures[shown_[i]]);
  std::vector<bool> moves(model_.bodies().size());
  for (std::size_t k = 1; k < moves.size(); ++k) {
    const Body& body = model_.bodies()[k];
    moves[k] =
        moves[static_cast<std::size_t>(body.parent)] || (body.joint != kNoJoint && model_[body.joint].nv > 0);
  }
  Picture picture;
  for (const ModelShape& shape : model_.shapes())
    if (shape.visible && moves[static_cast<std::size_t>(shape.body)])
      picture.solids.push_back({.shape = shape.shape, .X_WS = poses[shape.body] * shape.X_BS});
  const Bounds box = rex::bounds(picture);
  if (box.isEmpty()) return;
  moving_.include(box.low);
  moving_.include(box.high);
}

Picture MotionPictures::picture(std::size_t i) const {
  Picture picture = solidsAt(i);
  picture.ground.height = ground_;
  picture.ground.scene = bounds_;
  if (!caption_.empty()) picture.captions.push_back({.text = caption_});
  if (shown_[i] == 0) return picture;
  for (const auto& trace : traces_)
    picture.polylines.push_back(
        {.points = {trace.begin(), trace.begin() + static_cast<std::ptrdiff_t>(shown_[i]) + 1}});
  return picture;
}

Film MotionPictures::film() const {
  Film film;
  for (std::size_t i = 0; i < size(); ++i) film.push_back({time(i), picture(i)});
  return film;
}

namespace {

// Without ffmpeg the frames go into a folder with the film's name.
MadeSink openSink(std::filesystem::path& out) {
  MadeSink made = makeFrameSink(out);
  if (made.missing.empty()) return made;
  note(made.missing + "; the frames go into a folder instead");
  return makeFrameSink(out.replace_extension());
}

}  // namespace

void requireFilmable(const Model& model) {
  if (std::ranges::any_of(model.shapes(), [](const ModelShape& one) { return one.visible; })) return;
  throw UsageError({.what = model.name(), .found = "no shape that a film can show", .wanted = "--no-film"});
}

std::filesystem::path writeMotionFilm(const MotionPictures& pictures, const RenderPlan& plan,
                                      std::filesystem::path out) {
  constexpr std::size_t kTurn = 120;  // frames
  const bool isWalk = pictures.size() == 1;
  const std::size_t count = isWalk ? kTurn : pictures.size();
  Studio studio(plan, isWalk ? turningBox(pictures.framed()) : pictures.framed());
  note(studio.describe());
  const Picture first = pictures.picture(0);  // a walk around the scene shows only this one
  const auto draw = [&](std::size_t i) {
    if (!isWalk) return studio.draw(pictures.picture(i));
    return studio.draw(first, 2 * std::numbers::pi * static_cast<double>(i) / kTurn);
  };
  for (std::size_t i = 0; i < count && !studio.sawSomething(); ++i) static_cast<void>(draw(i));
  studio.requireSomethingSeen();
  const MadeSink made = openSink(out);
  std::atomic<std::size_t> frame = 0;
  const ProgressLine progress([&] { return fmt::format("film: frame {} of {}", frame.load(), count); });
  for (; frame < count; ++frame) made.sink->add(draw(frame));
  throwIfInterrupted();
  made.sink->finish();
  return out;
}

namespace {

// A folder that holds anything but frames stays.
void removeFrames(const fs::path& folder) {
  std::error_code unused;
  for (int i = 0; fs::remove(folder / fmt::format("{:04}.png", i), unused); ++i) {
  }
  if (fs::is_directory(folder, unused)) fs::remove(folder, unused);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& found, const std::string& wanted) {
  throw UsageError({.what = "-o " + escapeForTerminal(path.string()), .found = found, .wanted = wanted});
}

}  // namespace

double filmSpeed(double asked, double seconds) {
  const double speed = std::max(asked, seconds / kLongestFilm);
  if (speed > asked)
    note(fmt::format("the film plays {:.3g} times as fast as the motion, so that it lasts {:g} s", speed,
                     kLongestFilm));
  return speed;
}

void requireFolderName(const fs::path& folder, const std::string& wanted) {
  const std::string ending = folder.extension().string();
  for (const char* ofFiles : {".mp4", ".png", ".glb", ".html", ".csv", ".npy", ".ors", ".urdf"})
    if (ending == ofFiles) refuse(folder, "the name of a file", wanted);
}

void makeResultFolder(const fs::path& folder, std::initializer_list<const char*> files,
                      const std::string& frames) {
  requireFolderName(folder, "a folder");
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem || !fs::is_directory(folder))
    refuse(folder, problem ? problem.message() : "a file", "a folder");
  if (!std::ofstream(folder / *files.begin(), std::ios::app))
    refuse(folder, std::strerror(errno), "a folder to write to");
  removeFrames(folder / frames);
  for (const char* name : files) {
    fs::remove(folder / name, problem);
    if (problem) refuse(folder / name, problem.message(), "a file, or nothing");
  }
}

void writeReplay(Report report, const MotionPictures& pictures, const RenderPlan& plan, double speed,
                 const fs::path& page) {
  report.film = pictures.film();
  for (Frame& frame : report.film) frame.time /= speed;
  if (speed != 1) report.facts.emplace_back("speed of the replay", fmt::format("{:g}", speed));
  report.view = plan.views.front().view.direction();
  for (ReportFigure& item : report.figures) item.figure.width = 560, item.figure.height = 360;
  throwIfInterrupted();
  std::error_code ignored;  // writing the page reports the problem
  if (page.has_parent_path()) fs::create_directories(page.parent_path(), ignored);
  writeReport(report, page);
}

std::vector<fs::path> writeFilmAndReplay(const Model& model, const Motion& motion, BodyId body, Report report,
                                         const RenderPlan& pictures, const fs::path& stem, double speed) {
  const MotionPictures shots(model, motion, {}, {model[body].name}, report.title);
  const fs::path film = writeMotionFilm(shots, pictures, fs::path(stem).concat(".mp4"));
  const fs::path page = fs::path(stem).concat(".html");
  report.still.gl = pictures.renderer.gl;
  writeReplay(std::move(report), shots, pictures, speed, page);
  return {film, page};
}

}  // namespace rex::cli
