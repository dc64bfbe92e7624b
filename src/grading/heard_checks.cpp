#include "grading/heard_checks.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

constexpr const char *kCalls = "calls", *kAsked = "asked";

// The message with this question in place of the one that it ends with.
std::string withQuestion(std::string message, const std::string& asked, const std::string& question) {
  const std::size_t place = asked.empty() ? message.npos : message.rfind(". " + asked);
  if (place == message.npos) return message + ". " + question;
  return message.replace(place, 2 + asked.size(), ". " + question);
}

}  // namespace

std::filesystem::path HeardChecks::file(std::size_t check, const char* ending) const {
  return folder_ / fmt::format("{}.{}", check, ending);
}

void HeardChecks::keep(std::size_t check, const Heard& heard) const {
  writeTextFile(file(check, kCalls), toText(SketchedChecks{{"", heard.calls}}));
  writeTextFile(file(check, kAsked), heard.asked);
}

bool HeardChecks::askAboutMistakes(const GradingJob& job,
                                   const std::vector<std::pair<std::size_t, CheckResult*>>& checks) const {
  const bool failed = std::any_of(checks.begin(), checks.end(),
                                  [](const auto& check) { return check.second->status != Outcome::kPass; });
  if (job.sketches.empty() && (job.mistakes.empty() || !failed)) return false;
  bool changed = false;
  try {
    SketchedChecks heard;
    for (const auto& [k, check] : checks)
      if (const std::filesystem::path its = file(k, kCalls); std::filesystem::exists(its))
        heard[check->id] = readSketchedChecks(readTextFile(its), its.string())[""];
    if (!job.sketches.empty()) writeTextFile(job.sketches, toText(heard));
    if (job.mistakes.empty()) return false;
    const KnownMistakes known = readKnownMistakes(readTextFile(job.mistakes), job.mistakes.string());
    for (const auto& [k, check] : checks) {
      if (check->status == Outcome::kPass || !heard.contains(check->id)) continue;
      const std::string question = recognisedMistake(known, heard, check->id, check->function);
      if (question.empty()) continue;
      check->message = withQuestion(std::move(check->message), readTextFile(file(k, kAsked)), question);
      changed = true;
    }
  } catch (const Error&) {
  }
  return changed;
}

}  // namespace rex::grading
