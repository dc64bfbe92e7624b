#include "submission/shared_compile.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/process_pool.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

using std::filesystem::path;

constexpr const char* kMessages = "messages.json";
constexpr const char* kShareObject = "share.o";

// How a compiler ended; our copies say it by their exit codes.
enum End { kCompiled, kFoundErrors, kFailed };

End runCompiler(const BuildTools& tools, const std::vector<std::string>& command, const path& folder) {
  const ProcessResult run = tools.run(command);
  writeTextFile(folder / kMessages, run.error);
  if (run.ok()) return kCompiled;
  return run.started && !run.timedOut && run.exitCode == 1 ? kFoundErrors : kFailed;
}

path shareFolder(const path& object, std::size_t share) {
  return object.parent_path() / fmt::format("share-{}", share + 1);
}

// The messages of all, each once. Parts of a message that name its place are the same in each.
std::string joined(const std::vector<std::string>& texts) {
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& text : texts) {
    const nlohmann::json messages = nlohmann::json::parse(text, nullptr, false);
    if (!messages.is_array()) continue;
    for (const nlohmann::json& message : messages)
      if (std::find(all.begin(), all.end(), message) == all.end()) all.push_back(message);
  }
  return all.dump();
}

ProcessResult ended(int exitCode, std::string said) {
  ProcessResult run;
  run.started = true;
  run.exitCode = exitCode;
  run.error = std::move(said);
  return run;
}

}  // namespace

std::optional<ProcessResult> compileShares(const std::vector<std::string>& shares,
                                           const std::vector<std::string>& command, const std::string& name,
                                           const path& object,
                                           const std::function<BuildTools(const path&)>& toolsFor) {
  if (shares.empty()) return {};
  const path top = object.parent_path();
  std::vector<path> folders = {top};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    folders.push_back(shareFolder(object, k));
    std::filesystem::create_directories(folders.back());
    writeTextFile(folders.back() / name, shares[k]);
  }
  const int count = static_cast<int>(folders.size());
  const auto compile = [&](int k) -> int {
    const path& folder = folders[static_cast<std::size_t>(k)];
    std::vector<std::string> mine = command;
    // What the other shares call is unused in this one.
    if (k == 0)
      mine.insert(mine.end(), {"-fsyntax-only", name});
    else
      mine.insert(mine.end(), {"-Wno-unused-function", "-c", name, "-o", kShareObject});
    return runCompiler(toolsFor(folder), mine, folder);
  };
  std::vector<int> ends(folders.size(), kFailed);
  runInCopies(count, count, compile, [&](int k, int end) { ends[static_cast<std::size_t>(k)] = end; });
  if (ends[0] == kFoundErrors) return ended(1, readTextFile(top / kMessages));
  if (std::any_of(ends.begin(), ends.end(), [](int end) { return end != kCompiled; })) return {};

  std::vector<std::string> link = {command.front(), "-r", "-nostdlib", "-o", object.filename().string()};
  std::vector<std::string> texts = {readTextFile(top / kMessages)};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    link.push_back((folders[k + 1].filename() / kShareObject).string());
    texts.push_back(readTextFile(folders[k + 1] / kMessages));
  }
  if (!toolsFor(top).run(link).ok()) return {};
  return ended(0, joined(texts));
}

}  // namespace rex::grading
