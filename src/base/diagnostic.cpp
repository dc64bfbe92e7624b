#include "base/diagnostic.h"

namespace rex {

std::string toString(const Diagnostic& diagnostic) {
  const std::string where = toString(diagnostic.where);
  const char* severity = diagnostic.severity == Severity::kWarning ? "warning: " : "note: ";
  return (where.empty() ? "" : where + ": ") + severity + diagnostic.message;
}

}  // namespace rex
