#include "submission/symbol_scan.h"

#include <cstdlib>
#include <cstring>

#include <cxxabi.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/text_file.h"
#include "submission/worker_part.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::submission::symbol_scan_test {

const std::vector<ForbiddenFunction> kForbidden = {{"rex::solveIk", "you write it"}};

TEST(IsSymbolOf, MatchesTheFunctionWhateverItsArguments) {
  for (const char* symbol :
       {"_ZN3rex7solveIkERKN5Eigen6MatrixIdLi3ELi1ELi0ELi3ELi1EEEi", "_ZN3rex7solveIkIdEESt6vectorIiSaIiEET_",
        "_ZN3rex7solveIkB5cxx11Ei", "_ZN3rex7solveIk3runEi", "_ZNK3rex7solveIk3runEi", "_ZN3rex7solveIkE",
        "_ZN3rex7solveIkC1Ei", "_ZTIN3rex7solveIkE", "_ZTVN3rex7solveIkE", "_ZThn16_N3rex7solveIk3runEi",
        "_ZTv0_n24_N3rex7solveIk3runEi", "_ZZN3rex7solveIkEiE4kept", "_ZGVZN3rex7solveIkEiE4kept",
        "_ZN3rex7solveIkEi.constprop.0", "_ZN3rex7solveIkEi@REX_1", "_ZNVKR3rex7solveIk3runEi"})
    EXPECT_TRUE(isSymbolFor(symbol, "rex::solveIk")) << symbol;
  EXPECT_TRUE(isSymbolFor("_ZNK3rex9Simulator17inverseKinematicsEv", "rex::Simulator::inverseKinematics"));
  EXPECT_TRUE(isSymbolFor("_ZN3rex8internal4stepEv", "rex::internal"));
  EXPECT_TRUE(isSymbolFor("_Z5solvei", "solve"));
  EXPECT_TRUE(isSymbolFor("solve", "solve"));
}

TEST(IsSymbolOf, LeavesOtherNamesAlone) {
  for (const char* symbol :
       {"_ZN3rex13solveIkFasterEi", "_ZN4mine3rex7solveIkEi", "_ZN12_GLOBAL__N_17solveIkEi",
        "_ZNKSt6vectorIN3rex7solveIkESaIS1_EE4sizeEv", "_Z3runRKN3rex7solveIkE", "_Z7solveIki", "", "_Z",
        "_ZN", "_ZTh", "_ZTv0", "_ZThn16", "rex", "main", "_ZN3rex7solveI"})
    EXPECT_FALSE(isSymbolFor(symbol, "rex::solveIk")) << symbol;
  EXPECT_FALSE(isSymbolFor("_ZN3rex9SimulatorC1Ev", "rex::Simulator::inverseKinematics"));
  EXPECT_FALSE(isSymbolFor("_ZN4mine5solveEi", "solve"));
}

// The second opinion: a demangler says the same of all symbols of a large object.
TEST(IsSymbolOf, AgreesWithADemangler) {
  const TemporaryFolder folder;
  const std::string object = folder.path() / "a.o";
  const ProcessResult compiled = runProcess(
      {"g++", "-std=c++20", "-x", "c++", "-c", "-", "-o", object},
      {.input =
           "#include <functional>\n#include <vector>\nnamespace rex { struct solveIk { virtual ~solveIk(); "
           "int run(int) const; static int count(); template <class T> T as(); int v = 0; }; "
           "int solveIkFaster(int); }\nrex::solveIk::~solveIk() {}\n"
           "namespace mine { namespace rex { int solveIk(std::vector<::rex::solveIk> a) { "
           "a.emplace_back(); return a[0].run(1) + ::rex::solveIkFaster(2) + a[0].as<int>() + "
           "std::function<int()>(&::rex::solveIk::count)(); } } }\n"});
  ASSERT_TRUE(compiled.ok()) << compiled.error;
  int count = 0;
  for (const ObjectSymbol& symbol : readObjectFile(readTextFile(object), object).symbols) {
    if (!symbol.name.starts_with("_Z")) continue;
    int status = 0;
    char* raw = abi::__cxa_demangle(symbol.name.c_str(), nullptr, nullptr, &status);
    ASSERT_EQ(status, 0) << symbol.name;
    std::string name = raw;
    std::free(raw);
    for (const char* kind : {"vtable for ", "typeinfo for ", "typeinfo name for "})
      if (name.starts_with(kind)) name.erase(0, std::strlen(kind));
    if (name.starts_with("int rex::")) name.erase(0, 4);
    const bool is = name == "rex::solveIk" || name.starts_with("rex::solveIk::");
    EXPECT_EQ(isSymbolFor(symbol.name, "rex::solveIk"), is) << name;
    count += is ? 1 : 0;
  }
  EXPECT_GE(count, 6);
}

