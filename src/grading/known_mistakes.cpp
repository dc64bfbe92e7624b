#include "grading/known_mistakes.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace rex::grading {
namespace {

using Keys = std::map<std::uint64_t, const Sketch*>;

Keys byKey(const std::vector<SketchedCall>& calls) {
  Keys answers;
  for (const SketchedCall& call : calls) answers.emplace(call.key, &call.answer);
  return answers;
}

const std::vector<SketchedCall>& callsOf(const SketchedChecks& checks, const std::string& check) {
  static const std::vector<SketchedCall> kNoCalls;
  const auto found = checks.find(check);
  return found == checks.end() ? kNoCalls : found->second;
}

/// Chooses the calls of one check that are worth keeping.
class Choice {
 public:
  Choice(const std::vector<SketchedCall>& right, const std::vector<SketchedMistake>& mistakes,
         const std::string& check)
      : right_(right) {
    for (const SketchedMistake& mistake : mistakes) answers_.push_back(byKey(callsOf(mistake.checks, check)));
    std::set<std::string> functions;
    for (const SketchedCall& call : right) functions.insert(call.function);
    for (const std::string& function : functions)
      for (std::size_t k = 0; k < mistakes.size(); ++k) choose(function, k);
  }

  std::vector<KnownCall> calls() const {
    std::vector<KnownCall> all;
    for (const std::size_t i : chosen_) all.push_back({right_[i], wrongAnswers(i)});
    return all;
  }

 private:
  bool isWrong(std::size_t mistake, std::size_t call) const {
    const auto answer = answers_[mistake].find(right_[call].key);
    return answer != answers_[mistake].end() && !agree(*answer->second, right_[call].answer);
  }

  // Some wrong answers of a mistake, from the first to the last, rather those that are chosen already.
  void choose(const std::string& function, std::size_t mistake) {
    constexpr std::size_t kMost = 6;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < right_.size(); ++i)
      if (right_[i].function == function && isWrong(mistake, i)) wrong.push_back(i);
    const auto isChosen = [&](std::size_t i) { return chosen_.contains(i); };
    const auto chosen = static_cast<std::size_t>(std::count_if(wrong.begin(), wrong.end(), isChosen));
    const std::size_t wanted = std::min(kMost, wrong.size());
    if (chosen >= wanted) return;
    std::erase_if(wrong, isChosen);
    const std::size_t more = wanted - chosen;
    for (std::size_t n = 0; n < more; ++n) chosen_.insert(wrong[n * wrong.size() / more]);
  }

  std::vector<WrongAnswer> wrongAnswers(std::size_t call) const {
    std::vector<WrongAnswer> wrong;
    for (std::size_t k = 0; k < answers_.size(); ++k) {
      const auto found = answers_[k].find(right_[call].key);
      std::optional<Sketch> answer;
      if (found != answers_[k].end()) answer = *found->second;
      if (answer && agree(*answer, right_[call].answer)) continue;
      const auto same = std::find_if(wrong.begin(), wrong.end(), [&](const WrongAnswer& one) {
        return one.answer.has_value() == answer.has_value() && (!answer || agree(*one.answer, *answer));
      });
      if (same == wrong.end())
        wrong.push_back({{k}, answer});
      else
        same->mistakes.push_back(k);
    }
    return wrong;
  }

  const std::vector<SketchedCall>& right_;
  std::vector<Keys> answers_{};  // by mistake
  std::set<std::size_t> chosen_{};
};

/// How well a mistake explains what a function answered in a check.
struct Fit {
  bool contradicts = false;
  bool explains = false;      ///< a wrong answer
  bool explainsReal = false;  ///< one with numbers that are not whole
};

Fit fitOf(const std::vector<KnownCall>& known, const Keys& seen, const std::string& function,
          std::size_t mistake) {
  Fit fit;
  for (const KnownCall& call : known) {
    const auto answer = seen.find(call.right.key);
    if (call.right.function != function || answer == seen.end()) continue;
    const auto wrong = std::find_if(call.wrong.begin(), call.wrong.end(), [&](const WrongAnswer& one) {
      return std::find(one.mistakes.begin(), one.mistakes.end(), mistake) != one.mistakes.end();
    });
    if (wrong != call.wrong.end() && !wrong->answer) continue;
    const bool isRight = wrong == call.wrong.end();
    if (!agree(*answer->second, isRight ? call.right.answer : *wrong->answer)) fit.contradicts = true;
    // A throw, and zeros, are what many mistakes give.
    if (isRight || agree(*answer->second, call.right.answer)) continue;
    if (answer->second->threw || answer->second->size == 0) continue;
    fit.explains = true;
    fit.explainsReal = fit.explainsReal || !answer->second->isWhole;
  }
  return fit;
}

