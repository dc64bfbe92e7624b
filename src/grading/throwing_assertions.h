#pragma once

// Included before everything else where checks are compiled. It makes Eigen's assertions on sizes and
// indices throw, because students' answers can violate them. Only the judging of that answer ends then.
#ifdef EIGEN_CORE_H
#error "Eigen was included before"
#endif

namespace rex::grading {

/// Throws a std::logic_error that quotes the condition.
[[noreturn]] void failAssertion(const char* condition);

}  // namespace rex::grading

#define eigen_assert(condition)                                  \
  do {                                                           \
    if (!(condition)) ::rex::grading::failAssertion(#condition); \
  } while (false)
