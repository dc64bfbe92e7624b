// Programs that mean harm, handed in and graded at every sandbox level that this machine offers: no points,
// the right class, nothing left behind, and the next submission is graded as if nobody had come before.
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/process.h"
#include "base/text_file.h"
#include "classroom/submission_folder.h"
#include "grading/results.h"
#include "sandbox/confinement.h"
#include "sandbox/probes.h"
#include "submission/submission.h"
#include "submission/zip_file.h"
#include "support/archive_samples.h"
#include "support/paths.h"
#include "support/rounds.h"
#include "support/temporary_folder.h"

namespace rex::grading::battery_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path kBinary = ownFolder(), kOutput = kBinary / "tests" / "battery";
const fs::path kFolder = homeFolder() / "tests" / "grading";
constexpr const char* kSecret = "the-secret-of-the-course-0123456789";

const sandbox::Sandbox sandboxOf(int level) {
  return {.level = sandbox::parseLevel(level), .launcher = kBinary / "rex-sandbox"};
}

std::string whyNot(int level) {
  const TemporaryFolder folder;
  return sandbox::whyNot(sandboxOf(level), kBinary / "rex-sandbox-probe", folder.path());
}

std::vector<int> offeredLevels() {
  std::vector<int> levels;
  for (const int level : {3, 2, 1})
    if (whyNot(level).empty()) levels.push_back(level);
  return levels;
}

class Level : public ::testing::TestWithParam<int> {};

// The battery leaves out what the machine does not offer; this says so by name.
TEST_P(Level, IsOffered) {
  if (const std::string reason = whyNot(GetParam()); !reason.empty())
    GTEST_SKIP() << "sandbox level " << GetParam() << ": " << reason;
}
INSTANTIATE_TEST_SUITE_P(Sandbox, Level, ::testing::Values(3, 2, 1));

std::vector<std::string> cut(const std::string& text, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, separator);) fields.push_back(field);
  return fields;
}

void eraseVolatile(nlohmann::json& json) {
  if (json.is_object()) {
    json.erase("volatile");
    json.erase("sandbox");
  }
  if (json.is_structured())
    for (auto& entry : json) eraseVolatile(entry);
}

// Folders of /proc.
std::set<fs::path> processesOf(const fs::path& program) {
  std::set<fs::path> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code gone;
    if (fs::read_symlink(entry.path() / "exe", gone).string().starts_with(program.string()))
      found.insert(entry.path());
  }
  return found;
}

// In a sandbox all programs lie in the same place, those of gradings beside this one, too: they end soon.
bool someStayInASandbox() {
  const fs::path place = fs::path(sandbox::kInsideProgram).parent_path();
  std::set<fs::path> there = processesOf(place);
  for (int tenths = 0; !there.empty() && tenths < 600; ++tenths) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::set<fs::path> now = processesOf(place);
    std::erase_if(there, [&](const fs::path& one) { return !now.contains(one); });
  }
  return !there.empty();
}

class Battery : public ::testing::Test {
 protected:
  Battery() { writeTextFile(secret(), kSecret); }

  submission::SubmissionOptions optionsFor(const fs::path& file, int level, const std::string& name) const {
    return {.main = file,
            .workFolder = temporary_.path() / name / "work",
            .job = {.results = temporary_.path() / name / "results.json",
                    .sandbox = sandboxOf(level),
                    .secret = secret()},
            .compileSeconds = 20};
  }

  // The result of an honest program, without what may differ.
  std::string honest(int level) const {
    const submission::SubmissionOptions options = optionsFor("", level, "honest");
    fs::create_directories(options.workFolder);
    submission::BuiltSubmission built;
    built.worker = kOutput / "honest";
    EXPECT_EQ(submission::gradeBuilt(built, toolchain_, exercise(), options).score, 10);
    nlohmann::json json = nlohmann::json::parse(readTextFile(options.job.results));
    eraseVolatile(json);
    return json.dump(1);
  }

  static submission::ExerciseInfo exercise() { return submission::readExerciseInfo(kFolder / "battery"); }

  fs::path secret() const { return temporary_.path() / "secret-of-the-course"; }

