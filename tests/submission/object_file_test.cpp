#include <algorithm>
#include <cstring>
#include <random>
#include <sstream>

#include <elf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/text_file.h"
#include "submission/symbol_scan.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::submission::object_file_test {

using ::testing::HasSubstr;

constexpr const char* kSource =
    "extern \"C\" {\nint asked(int);\nint given(int a) { return asked(a); }\nstatic int own(int a) { return "
    "a; }\n"
    "int (*kept)(int) = &own;\n__attribute__((weak)) int soft() { return 1; }\n}\n"
    "template <class T> T copied(T a) { return a; }\ntemplate int copied<int>(int);\n";

class ObjectFileTest : public ::testing::Test {
 protected:
  std::string compiled(const std::string& source, std::vector<std::string> more = {}) const {
    std::vector<std::string> command = {"g++", "-O1",   "-ffunction-sections", "-x", "c++", "-c", "-",
                                        "-o",  object()};
    command.insert(command.end(), more.begin(), more.end());
    const ProcessResult run = runProcess(command, {.input = source});
    EXPECT_TRUE(run.ok()) << run.error;
    return readTextFile(object());
  }
  std::string object() const { return (temporary_.path() / "a.o").string(); }
  static ObjectSymbol symbol(const ObjectFile& file, const std::string& name) {
    for (const ObjectSymbol& one : file.symbols)
      if (one.name == name) return one;
    ADD_FAILURE() << "no symbol " << name;
    return {};
  }
  TemporaryFolder temporary_;
};

TEST_F(ObjectFileTest, TellsWhatSymbolsAre) {
  const ObjectFile file = readObjectFile(compiled(kSource), "a.o");
  const ObjectSymbol asked = symbol(file, "asked"), given = symbol(file, "given"), own = symbol(file, "own");
  EXPECT_TRUE(asked.isReferred && !asked.isDefined && asked.isGlobal);
  EXPECT_TRUE(!given.isReferred && given.isDefined && given.isGlobal && !given.isShared);
  EXPECT_TRUE(own.isDefined && !own.isGlobal && !own.isWeak);
  const ObjectSymbol soft = symbol(file, "soft"), copied = symbol(file, "_Z6copiedIiET_S0_");
  EXPECT_TRUE(soft.isWeak && !soft.isShared);
  EXPECT_TRUE(copied.isWeak && copied.isShared);
}