class ScanSymbolsTest : public ::testing::Test {
 protected:
  // What the scan says about a source file compiled here.
  std::vector<grading::CompileDiagnostic> scan(const std::string& source) {
    const std::filesystem::path object = temporary_.path() / "a.o";
    const ProcessResult compiled =
        runProcess({"g++", "-std=c++20", "-O1", "-ffunction-sections", "-fdata-sections", "-x", "c++", "-c",
                    "-", "-o", object.string()},
                   {.input = source});
    EXPECT_TRUE(compiled.ok()) << compiled.error;
    const std::string bytes = readTextFile(object);
    const auto strange = strangeParts(readObjectFile(bytes, "a.o"), "main.cpp");
    if (!strange.empty()) return strange;
    const std::filesystem::path part = temporary_.path() / "part.o";
    Toolchain toolchain;
    toolchain.compiler = "g++";
    const ProcessResult linked =
        withoutMain(object, part, toolchain, BuildTools({}, temporary_.path(), {})).value();
    EXPECT_TRUE(linked.ok()) << linked.error;
    return scanSymbols(part, source, "main.cpp", kForbidden);
  }
  // What is left of the functions of the last file.
  std::string left() const {
    std::string names;
    const std::filesystem::path part = temporary_.path() / "part.o";
    for (const ObjectSymbol& symbol : readObjectFile(readTextFile(part), "part.o").symbols)
      if (symbol.isDefined) names += symbol.name + " ";
    return names;
  }
  TemporaryFolder temporary_;
};

TEST_F(ScanSymbolsTest, NamesPlaceFunctionReasonAndAdvice) {
  const auto messages = scan(R"(#define GO rex::solveIk
namespace rex { int solveIk(int); }
int f() { return GO(3); }
)");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(toString(messages[0]),
            "main.cpp: error: calls rex::solveIk, which only main() may call in this exercise: you write it. "
            "Write it yourself instead [forbidden-call]");
}

TEST_F(ScanSymbolsTest, SeesThroughAliasesPointersAndOwnDeclarations) {
  EXPECT_EQ(scan("namespace rex { int solveIk(int); }\nauto* hidden = &rex::solveIk;\n").size(), 1u);
  EXPECT_EQ(scan("int innocent(int) asm(\"_ZN3rex7solveIkEi\");\nint f() { return innocent(1); }\n").size(),
            1u);
  EXPECT_EQ(scan("namespace rex { int solveIk(int); }\nnamespace r = rex;\n#define GO r::sol##veIk\n"
                 "int f() { return GO(1); }\n")
                .size(),
            1u);
}

TEST_F(ScanSymbolsTest, AllowsMainToCompareWithTheLibrary) {
  const std::string declared = "namespace rex { int solveIk(int); }\n";
  EXPECT_TRUE(scan(declared + "int f() { return 1; }\nint main() { return rex::solveIk(1); }\n").empty());
  EXPECT_EQ(left(), "_Z1fv ");
  EXPECT_TRUE(scan("#include <functional>\n" + declared +
                   "void each(const std::function<int(int)>& f);\n"
                   "int f() { return 1; }\nint main() { each([](int a) { return rex::solveIk(a); }); }\n")
                  .empty());
  EXPECT_EQ(scan(declared + "int f() { return rex::solveIk(1); }\nint main() { return f(); }\n").size(), 1u);
  EXPECT_EQ(scan(declared + "int kept = rex::solveIk(1);\nint main() { return kept; }\n").size(), 1u);
}