/// Compares a program with the known mistakes.
class Recognition {
 public:
  Recognition(const KnownMistakes& known, const SketchedChecks& seen) : known_(known) {
    for (const auto& [check, calls] : seen) seen_[check] = byKey(calls);
  }

  // The question about a function's answers; nothing if no mistake explains them.
  std::optional<std::string> about(const std::string& function, const std::string& check) const {
    std::vector<std::size_t> candidates;
    bool isClear = true;
    for (std::size_t k = 0; k < known_.questions.size(); ++k) {
      const Fit fit = fitIn(check, function, k);
      if (fit.contradicts || !fit.explains) continue;
      candidates.push_back(k);
      isClear = isClear && fit.explainsReal;
    }
    if (candidates.empty()) return {};
    if (candidates.size() > 1 || !isClear)
      std::erase_if(candidates, [&](std::size_t k) { return isContradicted(function, k); });
    std::set<std::string> questions;
    for (const std::size_t k : candidates) questions.insert(known_.questions[k]);
    return questions.size() == 1 ? *questions.begin() : "";
  }

 private:
  Fit fitIn(const std::string& check, const std::string& function, std::size_t mistake) const {
    const auto known = known_.checks.find(check);
    const auto seen = seen_.find(check);
    if (known == known_.checks.end() || seen == seen_.end()) return {};
    return fitOf(known->second, seen->second, function, mistake);
  }

  bool isContradicted(const std::string& function, std::size_t mistake) const {
    return std::any_of(seen_.begin(), seen_.end(),
                       [&](const auto& check) { return fitIn(check.first, function, mistake).contradicts; });
  }

  const KnownMistakes& known_;
  std::map<std::string, Keys> seen_{};
};

// A number as others compute it, too, unless they round in another way.
std::string text(const Sketch& sketch) {
  if (sketch.threw) return "threw";
  std::string line =
      fmt::format("{} {:08x} {:.7g}", sketch.isWhole ? "whole" : "real", sketch.form, sketch.size);
  for (const double sum : sketch.sums) line += fmt::format(" {:.7g}", sum == 0 ? 0 : sum);
  return line;
}

std::string text(const std::vector<std::size_t>& numbers) {
  std::vector<std::string> texts;
  for (const std::size_t number : numbers) texts.push_back(std::to_string(number));
  return join(texts, ",");
}

std::string text(const SketchedCall& call) {
  return fmt::format("call\t{}\t{:016x}\t{}\n", call.function, call.key, text(call.answer));
}

constexpr std::string_view kNotReached = "none";

/// Reads the lines of a file.
class LineReader {
 public:
  LineReader(std::string_view text, std::string file) : file_(std::move(file)) {
    for (const std::string_view line : splitLines(text)) {
      ++number_;
      if (!line.empty() && !line.starts_with('#')) read(splitAt(line, '\t'));
    }
  }

  KnownMistakes known{};

 private:
  [[noreturn]] void fail(std::string_view found, const char* wanted) const {
    throw Error({.what = "a line of sketches",
                 .where = {file_, number_},
                 .found = fmt::format("'{}'", found),
                 .wanted = wanted});
  }

  void read(const std::vector<std::string_view>& fields) {
    constexpr const char* kWanted =
        "'mistake', 'check', 'call' or 'wrong' and what belongs to it, separated by tabs";
    const std::string_view kind = fields.front();
    if (kind == "mistake" && fields.size() == 2) {
      known.questions.emplace_back(fields[1]);
    } else if (kind == "check" && fields.size() == 2) {
      check_ = &known.checks[std::string(fields[1])];
    } else if (kind == "call" && fields.size() == 4) {
      if (check_ == nullptr) fail(kind, "'check' before it");
      const auto key = parseNumber<std::uint64_t>(fields[2], 16);
      if (!key) fail(fields[2], "a hexadecimal number");
      check_->push_back({.right = {std::string(fields[1]), *key, sketch(fields[3])}});
    } else if (kind == "wrong" && fields.size() == 3) {
      if (check_ == nullptr || check_->empty()) fail(kind, "'call' before it");
      WrongAnswer wrong{.mistakes = mistakes(fields[1])};
      if (fields[2] != kNotReached) wrong.answer = sketch(fields[2]);
      check_->back().wrong.push_back(std::move(wrong));
    } else {
      fail(kind, kWanted);
    }
  }

  std::vector<std::size_t> mistakes(std::string_view list) const {
    std::vector<std::size_t> numbers;
    for (const std::string_view one : splitAt(list, ',')) {
      const auto number = parseNumber<std::size_t>(one);
      if (!number || *number >= known.questions.size()) fail(one, "the number of a mistake above");
      numbers.push_back(*number);
    }
    return numbers;
  }

