#include "classroom/archive.h"

#include <ctime>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "base/process.h"
#include "base/rng.h"
#include "base/text_file.h"
#include "submission/zip_file.h"
#include "support/archive_samples.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::archive_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ArchiveTest : public ::testing::Test {
 protected:
  std::vector<ArchiveFile> read(const std::string& name, const std::string& bytes,
                                const ArchiveLimits& limits = {}) const {
    writeTextFile(folder_.path() / name, bytes);
    return readArchive(folder_.path() / name, limits).files;
  }
  // Both kinds must refuse the members, with that reason.
  void expectRefusal(const std::vector<SampleMember>& members, const std::string& text,
                     const ArchiveLimits& limits = {}) const {
    EXPECT_REX_ERROR(read("a.zip", zipOf(members), limits), text);
    EXPECT_REX_ERROR(read("a.tar", tarOf(members), limits), text);
  }
  TemporaryFolder folder_;
};

std::map<std::string, std::string> asMap(const std::vector<ArchiveFile>& files) {
  std::map<std::string, std::string> map;
  for (const ArchiveFile& file : files) map[file.name] = file.text;
  return map;
}

TEST(ArchiveName, TellsByItsEnding) {
  for (const char* name : {"a.zip", "a.ZIP", "a.tar", "a.tar.gz", "a.tgz"}) {
    EXPECT_TRUE(isArchiveName(name)) << name;
    EXPECT_EQ(withoutArchiveEnding(name), "a");
  }
  for (const char* name : {"a", "a.gz", "zip", "a.zip.txt", "a.rar"})
    EXPECT_FALSE(isArchiveName(name)) << name;
}

TEST_F(ArchiveTest, ReadsWhatSubmitWrites) {
  submission::writeZip(folder_.path() / "a.zip", {{"01/main.cpp", "int a;\n"}, {"receipt.json", ""}});
  EXPECT_EQ(asMap(readArchive(folder_.path() / "a.zip").files),
            (std::map<std::string, std::string>{{"01/main.cpp", "int a;\n"}, {"receipt.json", ""}}));
}

// Names in UTF-8 are marked so, and neither the time nor the zone changes a byte.
TEST_F(ArchiveTest, WritesWhatOthersRead) {
  const std::filesystem::path zip = folder_.path() / "a.zip";
  std::string first;
  for (const char* zone : {"UTC", "Asia/Tokyo", "America/New_York"}) {
    ::setenv("TZ", zone, 1);
    ::tzset();
    submission::writeZip(zip, {{"Zoë/a.txt", "one"}, {"b", ""}});
    if (first.empty()) first = readTextFile(zip);
    EXPECT_EQ(readTextFile(zip), first) << zone;
  }
  ::unsetenv("TZ");
  const ProcessResult python = runProcess(
      {"python3", "-c",
       "import sys, zipfile\n"
       "packed = zipfile.ZipFile(sys.argv[1])\n"
       "assert packed.testzip() is None\n"
       "for file in packed.infolist():\n"
       "    print(ascii(file.filename), packed.read(file), file.date_time, oct(file.external_attr >> 16))",
       zip.string()});
  if (!python.started) GTEST_SKIP() << "python3 is not installed";
  EXPECT_EQ(python.output,
            "'Zo\\xeb/a.txt' b'one' (1980, 1, 1, 0, 0, 0) 0o100644\n"
            "'b' b'' (1980, 1, 1, 0, 0, 0) 0o100644\n");
}

// tar itself packs them; bytes of all kinds must come back.
TEST_F(ArchiveTest, ReadsWhatOthersPack) {
  Rng rng(5);
  std::map<std::string, std::string> files;
  for (const char* name : {"01/main.cpp", "02/main.cpp", "empty"}) {
    std::string text;
    for (int k = *name == 'e' ? 0 : 5000; k > 0; --k) text += static_cast<char>(rng.index(256));
    writeTextFile(folder_.path() / "in" / name, text);
    files[name] = text;
  }
  const std::string in = (folder_.path() / "in").string();
  for (const auto& [archive, option] : {std::pair("a.tar", "-cf"), std::pair("a.tgz", "-czf")}) {
    const std::string file = (folder_.path() / archive).string();
    ASSERT_TRUE(runProcess({"tar", option, file, "-C", in, "01", "02", "empty"}).ok());
    EXPECT_EQ(asMap(readArchive(file).files), files) << archive;
  }
  std::vector<SampleMember> members;
  for (const auto& [name, text] : files) members.push_back({.name = name, .text = text});
  EXPECT_EQ(asMap(read("b.zip", zipOf(members))), files);
  EXPECT_EQ(asMap(read("b.tar", tarOf(members))), files);
}