TEST_F(ScanSymbolsTest, AllowsClassesThreadsAndSwitchesInMain) {
  EXPECT_TRUE(scan(R"(#include <functional>
#include <memory>
#include <thread>
namespace rex { int solveIk(int); }
struct Base {
  virtual int run(int) = 0;
  virtual ~Base() = default;
};
int useBase(Base&);
void a(int), b(int);
int main(int n, char**) {
  struct Mine : Base {
    int run(int k) override { return rex::solveIk(k); }
  } mine;
  std::thread t([&] { n = rex::solveIk(n); });
  t.join();
  static const int kept = rex::solveIk(n);
  switch (n) {
    case 0: a(1); break;
    case 1: b(3); break;
    case 2: a(7); break;
    case 3: b(5); break;
    case 4: a(2); break;
    case 5: b(9); break;
  }
  return useBase(mine) + std::make_shared<Mine>()->run(kept);
}
struct Other : Base {
  int run(int k) override { return k; }
};
int f() {
  Other other;
  static int count = 0;
  return useBase(other) + ++count;
}
)")
                  .empty());
}

// Ways to call from where only main() may.
TEST_F(ScanSymbolsTest, SeesThroughWhatOnlyLooksLikeMain) {
  const std::string declared = "namespace rex { int solveIk(int); }\n";
  for (const char* section :
       {".text.main", ".text.startup.main", ".text.unlikely.main", ".text._ZZ4mainENKUlvE_clEv"})
    EXPECT_EQ(scan(declared + "__attribute__((section(\"" + section +
                   "\"), noinline)) static int helper(int a) { return rex::solveIk(a); }\n"
                   "int f() { return helper(1); }\nint main() { return 0; }\n")
                  .size(),
              1u)
        << section;
  const char* attacks[] = {
      // main() itself, by its name and by others
      "int in, out;\nint main() { return out = rex::solveIk(in); }\nint f() { main(); return out; }\n",
      "int main() { return rex::solveIk(1); }\nauto* stored = &main;\nint f() { return stored(); }\n",
      "int main() { return rex::solveIk(1); }\n"
      "extern \"C\" int other() __attribute__((alias(\"main\")));\nint f() { return other(); }\n",
      "int main() { return rex::solveIk(1); }\nint other() asm(\"main\");\nint f() { return other(); }\n",
      // a function under the name of a lambda of main()
      "__attribute__((noinline)) static int helper(int) asm(\"_ZZ4mainENKUliE_clEi\");\n"
      "static int helper(int a) { return rex::solveIk(a); }\nint f() { return helper(1); }\nint main() {}\n",
      // a lambda of main() whose type escapes
      "template <class T> struct Get { friend auto get(Get); };\n"
      "template <class T, class V> struct Set { friend auto get(Get<T>) { return V{}; } };\n"
      "int main() { auto l = [](int a) __attribute__((noinline)) { return rex::solveIk(a); };\n"
      "Set<int, decltype(l)> set; }\nint f() { return get(Get<int>{})(1); }\n",
      // other ways to say its name
      "static int weak(int) __attribute__((weakref(\"_ZN3rex7solveIkEi\")));\nint f() { return weak(1); }\n",
      "extern \"C\" int (*chosen())(int) { return &rex::solveIk; }\n"
      "int f(int) __attribute__((ifunc(\"chosen\")));\n",
      "int f() { int r; asm(\"call _ZN3rex7solveIkEi\" : \"=a\"(r)); return r; }\n",
      "asm(\".set mine, _ZN3rex7solveIkEi\");\nextern \"C\" int mine(int);\nint f() { return mine(1); }\n",
      "asm(\".section .text.main\\nmine: jmp _ZN3rex7solveIkEi\\n.text\");\nextern \"C\" int mine(int);\n"
      "int f() { return mine(1); }\nint main() {}\n"};
  for (const char* attack : attacks) EXPECT_EQ(scan(declared + attack).size(), 1u) << attack;
}

