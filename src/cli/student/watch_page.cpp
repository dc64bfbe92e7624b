#include "cli/student/watch_page.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/student/exercise_commands.h"
#include "cli/student/progress.h"
#include "cli/terminal.h"
#include "grading/results.h"
#include "reports/feedback_page.h"
#include "reports/markdown.h"

namespace rex::cli {

namespace {

namespace fs = std::filesystem;
using grading::CheckResult;
using grading::GradeResult;
using grading::Outcome;
using submission::ExercisePart;

bool passes(const CheckResult& check) { return check.status == Outcome::kPass; }

std::string textOrNothing(const fs::path& file) {
  return fs::is_regular_file(file) ? readTextFile(file) : "";
}

std::string taskOf(const fs::path& readMe) {
  const auto target = [](const std::string& link) {
    return link.starts_with('#') || link.starts_with("https:") || link.starts_with("http:") ? link : "";
  };
  const std::string text = textOrNothing(readMe);
  try {
    return reports::markdownPage(text, target).html;
  } catch (const Error& error) {  // a formula that we cannot draw
    return fmt::format("<pre>{}</pre>\n<p class=\"soft\">{}</p>\n", htmlText(text), htmlText(error.what()));
  }
}

std::string pointsOf(const submission::ExerciseInfo& exercise) {
  std::string text = "<h2>Points</h2>\n<table>\n";
  for (const ExercisePart& part : exercise.parts)
    text += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", htmlText(part.title), part.points);
  return text + fmt::format(
                    "<tr><th>together</th><th>{}</th></tr>\n</table>\n<p class=\"soft\">A check may take "
                    "{:g} s of processor time and {} MB of memory.</p>\n",
                    exercise.points(), exercise.limits.cpuSeconds,
                    exercise.limits.memory / grading::kMegabyte);
}

void fillIn(std::string& page, const std::string& name, const std::string& text) {
  const std::string place = "{{" + name + "}}";
  for (std::size_t at = 0; (at = page.find(place, at)) != std::string::npos; at += text.size())
    page.replace(at, place.size(), text);
}

// Its address changes with what is in it, so that browsers fetch it again only then.
std::string addressOf(const WatchFile& file) {
  return fmt::format("{}?v={:016x}", htmlText(file.name), std::hash<std::string>()(file.bytes));
}

std::string shownFile(const WatchFile& file, const std::string& title) {
  const std::string address = addressOf(file);
  if (file.name.ends_with(".png"))
    return fmt::format("<p><img alt=\"{}\" src=\"{}\"></p>\n", htmlText(title), address);
  if (file.name.ends_with(".mp4"))
    return fmt::format("<p><video controls preload=\"metadata\" src=\"{}\"></video></p>\n", address);
  return fmt::format(
      "<details data-key=\"{0}\"><summary>Replay: {1}</summary>\n<iframe title=\"{1}\" "
      "data-src=\"{2}\"></iframe>\n"
      "</details>\n<p class=\"soft\"><a href=\"{2}\" target=\"_blank\" rel=\"noopener\">Replay on a page of "
      "its "
      "own</a></p>\n",
      htmlText(file.name), htmlText(title), address);
}

bool isShowable(const fs::path& file) {
  constexpr std::uintmax_t kMost = 8'000'000;
  std::error_code problem;
  return (file.extension() == ".png" || file.extension() == ".html" || file.extension() == ".mp4") &&
         fs::symlink_status(file, problem).type() == fs::file_type::regular &&
         fs::file_size(file, problem) <= kMost && !problem;
}

}  // namespace

std::string emptyWatchPage(const submission::ExerciseInfo& exercise) {
  std::string page = kWatchPage;
  fillIn(page, "name", htmlText(exercise.name));
  fillIn(page, "title", htmlText(exercise.name));
  // Last those whose texts may hold anything.
  const std::size_t contract = page.find("{{contract}}");
  page.replace(contract, 12, htmlText(textOrNothing(exercise.definition / "exercise.h")));
  page.replace(page.find("{{task}}"), 8, taskOf(exercise.folder / "README.md") + pointsOf(exercise));
  return page;
}

std::string newsPart(const GradeResult& result, const std::optional<GradeResult>& before) {
  if (!before) return "";
  std::string news;
  for (const CheckResult& check : result.checks) {
    if (check.group == grading::Group::kHidden) continue;
    const auto isSame = [&](const CheckResult& other) { return other.id == check.id; };
    const auto was = std::find_if(before->checks.begin(), before->checks.end(), isSame);
    if (was == before->checks.end() || passes(*was) == passes(check)) continue;
    news +=
        fmt::format("<li>{}{}</li>\n", passes(check) ? "Now passes: " : "Fails now: ", htmlText(check.title));
  }
  return news.empty() ? "As after the last save." : "<ul>\n" + news + "</ul>\n";
}

std::string evidencePart(const GradeResult& result, const std::vector<WatchFile>& files) {
  std::string text;
  for (const CheckResult& check : result.checks) {
    if (check.group == grading::Group::kHidden) continue;
    std::string shown;
    for (const std::string& name : {check.picture, check.replay})
      for (const WatchFile& file : files)
        if (file.name == name) shown += shownFile(file, check.title);
    if (!shown.empty()) text += fmt::format("<h3>{}</h3>\n", htmlText(check.title)) + shown;
  }
  return text.empty() ? "" : "<h2>What happened</h2>\n" + text;
}

std::string ownPart(const std::vector<WatchFile>& files) {
  std::string text;
  for (const WatchFile& file : files)
    text += fmt::format("<figure><figcaption class=\"soft\">{}</figcaption>{}</figure>\n",
                        htmlText(file.name), shownFile(file, file.name));
  return text.empty() ? "" : "<h2>What your program has drawn</h2>\n" + text;
}

std::string hintsPart(const submission::ExerciseInfo& exercise,
                      const std::map<std::string, int>& shownHints) {
  std::string text;
  for (const ExercisePart& part : exercise.parts) {
    const auto found = shownHints.find(part.id);
    const int all = static_cast<int>(part.hints.size());
    const int shown = std::clamp(found == shownHints.end() ? 0 : found->second, 0, all);
    if (all == 0) continue;
    text += fmt::format("<p class=\"part\">{}", htmlText(part.title));
    if (shown < all)
      text += fmt::format("<button type=\"button\" data-hint=\"{}\">Open hint {} of {}</button>",
                          htmlText(part.id), shown + 1, all);
    text += "</p>\n<ol>\n";
    for (int k = 0; k < shown; ++k)
      text += "<li>" + htmlText(part.hints[static_cast<std::size_t>(k)]) + "</li>\n";
    text += "</ol>\n";
  }
  if (text.empty()) return "";
  return "<h2>Hints</h2>\n" + text + "<p class=\"soft\">They count as those of rex hint.</p>\n";
}

std::string sourcePart(const GradeResult& result, const std::string& source, const std::string& path) {
  reports::Feedback feedback{.result = result, .source = source};
  const std::string file = result.files.empty() ? "main.cpp" : result.files.front().name;
  for (const CheckResult& check : result.checks)
    if (check.group == grading::Group::kVisible && !passes(check) && check.line > 0)
      feedback.comments.push_back({.line = check.line, .text = "Fails: " + check.title});
  for (const grading::CompileDiagnostic& message : result.compile.diagnostics)
    if (message.file == file && message.severity != "note")
      feedback.comments.push_back({.line = message.line, .text = message.severity + ": " + message.message});
  return reports::listingHtml(feedback, path);
}

std::vector<WatchFile> filesOfChecks(const GradeResult& result, const fs::path& folder) {
  std::vector<WatchFile> files;
  for (const CheckResult& check : result.checks)
    for (const std::string& name : {check.picture, check.replay})
      if (!name.empty() && isShowable(folder / name)) files.push_back({name, readTextFile(folder / name)});
  return files;
}

std::vector<WatchFile> filesOfProgram(const fs::path& folder) {
  constexpr std::size_t kMost = 30;
  std::vector<std::string> names;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem))
    if (isShowable(entry.path())) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  names.resize(std::min(names.size(), kMost));
  std::vector<WatchFile> files;
  for (const std::string& name : names) files.push_back({name, readTextFile(folder / name)});
  return files;
}

namespace {

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
std::string timeStamp(const fs::path& folder) {
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
                       reports::checksHtml(now, main.string());
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
  for (const submission::ExercisePart& part : exercise_.parts)
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
  std::string stamp = timeStamp(folder_) + timeStamp(project_.root / ".rex");
  if (stamp == stamp_) return;
  stamp_ = std::move(stamp);
  const std::lock_guard lock(mutex_);
  renewHints();
  renewOwn();
  publish();
}

}  // namespace rex::cli
