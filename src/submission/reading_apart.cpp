#include <csignal>

#include <fmt/format.h>

#include "base/process.h"
#include "submission/reading_apart_internal.h"

namespace rex::submission {
namespace {

using Json = nlohmann::json;

std::string howItEnded(const IsolatedResult& result, const IsolationLimits& limits) {
  if (result.end == IsolatedEnd::kOutOfMemory)
    return fmt::format("needed more than {} MiB of memory", limits.memory >> 20);
  if (result.end == IsolatedEnd::kTookTooLong)
    return fmt::format("took more than {:g} s of processor time", limits.cpuSeconds);
  return fmt::format("failed with signal {}", result.signal);
}

}  // namespace

// CBOR carries strings that are not UTF-8, as a student's file may be in any encoding.
Json readApart(const std::string& what, const IsolationLimits& limits, const std::function<Json()>& read) {
  const auto call = [&] {
    return callIsolated(
        [&] {
          std::string bytes;
          Json::to_cbor(read(), bytes);
          return bytes;
        },
        limits);
  };
  const auto wasKilled = [](const IsolatedResult& one) { return one.signal == SIGKILL; };
  const IsolatedResult result = onceMoreIfKilled(call, wasKilled);
  if (result.end == IsolatedEnd::kReturned) return Json::from_cbor(result.bytes);
  // The limit on processor time sends SIGXCPU. The readers wait for nothing and kill nobody.
  if (wasKilled(result))
    throw Error({.what = fmt::format("reading {} was killed twice, through no fault of the file", what),
                 .wanted = "a machine that is less busy, with free memory"});
  throw UnreadableFile({.what = fmt::format("reading {} {}", what, howItEnded(result, limits))});
}

std::vector<grading::CompileDiagnostic> messagesApart(
    const std::string& what, const std::function<std::vector<grading::CompileDiagnostic>()>& read) {
  return readApart(what, kAfterCompiling, [&] { return Json(read()); })
      .get<std::vector<grading::CompileDiagnostic>>();
}

}  // namespace rex::submission

namespace rex::grading {

void to_json(nlohmann::json& json, const CompileDiagnostic& message) {
  json = {message.file, message.line, message.column, message.severity, message.rule, message.message};
}

void from_json(const nlohmann::json& json, CompileDiagnostic& message) {
  message = {json.at(0), json.at(1), json.at(2), json.at(3), json.at(4), json.at(5)};
}

}  // namespace rex::grading
