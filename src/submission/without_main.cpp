#include "submission/without_main.h"

#include <set>

#include <fmt/format.h>

#include "base/text_file.h"
#include "submission/object_file.h"
#include "submission/reading_apart_internal.h"
#include "submission/tool_failure.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

std::set<std::string> wantedByWorker(const fs::path& worker) {
  std::set<std::string> names;
  if (worker.empty() || !fs::exists(worker)) return names;
  for (const ObjectSymbol& symbol : readObjectFile(readTextFile(worker), worker.string()).symbols)
    if (!symbol.isDefined) names.insert(symbol.name);
  return names;
}

// What the worker refers to; without a worker, whatever any other file could refer to. Copies of templates
// and inline functions are kept only if something needs them.
std::set<std::string> rootsOf(const ObjectFile& object, const std::set<std::string>& wanted) {
  std::set<std::string> roots;
  for (const ObjectSymbol& symbol : object.symbols) {
    const bool isOffered = symbol.isGlobal || (symbol.isWeak && !symbol.isShared);
    const bool isWanted = wanted.empty() ? isOffered && symbol.name != "main" : wanted.contains(symbol.name);
    if (symbol.isDefined && isWanted) roots.insert(symbol.name);
  }
  return roots;
}

}  // namespace

std::optional<ProcessResult> withoutMain(const fs::path& object, const fs::path& part,
                                         const Toolchain& toolchain, const BuildTools& tools) {
  const std::set<std::string> wanted = wantedByWorker(toolchain.workerObject);
  const auto roots = readApart("what the object file defines", kAfterCompiling, [&] {
                       return rootsOf(readObjectFile(readTextFile(object), object.string()), wanted);
                     }).get<std::set<std::string>>();
  if (roots.empty()) return {};
  const fs::path options = fs::path(part).replace_extension(".args");
  for (const fs::path& old : {part, options}) fs::remove(old);  // perhaps of another user
  // There may be too many for a command line. strangeParts() has made sure that none has a blank or a quote.
  std::string list = "-Wl,--gc-sections\n";
  for (const std::string& root : roots) list += fmt::format("-Wl,--undefined={}\n", root);
  writeTextFile(options, list);
  return tools.run({toolchain.compiler, "-r", "-nostdlib", "-fno-lto", "@" + options.string(),
                    object.string(), "-o", part.string()},
                   [&](const ProcessResult& failed) { return blamesObject(failed.error, object.string()); });
}

}  // namespace rex::grading
