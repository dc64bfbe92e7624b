#include <algorithm>
#include <chrono>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/base64.h"
#include "base/error.h"
#include "base/printable.h"
#include "classroom/class_feedback.h"

namespace rex::grading {
namespace {

constexpr const char* kLineEnd = "\r\n";

std::string oneLine(const std::string& text) {
  std::string line = printable(text);
  for (char& c : line)
    if (c == '\n' || c == '\t') c = ' ';
  return line;
}

// RFC 2047: every text is encoded, so none can end the header. A word has at most 75 characters, and no
// character of the text is cut.
std::string encodedWords(const std::string& text) {
  constexpr std::size_t kWordBytes = 42;
  const std::string line = oneLine(text);
  std::string words;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t end = std::min(at + kWordBytes, line.size());
    while (end < line.size() && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;
    words += fmt::format("{}=?UTF-8?B?{}?=", words.empty() ? "" : "\r\n ", base64(line.substr(at, end - at)));
    at = end;
  }
  return words;
}

std::string encodedBody(const std::string& text) {
  constexpr std::size_t kColumns = 76;
  const std::string code = base64(text);
  std::string body;
  for (std::size_t at = 0; at < code.size(); at += kColumns) body += code.substr(at, kColumns) + kLineEnd;
  return body;
}

std::string dateText(std::int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  return fmt::format("{:%a, %d %b %Y %H:%M:%S} +0000", fmt::gmtime(time));
}

void requireAddress(const std::string& address, const std::string& whose) {
  if (const std::string why = whyNoAddress(address); !why.empty())
    throw Error({.what = fmt::format("the e-mail address of {}", whose),
                 .found = why,
                 .wanted = "an address such as zoe@uni.example"});
}

}  // namespace

std::string whyNoAddress(const std::string& address) {
  constexpr std::string_view kSigns = "!#$%&'*+-/=?^_`{|}~.@";
  if (address.empty()) return "none";
  const bool isPlain = std::all_of(address.begin(), address.end(), [&](char c) {
    const bool isLetter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return isLetter || kSigns.find(c) != std::string_view::npos;
  });
  if (!isPlain)
    return fmt::format("'{}', which has other characters than letters, digits and signs", oneLine(address));
  const std::size_t at = address.find('@');
  if (at == std::string::npos || at == 0 || at + 1 >= address.size() ||
      address.find('@', at + 1) != std::string::npos)
    return fmt::format("'{}', which is not NAME@HOST", address);
  return address.size() > 250 ? "more than 250 characters" : "";
}

std::string gradeMail(const Gradebook& book, const CourseStudent& student,
                      const std::filesystem::path& results, const std::string& course,
                      const std::string& from, std::int64_t date) {
  requireAddress(student.email, "'" + student.id + "'");
  requireAddress(from, "the sender");
  std::string body = shownName(student) + ",\n\nthese are your grades.\n";
  for (const GradeRow& row : book.rows) {
    if (row.student.id != student.id) continue;
    if (const auto feedback = feedbackOf(row, results)) {
      body += "\n" + feedbackText(*feedback);
    } else {
      body += fmt::format("\n{}: {}\n", row.exercise, toString(row.status));
      if (const auto judgement = judgementOf(row))
        for (const std::string& sentence : sentencesOf(*judgement)) body += "  " + sentence + "\n";
    }
  }
  for (const StudentTotal& sum : book.totals)
    if (sum.student.id == student.id && sum.total)
      body += fmt::format("\nTotal: {} of {} points.\n", hundredthsText(*sum.total),
                          hundredthsText(sum.possible));
  const std::string subject = course.empty() ? "Your grades" : fmt::format("Your grades: {}", course);
  return fmt::format(
      "Date: {}\r\nFrom: <{}>\r\nTo: {}\r\n <{}>\r\nSubject: {}\r\nX-Unsent: 1\r\nMIME-Version: 1.0\r\n"
      "Content-Type: text/plain; charset=utf-8\r\nContent-Transfer-Encoding: base64\r\n\r\n{}",
      dateText(date), from, encodedWords(shownName(student)), student.email, encodedWords(subject),
      encodedBody(printable(body)));
}

}  // namespace rex::grading
