#include "classroom/import_names.h"

#include <algorithm>

#include <fmt/format.h>

#include "classroom/composed_text.h"
#include "classroom/hand_in.h"

namespace rex::grading {
namespace {

bool isSame(const std::string& a, const std::string& b) { return !a.empty() && caseless(a) == caseless(b); }

bool contradicts(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && caseless(a) != caseless(b);
}

bool hasOnlyName(const Person& person) {
  return person.id.empty() && person.email.empty() && person.githubUsername.empty();
}

void complete(std::string& known, const std::string& told) {
  if (!told.empty()) known = composed(told);
}

}  // namespace

ImportNames::ImportNames(ImportTable& table, const Arrivals& arrivals)
    : table_(table), platform_(toString(arrivals.platform)) {
  for (const Arrival& arrival : arrivals.all)
    for (const Person& person : arrival.people) ++nameCounts_[caseless(person.name)];
}

// A name counts only if nobody else has it here or there, and nothing else contradicts.
ImportedStudent* ImportNames::known(const Person& person, const std::vector<std::string>& exercises) {
  const auto find = [&](const auto& fits) -> ImportedStudent* {
    const auto found = std::find_if(table_.students.begin(), table_.students.end(), fits);
    return found == table_.students.end() ? nullptr : &*found;
  };
  if (auto* one = find([&](const ImportedStudent& entry) { return isSame(entry.email, person.email); }))
    return one;
  if (auto* one = find([&](const ImportedStudent& entry) { return isSame(entry.id, person.id); })) return one;
  if (auto* one = find(
          [&](const ImportedStudent& entry) { return isSame(entry.githubUsername, person.githubUsername); }))
    return one;
  if (auto* one = find([&](const ImportedStudent& entry) {
        return std::any_of(exercises.begin(), exercises.end(), [&](const std::string& exercise) {
          const auto told = entry.exercises.find(exercise);
          return told != entry.exercises.end() && told->second.platform == platform_ &&
                 isSame(told->second.identifier, person.identifier);
        });
      }))
    return one;
  const auto hasName = [&](const ImportedStudent& entry) { return isSame(entry.name, person.name); };
  const auto count = std::count_if(table_.students.begin(), table_.students.end(), hasName);
  if (count != 1 || nameCounts_[caseless(person.name)] != 1) return nullptr;
  ImportedStudent* one = find(hasName);
  const bool isOther = contradicts(one->email, person.email) || contradicts(one->id, person.id) ||
                       contradicts(one->githubUsername, person.githubUsername);
  return isOther ? nullptr : one;
}

std::string ImportNames::newName(const Person& person) const {
  const std::string name = composed(person.name),
                    number = person.number.empty() ? person.identifier : person.number;
  const auto count = nameCounts_.find(caseless(name));
  const bool isShared = count != nameCounts_.end() && count->second > 1;
  std::vector<std::string> candidates = {composed(person.id), caseless(person.email),
                                         caseless(person.githubUsername)};
  if (!isShared) candidates.push_back(name);
  if (!name.empty() && !number.empty()) candidates.push_back(name + "-" + number);
  if (!number.empty()) candidates.push_back("participant-" + number);
  for (int k = 1; k <= static_cast<int>(table_.students.size()) + 1; ++k)
    candidates.push_back(fmt::format("student-{}", k));
  const auto isFree = [&](const std::string& candidate) {
    return std::none_of(table_.students.begin(), table_.students.end(), [&](const ImportedStudent& entry) {
      return caseless(entry.student) == caseless(candidate);
    });
  };
  for (const std::string& candidate : candidates)
    if (whyNoStudentName(candidate).empty() && isFree(candidate)) return candidate;
  return candidates.back();
}

std::string ImportNames::folderOf(const Person& person, const std::vector<std::string>& exercises) {
  ImportedStudent* entry = known(person, exercises);
  if (entry == nullptr) entry = &table_.students.emplace_back(ImportedStudent{.student = newName(person)});
  complete(entry->id, person.id);
  complete(entry->name, person.name);
  complete(entry->email, person.email);
  complete(entry->githubUsername, person.githubUsername);
  if (hasOnlyName(person) && !person.name.empty()) ++byNameAlone_;
  return entry->student;
}

}  // namespace rex::grading
