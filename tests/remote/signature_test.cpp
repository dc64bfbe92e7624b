#include <array>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "remote/layout.h"

namespace rex::remote::signature_test {

namespace before {
struct Value {
  double y;
};
}  // namespace before
namespace after {
struct Value {
  float y;
};
}  // namespace after

TEST(Signature, DiffersWithNameParametersResultAndOrder) {
  const std::set<std::uint64_t> hashes = {
      functionHash<double(double)>("f"),
      functionHash<double(double)>("g"),
      functionHash<float(double)>("f"),
      functionHash<double(float)>("f"),
      functionHash<double(double, double)>("f"),
      functionHash<double(const double&)>("f"),
      functionHash<double(Eigen::Vector3d)>("f"),
      functionHash<double(Eigen::VectorXd)>("f"),
      functionHash<double(std::vector<double>)>("f"),
      functionHash<double(std::vector<float>)>("f"),
      functionHash<double(std::array<float, 20>)>("f"),
      combineHashes(combineHashes(kEmptySignature, 1), 2),
      combineHashes(combineHashes(kEmptySignature, 2), 1),
  };
  EXPECT_EQ(hashes.size(), 13u);
}

TEST(Signature, IsKnownToTheCompiler) {
  static_assert(functionHash<void()>("f") == functionHash<void()>("f"));
  static_assert(hashText("") == 0xcbf29ce484222325u);
  static_assert(hashText("a") == 0xaf63dc4c8601ec8cu);  // published test vector of FNV-1a
}

// The names differ too, so the field types are compared on their own.
TEST(Signature, LooksIntoStructs) {
  static_assert(std::is_same_v<FieldTuple<before::Value>, std::tuple<double>>);
  static_assert(std::is_same_v<FieldTuple<after::Value>, std::tuple<float>>);
  EXPECT_NE(functionHash<before::Value()>("f"), functionHash<after::Value()>("f"));
}

}  // namespace rex::remote::signature_test