// Nothing is exempt that stays in the worker, wherever its address stands.
TEST_F(ScanSymbolsTest, LooksIntoEverySectionThatStays) {
  const std::string declared = "namespace rex { int solveIk(int); }\n";
  for (const char* section :
       {".rodata.table", ".eh_frame.mine", ".gcc_except_table.mine", ".debug_mine", ".data.rel.ro", "mine"})
    EXPECT_EQ(scan(declared + "asm(\".section " + section +
                   ",\\\"aw\\\"\\ntable: .quad _ZN3rex7solveIkEi\\n.text\");\n"
                   "extern \"C\" int (*table)(int);\nint f() { return table(1); }\n")
                  .size(),
              1u)
        << section;
  const char* attacks[] = {
      // main() by a pointer in a section that looks like a table of the compiler's
      "int main() { return rex::solveIk(1); }\n"
      "__attribute__((section(\".rodata.main\"))) int (*const pointer)() = &main;\nint f() { return "
      "pointer(); }\n",
      "int main() { return rex::solveIk(1); }\n"
      "asm(\".section .gcc_except_table.main,\\\"a\\\"\\npointer: .quad main\\n.text\");\n"
      "extern \"C\" int (*pointer)();\nint f() { return pointer(); }\n",
      // a lambda kept in a variable of main() that its type leads to, and one in a variable of the file
      "inline int (*kept)(int) = nullptr;\n"
      "int main() { kept = [](int a) { return rex::solveIk(a); }; }\nint f() { main(); return kept(1); }\n",
      "auto lambda = [](int a) __attribute__((noinline)) { return rex::solveIk(a); };\n"
      "int f() { return lambda(1); }\nint main() {}\n",
      // what runs before main() or after
      "int early = rex::solveIk(1);\nint f() { return early; }\nint main() {}\n",
      "static int got;\n__attribute__((constructor)) static void run() { got = rex::solveIk(1); }\n"
      "int f() { return got; }\nint main() {}\n",
      "__attribute__((destructor)) static void run() { rex::solveIk(1); }\nint f() { return 1; }\nint main() "
      "{}\n",
      "static int got;\nstatic void run() { got = rex::solveIk(1); }\n"
      "__attribute__((section(\".init_array\"), used)) static void (*entry)() = &run;\n"
      "int f() { return got; }\nint main() {}\n",
      "static int got;\nstatic void run() { got = rex::solveIk(1); }\n"
      "__attribute__((section(\".preinit_array\"), used)) static void (*entry)() = &run;\n"
      "int f() { return got; }\nint main() {}\n",
      // of one version
      "asm(\".symver wanted,_ZN3rex7solveIkEi@REX_1\");\nextern \"C\" int wanted(int);\n"
      "int f() { return wanted(1); }\nint main() {}\n"};
  for (const char* attack : attacks) EXPECT_EQ(scan(declared + attack).size(), 1u) << attack;
}

// What main() alone leads to is not in the worker: nobody finds it there, by whatever arithmetic.
TEST_F(ScanSymbolsTest, LeavesNothingOfMainInTheWorker) {
  const std::string declared = "namespace rex { int solveIk(int); }\nint f() { return 1; }\n";
  for (const char* escapeForTerminal :
       {"static int compare(int a) { return rex::solveIk(a); }\nint main() { return compare(1); }\n",
        "int main() { static int (*volatile p)(int) = &rex::solveIk; return p(1); }\n",
        "inline int compare(int a) { return rex::solveIk(a); }\nint main() { return compare(1); }\n"}) {
    EXPECT_TRUE(scan(declared + escapeForTerminal).empty()) << escapeForTerminal;
    EXPECT_EQ(left(), "_Z1fv ") << escapeForTerminal;
  }
}

// Names with line breaks once forged lines of a listing.
TEST_F(ScanSymbolsTest, RefusesNamesThatNoCompilerGives) {
  EXPECT_TRUE(scan("int gr\xc3\xb6\xc3\x9f"
                   "e() { return 1; }\nint f() { return 1; }\n")
                  .empty());
  const std::string object = temporary_.path() / "a.o", wanted = "', wanted letters, digits and underscores";
  const auto renamed = [&](const std::string& option) {
    const std::string copy = temporary_.path() / "copy.o";
    const ProcessResult run = runProcess({"objcopy", option, object, copy});
    EXPECT_TRUE(run.ok()) << run.error;
    const auto messages = strangeParts(readObjectFile(readTextFile(copy), "copy.o"), "main.cpp");
    return messages.empty() ? "" : toString(messages[0]);
  };
  for (const char* name : {"a\n0000000000000000 g     F .text.main\t0000000000000001 main", "a b", "\x1b[2J",
                           "two\rlines", "a,b", "a'b", "a\"b", "\xff\xfe", "a\\b"})
    EXPECT_THAT(renamed(std::string("--redefine-sym=_Z1fv=") + name),
                ::testing::AllOf(::testing::StartsWith("main.cpp: error: names something '"),
                                 ::testing::HasSubstr(wanted)))
        << name;
  EXPECT_THAT(renamed("--rename-section=.text._Z1fv=a b"), ::testing::HasSubstr("names a section 'a b'"));
  EXPECT_EQ(renamed("--redefine-sym=_Z1fv=_Z1gv"), "");
}

