#include "authoring/joint_build.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/lines.h"
#include "base/process.h"
#include "base/text_file.h"
#include "submission/build_tools.h"
#include "submission/symbol_scan.h"

namespace rex::grading {

using std::filesystem::path;

JointBuild::JointBuild(const GateContext& context, const std::string& reference,
                       std::vector<std::string> variants)
    : context_(context),
      sources_(std::move(variants)),
      folder_(std::filesystem::absolute(context.workFolder) / "joined") {
  std::vector<std::size_t> culprits;
  do {
    culprits = compile(reference);
    for (const std::size_t culprit : culprits) sources_[culprit] = reference;  // which leaves it out
  } while (!culprits.empty());
}

// Returns the variants whose functions do not compile.
std::vector<std::size_t> JointBuild::compile(const std::string& reference) {
  const JoinedVariants joined(reference, sources_);
  functions_.assign(sources_.size(), {});
  Toolchain toolchain = context_.toolchain;
  toolchain.flags.emplace_back("-w");  // functions that only main() used are unused now
  const path file = context_.workFolder / "main.cpp";
  writeTextFile(file, joined.source());
  constexpr double kSeconds = 60, kSecondsEach = 5;
  object_ = compileStudent(toolchain, {},
                           {.main = file,
                            .workFolder = folder_,
                            .publicHeadersOnly = true,
                            .seconds = kSeconds + kSecondsEach * static_cast<double>(sources_.size()),
                            .memory = std::size_t{4} << 30});
  std::vector<std::size_t> culprits;
  if (object_.ok) {
    const std::vector<std::string> all = symbols();
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      functions_[k] = standIns(all, k);
      if (functions_[k].size() != joined.functions(k)) functions_[k].clear();
    }
  } else {
    for (const CompileDiagnostic& message : object_.messages)
      if (const std::size_t k = joined.variantAt(message.line); k < sources_.size()) culprits.push_back(k);
  }
  return culprits;
}

// The functions that other files may call, from lines such as
// "0000000000000000 g     F .text._Z4stepv\t0000000000000045 _Z4stepv".
std::vector<std::string> JointBuild::symbols() const {
  const Toolchain& toolchain = context_.toolchain;
  const ProcessResult listed = BuildTools(toolchain, folder_, {})
                                   .run({toolchain.objdump, "-t", object_.object.string()}, {}, 256u << 20);
  if (!listed.ok()) throw Error({.what = "cannot list the functions of the variants", .found = listed.error});
  std::vector<std::string> names;
  constexpr std::size_t kScope = 17, kKind = kScope + 6;
  for (const std::string_view line : splitLines(listed.output))
    if (line.size() > kKind && line[kScope] == 'g' && line[kKind] == 'F')
      names.emplace_back(line.substr(line.rfind(' ') + 1));
  return names;
}

bool JointBuild::holds(std::size_t variant) const { return !functions_[variant].empty(); }

// The scan of compileStudent() over everything that these functions reach. Whatever the rest of the file
// calls, the solution calls, too.
std::vector<CompileDiagnostic> JointBuild::forbiddenCallsOf(std::size_t variant) const {
  const auto& forbidden = context_.exercise.forbidden;
  if (forbidden.empty()) return {};
  const path part = folder_ / "part.o";
  std::vector<std::string> command = {context_.toolchain.compiler, "-r", "-nostdlib", "-Wl,--gc-sections"};
  for (const StandIn& function : functions_[variant]) command.push_back("-Wl,--undefined=" + function.own);
  command.insert(command.end(), {object_.object.string(), "-o", part.string()});
  const BuildTools tools(context_.toolchain, folder_, {});
  const ProcessResult run = tools.run(command);
  if (!run.ok()) throw Error({.what = "cannot separate a variant from the others", .found = run.error});
  return scanSymbols(part, sources_[variant], object_.name, forbidden);
}

BuiltSubmission JointBuild::link(std::size_t variant) const {
  BuiltSubmission built{.start = {}, .source = sources_[variant], .worker = {}};
  std::vector<CompileDiagnostic>& messages = built.start.compile.diagnostics;
  messages = forbiddenCallsOf(variant);
  if (messages.empty()) {
    Toolchain toolchain = context_.toolchain;
    for (const auto& [own, replaced] : functions_[variant])
      toolchain.linkFlags.push_back(fmt::format("-Wl,--defsym={}={}", replaced, own));
    const StudentProgram worker = linkWorker(toolchain, object_);
    if (worker.ok) built.worker = worker.program;
    messages = worker.messages;
  }
  if (built.worker.empty()) {
    built.start.outcome = Outcome::kCompileError;
    built.start.message = messages.empty() ? "it cannot be linked" : toString(messages.front());
  }
  return built;
}

}  // namespace rex::grading