  // What must hold whatever was handed in.
  void expectNoHarm(const GradeResult& result, const submission::SubmissionOptions& options) const {
    for (const CheckResult& check : result.checks) EXPECT_LE(check.wallSeconds, 4 * 2.4 + 2) << check.id;
    EXPECT_EQ(loadResult(options.job.results).outcome, result.outcome);
    EXPECT_EQ(result.sandboxLevel, numberOf(options.job.sandbox.level));
    EXPECT_THAT(processesOf(options.workFolder), ::testing::IsEmpty());
    EXPECT_FALSE(someStayInASandbox());
    for (const auto& entry : fs::directory_iterator(options.workFolder))
      EXPECT_FALSE(entry.is_directory()) << entry.path();
    for (const char* file : {"/tmp/results.json", "/tmp/x.so", "/tmp/rex-battery-stayed", "/results.json"})
      EXPECT_FALSE(fs::exists(file)) << file;
    const std::string text = readTextFile(options.job.results);
    EXPECT_LT(text.size(), 64u << 10);
    EXPECT_THAT(text, Not(HasSubstr(kSecret)));
    EXPECT_THAT(text, Not(HasSubstr("root:x:0:0")));
  }

  TemporaryFolder temporary_;
  submission::Toolchain toolchain_ = submission::readToolchain(kOutput / "build.json");
};

// Whether a file was built or refused as its row says: "-" for a file that is built, or pieces of the
// messages that may refuse it. A file that is refused for another reason, such as a header that is gone,
// attacks nothing.
bool isAsExpected(const submission::BuiltSubmission& built, const std::string& refused) {
  const std::string& message = built.start.message;
  const std::vector<std::string> pieces = cut(refused, '|');
  return std::any_of(pieces.begin(), pieces.end(), [&](const std::string& piece) {
    return piece == "-" ? !built.worker.empty() : built.worker.empty() && message.find(piece) != message.npos;
  });
}

// A line of attacks.tsv: what may become of a program that means harm, level by level.
struct Attack {
  std::string file;
  std::map<int, std::set<Outcome>> outcomes{};  // by sandbox level
  int mostPoints = 0;
  std::vector<std::string> checks{};  // those that matter, where each takes its time
  bool whileCompiling = false;
  std::string refused{};
};

void PrintTo(const Attack& attack, std::ostream* out) { *out << attack.file; }

std::set<Outcome> outcomesFrom(const std::string& text) {
  std::set<Outcome> outcomes;
  for (const std::string& name : cut(text, '|')) outcomes.insert(outcomeFromString(name).value());
  return outcomes;
}

Attack attackFrom(const std::string& line) {
  const std::vector<std::string> fields = cut(line, '\t');
  Attack attack{.file = fields.at(0)};
  for (const int level : {3, 2, 1})
    attack.outcomes[level] = outcomesFrom(fields.at(static_cast<std::size_t>(4 - level)));
  attack.mostPoints = std::stoi(fields.at(4));
  if (fields.at(5) != "all") attack.checks = cut(fields.at(5), ',');
  attack.whileCompiling = fields.at(6) == "compiler";
  attack.refused = fields.at(7);
  return attack;
}

std::vector<Attack> knownAttacks() {
  std::istringstream lines(readTextFile(kFolder / "attacks.tsv"));
  std::vector<Attack> attacks;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) attacks.push_back(attackFrom(line));
  return attacks;
}

class Attacks : public Battery, public ::testing::WithParamInterface<Attack> {
 protected:
  fs::path source() const { return kFolder / "attacks" / (GetParam().file + ".cpp"); }

  void expectHarmless(const GradeResult& result, const submission::SubmissionOptions& options,
                      bool compiled) const {
    const Attack& attack = GetParam();
    const int level = numberOf(options.job.sandbox.level);
    RecordProperty("level_" + std::to_string(level), std::string(toString(result.outcome)));
    EXPECT_THAT(attack.outcomes.at(level), ::testing::Contains(result.outcome))
        << toString(result.outcome) << ": " << result.message
        << (result.checks.empty() ? "" : "; " + result.checks.front().message);
    EXPECT_LE(result.score, attack.mostPoints);
    if (compiled) expectNoHarm(result, options);
    const std::string log = readTextFile(options.job.results.parent_path() / "build.log");
    EXPECT_THAT(log, Not(HasSubstr("root:x:0:0")));
    EXPECT_LE(log.size(), 64u << 10);
  }
};