TEST_F(ArchiveTest, RefusesNamesThatLeaveTheFolder) {
  const std::string wanted = ", wanted a name inside a folder";
  for (const char* name : {"../main.cpp", "a/../../main.cpp", ".."})
    expectRefusal({{.name = "ok"}, {.name = name}},
                  fmt::format("member '{}': found a path out of its folder", name) + wanted);
  for (const char* name : {"/etc/passwd", "//main.cpp"})
    expectRefusal({{.name = name}},
                  fmt::format("member '{}': found an absolute name or a backslash", name) + wanted);
  EXPECT_REX_ERROR(read("a.tar", tarOf({{.name = "..\\main.cpp"}})), "an absolute name or a backslash");
}

// What is beside them is taken all the same.
TEST_F(ArchiveTest, LeavesOutLinksPipesAndDevices) {
  const SampleMember good{.name = "01/main.cpp", .text = "int a;"};
  const auto expectLeftOut = [&](const std::string& name, const std::string& bytes, const std::string& why) {
    writeTextFile(folder_.path() / name, bytes);
    const ArchiveContent content = readArchive(folder_.path() / name);
    EXPECT_EQ(asMap(content.files), (std::map<std::string, std::string>{{"01/main.cpp", "int a;"}})) << why;
    ASSERT_EQ(content.leftOut.size(), 1u) << why;
    EXPECT_EQ(content.leftOut[0].name, "01/x");
    EXPECT_EQ(content.leftOut[0].why, why);
  };
  for (const auto& [type, why] :
       {std::pair('1', "a hard link"), std::pair('2', "a symbolic link"),
        std::pair('3', "a device or socket"), std::pair('4', "a device or socket"), std::pair('6', "a pipe")})
    expectLeftOut("a.tar", tarOf({good, {.name = "01/x", .type = type, .target = "/etc/passwd"}}), why);
  expectLeftOut("a.zip", zipOf({good, {.name = "01/x", .text = "/etc/passwd", .mode = 0120777}}),
                "a symbolic link");
  // Zip files know no pipes: it is read as a file, and nothing is made on the disk anyway.
  EXPECT_EQ(asMap(read("a.zip", zipOf({{.name = "01/x", .text = "y", .mode = 0010644}}))).at("01/x"), "y");
}

TEST_F(ArchiveTest, GivesNamesAsUtf8) {
  for (const auto& [bytes, name] :
       {std::pair("01/\x81\x94\x84.cpp", "01/\u00FC\u00F6\u00E4.cpp"),  // code page 437
        std::pair("01/\xE1\xFF", "01/\u00DF\u00A0"),
        std::pair("01/\u00FC\u20AC\U0001F916", "01/\u00FC\u20AC\U0001F916")}) {
    EXPECT_EQ(read("a.zip", zipOf({{.name = bytes}})).at(0).name, name);
    EXPECT_EQ(read("a.tar", tarOf({{.name = bytes}})).at(0).name, name);
  }
}

// Python's table is another opinion, and so is its way to write zip files, with the mark of UTF-8.
TEST_F(ArchiveTest, ReadsTheNamesThatPythonWrites) {
  const std::string file = (folder_.path() / "p.zip").string();
  const ProcessResult python =
      runProcess({"python3", "-c",
                  "import sys, zipfile\n"
                  "with zipfile.ZipFile(sys.argv[1], 'w') as z:\n"
                  "    z.writestr('d/', '')\n"
                  "    z.writestr('d/10:30 \\u00fc\\u4e2d.txt', 'x')\n"
                  "sys.stdout.buffer.write(bytes(range(128, 256)).decode('cp437').encode())\n",
                  file});
  if (!python.started) GTEST_SKIP() << "python3 is not installed";
  ASSERT_TRUE(python.ok()) << python.error;
  EXPECT_EQ(readArchive(file).files.at(0).name, "d/10:30 \u00fc\u4e2d.txt");
  std::string upper;
  for (int k = 128; k < 256; ++k) upper += static_cast<char>(k);
  EXPECT_EQ(read("a.zip", zipOf({{.name = upper}}), {.nameBytes = 1000}).at(0).name, python.output);
}