  Sketch sketch(std::string_view text) const {
    constexpr const char* kWanted = "'threw', or 'real' or 'whole', a hexadecimal number and four numbers";
    Sketch read;
    const std::vector<std::string_view> words = splitWords(text);
    read.threw = text == "threw";
    if (read.threw) return read;
    if (words.size() != 3 + read.sums.size() || (words[0] != "real" && words[0] != "whole"))
      fail(text, kWanted);
    const auto form = parseNumber<std::uint32_t>(words[1], 16);
    if (!form) fail(text, kWanted);
    std::vector<double> numbers;
    for (auto word = words.begin() + 2; word != words.end(); ++word) {
      const auto number = parseNumber<double>(*word);
      if (!number) fail(text, kWanted);
      numbers.push_back(*number);
    }
    read.isWhole = words[0] == "whole";
    read.form = *form;
    read.size = numbers.front();
    std::copy(numbers.begin() + 1, numbers.end(), read.sums.begin());
    return read;
  }

  std::string file_;
  int number_ = 0;
  std::vector<KnownCall>* check_ = nullptr;
};

bool sameAnswers(const std::vector<WrongAnswer>& a, const std::vector<WrongAnswer>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const WrongAnswer& one, const WrongAnswer& other) {
        return one.mistakes == other.mistakes && one.answer.has_value() == other.answer.has_value() &&
               (!one.answer || agree(*one.answer, *other.answer));
      });
}

}  // namespace

KnownMistakes knownMistakes(const SketchedChecks& right, const std::vector<SketchedMistake>& mistakes) {
  KnownMistakes known;
  for (const SketchedMistake& mistake : mistakes) known.questions.push_back(mistake.question);
  for (const auto& [check, calls] : right)
    if (auto chosen = Choice(calls, mistakes, check).calls(); !chosen.empty())
      known.checks.emplace(check, std::move(chosen));
  return known;
}

std::string recognisedMistake(const KnownMistakes& known, const SketchedChecks& seen,
                              const std::string& check, const std::string& function) {
  std::vector<std::string> functions = {function};
  for (const SketchedCall& call : callsOf(seen, check))
    if (std::find(functions.begin(), functions.end(), call.function) == functions.end())
      functions.push_back(call.function);
  const Recognition recognition(known, seen);
  for (const std::string& one : functions)
    if (const auto question = recognition.about(one, check)) return *question;
  return "";
}

std::string toText(const KnownMistakes& known) {
  std::string all;
  for (const std::string& question : known.questions) all += "mistake\t" + question + "\n";
  for (const auto& [check, calls] : known.checks) {
    all += "check\t" + check + "\n";
    for (const KnownCall& call : calls) {
      all += text(call.right);
      for (const auto& [mistakes, answer] : call.wrong)
        all += fmt::format("wrong\t{}\t{}\n", text(mistakes), answer ? text(*answer) : kNotReached);
    }
  }
  return all;
}

std::string toText(const SketchedChecks& seen) {
  std::string all;
  for (const auto& [check, calls] : seen) {
    all += "check\t" + check + "\n";
    for (const SketchedCall& call : calls) all += text(call);
  }
  return all;
}

KnownMistakes readKnownMistakes(std::string_view text, const std::string& file) {
  return LineReader(text, file).known;
}

SketchedChecks readSketchedChecks(std::string_view text, const std::string& file) {
  SketchedChecks seen;
  for (const auto& [check, calls] : LineReader(text, file).known.checks)
    std::transform(calls.begin(), calls.end(), std::back_inserter(seen[check]),
                   [](const KnownCall& call) { return call.right; });
  return seen;
}

std::string differenceBetween(const KnownMistakes& a, const KnownMistakes& b) {
  if (a.questions != b.questions) return "other questions";
  for (const auto* one : {&a, &b})
    for (const auto& [check, calls] : one->checks)
      if (!a.checks.contains(check) || !b.checks.contains(check)) return fmt::format("check '{}'", check);
  for (const auto& [check, calls] : a.checks) {
    const std::vector<KnownCall>& others = b.checks.at(check);
    if (calls.size() != others.size()) return fmt::format("check '{}': another number of calls", check);
    for (std::size_t k = 0; k < calls.size(); ++k)
      if (calls[k].right.key != others[k].right.key ||
          !agree(calls[k].right.answer, others[k].right.answer) ||
          !sameAnswers(calls[k].wrong, others[k].wrong))
        return fmt::format("check '{}': other answers of {}", check, calls[k].right.function);
  }
  return "";
}

}  // namespace rex::grading