TEST_P(Attacks, GainNothingAndHarmNobody) {
  const Attack& attack = GetParam();
  std::vector<int> levels = offeredLevels();
  if (levels.empty()) GTEST_SKIP() << "no sandbox is offered here";
  if (!isLongRun()) levels.resize(1);
  const std::string before = honest(levels.front());
  std::optional<submission::BuiltSubmission> built;
  for (const int level : levels) {
    SCOPED_TRACE("level " + std::to_string(level));
    submission::SubmissionOptions options = optionsFor(source(), level, "attack");
    options.job.checks = attack.checks;
    if (attack.file.starts_with("A15") || attack.file.starts_with("A16")) options.compileSeconds = 2;
    submission::ExerciseInfo info = exercise();
    // Some machines need more than a second to touch all memory that is allowed.
    if (attack.outcomes.at(level).contains(Outcome::kMemoryLimit)) info.limits.cpuSeconds = 4;
    if (!built || attack.whileCompiling) built = submission::buildSubmission(toolchain_, info, options);
    EXPECT_TRUE(isAsExpected(*built, attack.refused)) << built->start.message;
    expectHarmless(submission::gradeBuilt(*built, toolchain_, info, options), options,
                   !built->worker.empty());
    EXPECT_EQ(honest(level), before);
  }
}

// Root has a user of its own for each program; others share theirs with what they grade. The test of that
// name once more by a user who owns nothing, at the levels that he is offered.
void expectTheSameAsAnOrdinaryUser(const std::string& name) {
  if (::geteuid() != 0) GTEST_SKIP() << "this is an ordinary user: the test before has tried";
  constexpr const char* kNobodysNumber = "60705";
  const std::vector<std::string> asUser = {"setpriv", "--reuid",      kNobodysNumber,
                                           "--regid", kNobodysNumber, "--clear-groups"};
  const auto run = [&](const std::vector<std::string>& words) {
    std::vector<std::string> command = asUser;
    command.insert(command.end(), words.begin(), words.end());
    return runProcess(command, {.timeout = 600});
  };
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  if (!run({"test", "-x", self}).ok() || !run({"test", "-r", (kFolder / "attacks.tsv").string()}).ok())
    GTEST_SKIP() << "setpriv is missing, or an ordinary user cannot read " << kFolder;
  const ProcessResult ended = run({self, "--gtest_filter=" + name});
  if (ended.output.find("[  SKIPPED ] 1 test") != std::string::npos)
    GTEST_SKIP() << "no sandbox is offered to an ordinary user here";
  EXPECT_TRUE(ended.ok()) << ended.output << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("[  PASSED  ] 1 test"));
}

TEST_P(Attacks, GainNothingFromAnOrdinaryUser) {
  expectTheSameAsAnOrdinaryUser("All/Attacks.GainNothingAndHarmNobody/" + GetParam().file);
}

using enum Outcome;
INSTANTIATE_TEST_SUITE_P(All, Attacks, ::testing::ValuesIn(knownAttacks()),
                         [](const auto& attack) { return attack.param.file; });

// Attacks by the classes of causes that were found once, A to R, at least three of each: what may become of
// them is nobody's business but that they get nothing.
struct ClassedAttack {
  std::string file{}, refused{};
  int mostPoints = 0;  ///< for what it answers honestly
  int number = 0;      ///< in its class, from 0
};

void PrintTo(const ClassedAttack& attack, std::ostream* out) { *out << attack.file; }

// Short runs take three of each class.
std::vector<ClassedAttack> classedAttacks() {
  std::istringstream lines(readTextFile(kFolder / "attacks_by_class" / "list.tsv"));
  std::vector<ClassedAttack> attacks;
  std::map<std::string, int> count;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    const std::vector<std::string> fields = cut(line, '\t');
    const int number = count[fields.at(1)]++;
    if (number < rounds(3, 1000))
      attacks.push_back({fields.at(0), fields.at(3), std::stoi(fields.at(2)), number});
  }
  return attacks;
}

// The text of an attack, with the text of a header beside it in place of the line that includes it.
std::string textOfAttack(const std::string& name) {
  const fs::path folder = kFolder / "attacks_by_class";
  std::string text = readTextFile(folder / (name + ".cpp"));
  for (const std::string header : {"attack_tools.h", "channel.h", "system_call.h"}) {
    const std::string line = "#include \"" + header + "\"\n";
    if (const std::size_t include = text.find(line); include != text.npos)
      text.replace(include, line.size(), readTextFile(folder / header));
  }
  return text;
}

