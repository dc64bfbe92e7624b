#include "submission/two_compilers.h"

#include <array>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/process_pool.h"
#include "base/text_file.h"
#include "submission/compiler_messages.h"
#include "submission/reading_apart_internal.h"

namespace rex::submission {
namespace {

using std::filesystem::path;

constexpr const char* kMessages = "messages.json";

// How a compiler ended; our copies report it by their exit codes.
enum End { kCompiled, kFoundErrors, kTimedOut, kFailed };

End runCompiler(const BuildTools& tools, const std::vector<std::string>& command, const path& folder) {
  const ProcessResult run =
      tools.run(command, [](const ProcessResult& failed) { return namesErrors(failed.error); });
  writeTextFile(folder / kMessages, run.error);
  if (run.ok()) return kCompiled;
  if (run.timedOut) return kTimedOut;
  return run.exitCode == 1 ? kFoundErrors : kFailed;
}

// The messages of both compilers without duplicates.
std::string joined(const std::string& first, const std::string& second) {
  const auto join = [&] {
    nlohmann::json all = nlohmann::json::array();
    std::set<std::string> known;
    for (const std::string& text : {first, second}) {
      const nlohmann::json messages = nlohmann::json::parse(text, nullptr, false);
      if (!messages.is_array()) continue;
      for (const nlohmann::json& message : messages)
        if (known.insert(message.dump()).second) all.push_back(message);
    }
    return all;
  };
  return readApart("the messages of two compilers", kAfterCompiling, join).dump();
}

ProcessResult ended(int exitCode, std::string said) {
  ProcessResult run;
  run.started = true;
  run.exitCode = exitCode;
  run.error = std::move(said);
  return run;
}

}  // namespace

std::optional<ProcessResult> compilePart(const std::string& part, const std::vector<std::string>& command,
                                         const std::string& name, const path& object,
                                         const std::function<BuildTools(const path&)>& toolsFor) {
  const path top = object.parent_path(), folder = top / "graded";
  std::filesystem::create_directories(folder);
  writeSource(folder / name, part);
  const auto compile = [&](int k) -> int {
    std::vector<std::string> mine = command;
    if (k == 0) {
      mine.insert(mine.end(), {"-fsyntax-only", name});
      return runCompiler(toolsFor(top), mine, top);
    }
    mine.insert(mine.end(), {"-c", name, "-o", object.filename().string()});
    return runCompiler(toolsFor(folder), mine, folder);
  };
  std::array<int, 2> ends = {kFailed, kFailed};
  forkMap(2, 2, compile, [&](int k, int end) { ends[static_cast<std::size_t>(k)] = end; });
  if (ends[0] == kFoundErrors) return ended(1, readTextFile(top / kMessages));
  if (ends[0] == kTimedOut || ends[1] == kTimedOut) {
    ProcessResult run = ended(1, "");
    run.timedOut = true;
    return run;
  }
  if (ends[0] != kCompiled || ends[1] != kCompiled) return {};
  std::filesystem::rename(folder / object.filename(), object);
  return ended(0, joined(readTextFile(top / kMessages), readTextFile(folder / kMessages)));
}

}  // namespace rex::submission
