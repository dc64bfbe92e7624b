#pragma once

// Included before everything else where checks are compiled: what Eigen asserts of sizes and indices throws,
// for answers of students lead there. The judging of that answer ends, and nothing else does.
#ifdef EIGEN_CORE_H
#error "Eigen was included before"
#endif

namespace rex::grading {

/// Throws std::logic_error that quotes the condition.
[[noreturn]] void failAssertion(const char* condition);

}  // namespace rex::grading

#define eigen_assert(condition)                                  \
  do {                                                           \
    if (!(condition)) ::rex::grading::failAssertion(#condition); \
  } while (false)