class Classes : public Battery, public ::testing::WithParamInterface<ClassedAttack> {
 protected:
  // What follows a line "// double N" is doubled N times, so that long files are short here; if it says "in
  // one line", all of it is on the line before. What "#if 0" leaves out ends with the file.
  fs::path source() const {
    constexpr std::string_view kMark = "// double ";
    std::string text = textOfAttack(GetParam().file);
    if (const std::size_t mark = text.find(kMark); mark != text.npos) {
      const std::size_t start = text.find('\n', mark) + 1;
      const int times = std::stoi(text.substr(mark + kMark.size()));
      const bool isOneLine = text.find("in one line", mark) < start;
      std::string grown = text.substr(start, text.size() - start - (isOneLine ? 1 : 0));
      for (int k = 0; k < times; ++k) grown += std::string(grown);
      text.replace(isOneLine ? mark - 1 : mark, text.npos, grown);
      if (text.find("\n#if 0\n") != text.npos) text += "\n#endif\n";
    }
    const fs::path file = temporary_.path() / "source" / (GetParam().file + ".cpp");
    writeTextFile(file, text);
    return file;
  }
};

// What no report, log or result may hold: text of the machine, and signs that deceive whoever reads it.
void expectNothingTold(const std::string& text) {
  for (const char* of : {"root:x:0:0", kSecret, "another program ran", "channel open", "in memory: "})
    EXPECT_THAT(text, Not(HasSubstr(of)));
  for (const char* hidden : {"\u202e", "\u2066", "\u2028", "\u200b", "\u001b"})
    EXPECT_THAT(text, Not(HasSubstr(hidden)));
}

// The same without a secret, with all checks at once: channels need a neighbour.
void expectNothingPrinted(const submission::BuiltSubmission& built, submission::SubmissionOptions options) {
  options.job.secret.clear();
  options.job.jobs = 3;
  static_cast<void>(submission::gradeBuilt(built, submission::readToolchain(kOutput / "build.json"),
                                           submission::readExerciseInfo(kFolder / "battery"), options));
  const std::string text = readTextFile(options.job.results);
  expectNothingTold(text);
  EXPECT_THAT(text, Not(::testing::ContainsRegex("channel held [1-9]")));
}

// Short runs try each attack at one level, and so each class at all of them.
TEST_P(Classes, GainNothingAndHarmNobody) {
  std::vector<int> levels = offeredLevels();
  if (levels.empty()) GTEST_SKIP() << "no sandbox is offered here";
  if (!isLongRun()) levels = {levels[static_cast<std::size_t>(GetParam().number) % levels.size()]};
  const std::string before = honest(levels.front());
  for (const int level : levels) {
    SCOPED_TRACE("level " + std::to_string(level));
    submission::SubmissionOptions options = optionsFor(source(), level, "attack");
    if (GetParam().file.starts_with("C_") || GetParam().file.starts_with("N_")) options.compileSeconds = 2;
    const submission::BuiltSubmission built = submission::buildSubmission(toolchain_, exercise(), options);
    EXPECT_TRUE(isAsExpected(built, GetParam().refused)) << built.start.message;
    const GradeResult result = submission::gradeBuilt(built, toolchain_, exercise(), options);
    RecordProperty("level_" + std::to_string(level), std::string(toString(result.outcome)));
    EXPECT_NE(result.outcome, Outcome::kGraderError) << result.message;
    EXPECT_LE(result.score, GetParam().mostPoints) << toString(result.outcome);
    if (!built.worker.empty()) expectNoHarm(result, options);
    expectNothingTold(readTextFile(options.job.results));
    expectNothingTold(readTextFile(options.job.results.parent_path() / "build.log"));
    if (!built.worker.empty() && std::string("EL").find(GetParam().file.front()) != std::string::npos)
      expectNothingPrinted(built, options);
    EXPECT_EQ(honest(level), before);
  }
}

// Nothing that is printed is shown beside secret checks, so a program that can start another, or talk to a
// neighbour, would not be seen by that.
TEST_F(Battery, SeesWhatIsPrintedWithoutWalls) {
  const fs::path file = temporary_.path() / "source" / "main.cpp";
  writeTextFile(file, textOfAttack("E_spawns_beside"));
  submission::SubmissionOptions options = optionsFor(file, 0, "attack");
  options.job.secret.clear();
  const submission::BuiltSubmission built = submission::buildSubmission(toolchain_, exercise(), options);
  static_cast<void>(submission::gradeBuilt(built, toolchain_, exercise(), options));
  EXPECT_THAT(readTextFile(options.job.results), HasSubstr("another program ran"));
}

TEST_P(Classes, GainNothingFromAnOrdinaryUser) {
  expectTheSameAsAnOrdinaryUser("All/Classes.GainNothingAndHarmNobody/" + GetParam().file);
}

INSTANTIATE_TEST_SUITE_P(All, Classes, ::testing::ValuesIn(classedAttacks()),
                         [](const auto& attack) { return attack.param.file; });

