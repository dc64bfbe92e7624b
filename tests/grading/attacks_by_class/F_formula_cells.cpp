// Throws texts that begin like formulas, with ordinary, full-width and small signs, behind blanks, separators
// and quotation marks.
#include <stdexcept>
#include <string>

#include "exercise.h"

namespace {
const char* const starts[] = {
    "=1+1",    "+1+1",         "-1+1",        "@SUM(1)",    "\t=1+1",     "\r=1+1",       "\n=1+1",
    " =1+1",   "\u00a0=1+1",   "\u3000=1+1",  "\ufeff=1+1", "\u200b=1+1", "\uff1d1+1",    "\uff0b1",
    "\uff0d1", "\uff20SUM(1)", "\ufe661+1",   "\ufe621",    "\ufe631",    "\ufe6bSUM(1)", "\u22121",
    "\u02961", ";=1+1",        "\";=1+1;\"",  "\",=1+1,\"", "\t;=1",      "%0A=1+1",      "|=1",
    "'=1",     "\"=1",         "DDE(\"cmd\")"};
}

double twice(double x) {
  const std::size_t number = sizeof starts / sizeof *starts;
  throw std::runtime_error(starts[static_cast<std::size_t>(x < 0 ? -x : x) % number]);
}

std::vector<double> squares(int) {
  std::string all;
  for (const char* start : starts) all += std::string(start) + "\n";
  throw std::runtime_error(all);
}

int main() {}
