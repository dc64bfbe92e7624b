#pragma once

#include <string>

#include "classroom/csv.h"

namespace rex::grading {

/// Headings of Moodle's grading worksheet in English and German; case does not count.
inline const CsvTable::Headings kMoodleIdentifier = {"Identifier", "ID"},
                                kMoodleName = {"Full name", "Vollständiger Name"},
                                kMoodleIdNumber = {"ID number", "ID-Nummer", "Matrikelnummer", "Student ID"},
                                kMoodleEmail = {"Email address", "E-Mail-Adresse", "E-Mail"},
                                kMoodleGrade = {"Grade", "Bewertung"},
                                kMoodleMaximum = {"Maximum Grade", "Bestwertung"};

/// "501" of the identifier "Participant 501"; empty if it has no number at its end.
inline std::string participantNumber(const std::string& identifier) {
  return identifier.substr(identifier.find_last_not_of("0123456789") + 1);
}

}  // namespace rex::grading