// The walls are what stops them: with the whole library in the worker an attack finds the forbidden function.
TEST_F(Battery, FindsTheAnswerWhereItIsInMemory) {
  const fs::path file = temporary_.path() / "source" / "main.cpp";
  writeTextFile(file, textOfAttack("A_header_below_return_address"));
  const submission::SubmissionOptions options = optionsFor(file, 0, "attack");
  submission::Toolchain whole = toolchain_;
  whole.workerPart.clear();
  whole.offers.clear();
  whole.linkFlags.insert(whole.linkFlags.begin(),
                         {"-Wl,--no-as-needed", (kBinary / "lib" / "librex_battery_answer.so").string()});
  const submission::BuiltSubmission built = submission::buildSubmission(whole, exercise(), options);
  EXPECT_EQ(submission::gradeBuilt(built, whole, exercise(), options).score, 8) << built.start.message;
}

TEST(AnAttack, IsStaleIfItIsRefusedForAnotherReason) {
  submission::BuiltSubmission built;
  built.start.message = "main.cpp:3:10: fatal error: old.h: No such file or directory";
  EXPECT_FALSE(isAsExpected(built, "-"));
  EXPECT_FALSE(isAsExpected(built, "-|includes passwd: only public headers"));
  EXPECT_TRUE(isAsExpected(built, "old.h: No such file"));
  built.worker = "worker";
  EXPECT_TRUE(isAsExpected(built, "-"));
  EXPECT_FALSE(isAsExpected(built, "old.h: No such file"));
}

TEST(ClassesOfAttacks, AreAllTriedAtLeastThreeTimes) {
  std::map<std::string, int> count;
  std::istringstream lines(readTextFile(kFolder / "attacks_by_class" / "list.tsv"));
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    const std::vector<std::string> fields = cut(line, '\t');
    EXPECT_TRUE(fs::exists(kFolder / "attacks_by_class" / (fields.at(0) + ".cpp"))) << fields.at(0);
    ++count[fields.at(1)];
  }
  // H and J are archives: see ArchiveBattery and HandInTest.
  for (const char* kind : {"A", "B", "C", "D", "E", "F", "G", "I", "K", "L", "M", "N", "O", "P", "Q", "R"})
    EXPECT_GE(count[kind], 3) << kind;
}

std::set<std::string> filesOfAttacks() {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(kFolder / "attacks"))
    files.insert(entry.path().stem().string());
  return files;
}

// Every attack is tried: by a row of attacks.tsv, or by a test that share/doc/sandbox.md names.
TEST(Documentation, LeavesOutNoAttack) {
  std::set<std::string> files = filesOfAttacks(), numbers;
  for (const Attack& attack : knownAttacks()) {
    EXPECT_EQ(files.erase(attack.file), 1u) << attack.file;
    numbers.insert(attack.file.substr(0, 3));
  }
  EXPECT_THAT(files, ::testing::ElementsAre("A24_talks"));
  for (const std::string& line : cut(readTextFile(homeFolder() / "share" / "doc" / "sandbox.md"), '\n'))
    if (line.starts_with("| A")) numbers.insert(line.substr(2, 3));
  for (int k = 1; k <= 38; ++k)
    EXPECT_EQ(numbers.count("A" + std::string(k < 10 ? "0" : "") + std::to_string(k)), 1u) << k;
}

TEST(Documentation, NamesTestsThatThereAre) {
  const std::string page = readTextFile(homeFolder() / "share" / "doc" / "sandbox.md");
  std::set<std::string> known;
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int suite = 0; suite < all.total_test_suite_count(); ++suite)
    for (int test = 0; test < all.GetTestSuite(suite)->total_test_count(); ++test)
      known.insert(std::string(all.GetTestSuite(suite)->name()) + "." +
                   all.GetTestSuite(suite)->GetTestInfo(test)->name());
  const std::regex name("`((?:Archive)?Battery\\.A\\w+)`");
  int named = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), name), end; found != end; ++found, ++named)
    EXPECT_EQ(known.count((*found)[1]), 1u) << (*found)[1];
  EXPECT_GE(named, 6);
}