TEST_F(ArchiveTest, RefusesTwoFilesOfOneName) {
  const std::string text = "found a second file of that name (ignoring case), wanted one";
  expectRefusal({{.name = "01/main.cpp"}, {.name = "01/main.cpp"}}, "member '01/main.cpp': " + text);
  expectRefusal({{.name = "01/main.cpp"}, {.name = "01/Main.cpp"}}, "member '01/Main.cpp': " + text);
  expectRefusal({{.name = "01/main.cpp"}, {.name = "./01//main.cpp"}}, text);
}

TEST_F(ArchiveTest, RefusesWhatGoesBeyondTheLimits) {
  std::vector<SampleMember> many;
  for (int k = 0; k <= 200; ++k) many.push_back({.name = fmt::format("{}", k)});
  expectRefusal(many, "not accepted: found more members, wanted at most 200");
  many.pop_back();
  EXPECT_EQ(read("a.zip", zipOf(many)).size(), 200u);
  const SampleMember large{.name = "x", .text = std::string(1000, 'x')};
  const ArchiveLimits few{.bytes = 3000};
  expectRefusal({large, {.name = "y", .text = std::string(2500, 'x')}}, "bytes, wanted at most 3000", few);
  EXPECT_REX_ERROR(read("a.zip", zipOf({{.name = std::string(300, 'n')}})),
                   "found a name of 300 bytes, wanted names of at most 255 bytes in a path of at most 4096");
  const std::string longest(255, 'n');
  std::string path = longest;
  while (path.size() < 4096 - 256) path += "/" + longest;
  EXPECT_EQ(read("a.zip", zipOf({{.name = path}})).at(0).name, path) << "each name has room";
  EXPECT_REX_ERROR(read("a.zip", zipOf({{.name = path + "/" + longest + "/x"}})), "found a path of ");
  submission::writeZip(folder_.path() / "b.zip", {{"zeros", std::string(1u << 20, '\0')}});
  EXPECT_REX_ERROR(
      readArchive(folder_.path() / "b.zip"),
      "member 'zeros': found more than 100 times the bytes of the archive, wanted files that were "
      "written by hand");
}

bool isSource(const std::string& name) { return name.ends_with(".cpp") || name.ends_with(".zip"); }

std::vector<std::string> namesOfBundle(const std::filesystem::path& file) {
  const ArchiveContent content = readBundle(file, isSource);
  std::vector<std::string> names;
  for (const ArchiveFile& one : content.files) names.push_back(one.name);
  for (const auto& [name, why] : content.leftOut) names.push_back(name + ": " + why);
  return names;
}