// The lines of a tool that says the same in words.
std::vector<std::string> linesOf(const std::vector<std::string>& command) {
  std::istringstream text(runProcess(command, {.outputLimit = 16u << 20}).output);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST_F(ObjectFileTest, AgreesWithReadelf) {
  const std::string source =
      "#include <functional>\n#include <map>\n#include <string>\n"
      "std::map<std::string, std::function<int(int)>> all;\n"
      "int f(const std::string& s) { try { return all.at(s)(3); } catch (...) { return 0; } }\n";
  for (const std::vector<std::string>& flags :
       {std::vector<std::string>{}, {"-g"}, {"-fdata-sections", "-O0"}}) {
    const ObjectFile file = readObjectFile(compiled(source, flags), "a.o");
    std::vector<std::string> expected, found;
    for (const std::string& line : linesOf({"readelf", "-sW", object()})) {
      std::istringstream words(line);
      std::string number, value, size, type, scope, seen, section, name;
      if (words >> number >> value >> size >> type >> scope >> seen >> section >> name && type != "FILE" &&
          type != "SECTION" && type != "Type")
        expected.push_back(name + " " + scope + (section == "UND" ? " UND" : ""));
    }
    for (const ObjectSymbol& one : file.symbols)
      found.push_back(one.name +
                      (one.isGlobal ? " GLOBAL"
                       : one.isWeak ? " WEAK"
                                    : " LOCAL") +
                      (one.isDefined ? "" : " UND"));
    EXPECT_THAT(found, ::testing::ElementsAreArray(expected));
    for (const std::string& line : linesOf({"readelf", "-rW", object()}))
      for (const ObjectSymbol& one : file.symbols)
        if (line.find(" " + one.name + " - ") != line.npos ||
            line.find(" " + one.name + " + ") != line.npos) {
          EXPECT_TRUE(one.isReferred) << line;
        }
  }
}

// More sections than fit into the header of the file.
TEST_F(ObjectFileTest, ReadsManySections) {
  std::string source;
  for (int k = 0; k < 66000; ++k) source += ".section s" + std::to_string(k) + "\n";
  source += ".text\n.globl last\nlast: call beyond\n";
  const ProcessResult run = runProcess({"as", "-", "-o", object()}, {.input = source});
  ASSERT_TRUE(run.ok()) << run.error;
  const ObjectFile file = readObjectFile(readTextFile(object()), "a.o");
  EXPECT_GT(file.sections.size(), 66000u);
  EXPECT_TRUE(symbol(file, "beyond").isReferred);
  EXPECT_TRUE(symbol(file, "last").isDefined);
}

TEST_F(ObjectFileTest, RefusesOtherFiles) {
  for (const std::string& bytes : {std::string(), std::string("text"), std::string(4096, '\0')})
    EXPECT_REX_ERROR(readObjectFile(bytes, "a.o"), "a.o: cannot read the compiled file");
  EXPECT_REX_ERROR(readObjectFile(readTextFile("/proc/self/exe"), "a.o"),
                   "found another kind of file, wanted a relocatable 64-bit ELF file");
}

// Each place of the file spoilt in turn: an answer or an Error, and nothing read outside of it.
TEST_F(ObjectFileTest, TrustsNoNumberInTheFile) {
  const std::string good = compiled(kSource);
  Elf64_Ehdr header;
  std::memcpy(&header, good.data(), sizeof header);
  const auto with = [&](std::size_t section, std::size_t field, std::uint64_t value, std::size_t size) {
    std::string bad = good;
    std::memcpy(bad.data() + header.e_shoff + section * sizeof(Elf64_Shdr) + field, &value, size);
    return bad;
  };
  std::size_t symbols = 0, relocations = 0;
  for (std::size_t k = 0; k < header.e_shnum; ++k) {
    Elf64_Shdr section;
    std::memcpy(&section, good.data() + header.e_shoff + k * sizeof section, sizeof section);
    if (section.sh_type == SHT_SYMTAB) symbols = k;
    if (section.sh_type == SHT_RELA) relocations = k;
  }
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_offset), ~0ull, 8), "a.o"),
                   "bytes from");
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_size), 23, 8), "a.o"),
                   "wanted entries of 24 bytes");
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_size), 24ull << 56, 8), "a.o"),
                   "a table of");
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_link), 0, 4), "a.o"),
                   "found section 0");
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_link), symbols, 4), "a.o"),
                   "names outside a string table");
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_type), SHT_NOTE, 4), "a.o"),
                   "found no symbol table, wanted one");
  EXPECT_REX_ERROR(readObjectFile(with(relocations, offsetof(Elf64_Shdr, sh_type), SHT_SYMTAB, 4), "a.o"),
                   "found a second symbol table, wanted one");
  EXPECT_REX_ERROR(readObjectFile(with(relocations, offsetof(Elf64_Shdr, sh_link), 1, 4), "a.o"),
                   "found relocations of the symbols in section 1");
  EXPECT_REX_ERROR(readObjectFile(with(symbols, offsetof(Elf64_Shdr, sh_size), 24, 8), "a.o"),
                   "found a relocation to symbol");
  EXPECT_REX_ERROR(
      readObjectFile(with(0, offsetof(Elf64_Shdr, sh_size), 0, 8).substr(0, header.e_shoff), "a.o"),
      "wanted positions within its");
}

TEST_F(ObjectFileTest, SurvivesAnyBytes) {
  const std::string good = compiled(kSource);
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string bad = good;
    for (int k = 0; k < 6; ++k) {
      // Mostly in the header of the file or in those of sections, which lie at its end.
      const bool atEnd = random() % 4 != 0;
      const std::size_t at =
          atEnd ? bad.size() - 1 - random() % std::min<std::size_t>(bad.size(), 2400) : random() % bad.size();
      bad[at] = static_cast<char>(random() % 3 == 0 ? 0xFF : random());
    }
    try {
      static_cast<void>(readObjectFile(bad, "a.o"));
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000) << "seed " << kSeed;
}

}  // namespace rex::submission::object_file_test