TEST_F(Battery, A13SeesNothingBesideACompilerInTheHome) {
  const fs::path home = temporary_.path() / "home", main = temporary_.path() / "main.cpp";
  fs::create_directories(home / "bin");
  fs::create_symlink("/usr/bin/c++", home / "bin" / "c++");
  writeTextFile(home / "secret.h", readTextFile(kFolder / "battery" / "honest.cpp"));
  submission::Toolchain toolchain = toolchain_;
  toolchain.compiler = home / "bin" / "c++";
  for (const int level : offeredLevels()) {
    for (const std::string& text :
         {readTextFile(home / "secret.h"), "#include \"" + (home / "secret.h").string() + "\"\n"}) {
      writeTextFile(main, text);
      const submission::BuiltSubmission built =
          submission::buildSubmission(toolchain, exercise(), optionsFor(main, level, "attack"));
      EXPECT_EQ(built.worker.empty(), text.starts_with("#include \"/")) << built.start.message;
      EXPECT_EQ(built.start.outcome == kCompileError, built.worker.empty()) << built.start.message;
    }
  }
}

// No attack: a machine short of memory does that.
TEST_F(Battery, ToolsThatAreKilledAreNoFaultOfTheFile) {
  const fs::path tools = temporary_.path() / "tools" / "bin", main = temporary_.path() / "main.cpp";
  fs::create_directories(tools);
  fs::create_symlink("/usr/bin/c++", tools / "c++");
  writeTextFile(tools / "cc1plus", "#!/bin/sh\nkill -KILL $$\n");
  fs::permissions(tools / "cc1plus", fs::perms(0755));
  writeTextFile(main, readTextFile(kFolder / "battery" / "honest.cpp"));
  submission::Toolchain toolchain = toolchain_;
  toolchain.compiler = tools / "c++";
  toolchain.flags.push_back("-B" + tools.string());
  for (const int level : offeredLevels()) {
    const submission::BuiltSubmission built =
        submission::buildSubmission(toolchain, exercise(), optionsFor(main, level, "killed"));
    EXPECT_EQ(built.start.outcome, Outcome::kGraderError);
    EXPECT_THAT(built.start.message, HasSubstr("failed twice through no fault of the file")) << level;
  }
}

TEST_F(Battery, A24TalksToNobody) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 4), 0);
  ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  const fs::path main = temporary_.path() / "main.cpp";
  writeTextFile(main, "#define REX_PORT " + std::to_string(::ntohs(address.sin_port)) + "\n" +
                          readTextFile(kFolder / "attacks" / "A24_talks.cpp"));
  std::optional<submission::BuiltSubmission> built;
  for (const int level : offeredLevels()) {
    const submission::SubmissionOptions options = optionsFor(main, level, "attack");
    if (!built) built = submission::buildSubmission(toolchain_, exercise(), options);
    const GradeResult result = submission::gradeBuilt(*built, toolchain_, exercise(), options);
    EXPECT_EQ(result.outcome, kFail) << level;
    EXPECT_EQ(result.score, 0) << level;
    expectNoHarm(result, options);
  }
  pollfd polled{listener, POLLIN, 0};
  EXPECT_EQ(::poll(&polled, 1, 0), 0) << "somebody came";
  ::close(listener);
}

// Archives that mean harm, each handed in beside an honest one.
class ArchiveBattery : public Battery {
 protected:
  ArchiveBattery() {
    writeTextFile(in() / "honest.zip", zipOf({{.name = "battery/main.cpp", .text = "int main() {}\n"}}));
  }
  fs::path in() const { return temporary_.path() / "in"; }
  std::vector<std::string> everythingHere() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(temporary_.path()))
      files.push_back(entry.path().string());
    return files;
  }
  // The archive is refused for this reason, its neighbour is not, and nothing is written anywhere.
  void expectRefusal(const std::string& name, const std::string& bytes, const std::string& reason) const {
    SCOPED_TRACE(reason);
    writeTextFile(in() / name, bytes);
    expectRefusal(name, reason);
  }
  void expectRefusal(const std::string& name, const std::string& reason) const {
    const std::vector<std::string> before = everythingHere();
    const classroom::SubmittedFiles found = classroom::readSubmittedFiles(in(), {exercise()});
    EXPECT_THAT(found.complaints,
                ::testing::ElementsAre(::testing::AllOf(HasSubstr(name), HasSubstr(reason))));
    ASSERT_EQ(found.files.size(), 1u);
    EXPECT_EQ(found.files.front().student, "honest");
    EXPECT_EQ(everythingHere(), before);
    fs::remove(in() / name);
  }
};