// One student with too much is left out and named; it costs the others nothing.
TEST_F(ArchiveTest, LeavesOutStudentsWithTooMuchInABundle) {
  std::vector<SampleMember> many = {{.name = "class/Adam/main.cpp"}}, large = many;
  for (int k = 0; k <= 50'000; ++k) many.push_back({.name = fmt::format("class/Zoe/{}", k)});
  many.push_back({.name = "class/Zoe/main.cpp"});
  for (int k = 0; k < 3; ++k)
    large.push_back({.name = fmt::format("class/Zoe_1_assignsubmission_file_/{}.zip", k),
                     .text = std::string(19u << 20, '\0')});
  std::swap(many.front(), many.back());
  writeTextFile(folder_.path() / "many.tar", tarOf(many));
  EXPECT_THAT(namesOfBundle(folder_.path() / "many.tar"),
              ElementsAre("class/Adam/main.cpp", "class/Zoe/main.cpp: more than 5000 files of one student"));
  std::vector<submission::ZipEntry> packed;
  for (const SampleMember& member : large) packed.push_back({member.name, member.text});
  submission::writeZip(folder_.path() / "large.zip", packed);
  EXPECT_THAT(namesOfBundle(folder_.path() / "large.zip"),
              ElementsAre("class/Adam/main.cpp",
                          "class/Zoe_1_assignsubmission_file_/0.zip: more than 40 MiB in "
                          "the files of one student"));
}

// With the mark of encryption in both headers of its first member.
std::string withEncrypted(std::string zip) {
  constexpr std::size_t kInLocal = 6, kInDirectory = 8;
  zip[kInLocal] |= 1;
  zip[zip.find("PK\x01\x02") + kInDirectory] |= 1;
  return zip;
}

TEST_F(ArchiveTest, TakesNothingEncrypted) {
  const std::string zip = withEncrypted(
      zipOf({{.name = "zoe/main.cpp", .text = "int a;\n"}, {.name = "adam/main.cpp", .text = "int b;\n"}}));
  EXPECT_REX_ERROR(read("a.zip", zip),
                   "member 'zoe/main.cpp': found an encrypted file, wanted one without a password");
  writeTextFile(folder_.path() / "all.zip", zip);
  EXPECT_THAT(namesOfBundle(folder_.path() / "all.zip"),
              ElementsAre("adam/main.cpp", "zoe/main.cpp: an encrypted file"));
}

TEST_F(ArchiveTest, ReadsFiftyThousandFilesOfABundleAndNoMore) {
  std::vector<SampleMember> many;
  for (int k = 0; k < 50'000; ++k) many.push_back({.name = fmt::format("class/{}/main.cpp", k)});
  writeTextFile(folder_.path() / "many.tar", tarOf(many));
  EXPECT_EQ(namesOfBundle(folder_.path() / "many.tar").size(), 50'000u);
  many.push_back({.name = "class/one more/main.cpp"});
  many.push_back({.name = "class/and one/main.cpp"});
  writeTextFile(folder_.path() / "many.tar", tarOf(many));
  EXPECT_REX_ERROR((void)readBundle(folder_.path() / "many.tar", isSource),
                   "found more members, wanted at most 50000");
}

TEST_F(ArchiveTest, RefusesSizesThatAreNotTrue) {
  const std::vector<SampleMember> members = {{.name = "01/main.cpp", .text = "int a;\n"}};
  EXPECT_EQ(asMap(read("a.zip", zipOf(members, 0))).at("01/main.cpp"), "") << "no byte beyond the claim";
  for (const std::int64_t claimed : {3, 1 << 30}) {
    SCOPED_TRACE(claimed);
    EXPECT_REX_ERROR(read("a.zip", zipOf(members, claimed)), "not accepted");
  }
}

TEST_F(ArchiveTest, RefusesWhatIsBrokenOrNone) {
  EXPECT_REX_ERROR(read("a.zip", "no archive"), "wanted an intact .zip, .tar or .tar.gz file");
  EXPECT_REX_ERROR(read("a.zip", ""), "a.zip: this archive is not accepted");
  const std::string tar = tarOf({{.name = "01/main.cpp", .text = std::string(5000, 'x')}});
  EXPECT_REX_ERROR(read("a.tar", tar.substr(0, 3000)), "wanted an intact");
}

// Whatever bytes a file has, reading ends, and with a list or an Error.
TEST_F(ArchiveTest, SurvivesChangedBytes) {
  const std::uint64_t seed = 9;
  Rng rng(seed);
  const std::vector<SampleMember> members = {{.name = "01/main.cpp", .text = "int a;\n"}, {.name = "b"}};
  int taken = 0;
  for (int k = 0; k < 200; ++k) {
    std::string bytes = k % 2 == 0 ? zipOf(members) : tarOf(members);
    for (int changes = 1 + rng.index(4); changes > 0; --changes)
      bytes[static_cast<std::size_t>(rng.index(static_cast<int>(bytes.size())))] =
          static_cast<char>(rng.index(256));
    try {
      taken += static_cast<int>(read("a.zip", bytes).size());
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("a.zip: this archive is not accepted")) << "seed " << seed;
    }
  }
  EXPECT_LT(taken, 400);
}

}  // namespace rex::classroom::archive_test
