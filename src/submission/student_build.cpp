#include "submission/student_build.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/process.h"
#include "base/text_file.h"
#include "submission/build_tools.h"
#include "submission/cpp_names.h"
#include "submission/graded_source.h"
#include "submission/included_files.h"
#include "submission/program_build.h"
#include "submission/reading_apart_internal.h"
#include "submission/source_remarks.h"
#include "submission/symbol_scan.h"
#include "submission/worker_part.h"

namespace rex::submission {
namespace {

using std::filesystem::path;

constexpr const char *kDependencies = "student.d", *kOfAssembler = "student.as.d";
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

// Why a compiler that reported no error still failed, although the machine is not to blame.
std::string whyItGaveUp(const ProcessResult& run, const BuildTools& tools,
                        const StudentBuildOptions& limits) {
  if (run.timedOut)
    return fmt::format(
        "compiling did not end within {:g} s: does it include a pipe or a device, or is this machine busy?",
        clockSeconds(limits.seconds));
  if (const std::string limit = tools.limitReached(run); !limit.empty()) return "compiling " + limit;
  constexpr std::size_t kMostText = 8u << 20;  // all that BuildTools keeps
  if (namesErrors(run.error) || run.error.size() >= kMostText)
    return "the compiler prints more than can be read";
  return "the compiler gave up: " + lastLine(run);
}

std::vector<std::string> compileCommand(const Toolchain& toolchain, const StudentBuildOptions& options,
                                        const std::vector<std::string>& prefix) {
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
  command.insert(command.end(), prefix.begin(), prefix.end());
  return command;
}

// The compiler's report as plain text. Only this form says which line of the student's file caused an error
// in a header. It quotes no source lines, as they could come from any file.
ProcessResult plainReport(std::vector<std::string> command, const std::string& name, const BuildTools& tools,
                          bool ofOptimiser) {
  command.insert(command.end(), {"-fmax-errors=20", "-fno-diagnostics-show-caret", name});
  if (ofOptimiser)
    command.insert(command.end(), {"-c", "-o", "plain.o"});
  else
    command.emplace_back("-fsyntax-only");
  return tools.runOnce(command);
}

std::string writeLog(const std::vector<grading::CompileDiagnostic>& messages) {
  std::string log;
  for (const grading::CompileDiagnostic& message : messages) log += toString(message) + "\n";
  return log;
}

bool isError(const grading::CompileDiagnostic& message) { return message.severity == "error"; }

// Finds what the file did wrong. Throws Error if the disk is full and the syntax is right: a compiler that
// cannot write reports that as an error, in words that a file could use, too.
void explain(const ProcessResult& run, const std::vector<std::string>& command, const std::string& name,
             const BuildTools& tools, const StudentBuildOptions& options, StudentObject& result) {
  const auto explained = [&] { return std::any_of(result.messages.begin(), result.messages.end(), isError); };
  const auto isOfOptimiser = [](const auto& m) { return m.rule.find("uninitialized") != std::string::npos; };
  // g++ 12 writes no JSON when -fmax-errors stops it, so only the plain text has that limit. It takes over
  // when there are too many errors for complete JSON.
  if (!run.timedOut) {
    const std::string full = tools.shortOfDisk();
    const bool ofOptimiser =
        full.empty() && std::any_of(result.messages.begin(), result.messages.end(), isOfOptimiser);
    const ProcessResult plain = plainReport(command, name, tools, ofOptimiser);
    if (!full.empty() && plain.ok())
      throw Error(
          {.what = "the compiler failed through no fault of the file",
           .found = fmt::format(
               "{}; {}", full,
               explained() ? std::find_if(result.messages.begin(), result.messages.end(), isError)->message
                           : lastLine(run)),
           .wanted = "a machine with free disk space"});
    result.log = printable(plain.error, kLogSize);
  }
  if (!explained())
    result.messages = messagesApart("the compiler's text", [&] { return parseCompilerText(result.log); });
  if (!explained())
    result.messages = messagesApart("the assembler's text", [&] { return parseAssemblerText(run.error); });
  if (!explained()) result.messages.push_back({name, 0, 0, "error", "", whyItGaveUp(run, tools, options)});
}

// The last parts of their qualified names.
std::vector<std::string> lastNames(const std::vector<ForbiddenFunction>& forbidden) {
  std::vector<std::string> names;
  for (const ForbiddenFunction& one : forbidden)
    names.push_back(one.function.substr(one.function.rfind(':') + 1));
  return names;
}

// What is read in a student's file before a compiler starts.
struct FirstReading {
  std::vector<std::string> prefix{};  // prefixFlags()
  std::string part{};                 // gradedSource()
  bool isAsking = false;              // with withAutoQuestions()
};

FirstReading readFirst(const std::string& source, const Toolchain& toolchain,
                       const std::vector<ForbiddenFunction>& forbidden, const StudentBuildOptions& options) {
  const auto read = [&]() -> nlohmann::json {
    const std::string asking = options.part ? withAutoQuestions(CppText(source)) : "";
    const std::string& whole = asking.empty() ? source : asking;
    const std::string part =
        options.part ? gradedSource(whole, toolchain.functions, lastNames(forbidden)) : "";
    return {prefixFlags(toolchain.prefix, source, toolchain.flags), part, !asking.empty()};
  };
  const nlohmann::json found = readApart("the file", kBeforeCompiling, read);
  return {found.at(0), found.at(1), found.at(2)};
}

// Why a file must not be compiled: the compiler would attribute its messages to lines that the file chooses.
struct Markers {
  std::vector<grading::CompileDiagnostic> found{};
  std::vector<grading::CompileDiagnostic> error{};  // which the compiler is to find again, and to explain
};

Markers readMarkers(std::vector<std::string> command, const BuildTools& tools,
                    const StudentBuildOptions& options, const StudentObject& result) {
  constexpr std::size_t kMostText = 32u << 20;
  const path file = options.workFolder / result.name;
  command.insert(command.end(),
                 {"-E", "-fpch-preprocess", "-pedantic", "-fno-diagnostics-show-caret", result.name});
  writeSource(file, sourceForMarkers(result.source));
  const auto hasErrors = [](const ProcessResult& run) {
    return run.error.find("error: ") != std::string::npos;
  };
  const ProcessResult run = tools.run(command, hasErrors, kMostText);
  writeSource(file, result.source);
  const auto failure = [&](const std::string& why) {
    return std::vector<grading::CompileDiagnostic>{{result.name, 0, 0, "error", "", why}};
  };
  if (std::max(run.output.size(), run.error.size()) >= kMostText)
    return {failure("the compiler prints more than can be read")};
  if (!run.ok() && (run.timedOut || !hasErrors(run))) return {failure(whyItGaveUp(run, tools, options))};
  return {
      messagesApart("the preprocessed file",
                    [&] { return lineMarkers(run.output, run.error, result.source, result.name, run.ok()); }),
      run.ok() ? std::vector<grading::CompileDiagnostic>{} : failure(whyItGaveUp(run, tools, options))};
}

// Compiles the graded part alone if that is wanted and the file allows it. It does not if the scan for
// forbidden functions, which sees only what is compiled, would miss something. Errors are better reported
// without the words that are put into the part.
ProcessResult compileAll(const std::vector<std::string>& command, const std::string& name,
                         const BuildTools& tools, const StudentBuildOptions& options,
                         const FirstReading& reading, const StudentObject& result) {
  std::vector<std::string> withJson = command;
  withJson.insert(withJson.end(), {"-fdiagnostics-format=json", "-MD", "-MF", kDependencies,
                                   std::string("-Wa,--MD,") + kOfAssembler, "-c", name, "-o",
                                   result.object.filename().string()});
  const auto hasErrors = [](const ProcessResult& failed) { return namesErrors(failed.error); };
  if (!reading.part.empty() && reading.part != result.source) {
    const path file = options.workFolder / name;
    writeSource(file, reading.part);
    std::vector<std::string> ofPart = withJson;
    ofPart.emplace_back("-Wfatal-errors");
    if (reading.isAsking) ofPart.insert(ofPart.end(), {"-include", kAutoQuestions});
    const ProcessResult run = tools.run(ofPart, hasErrors);
    writeSource(file, result.source);
    if (run.ok() || run.timedOut) return run;
  }
  return tools.run(withJson, hasErrors);
}

// Adds warnings of our own, and puts each message at a line of the file.
std::vector<grading::CompileDiagnostic> finished(std::vector<grading::CompileDiagnostic> messages,
                                                 const StudentObject& result) {
  const CppText text(result.source);
  explainAutoAnswers(messages, text);
  if (messages.size() > kMostMessages + 1) messages.resize(kMostMessages + 1);
  const std::vector<grading::CompileDiagnostic> divisions = integerDivisions(text, result.name);
  messages.insert(messages.end(), divisions.begin(), divisions.end());
  blameMainFile(messages, result.name, result.log);
  return messages;
}

void compile(const std::vector<std::string>& command, const std::string& name, const BuildTools& tools,
             const StudentBuildOptions& options, const FirstReading& reading, StudentObject& result) {
  const ProcessResult run = compileAll(command, name, tools, options, reading, result);
  result.exitCode = run.exitCode;
  result.ok = run.ok();
  result.messages = messagesApart("the compiler's messages", [&] { return parseCompilerJson(run.error); });
  if (!run.ok()) explain(run, command, name, tools, options, result);
  result.messages = messagesApart("the file with the compiler's messages",
                                  [&] { return finished(result.messages, result); });
  result.truncated = admitMessages(result.messages);
  if (result.log.empty()) result.log = writeLog(result.messages);
}

// What the linker found wrong with the last of the objects, which is the student's.
std::vector<grading::CompileDiagnostic> explainLinking(const ProcessResult& run, const BuildTools& tools,
                                                       const std::string& object,
                                                       const std::string& mainFile) {
  std::vector<grading::CompileDiagnostic> messages =
      messagesApart("the linker's text", [&] { return parseLinkerText(run.error, mainFile); });
  if (!messages.empty()) return messages;
  const std::string limit = tools.limitReached(run);
  if (!limit.empty()) return {{mainFile, 0, 0, "error", "", "linking " + limit}};
  const std::string complaint = complaintAbout(object, run.error);
  return {
      {mainFile, 0, 0, "error", "", "cannot be linked: " + (complaint.empty() ? lastLine(run) : complaint)}};
}

// The forbidden ones among all files that the compiler and the assembler opened.
std::vector<grading::CompileDiagnostic> forbiddenFilesIn(const StudentObject& object, const path& folder,
                                                         const Toolchain& toolchain) {
  std::vector<path> files = dependenciesIn(readTextFile(folder / kDependencies), folder);
  for (path& file : filesOfAssembler(readTextFile(folder / kOfAssembler), folder))
    files.push_back(std::move(file));
  return forbiddenIncludes(files, object.source, object.name, folder, toolchain);
}

// Makes `result.graded`, in which nothing may call what is forbidden; messages say if the file prevents that.
std::vector<grading::CompileDiagnostic> forbiddenCallsIn(StudentObject& result, const Toolchain& toolchain,
                                                         const std::vector<ForbiddenFunction>& forbidden,
                                                         const BuildTools& tools) {
  const std::string bytes = readTextFile(result.object);
  const std::vector<grading::CompileDiagnostic> messages = messagesApart("the object file", [&] {
    try {
      return strangeParts(readObjectFile(bytes, "graded"), result.name);
    } catch (const Error& error) {
      return std::vector<grading::CompileDiagnostic>{
          {result.name, 0, 0, "error", "forbidden-call",
           "makes an object file that cannot be read: " + error.parts().found}};
    }
  });
  if (!messages.empty()) return messages;
  const path graded = result.object.parent_path() / "graded.o";
  const std::optional<ProcessResult> run = withoutMain(result.object, graded, toolchain, tools);
  if (!run) return {};
  if (!run->ok()) return explainLinking(*run, tools, result.object.string(), result.name);
  result.graded = graded;
  return messagesApart("what the object file calls", [&] {
    return scanSymbols(result.graded, result.source, result.name, forbidden, toolchain.offers);
  });
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
  ProcessResult run = tools.runOnce(command);
  if (!run.ok()) {
    // The standard linker has the last word: its complaints are the ones that we can explain.
    command.emplace_back("-fuse-ld=bfd");
    run = tools.run(command,
                    [&](const ProcessResult& failed) { return blamesObject(failed.error, objects.back()); });
  }
  StudentProgram result{
      .program = program, .messages = {}, .log = printable(run.error, kLogSize), .ok = run.ok()};
  try {
    if (!run.ok()) result.messages = explainLinking(run, tools, objects.back(), mainFile);
  } catch (const UnreadableFile& error) {
    result.messages = {{mainFile, 0, 0, "error", "", std::string("cannot be linked: ") + error.what()}};
  }
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

namespace {

// A file of which nothing is compiled, or nothing that was compiled may be used.
void reject(StudentObject& result, std::vector<grading::CompileDiagnostic> messages) {
  result.messages = std::move(messages);
  result.truncated = admitMessages(result.messages);
  result.log = writeLog(result.messages);
  result.exitCode = 1;
  result.ok = false;
}

void reject(StudentObject& result, const Error& error) {
  const std::string found = error.parts().found.empty() ? "" : "found " + error.parts().found + ", wanted ";
  reject(result,
         {{result.name, 0, 0, "error", "",
           "cannot be graded: " + (found.empty() ? error.parts().what : found + error.parts().wanted)}});
}

// What the scans after compiling find: errors, and a warning.
std::vector<grading::CompileDiagnostic> findingsIn(const StudentObject& object, const Toolchain& toolchain,
                                                   const StudentBuildOptions& options) {
  std::vector<grading::CompileDiagnostic> found;
  if (options.publicHeadersOnly) {
    found = forbiddenFilesIn(object, options.workFolder, toolchain);
    const std::vector<grading::CompileDiagnostic> macros = forbiddenMacros(object.source, object.name);
    found.insert(found.end(), macros.begin(), macros.end());
  }
  if (const auto [line, column] = standardInputUse(CppText(object.source)); line > 0)
    found.push_back({object.name, line, column, "warning", "stdin",
                     "reads standard input, which is empty here: every read finds its end"});
  return found;
}

void compileText(const Toolchain& toolchain, const std::vector<ForbiddenFunction>& forbidden,
                 const StudentBuildOptions& options, StudentObject& result) {
  const FirstReading reading = readFirst(result.source, toolchain, forbidden, options);
  // A copy, so that exactly what was read is graded and no file beside the student's is included.
  const path& folder = options.workFolder;
  std::filesystem::create_directories(folder);
  writeSource(folder / result.name, result.source);
  result.object = folder / "student.o";
  // They may belong to another user, after grading at another level.
  for (const path& old : {folder / kDependencies, folder / kOfAssembler, result.object})
    std::filesystem::remove(old);
  const BuildTools tools(toolchain, folder, options.sandbox,
                         {.seconds = options.seconds, .memory = options.memory});
  const std::vector<std::string> command = compileCommand(toolchain, options, reading.prefix);
  const Markers markers =
      options.publicHeadersOnly ? readMarkers(command, tools, options, result) : Markers{};
  if (!markers.found.empty()) return reject(result, markers.found);
  compile(command, result.name, tools, options, reading, result);
  if (!result.ok) return;
  if (!markers.error.empty()) return reject(result, markers.error);
  std::vector<grading::CompileDiagnostic> found;
  if (options.graded) found = forbiddenCallsIn(result, toolchain, forbidden, tools);
  const std::vector<grading::CompileDiagnostic> more =
      messagesApart("the file and what it includes", [&] { return findingsIn(result, toolchain, options); });
  found.insert(found.end(), more.begin(), more.end());
  result.ok = std::none_of(found.begin(), found.end(), isError);
  result.messages.insert(result.messages.end(), found.begin(), found.end());
  result.truncated = admitMessages(result.messages) || result.truncated;
  result.log = writeLog(result.messages);
}

}  // namespace

StudentObject compileStudent(const Toolchain& toolchain, const std::vector<ForbiddenFunction>& forbidden,
                             const StudentBuildOptions& options) {
  StudentBuildOptions absolute = options;
  absolute.workFolder = std::filesystem::absolute(options.workFolder);
  StudentObject result;
  result.name = plainName(options.main);
  try {
    result.source = readStudentFile(options.main);
  } catch (const Error& error) {
    reject(result, error);
    return result;
  }
  try {
    compileText(toolchain, forbidden, absolute, result);
  } catch (const UnreadableFile& error) {
    reject(result, error);
  }
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
  if (!run.ok()) {
    if (!tools.runOnce({toolchain.objcopy, "--version"}).ok())
      throw Error({.what = "cannot rename main in the compiled file", .found = run.error});
    return {.program = {},
            .messages = {{object.name, 0, 0, "error", "", "cannot be linked: " + lastLine(run)}},
            .log = printable(run.error, kLogSize)};
  }
  const path worker = folder / "worker";
  if (isWhole || toolchain.workerPart.empty())
    return link(toolchain, tools, worker, {toolchain.workerObject.string(), renamed.string()},
                librariesOfProgram(toolchain), object.name);
  std::vector<std::string> parts;
  for (const WorkerOfPart& part : workersOfParts(toolchain.workerPart)) {
    const StudentProgram linked =
        link(toolchain, tools, worker.string() + "." + part.id,
             {part.object.string(), "@" + part.options.string(), renamed.string()}, {}, object.name);
    if (!linked.ok) return linked;
    parts.push_back(part.id);
  }
  const std::string options = "@" + linkOptions(toolchain.workerPart).string();
  StudentProgram linked = link(toolchain, tools, worker,
                               {toolchain.workerPart.string(), options, renamed.string()}, {}, object.name);
  linked.parts = std::move(parts);
  return linked;
}

StudentProgram linkProgram(const Toolchain& toolchain, const StudentObject& object) {
  const path folder = object.object.parent_path();
  return link(toolchain, BuildTools(toolchain, folder, {}), folder / "program", {object.object.string()},
              librariesOfProgram(toolchain), object.name);
}

}  // namespace rex::submission