TEST_F(ArchiveBattery, A26RefusesMembersThatAreNoFilesOfTheirFolder) {
  const SampleMember good{.name = "battery/main.cpp", .text = "int main() {}\n"};
  const auto both = [&](const SampleMember& bad, const std::string& reason) {
    expectRefusal("mallory.tar", tarOf({good, bad}), reason);
    expectRefusal("mallory.zip", zipOf({good, bad}), reason);
  };
  both({.name = "../main.cpp"}, "member '../main.cpp': found a path out of its folder");
  both({.name = "battery/../../main.cpp"}, "member 'battery/../../main.cpp': found a path out");
  both({.name = "/tmp/rex-battery-stayed"}, "member '/tmp/rex-battery-stayed': found an absolute name");
  both({.name = "battery/main.cpp"}, "member 'battery/main.cpp': found a second file of that name");
  both({.name = "battery/Main.CPP"}, "member 'battery/Main.CPP': found a second file of that name");
  const auto leavesOut = [&](const std::string& name, const std::string& bytes, const std::string& kind) {
    writeTextFile(in() / name, bytes);
    const classroom::SubmittedFiles found = classroom::readSubmittedFiles(in(), {exercise()});
    EXPECT_THAT(found.complaints, ::testing::IsEmpty()) << kind;
    EXPECT_THAT(found.notes, ::testing::ElementsAre(HasSubstr(name + "/battery/x: ignored: " + kind)));
    EXPECT_EQ(found.files.size(), 2u) << kind;
    fs::remove(in() / name);
  };
  for (const auto& [type, kind] :
       {std::pair('1', "a hard link"), std::pair('2', "a symbolic link"), std::pair('3', "a device"),
        std::pair('4', "a device"), std::pair('6', "a pipe")})
    leavesOut("mallory.tar", tarOf({good, {.name = "battery/x", .type = type, .target = "/etc/passwd"}}),
              kind);
  leavesOut("mallory.zip", zipOf({good, {.name = "battery/x", .text = "/etc/passwd", .mode = 0120777}}),
            "a symbolic link");
  EXPECT_FALSE(fs::exists("/tmp/rex-battery-stayed"));
}

std::string gzipped(const std::string& bytes) {
  return runProcess({"gzip", "-c"}, {.input = bytes, .outputLimit = 64u << 20}).output;
}

TEST_F(ArchiveBattery, A27StopsAtItsLimits) {
  constexpr std::size_t kBomb = 200'000'000;
  submission::writeZip(in() / "mallory.zip", {{"battery/main.cpp", std::string(kBomb, '\0')}});
  EXPECT_LT(fs::file_size(in() / "mallory.zip"), 300'000u);
  expectRefusal("mallory.zip", "member 'battery/main.cpp': found more ");
  constexpr int kMany = 100'000;
  std::vector<SampleMember> many(kMany);
  for (int k = 0; k < kMany; ++k) many[static_cast<std::size_t>(k)].name = std::to_string(k);
  expectRefusal("mallory.tgz", gzipped(tarOf(many)), "found more members, wanted at most 200");
  expectRefusal("mallory.zip", zipOf(many), "not accepted: found ");
  expectRefusal("mallory.zip", zipOf({{.name = std::string(65535, 'n')}}), "found a name of 65535 bytes");
  for (const std::int64_t claimed : {3, 1 << 30})
    expectRefusal("mallory.zip", zipOf({{.name = "battery/main.cpp", .text = "int a;\n"}}, claimed),
                  "not accepted");
}

// This process stays small, so that the largest of its children is the one that reads.
TEST_F(ArchiveBattery, A27TakesLittleMemory) {
  rusage children{};
  ::getrusage(RUSAGE_CHILDREN, &children);
  if (children.ru_maxrss > 100 << 10) GTEST_SKIP() << "needs a process of its own, which ctest gives it";
  writeTextFile(temporary_.path() / "zeros", "");
  fs::resize_file(temporary_.path() / "zeros", 200'000'000);
  ASSERT_TRUE(
      runProcess({"tar", "-czf", (in() / "mallory.tgz").string(), "-C", temporary_.path().string(), "zeros"})
          .ok());
  expectRefusal("mallory.tgz", "member 'zeros': found more ");
#ifndef __SANITIZE_ADDRESS__
  ::getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 100 << 10) << "kilobytes";
#endif
}

TEST_F(ArchiveBattery, A27OpensNoArchiveInsideOfOne) {
  const std::string inner = zipOf({{.name = "../main.cpp"}});
  writeTextFile(in() / "mallory.zip", zipOf({{.name = "inner.zip", .text = inner},
                                             {.name = "battery/main.cpp", .text = "int a;\n"}}));
  const classroom::SubmittedFiles found = classroom::readSubmittedFiles(in(), {exercise()});
  EXPECT_THAT(found.complaints, ::testing::IsEmpty());
  EXPECT_THAT(found.notes, ::testing::ElementsAre(HasSubstr("mallory.zip/inner.zip: ignored")));
  EXPECT_EQ(found.files.size(), 2u);
}

