#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "reports/markdown.h"

namespace rex::reports {
namespace {

using Names = std::map<std::string_view, std::string_view>;

const Names kLetters = {
    {"alpha", "α"},      {"beta", "β"},   {"gamma", "γ"},   {"delta", "δ"},   {"epsilon", "ε"},
    {"varepsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},     {"theta", "θ"},   {"kappa", "κ"},
    {"lambda", "λ"},     {"mu", "μ"},     {"nu", "ν"},      {"xi", "ξ"},      {"pi", "π"},
    {"rho", "ρ"},        {"varrho", "ϱ"}, {"sigma", "σ"},   {"tau", "τ"},     {"phi", "φ"},
    {"varphi", "ϕ"},     {"chi", "χ"},    {"psi", "ψ"},     {"omega", "ω"},   {"Gamma", "Γ"},
    {"Delta", "Δ"},      {"Theta", "Θ"},  {"Lambda", "Λ"},  {"Sigma", "Σ"},   {"Phi", "Φ"},
    {"Psi", "Ψ"},        {"Omega", "Ω"},  {"infty", "∞"},   {"partial", "∂"}, {"nabla", "∇"},
    {"ell", "ℓ"},        {"top", "⊤"},    {"emptyset", "∅"}};

const Names kSigns = {
    {"cdot", "·"},   {"times", "×"},  {"circ", "∘"},      {"pm", "±"},         {"le", "≤"},
    {"ge", "≥"},     {"ne", "≠"},     {"approx", "≈"},    {"sim", "∼"},        {"propto", "∝"},
    {"to", "→"},     {"mapsto", "↦"}, {"leftarrow", "←"}, {"Rightarrow", "⇒"}, {"Leftrightarrow", "⇔"},
    {"in", "∈"},     {"subset", "⊂"}, {"forall", "∀"},    {"exists", "∃"},     {"ldots", "…"},
    {"cdots", "⋯"},  {"vdots", "⋮"},  {"ddots", "⋱"},     {"mid", "∣"},        {"perp", "⊥"},
    {"ll", "≪"},     {"gg", "≫"},     {"equiv", "≡"},     {"cup", "∪"},        {"cap", "∩"},
    {"colon", ":"},  {"lbrace", "{"}, {"rbrace", "}"},    {"{", "{"},          {"}", "}"},
    {"|", "‖"},      {"vert", "|"},   {"Vert", "‖"},      {"lfloor", "⌊"},     {"rfloor", "⌋"},
    {"langle", "⟨"}, {"rangle", "⟩"}, {"%", "%"},         {"#", "#"}};

const Names kLarge = {{"sum", "∑"}, {"prod", "∏"}, {"int", "∫"}, {"oint", "∮"}};
const Names kAccents = {{"hat", "^"},  {"bar", "¯"},   {"dot", "˙"},
                        {"ddot", "¨"}, {"tilde", "~"}, {"vec", "→"}};
const Names kSpaces = {{",", "0.17em"}, {";", "0.28em"}, {" ", "0.25em"}, {"quad", "1em"}, {"qquad", "2em"}};
constexpr std::string_view kFunctions[] = {"sin", "cos", "tan", "arctan", "arccos", "exp",  "log", "ln",
                                           "det", "max", "min", "lim",    "arg",    "sinh", "cosh"};
// The first letter of each alphabet in Unicode, which leaves out some of \mathbb and \mathcal for older ones.
const std::map<std::string_view, char32_t> kAlphabets = {
    {"mathbf", U'\U0001D400'}, {"mathcal", U'\U0001D49C'}, {"mathbb", U'\U0001D538'}};
const std::map<std::pair<std::string_view, char>, std::string_view> kOlderLetters = {
    {{"mathbb", 'R'}, "ℝ"},  {{"mathbb", 'N'}, "ℕ"},  {{"mathbb", 'P'}, "ℙ"},  {{"mathbb", 'Z'}, "ℤ"},
    {{"mathbb", 'C'}, "ℂ"},  {{"mathbb", 'Q'}, "ℚ"},  {{"mathbb", 'H'}, "ℍ"},  {{"mathcal", 'L'}, "ℒ"},
    {{"mathcal", 'B'}, "ℬ"}, {{"mathcal", 'E'}, "ℰ"}, {{"mathcal", 'F'}, "ℱ"}, {{"mathcal", 'H'}, "ℋ"},
    {{"mathcal", 'I'}, "ℐ"}, {{"mathcal", 'M'}, "ℳ"}, {{"mathcal", 'R'}, "ℛ"}};

std::string element(std::string_view name, std::string_view inside) {
  return fmt::format("<{0}>{1}</{0}>", name, inside);
}

std::string fourBytes(char32_t letter) {
  std::string bytes;
  for (const int shift : {18, 12, 6, 0})
    bytes += static_cast<char>((shift == 18 ? 0xF0U : 0x80U) | ((letter >> shift) & 0x3FU));
  return bytes;
}

/// Reads a formula from left to right.
class TexReader {
 public:
  explicit TexReader(std::string_view tex) : tex_(tex) {}

  std::string formula() {
    const std::string all = row("");
    if (at_ < tex_.size()) refuse("something that nothing opened");
    return all;
  }

 private:
  [[noreturn]] void refuse(std::string what) const {
    throw Error({.what = "cannot read the formula '" + std::string(tex_) + "'",
                 .found = fmt::format("{} at '{}'", what, tex_.substr(std::min(at_, tex_.size()), 20))});
  }

  void skipBlanks() {
    while (at_ < tex_.size() && std::isspace(static_cast<unsigned char>(tex_[at_]))) ++at_;
  }
  bool isNext(std::string_view text) {
    skipBlanks();
    const std::string_view rest = tex_.substr(at_);
    // \right is no \rightarrow.
    return rest.starts_with(text) && !(text.size() > 2 && text[0] == '\\' && rest.size() > text.size() &&
                                       std::isalpha(static_cast<unsigned char>(rest[text.size()])));
  }
  bool take(std::string_view text) {
    if (!isNext(text)) return false;
    at_ += text.size();
    return true;
  }
  void demand(std::string_view text) {
    if (!take(text)) refuse(fmt::format("no {}", text));
  }

  // Up to one of the ends, which are not taken.
  std::string row(std::string_view end) {
    std::string all;
    for (skipBlanks(); at_ < tex_.size(); skipBlanks()) {
      if ((!end.empty() && isNext(end)) || isNext("}") || isNext("&") || isNext("\\\\") || isNext("\\end") ||
          isNext("\\right"))
        break;
      all += withScripts(atom());
    }
    return element("mrow", all);
  }

  struct Atom {
    std::string xml;
    bool hasLimits = false;  // scripts below and above it, in displayed formulas
  };

  std::string withScripts(const Atom& atom) {
    std::string below, above;
    for (;; skipBlanks()) {
      if (take("_")) {
        if (!below.empty()) refuse("a second index");
        below = argument();
      } else if (take("^")) {
        if (!above.empty()) refuse("a second power");
        above = argument();
      } else if (take("'")) {
        above = element("mrow", above + element("mo", "′"));
      } else {
        break;
      }
    }
    const std::string scripts = below + above;
    if (scripts.empty()) return atom.xml;
    const std::string name = atom.hasLimits ? (above.empty()   ? "munder"
                                               : below.empty() ? "mover"
                                                               : "munderover")
                                            : (above.empty()   ? "msub"
                                               : below.empty() ? "msup"
                                                               : "msubsup");
    return element(name, atom.xml + scripts);
  }

  std::string argument() {
    skipBlanks();
    if (at_ == tex_.size()) refuse("no argument");
    return atom(true).xml;
  }

  std::string group() {
    demand("{");
    const std::string inside = row("}");
    demand("}");
    return inside;
  }

  // The text of a group, as it is.
  std::string_view literal() {
    demand("{");
    const std::size_t end = tex_.find('}', at_);
    if (end == tex_.npos) refuse("no }");
    const std::string_view inside = tex_.substr(at_, end - at_);
    at_ = end + 1;
    return inside;
  }

  Atom atom(bool onlyOneDigit = false) {
    const char c = tex_[at_];
    if (c == '{') return {group()};
    if (c == '\\') return command();
    const auto letter = static_cast<unsigned char>(c);
    if (std::isdigit(letter)) {
      const std::size_t begin = at_++;
      const auto isDigit = [&](std::size_t k) {
        return k < tex_.size() && std::isdigit(static_cast<unsigned char>(tex_[k]));
      };
      while (!onlyOneDigit && (isDigit(at_) || (at_ < tex_.size() && tex_[at_] == '.' && isDigit(at_ + 1))))
        ++at_;
      return {element("mn", tex_.substr(begin, at_ - begin))};
    }
    if (std::isalpha(letter)) {
      ++at_;
      return {element("mi", std::string(1, c))};
    }
    constexpr std::string_view kUsual = "+-=<>()[]|/,;:!.*";
    if (kUsual.find(c) == kUsual.npos) refuse("an unknown sign");
    ++at_;
    return {c == '-' ? element("mo", "−") : sign(std::string(1, c))};
  }

  // Brackets grow only between \left and \right, and bars and slashes have no space around them, as in TeX.
  static std::string sign(std::string_view text) {
    constexpr std::string_view kBrackets = "()[]{}⟨⟩⌊⌋", kTight = "|‖/";
    if (kBrackets.find(text) != kBrackets.npos) return fmt::format("<mo stretchy=\"false\">{}</mo>", text);
    if (kTight.find(text) != kTight.npos)
      return fmt::format("<mo stretchy=\"false\" lspace=\"0\" rspace=\"0\">{}</mo>", text);
    return element("mo", htmlText(text));
  }

  std::string_view commandName() {
    const std::size_t begin = ++at_;
    while (at_ < tex_.size() && std::isalpha(static_cast<unsigned char>(tex_[at_]))) ++at_;
    if (at_ == begin && at_ < tex_.size()) ++at_;
    return tex_.substr(begin, at_ - begin);
  }

  Atom command() {
    const std::size_t begin = at_;
    const std::string_view name = commandName();
    if (const auto found = kLetters.find(name); found != kLetters.end())
      return {element("mi", found->second)};
    if (const auto found = kSigns.find(name); found != kSigns.end()) return {sign(found->second)};
    if (const auto found = kLarge.find(name); found != kLarge.end())
      return {element("mo", found->second), name == "sum" || name == "prod"};
    if (const auto found = kSpaces.find(name); found != kSpaces.end())
      return {fmt::format("<mspace width=\"{}\"></mspace>", found->second)};
    if (const auto found = kAccents.find(name); found != kAccents.end())
      return {fmt::format("<mover accent=\"true\">{}<mo stretchy=\"false\">{}</mo></mover>", argument(),
                          found->second)};
    if (std::find(std::begin(kFunctions), std::end(kFunctions), name) != std::end(kFunctions))
      return {fmt::format("<mo lspace=\"0\" rspace=\"0.17em\" movablelimits=\"true\">{}</mo>", name),
              name == "max" || name == "min" || name == "lim"};
    if (name == "frac") {
      const std::string above = argument();
      return {element("mfrac", above + argument())};
    }
    if (name == "sqrt") return {element("msqrt", argument())};
    if (name == "text") return {element("mtext", htmlText(literal()))};
    if (name == "operatorname" || name == "mathrm") {
      const std::string_view word = literal();
      return {word.size() == 1 ? fmt::format("<mi mathvariant=\"normal\">{}</mi>", htmlText(word))
                               : element("mi", htmlText(word))};
    }
    if (const auto found = kAlphabets.find(name); found != kAlphabets.end())
      return {alphabet(found->first, found->second)};
    if (name == "left") return {fenced()};
    if (name == "begin") return {environment()};
    at_ = begin;
    refuse("an unknown command");
  }

  std::string alphabet(std::string_view name, char32_t first) {
    std::string letters;
    for (const char c : literal()) {
      if (c == '1' && name == "mathbf") {
        letters += fourBytes(U'\U0001D7CF');
        continue;
      }
      if (c < 'A' || c > 'Z') refuse("a letter that is not a capital in another alphabet");
      const auto older = kOlderLetters.find({name, c});
      letters += older != kOlderLetters.end() ? std::string(older->second)
                                              : fourBytes(first + static_cast<char32_t>(c - 'A'));
    }
    return element("mi", letters);
  }

  std::string bracket() {
    skipBlanks();
    if (at_ == tex_.size()) refuse("no bracket");
    if (tex_[at_] == '.') return ++at_, std::string();
    std::string_view text = tex_.substr(at_, 1);
    if (text == "\\") {
      const auto found = kSigns.find(commandName());
      if (found == kSigns.end()) refuse("no bracket");
      text = found->second;
    } else {
      ++at_;
    }
    return fmt::format("<mo stretchy=\"true\">{}</mo>", htmlText(text));
  }

  std::string fenced() {
    const std::string open = bracket(), inside = row("");
    demand("\\right");
    const std::string close = bracket();
    return element("mrow", open + inside + close);
  }

  std::string environment() {
    const std::string name(literal());
    static const std::map<std::string, std::pair<std::string_view, std::string_view>> kKinds = {
        {"matrix", {"", ""}},
        {"pmatrix", {"(", ")"}},
        {"bmatrix", {"[", "]"}},
        {"cases", {"{", ""}},
        {"aligned", {"", ""}}};
    const auto kind = kKinds.find(name);
    if (kind == kKinds.end()) refuse("an unknown environment");
    std::string rows, cells;
    for (;;) {
      cells += element("mtd", row(""));
      if (take("&")) continue;
      rows += element("mtr", cells);
      cells.clear();
      if (!take("\\\\")) break;
      if (isNext("\\end")) break;
    }
    demand("\\end");
    if (literal() != name) refuse("the end of another environment");
    const auto side = [](std::string_view text) {
      return text.empty() ? std::string() : fmt::format("<mo stretchy=\"true\">{}</mo>", text);
    };
    const std::string_view like = name == "aligned" ? " class=\"aligned\""
                                  : name == "cases" ? " class=\"cases\""
                                                    : "";
    return element("mrow", side(kind->second.first) + fmt::format("<mtable{}>{}</mtable>", like, rows) +
                               side(kind->second.second));
  }

  std::string_view tex_;
  std::size_t at_ = 0;
};

}  // namespace

std::string toMathMl(std::string_view tex, bool isDisplayed) {
  const std::string inside = TexReader(tex).formula();
  return isDisplayed ? fmt::format("<math display=\"block\">{}</math>", inside) : element("math", inside);
}

}  // namespace rex::reports
