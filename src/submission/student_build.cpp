#include "submission/student_build.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <functional>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/process.h"
#include "base/text_file.h"
#include "submission/build_tools.h"
#include "submission/dangling_auto.h"
#include "submission/graded_part.h"
#include "submission/included_files.h"
#include "submission/integer_division.h"
#include "submission/line_markers.h"
#include "submission/mentions.h"
#include "submission/precompiled_prefix.h"
#include "submission/symbol_scan.h"
#include "submission/tool_failure.h"
#include "submission/two_compilers.h"
#include "submission/without_main.h"
#include "submission/worker_part.h"

namespace rex::grading {
namespace {

using std::filesystem::path;

constexpr const char *kDependencies = "student.d", *kOfAssembler = "student.as.d", *kPart = "graded";
constexpr std::size_t kLogSize = 64u << 10;

// The name to compile under: the student's own if it is plain, for names come from strangers.
std::string plainName(const path& file) {
  const std::string name = file.filename().string();
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
  };
  const bool usable = name.ends_with(".cpp") && std::isalnum(static_cast<unsigned char>(name.front())) &&
                      std::all_of(name.begin(), name.end(), plain);
  return usable ? name : "main.cpp";
}

Error unexplained(const std::string& what, std::string found) {
  return Error({.what = what + " through no fault of the file",
                .found = std::move(found),
                .wanted = "a machine with free disk space and working tools"});
}

// Why a compiler that reported no error still failed. A crash that the source causes is repeatable; a failure
// that nobody can explain is not the student's fault.
std::string whyItGaveUp(const ProcessResult& run, const BuildTools& tools,
                        const StudentBuildOptions& limits) {
  if (run.timedOut)
    return fmt::format(
        "compiling did not end within {:g} s: does it include a pipe or a device, or is this machine busy?",
        clockSeconds(limits.seconds, limits.sandbox.level));
  if (const std::string limit = tools.limitReached(run); !limit.empty()) return "compiling " + limit;
  constexpr std::size_t kMostText = 8u << 20;  // all that BuildTools keeps
  const bool namesErrors = run.error.find("\"kind\": \"error\"") != run.error.npos;
  if (namesErrors || run.error.size() >= kMostText) return "the compiler prints more than can be read";
  const std::string words = lastWordsOf(run);
  if (words.find("internal compiler error") == words.npos) throw unexplained("the compiler failed", words);
  return "the compiler gave up: " + words;
}

// From level 2 on, temporary files of the compiler lie in memory that it shares with nobody.
bool isInSandboxsMemory(const std::string& text, sandbox::Level level) {
  return hasNamespaces(level) && text.find(fmt::format(" {}/cc", sandbox::kInsideFolder)) != text.npos;
}

std::vector<std::string> compileCommand(const Toolchain& toolchain, const StudentBuildOptions& options,
                                        const std::string& source) {
  std::vector<std::string> command = {toolchain.compiler};
  command.insert(command.end(), toolchain.flags.begin(), toolchain.flags.end());
  // Separate sections let the linker find what only main() needs.
  command.insert(command.end(), {"-ftemplate-depth=200", "-ffunction-sections", "-fdata-sections"});
  if (options.debug) {
    const path folder = std::filesystem::absolute(options.main).parent_path();
    command.insert(
        command.end(),
        {"-g", "-O0", fmt::format("-fdebug-prefix-map={}={}", options.workFolder.string(), folder.string())});
    return command;
  }
  const std::vector<std::string> prefix = prefixFlags(toolchain.prefix, source, toolchain.flags);
  command.insert(command.end(), prefix.begin(), prefix.end());
  return command;
}

// The compiler's report as plain text. Only this form says which line of the student's file caused an error
// in a header. It quotes no source lines, as they could come from any file.
std::string plainReport(std::vector<std::string> command, const std::string& name, const BuildTools& tools,
                        bool ofOptimiser) {
  command.insert(command.end(), {"-fmax-errors=20", "-fno-diagnostics-show-caret", name});
  if (ofOptimiser)
    command.insert(command.end(), {"-c", "-o", "plain.o"});
  else
    command.emplace_back("-fsyntax-only");
  return tools.runOnce(command).error;
}

std::string writeLog(const std::vector<CompileDiagnostic>& messages) {
  std::string log;
  for (const CompileDiagnostic& message : messages) log += toString(message) + "\n";
  return log;
}

// Finds what the file did wrong. Throws Error if nothing explains it.
void explain(const ProcessResult& run, const std::vector<std::string>& command, const std::string& name,
             const BuildTools& tools, const StudentBuildOptions& options, StudentObject& result) {
  if (const auto full = fullDiskIn(result.messages)) {
    if (!isInSandboxsMemory(*full, options.sandbox.level)) throw unexplained("the compiler failed", *full);
    result.messages = {
        {name, 0, 0, "error", "", "compiling filled the sandbox's folder for temporary files"}};
  }
  const auto isError = [](const CompileDiagnostic& m) { return m.severity == "error"; };
  const auto explained = [&] { return std::any_of(result.messages.begin(), result.messages.end(), isError); };
  // g++ 12 writes no JSON when -fmax-errors stops it, so only the plain text has that limit. It takes over
  // when there are too many errors for complete JSON.
  const bool ofOptimiser = std::any_of(result.messages.begin(), result.messages.end(), [](const auto& m) {
    return m.rule.find("uninitialized") != std::string::npos;
  });
  result.log = printable(plainReport(command, name, tools, ofOptimiser), kLogSize);
  if (!explained()) result.messages = parseCompilerText(result.log);
  if (!explained()) result.messages = parseAssemblerText(run.error);
  if (!explained()) result.messages.push_back({name, 0, 0, "error", "", whyItGaveUp(run, tools, options)});
}

// The last parts of their qualified names.
std::vector<std::string> lastNames(const std::vector<ForbiddenFunction>& forbidden) {
  std::vector<std::string> names;
  for (const ForbiddenFunction& one : forbidden)
    names.push_back(one.function.substr(one.function.rfind(':') + 1));
  return names;
}

// Like compilePart(), with questions in the text that is only checked. Empty if there are none, or errors:
// those are better reported without.
std::optional<ProcessResult> askAboutAuto(const std::string& part, std::vector<std::string> command,
                                          const std::string& name, const StudentObject& result,
                                          const std::function<BuildTools(const path&)>& toolsFor) {
  const std::string asking = withAutoQuestions(result.source);
  if (asking.empty()) return {};
  const path file = result.object.parent_path() / name;
  writeSource(file, asking);
  command.insert(command.end(), {"-include", kAutoQuestions});
  std::optional<ProcessResult> run = compilePart(part, command, name, result.object, toolsFor);
  writeSource(file, result.source);
  return run && run->ok() ? run : std::nullopt;
}

// A second compiler reads the same headers again, which saves time only if the part leaves out enough.
bool leavesOutMuch(const std::string& part, const std::string& source) {
  constexpr int kMuch = 300;  // characters
  int changed = 0;
  for (std::size_t k = 0; k < source.size(); ++k) changed += part[k] != source[k];
  return changed > kMuch;
}

// Compiles the graded part alone if that is wanted and the file allows it. It does not if the scan for
// forbidden functions, which sees only what is compiled, would miss something.
ProcessResult compileAll(const Toolchain& toolchain, const std::vector<ForbiddenFunction>& forbidden,
                         const std::vector<std::string>& command, const std::string& name,
                         const BuildTools& tools, const StudentBuildOptions& options,
                         const StudentObject& result) {
  std::vector<std::string> withJson = command;
  withJson.insert(withJson.end(), {"-fdiagnostics-format=json", "-MD", "-MF", kDependencies,
                                   std::string("-Wa,--MD,") + kOfAssembler});
  const std::string part =
      options.part ? gradedPart(result.source, toolchain.functions, lastNames(forbidden)) : "";
  if (!part.empty()) {
    const auto toolsFor = [&](const path& folder) {
      return BuildTools(toolchain, folder, options.sandbox,
                        {.seconds = options.seconds, .memory = options.memory});
    };
    if (const auto run = askAboutAuto(part, withJson, name, result, toolsFor)) return *run;
    if (leavesOutMuch(part, result.source))
      if (const auto run = compilePart(part, withJson, name, result.object, toolsFor)) return *run;
  }
  withJson.insert(withJson.end(), {"-c", name, "-o", result.object.filename().string()});
  return tools.run(withJson);
}

void compile(const Toolchain& toolchain, const std::vector<ForbiddenFunction>& forbidden,
             const std::vector<std::string>& command, const std::string& name, const BuildTools& tools,
             const StudentBuildOptions& options, StudentObject& result) {
  const ProcessResult run = compileAll(toolchain, forbidden, command, name, tools, options, result);
  result.exitCode = run.exitCode;
  result.ok = run.ok();
  result.messages = parseCompilerJson(run.error);
  if (!run.ok()) explain(run, command, name, tools, options, result);
  explainAutoAnswers(result.messages, result.source);
  const std::vector<CompileDiagnostic> divisions = integerDivisions(result.source, name);
  result.messages.insert(result.messages.end(), divisions.begin(), divisions.end());
  blameMainFile(result.messages, name, result.log);
  result.truncated = admitMessages(result.messages);
  if (result.log.empty()) result.log = writeLog(result.messages);
}

// What the linker found wrong with the last of the objects, which is the student's. Throws Error if nothing
// explains the failure.
std::vector<CompileDiagnostic> explainLinking(const ProcessResult& run, const BuildTools& tools,
                                              const std::string& object, const std::string& mainFile) {
  std::vector<CompileDiagnostic> messages = parseLinkerText(run.error, mainFile);
  if (!messages.empty()) return messages;
  const std::string limit = tools.limitReached(run);
  if (!limit.empty()) return {{mainFile, 0, 0, "error", "", "linking " + limit}};
  const std::string complaint = complaintAbout(object, run.error);
  if (complaint.empty()) throw unexplained("the linker failed", lastWordsOf(run));
  return {{mainFile, 0, 0, "error", "", "cannot be linked: " + complaint}};
}

// The forbidden ones among all files that the compiler and the assembler opened. If only a part was compiled,
// that was done in a folder of its own.
std::vector<CompileDiagnostic> forbiddenFilesIn(const StudentObject& object, const path& folder,
                                                const Toolchain& toolchain) {
  const auto forbidden = [&](const std::vector<path>& files, const path& where) {
    return forbiddenIncludes(files, object.source, object.name, where, toolchain);
  };
  std::vector<CompileDiagnostic> found =
      forbidden(dependenciesIn(readTextFile(folder / kDependencies), folder), folder);
  const path assembled = std::filesystem::exists(folder / kOfAssembler) ? folder : folder / kPart;
  const auto more = forbidden(filesOfAssembler(readTextFile(assembled / kOfAssembler), assembled), assembled);
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

// Makes `result.graded`, in which nothing may call what is forbidden; messages say if the file prevents that.
std::vector<CompileDiagnostic> forbiddenCallsIn(StudentObject& result, const Toolchain& toolchain,
                                                const std::vector<ForbiddenFunction>& forbidden,
                                                const BuildTools& tools) {
  const ObjectFile whole = readObjectFile(readTextFile(result.object), result.object.string());
  std::vector<CompileDiagnostic> messages = strangeParts(whole, result.name);
  if (!messages.empty()) return messages;
  const path graded = result.object.parent_path() / "graded.o";
  const std::optional<ProcessResult> run = withoutMain(result.object, graded, toolchain, tools);
  if (!run) return {};
  if (!run->ok()) return explainLinking(*run, tools, result.object.string(), result.name);
  result.graded = graded;
  return scanSymbols(result.graded, result.source, result.name, forbidden, toolchain.offers);
}

std::vector<std::string> texts(const std::vector<path>& paths) { return {paths.begin(), paths.end()}; }

StudentProgram link(const Toolchain& toolchain, const BuildTools& tools, const path& program,
                    const std::vector<std::string>& objects, const std::vector<std::string>& libraries,
                    const std::string& mainFile) {
  std::vector<std::string> command = {toolchain.compiler, "-o", program.string()};
  command.insert(command.end(), objects.begin(), objects.end());
  command.emplace_back("-Wl,--as-needed");
  command.insert(command.end(), libraries.begin(), libraries.end());
  command.insert(command.end(), toolchain.linkFlags.begin(), toolchain.linkFlags.end());
  ProcessResult run = tools.run(command);
  if (!run.ok()) {
    // The standard linker has the last word: its complaints are the ones that we can explain.
    command.emplace_back("-fuse-ld=bfd");
    run = tools.run(command);
  }
  StudentProgram result{
      .program = program, .messages = {}, .log = printable(run.error, kLogSize), .ok = run.ok()};
  if (!run.ok()) result.messages = explainLinking(run, tools, objects.back(), mainFile);
  admitMessages(result.messages);
  return result;
}

// The library, preceded by what main() draws with.
std::vector<std::string> librariesOfProgram(const Toolchain& toolchain) {
  std::vector<std::string> libraries = texts(toolchain.libraries);
  if (!toolchain.show.empty()) libraries.insert(libraries.begin(), toolchain.show.string());
  return libraries;
}

Error noSource(const path& file, std::string found) {
  return Error({.what = "cannot be graded",
                .where = {file.string()},
                .found = std::move(found),
                .wanted = "a C++ source file"});
}

std::string readText(const OpenedFile& opened, const path& file) {
  constexpr std::size_t kLargest = 1u << 20;
  struct stat status {};
  if (::fstat(opened.fd(), &status) != 0) throw noSource(file, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw noSource(file, "a folder");
  if (!S_ISREG(status.st_mode)) throw noSource(file, "a pipe or device");
  std::string text;
  std::array<char, 65536> buffer;
  for (ssize_t n = 1; n > 0 && text.size() <= kLargest;) {
    n = ::read(opened.fd(), buffer.data(), buffer.size());
    if (n < 0) throw noSource(file, std::strerror(errno));
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  if (text.size() > kLargest) throw noSource(file, "more than 1 MiB");
  if (text.find('\0') != std::string::npos) throw noSource(file, "NUL bytes, as in a binary or UTF-16 file");
  return text;
}

}  // namespace

std::string readStudentFile(const path& file) {
  const OpenedFile opened(::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (opened.fd() < 0)
    throw noSource(file, errno == ELOOP    ? "a symbolic link"
                         : errno == ENOENT ? "no file"
                                           : std::strerror(errno));
  return readText(opened, file);
}

StudentFile readStudentFile(const OpenedFolder& folder, const std::string& name) {
  try {
    const OpenedFile opened = folder.file(name);
    return {readText(opened, folder.path() / name), opened.modifiedAt()};
  } catch (const Error& error) {
    throw noSource(folder.path() / name, error.parts().found);
  }
}

StudentObject compileStudent(const Toolchain& toolchain, const std::vector<ForbiddenFunction>& forbidden,
                             const StudentBuildOptions& options) {
  const std::string name = plainName(options.main);
  const path folder = std::filesystem::absolute(options.workFolder);
  StudentObject result;
  result.name = name;
  try {
    result.source = readStudentFile(options.main);
  } catch (const Error& error) {
    result.messages.push_back(
        {name, 0, 0, "error", "",
         "cannot be graded: found " + error.parts().found + ", wanted " + error.parts().wanted});
    result.log = writeLog(result.messages);
    result.exitCode = 1;
    return result;
  }
  // Before anything is compiled: the compiler would attribute its messages to lines that the file chooses.
  if (options.publicHeadersOnly) result.messages = lineMarkers(result.source, name);
  if (!result.messages.empty()) {
    result.truncated = admitMessages(result.messages);
    result.log = writeLog(result.messages);
    result.exitCode = 1;
    return result;
  }
  // A copy, so that exactly what was read is graded and no file beside the student's is included.
  std::filesystem::create_directories(folder);
  writeSource(folder / name, result.source);
  result.object = folder / "student.o";
  // They may belong to another user, after grading at another level.
  for (const path& old :
       {folder / kDependencies, folder / kOfAssembler, folder / kPart / kOfAssembler, result.object})
    std::filesystem::remove(old);
  StudentBuildOptions absolute = options;
  absolute.workFolder = folder;
  const BuildTools tools(toolchain, folder, options.sandbox,
                         {.seconds = options.seconds, .memory = options.memory});
  compile(toolchain, forbidden, compileCommand(toolchain, absolute, result.source), name, tools, absolute,
          result);
  if (!result.ok) return result;

  std::vector<CompileDiagnostic> calls;
  if (options.graded) calls = forbiddenCallsIn(result, toolchain, forbidden, tools);
  if (options.publicHeadersOnly) {
    for (const CompileDiagnostic& file : forbiddenFilesIn(result, folder, toolchain)) calls.push_back(file);
    for (const CompileDiagnostic& macro : forbiddenMacros(result.source, name)) calls.push_back(macro);
  }
  result.ok = calls.empty();
  result.messages.insert(result.messages.end(), calls.begin(), calls.end());
  if (const auto [line, column] = standardInputUse(result.source); line > 0)
    result.messages.push_back({name, line, column, "warning", "stdin",
                               "reads standard input, which is empty here: every read finds its end"});
  result.truncated = admitMessages(result.messages) || result.truncated;
  result.log = writeLog(result.messages);
  return result;
}

StudentProgram linkWorker(const Toolchain& toolchain, const StudentObject& object,
                          const sandbox::Sandbox& sandbox) {
  const path folder = object.object.parent_path(), renamed = folder / "worker_student.o";
  // Exactly what was scanned.
  const bool isWhole = object.graded.empty();
  const path& graded = isWhole ? object.object : object.graded;
  const BuildTools tools(toolchain, folder, sandbox);
  const ProcessResult run =
      tools.run({toolchain.objcopy, "--redefine-sym", "main=studentMain", graded.string(), renamed.string()});
  if (!run.ok()) throw Error({.what = "cannot rename main in the compiled file", .found = run.error});
  const path worker = folder / "worker";
  if (isWhole || toolchain.workerPart.empty())
    return link(toolchain, tools, worker, {toolchain.workerObject.string(), renamed.string()},
                librariesOfProgram(toolchain), object.name);
  for (const WorkerOfPart& part : workersOfParts(toolchain.workerPart)) {
    const StudentProgram linked =
        link(toolchain, tools, worker.string() + "." + part.id,
             {part.object.string(), "@" + part.options.string(), renamed.string()}, {}, object.name);
    if (!linked.ok) return linked;
  }
  const std::string options = "@" + linkOptions(toolchain.workerPart).string();
  return link(toolchain, tools, worker, {toolchain.workerPart.string(), options, renamed.string()}, {},
              object.name);
}

StudentProgram linkProgram(const Toolchain& toolchain, const StudentObject& object) {
  const path folder = object.object.parent_path();
  return link(toolchain, BuildTools(toolchain, folder, {}), folder / "program", {object.object.string()},
              librariesOfProgram(toolchain), object.name);
}

}  // namespace rex::grading