TEST_F(ScanSymbolsTest, RefusesLargeVariablesOfEachThread) {
  EXPECT_TRUE(scan("thread_local char some[64 << 20];\nchar f() { return some[5]; }\n").empty());
  const auto messages = scan("thread_local char big[(64 << 20) + 1];\nchar f() { return big[5]; }\n");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(
      toString(messages[0]),
      "main.cpp: error: keeps more than 64 MiB for each thread in section '.tbss.big' [forbidden-call]");
}

// The linker would compile the first, and take the others for its own tables.
TEST_F(ScanSymbolsTest, RefusesSectionsOfTheLinker) {
  for (const char* section : {".gnu.lto_.symtab", ".dynsym", ".dynamic", ".rela.dyn", ".got.plt", ".gnu.hash",
                              ".interp", ".gnu.version_r"}) {
    const auto messages = scan(std::string("asm(\".section ") + section +
                               ",\\\"a\\\",@progbits\\n.quad 0\\n.text\");\nint f() { return 1; }\n");
    ASSERT_EQ(messages.size(), 1u) << section;
    EXPECT_EQ(toString(messages[0]), std::string("main.cpp: error: makes a section '") + section +
                                         "', which only the linker may make [forbidden-call]");
  }
  EXPECT_EQ(scan("asm(\".section mine,\\\"a\\\",@0x6\\n.quad 0\\n.text\");\nint f() { return 1; }\n").size(),
            1u);
}

// More than was once listed: the call behind it all is found.
TEST_F(ScanSymbolsTest, ReadsLargeFilesToTheirEnd) {
  std::string source =
      "namespace rex { int solveIk(int); }\nasm(\".data\\n.rept 300000\\n.quad outside\\n.endr\\n"
      ".text\");\nint f() { return rex::solveIk(1); }\n";
  EXPECT_EQ(scan(source).size(), 1u);
}

TEST_F(ScanSymbolsTest, RefusesToFindFunctionsByName) {
  const auto messages = scan(
      "#include <dlfcn.h>\nint f() {\n  return reinterpret_cast<int (*)(int)>(dlsym(nullptr, "
      "\"_ZN3rex7solveIkEi\"))(1);\n}\n");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(toString(messages[0]),
            "main.cpp:3:41: error: calls dlsym, which nobody may call in this exercise: it looks up "
            "functions at run time [forbidden-call]");
}

TEST_F(ScanSymbolsTest, AllowsWritingAFunctionOfThatNameOrOnlyDeclaringIt) {
  EXPECT_TRUE(scan("namespace rex { int solveIk(int); }\nint solveIk(int a) { return a; }\nint f() { return "
                   "::solveIk(1); }\n")
                  .empty());
}

TEST_F(ScanSymbolsTest, RefusesTablesOfTheLoader) {
  for (const char* name : {"_r_debug", "_DYNAMIC", "_rtld_global", "getauxval", "dl_iterate_phdr", "dlopen"})
    EXPECT_THAT(
        scan(std::string("extern \"C\" char ") + name + "[];\nchar f() { return " + name + "[1]; }\n"),
        ::testing::ElementsAre(
            ::testing::Field(&grading::CompileDiagnostic::message,
                             ::testing::StartsWith(std::string("calls ") + name + ", which nobody"))));
  EXPECT_TRUE(scan("namespace mine { int dlsym(int); }\nint f() { return mine::dlsym(1); }\n").empty());
}

TEST_F(ScanSymbolsTest, SaysWhenItCannotRead) {
  const std::filesystem::path file = temporary_.path() / "none.o";
  writeTextFile(file, "nothing");
  EXPECT_REX_ERROR(scanSymbols(file, "", "main.cpp", kForbidden), "cannot read the compiled file");
}

}  // namespace rex::submission::symbol_scan_test
