#include "cli/student/watch_page.h"

#include <chrono>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/student/hint.h"
#include "cli/student/progress_file.h"
#include "cli/student/watch_files_internal.h"
#include "cli/student/watch_parts.h"
#include "cli/terminal.h"
#include "grading/result_file.h"
#include "reports/feedback_page.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// Replays run the scripts that their own policy names, and may ask this server for nothing.
constexpr const char* kReplayPolicy =
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; frame-ancestors 'self'";

void offerFiles(LiveServer& server, const std::vector<WatchFile>& files) {
  for (const WatchFile& file : files) {
    const bool isPage = file.name.ends_with(".html");
    const char* const type = isPage                        ? "text/html; charset=utf-8"
                             : file.name.ends_with(".png") ? "image/png"
                                                           : "video/mp4";
    server.offer(file.name, {.type = type, .bytes = file.bytes, .policy = isPage ? kReplayPolicy : ""});
  }
}

// Changes when a file of the folder does.
std::string stampOf(const fs::path& folder) {
  std::string stamp;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem))
    stamp += fmt::format("{} {} {}\n", entry.path().filename().string(),
                         entry.last_write_time(problem).time_since_epoch().count(), entry.file_size(problem));
  return stamp;
}

}  // namespace

WatchPage::WatchPage(const Project& project, const ExerciseInfo& exercise, LiveServer& server)
    : project_(project), exercise_(exercise), server_(server), folder_(project.outFolder(exercise, false)) {
  server_.offer("style.css", {.type = "text/css; charset=utf-8", .bytes = kWatchStyle});
  server_.offer("watch.js", {.type = "text/javascript; charset=utf-8", .bytes = kWatchScript});
  server_.offer("", {.type = "text/html; charset=utf-8", .bytes = emptyWatchPage(exercise)});
  listener_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

WatchPage::~WatchPage() = default;

void WatchPage::startGrading() {
  const std::lock_guard lock(mutex_);
  isBusy_ = true;
  if (last_) text_ = "grading what you saved";
  publish();
}

void WatchPage::renew(const std::string& text) {
  const std::lock_guard lock(mutex_);
  isBusy_ = false, text_ = text;
  if (const fs::path results = folder_ / "results.json"; fs::exists(results)) {
    grading::GradeResult now = grading::loadResult(results);
    const fs::path main = fs::absolute(exercise_.folder / "main.cpp");
    const std::vector<WatchFile> files = filesOfChecks(now, folder_);
    offerFiles(server_, files);
    parts_["news"] = newsPart(now, last_);
    parts_["checks"] = fmt::format("<h2>{} of {} points</h2>\n", now.score, now.maxScore) +
                       grading::checksHtml(now, main.string());
    parts_["evidence"] = evidencePart(now, files);
    parts_["source"] = sourcePart(now, fs::exists(main) ? readTextFile(main) : "", main.string());
    last_ = std::move(now);
  }
  publish();
}

// Call these under the lock.
void WatchPage::publish() {
  const Json frame = {
      {"exercise", exercise_.name}, {"busy", isBusy_}, {"text", printable(text_)}, {"parts", parts_}};
  server_.publish(dump(frame));
}

void WatchPage::renewHints() {
  AllProgress all = ProgressFile(project_.root).read();
  parts_["hints"] = hintsPart(exercise_, all.exercises[exercise_.name].hints);
}

void WatchPage::renewOwn() {
  const std::vector<WatchFile> files = filesOfProgram(folder_);
  offerFiles(server_, files);
  parts_["own"] = ownPart(files);
}

// What a page asks for: {"hint": "id of a part"}. Anything else is not for us.
void WatchPage::hear(const std::string& message) {
  const Json event = Json::parse(message, nullptr, false);
  if (!event.is_object() || !event.contains("hint") || !event["hint"].is_string()) return;
  for (const grading::ExercisePart& part : exercise_.parts)
    if (part.id == event["hint"].get<std::string>() && !part.hints.empty())
      static_cast<void>(openHint(project_, exercise_, part));
}

void WatchPage::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const std::vector<std::string> messages = server_.takeMessages(std::chrono::milliseconds(200));
    try {
      for (const std::string& message : messages) hear(message);
      renewWhatChanged();
    } catch (
        const std::exception& error) {  // such as a file that is just being written: its next change helps
      const std::lock_guard lock(mutex_);
      text_ = error.what();
      publish();
    }
  }
}

void WatchPage::renewWhatChanged() {
  std::string stamp = stampOf(folder_) + stampOf(project_.root / ".rex");
  if (stamp == stamp_) return;
  stamp_ = std::move(stamp);
  const std::lock_guard lock(mutex_);
  renewHints();
  renewOwn();
  publish();
}

}  // namespace rex::cli