// The source file itself is the attack: no file, or no text.
TEST_F(Battery, A28RefusesWhatIsNoSourceFile) {
  const fs::path folder = temporary_.path();
  fs::create_symlink("/etc/passwd", folder / "link.cpp");
  ASSERT_EQ(::mkfifo((folder / "pipe.cpp").c_str(), 0600), 0);
  fs::create_directory(folder / "folder.cpp");
  std::ofstream(folder / "sparse.cpp") << "int main() {}\n";
  fs::resize_file(folder / "sparse.cpp", 2u << 30);
  std::ofstream(folder / "nul.cpp", std::ios::binary) << std::string("int a;\0int b;", 13);
  std::ofstream(folder / "utf16.cpp", std::ios::binary) << std::string("\xff\xfei\0n\0t\0", 8);
  for (const int level : offeredLevels()) {
    for (const char* name : {"link.cpp", "pipe.cpp", "folder.cpp", "sparse.cpp", "nul.cpp", "utf16.cpp"}) {
      const GradeResult result =
          submission::gradeSubmission(toolchain_, exercise(), optionsFor(folder / name, level, "attack"))
              .result;
      EXPECT_EQ(result.outcome, kCompileError) << name;
      EXPECT_THAT(result.message, Not(HasSubstr("root:x")));
    }
  }
}

TEST_F(Battery, A28TakesLineEndsAndMarksOfOtherSystems) {
  std::string text = readTextFile(kFolder / "battery" / "honest.cpp"), windows = "\xef\xbb\xbf";
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  std::ofstream(temporary_.path() / "main.cpp", std::ios::binary) << windows;
  for (const int level : offeredLevels())
    EXPECT_EQ(submission::gradeSubmission(toolchain_, exercise(),
                                          optionsFor(temporary_.path() / "main.cpp", level, "honest"))
                  .result.outcome,
              kPass);
}

TEST_F(Battery, A29IgnoresWhatLiesBesideTheFile) {
  const fs::path folder = temporary_.path() / "handed in";
  fs::create_directories(folder / "Eigen");
  fs::copy_file(kFolder / "battery" / "honest.cpp", folder / "main.cpp");
  for (const char* name : {"vector", "Eigen/Dense", "exercise.h"})
    writeTextFile(folder / name, "#error taken\n");
  writeTextFile(folder / "CMakeLists.txt", "execute_process(COMMAND touch /tmp/rex-battery-stayed)\n");
  writeTextFile(folder / "Makefile", "all:\n\ttouch /tmp/rex-battery-stayed\n");
  for (const char* name : {".clang-tidy", "compile_commands.json", ".gitattributes", "conftest.py", "main.o"})
    writeTextFile(folder / name, "touch /tmp/rex-battery-stayed\n");
  for (const int level : offeredLevels()) {
    const submission::SubmissionOptions options = optionsFor(folder / "main.cpp", level, "honest");
    const GradeResult result = submission::gradeSubmission(toolchain_, exercise(), options).result;
    EXPECT_EQ(result.outcome, kPass) << result.message;
    EXPECT_EQ(result.files.size(), 1u);
    expectNoHarm(result, options);
  }
}

TEST_F(Battery, A30TakesNamesAsTheyAre) {
  const int level = offeredLevels().empty() ? 0 : offeredLevels().front();
  for (const std::string& name :
       {std::string("-o.cpp"), std::string("$(touch x).cpp"), std::string("a\nb.cpp"),
        std::string("\xff\xfe.cpp"), std::string(251, 'a') + ".cpp",
        std::string("two words 'and' \"quotes\"/main.cpp")}) {
    const fs::path file = temporary_.path() / name;
    fs::create_directories(file.parent_path());
    fs::copy_file(kFolder / "battery" / "honest.cpp", file, fs::copy_options::overwrite_existing);
    const submission::SubmissionOptions options = optionsFor(file, level, "honest");
    const GradeResult result = submission::gradeSubmission(toolchain_, exercise(), options).result;
    EXPECT_EQ(result.outcome, kPass) << name << ": " << result.message;
    EXPECT_TRUE(nlohmann::json::accept(readTextFile(options.job.results)));
    EXPECT_FALSE(fs::exists(options.workFolder / "x"));
  }
}

}  // namespace rex::grading::battery_test
