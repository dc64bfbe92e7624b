#include "base/diagnostic.h"

namespace rex {

std::string toString(const Diagnostic& diagnostic) {
  const std::string where = toString(diagnostic.where);
  return (where.empty() ? "" : where + ": ") + "note: " + diagnostic.message;
}

}  // namespace rex
