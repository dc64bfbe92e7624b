#include "support/synthetic_class.h"

#include <array>
#include <ctime>

#include <fmt/format.h>

namespace rex {
namespace {

constexpr std::int64_t kDeadline = 1'795'215'540;  // 2026-11-20T22:59:00Z, 23:59 in Berlin

// The seventh and the eighth are one name, composed and decomposed.
constexpr std::array<const char*, 12> kNames = {
    "Zoe Miller",     "Adam O'Hara", "Änne Müller-Weiß", "José Peña",
    "Nguyễn Thị Hoa", "Łukasz Żak",  "Jürgen Groß",      "J\u0075\u0308rgen Groß",
    "Li Wei",         "Bo",          "Çağla Öztürk",     "Max, jun."};

std::string berlin(std::int64_t time, const char* format) {
  const std::time_t local = time + 3600;  // no summer time in November
  std::tm parts{};
  ::gmtime_r(&local, &parts);
  std::array<char, 100> text{};
  std::strftime(text.data(), text.size(), format, &parts);
  return text.data();
}

std::string germanDate(std::int64_t time) {
  constexpr std::array<const char*, 7> kDays = {"Sonntag",    "Montag",  "Dienstag", "Mittwoch",
                                                "Donnerstag", "Freitag", "Samstag"};
  const int day = berlin(time, "%w").front() - '0';
  return std::string(kDays[static_cast<std::size_t>(day)]) + berlin(time, ", %e. November %Y, %H:%M");
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

// An archive that nobody should unpack.
std::string hostileZip(int k) {
  if (k % 3 == 0) return zipOf({{.name = "../../../tmp/main.cpp", .text = "int main() {}\n"}});
  if (k % 3 == 1) return zipOf({{.name = "main.cpp", .text = "/etc/passwd", .mode = 0120777}});
  return zipOf({{.name = "main.cpp", .text = "int main() {}\n"}}, 4'000'000'000);
}

// What one student uploads, below the folder that the platform makes.
std::vector<SampleMember> uploads(const SyntheticStudent& student, const std::string& exercise) {
  if (student.work == SyntheticWork::kAttack)
    return {{.name = "work.zip", .text = hostileZip(student.number)}};
  switch (student.number % 4) {
    case 0:
      return {{.name = "main.cpp", .text = student.text}};
    case 1:
      return {{.name = exercise + ".zip",
               .text = zipOf(
                   {{.name = exercise + "/main.cpp", .text = student.text}, {.name = "receipt.json"}})}};
    case 2:
      return {{.name = "main (1).cpp", .text = student.text}, {.name = "notes.pdf", .text = "%PDF"}};
    default:
      return {{.name = "course.zip",
               .text = zipOf({{.name = "course/exercises/" + exercise + "/main.cpp", .text = student.text},
                              {.name = "__MACOSX/course/._main.cpp"}})}};
  }
}

}  // namespace

std::string syntheticInstant(std::int64_t time) { return berlin(time - 3600, "%Y-%m-%dT%H:%M:%SZ"); }

std::vector<SyntheticStudent> syntheticClass(int count, const SyntheticTexts& texts) {
  std::vector<SyntheticStudent> all;
  for (int k = 0; k < count; ++k) {
    const int place = k % 12;
    SyntheticStudent student{.name = kNames[static_cast<std::size_t>(place)],
                             .id = fmt::format("31{:05}", k),
                             .email = fmt::format("student{}@uni.example", k),
                             .user = fmt::format("octo-{}", k),
                             .number = 500 + k,
                             .work = SyntheticWork::kHonest,
                             .time = kDeadline - 60 * (1 + 37 * k)};
    if (k >= 12 && place != 6 && place != 7) student.name += fmt::format(" {}", k / 12 + 1);
    if (place == 1 || place == 9) student.work = SyntheticWork::kWrong;
    if (place == 2) student.work = SyntheticWork::kBroken;
    if (place == 3) student.work = SyntheticWork::kAttack;
    if (place == 8) student.work = SyntheticWork::kMissing;
    if (place == 5) student.time = kDeadline + 60 * (30 + k);
    const bool isWrong = student.work == SyntheticWork::kWrong,
               isBroken = student.work == SyntheticWork::kBroken;
    student.text = (isWrong    ? texts.wrong
                    : isBroken ? texts.broken
                               : texts.honest) +
                   fmt::format("// {}\n", k);
    if ((place == 10 && k + 1 < count) || place == 11) {
      student.partner = place == 10 ? k + 1 : k - 1;
      student.isSecond = place == 11;
      if (student.isSecond) student.text = all.back().text, student.time = all.back().time;
    }
    all.push_back(std::move(student));
  }
  return all;
}

std::vector<SampleMember> moodleMembers(const std::vector<SyntheticStudent>& all, const std::string& exercise,
                                        bool isFlat) {
  std::vector<SampleMember> members;
  for (const SyntheticStudent& student : all) {
    if (student.work == SyntheticWork::kMissing) continue;
    const SyntheticStudent& uploader =
        student.isSecond ? all[static_cast<std::size_t>(student.partner)] : student;
    const std::string group =
        student.partner < 0 ? ""
                            : fmt::format("Pair {}-", std::min(student.partner, student.number - 500) / 12);
    const std::string folder =
        fmt::format("{}{}_{}_assignsubmission_file_", group, student.name, student.number);
    for (SampleMember member : uploads(uploader, exercise)) {
      member.name = folder + (isFlat ? "" : "/") + member.name;
      members.push_back(std::move(member));
    }
    if (student.number % 5 == 0 && !isFlat)
      members.push_back({.name = fmt::format("{}{}_{}_assignsubmission_onlinetext_/onlinetext.html", group,
                                             student.name, student.number),
                         .text = "<p>see the file</p>"});
  }
  return members;
}

std::string moodleWorksheet(const std::vector<SyntheticStudent>& all, bool isGerman) {
  std::string text =
      isGerman
          ? "\xEF\xBB\xBFID,\"Vollständiger Name\",E-Mail-Adresse,Status,Bewertung,Bestwertung,\"Bewertung "
            "kann "
            "geändert werden\",\"Zuletzt geändert (Abgabe)\",\"Zuletzt geändert (Bewertung)\",\"Feedback als "
            "Kommentar\"\n"
          : "Identifier,\"Full name\",\"Email address\",Status,Grade,\"Maximum Grade\",\"Grade can be "
            "changed\",\"Last modified (submission)\",\"Last modified (grade)\",\"Feedback comments\"\n";
  for (const SyntheticStudent& student : all) {
    const bool isMissing = student.work == SyntheticWork::kMissing;
    const std::string time = isMissing  ? "-"
                             : isGerman ? germanDate(student.time)
                                        : berlin(student.time, "%A, %d %B %Y, %I:%M %p");
    text += fmt::format("{}{},{},{},{},,\"100,00\",{},{},-,\n", isGerman ? "Teilnehmer/in" : "Participant ",
                        student.number, quoted(student.name), student.email,
                        isMissing ? "\"No submission\"" : "\"Submitted for grading\"",
                        isGerman ? "Ja" : "Yes", quoted(time));
  }
  return text;
}

std::vector<SampleMember> gradescopeMembers(const std::vector<SyntheticStudent>& all,
                                            const std::string& exercise) {
  const std::string root = "assignment_7_export/";
  std::vector<SampleMember> members;
  std::string metadata = "---\n";
  const auto submitter = [](const SyntheticStudent& student) {
    return fmt::format("  - :name: {}\n    :sid: '{}'\n    :email: {}\n", quoted(student.name), student.id,
                       student.email);
  };
  for (const SyntheticStudent& student : all) {
    if (student.work == SyntheticWork::kMissing || student.isSecond) continue;
    const std::string folder = fmt::format("submission_{}", student.number);
    metadata += folder + ":\n  :submitters:\n" + submitter(student);
    if (student.partner >= 0) metadata += submitter(all[static_cast<std::size_t>(student.partner)]);
    metadata += fmt::format("  :created_at: {} -08:00\n  :score: 0.0\n  :status: processed\n",
                            berlin(student.time - 9 * 3600, "%Y-%m-%d %H:%M:%S.250000000"));
    for (SampleMember member : uploads(student, exercise)) {
      member.name = root + folder + "/" + member.name;
      members.push_back(std::move(member));
    }
  }
  members.push_back({.name = root + "submission_metadata.yml", .text = metadata});
  return members;
}

std::vector<SampleMember> folderMembers(const std::vector<SyntheticStudent>& all) {
  std::vector<SampleMember> members;
  for (const SyntheticStudent& student : all) {
    if (student.work == SyntheticWork::kMissing || student.isSecond) continue;
    const std::string name = student.email.substr(0, student.email.find('@'));
    if (student.work == SyntheticWork::kAttack)
      members.push_back({.name = name + ".zip", .text = hostileZip(student.number)});
    else if (student.number % 3 == 0)
      members.push_back({.name = name + "/main.cpp", .text = student.text});
    else if (student.number % 3 == 1)
      members.push_back({.name = name + ".cpp", .text = student.text});
    else
      members.push_back({.name = name + ".zip", .text = zipOf({{.name = "main.cpp", .text = student.text}})});
  }
  return members;
}

std::string rosterOfClones(const std::vector<SyntheticStudent>& all) {
  std::string text = "\"identifier\",\"github_username\",\"github_id\",\"name\"\n";
  for (const SyntheticStudent& student : all)
    text += fmt::format("\"{}\",\"{}\",\"{}\",\"{}\"\n", student.email, student.user, student.number,
                        student.name);
  return text;
}

std::string recordOfClones(const std::vector<SyntheticStudent>& all,
                           const std::vector<std::string>& commits) {
  std::string text =
      "assignment_name,github_username,roster_identifier,student_repository_name,submission_timestamp,"
      "points_awarded,points_available,group_name,commit\n";
  for (std::size_t k = 0; k < all.size(); ++k) {
    const SyntheticStudent& student = all[k];
    if (student.work == SyntheticWork::kMissing) continue;
    const SyntheticStudent& owner =
        student.isSecond ? all[static_cast<std::size_t>(student.partner)] : student;
    text +=
        fmt::format("Kinematics,{},{},kinematics-{},{},,20,{},{}\n", student.user, student.email, owner.user,
                    syntheticInstant(student.time), student.partner < 0 ? "" : "pair-" + owner.user,
                    k < commits.size() ? commits[k] : "");
  }
  return text;
}

}  // namespace rex
