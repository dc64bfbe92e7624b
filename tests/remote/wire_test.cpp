#include "remote/wire.h"

#include <gtest/gtest.h>

namespace rex::remote::wire_test {

enum class Colour : std::uint8_t { red, green };

struct TaskValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
  bool operator==(const TaskValue&) const = default;
};

struct Everything {
  double number = 0;
  std::int64_t count = 0;
  Colour colour = Colour::red;
  std::string text;
  std::vector<TaskValue> tasks;
  std::optional<Eigen::Vector3d> point;
  std::pair<bool, float> pair;
  std::array<int, 2> pixel{};
  bool operator==(const Everything&) const = default;
};

static_assert(kFieldCount<TaskValue> == 2);
static_assert(kFieldCount<Everything> == 8);

template <class T>
std::vector<std::byte> bytesOf(const T& value) {
  Writer writer;
  Wire<T>::put(writer, value);
  return {writer.bytes().begin(), writer.bytes().end()};
}

template <class T>
T fromBytes(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  T value = Wire<T>::get(reader);
  reader.expectEnd();
  return value;
}

template <class T>
void expectRoundTrip(const T& value) {
  EXPECT_EQ(fromBytes<T>(bytesOf(value)), value);
}

Eigen::MatrixXd randomMatrix(Rng& rng, int rows, int cols) {
  return rng.normalVector(rows * cols).reshaped(rows, cols);
}

std::string randomText(Rng& rng) {
  std::string text(rng.index(20), '\0');
  for (char& c : text) c = static_cast<char>(rng.index(256));
  return text;
}

TaskValue randomTask(Rng& rng) {
  const int rows = rng.index(5);
  return {.y = rng.normalVector(rows), .J = randomMatrix(rng, rows, rng.index(8))};
}

Everything randomEverything(Rng& rng) {
  Everything e;
  e.number = rng.normal() * 1e200;
  e.count = static_cast<std::int64_t>(rng.next());
  e.colour = static_cast<Colour>(rng.index(2));
  e.text = randomText(rng);
  for (int n = rng.index(4); n > 0; --n) e.tasks.push_back(randomTask(rng));
  if (rng.index(2) == 0) e.point = rng.normalVector(3);
  e.pair = {rng.index(2) == 0, static_cast<float>(rng.normal())};
  e.pixel = {rng.index(1000), -rng.index(1000)};
  return e;
}

TEST(Wire, ReturnsEveryTypeAsItWas) {
  Rng rng(1);
  for (int k = 0; k < 300; ++k) {
    expectRoundTrip(rng.normal());
    expectRoundTrip(static_cast<float>(rng.normal()));
    expectRoundTrip(static_cast<int>(rng.next()));
    expectRoundTrip(static_cast<std::uint8_t>(rng.next()));
    expectRoundTrip(rng.index(2) == 0);
    expectRoundTrip(static_cast<Colour>(rng.index(2)));
    expectRoundTrip(randomText(rng));
    expectRoundTrip<Eigen::VectorXd>(rng.normalVector(rng.index(6)));
    expectRoundTrip<Eigen::MatrixXd>(randomMatrix(rng, rng.index(5), rng.index(5)));
    expectRoundTrip<Eigen::Matrix3Xd>(randomMatrix(rng, 3, rng.index(5)));
    expectRoundTrip<Eigen::Matrix4d>(randomMatrix(rng, 4, 4));
    expectRoundTrip<Eigen::RowVectorXd>(randomMatrix(rng, 1, rng.index(5)));
    expectRoundTrip<Eigen::VectorXi>(randomMatrix(rng, rng.index(5), 1).cast<int>());
    expectRoundTrip(std::vector<bool>(static_cast<std::size_t>(rng.index(9)), true));
    expectRoundTrip(std::vector<std::string>(static_cast<std::size_t>(rng.index(9)), randomText(rng)));
    expectRoundTrip(randomEverything(rng));
  }
  expectRoundTrip(std::optional<int>());
  expectRoundTrip(std::vector<std::vector<double>>{{}, {1, 2}, {}});
}

TEST(Wire, KeepsTheBitsOfSpecialNumbers) {
  for (const double x : {-0.0, std::numeric_limits<double>::infinity(), 5e-324, std::nan("7")}) {
    const double back = fromBytes<double>(bytesOf(x));
    EXPECT_EQ(std::memcmp(&back, &x, sizeof x), 0);
  }
}

TEST(Wire, LetsBothSidesDrawTheSameNumbers) {
  SplitRng rng(Rng(3), 1);
  rng.next();
  SplitRng copy = fromBytes<SplitRng>(bytesOf(rng));
  EXPECT_EQ(copy.next(), rng.next());
}

TEST(Wire, RejectsEveryTruncation) {
  Rng rng(5);
  for (int k = 0; k < 50; ++k) {
    const std::vector<std::byte> whole = bytesOf(randomEverything(rng));
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::span<const std::byte> cut(whole.data(), size);
      EXPECT_THROW(static_cast<void>(fromBytes<Everything>(cut)), ProtocolError) << size;
    }
  }
}

TEST(Wire, SurvivesRandomMutations) {
  Rng rng(7);
  int rejected = 0;
  for (int k = 0; k < 20000; ++k) {
    std::vector<std::byte> bytes = bytesOf(randomEverything(rng));
    for (int n = 1 + rng.index(3); n > 0; --n)
      bytes[rng.index(static_cast<int>(bytes.size()))] = static_cast<std::byte>(rng.index(256));
    try {
      static_cast<void>(fromBytes<Everything>(bytes));
    } catch (const ProtocolError&) {
      ++rejected;
    }
  }
  EXPECT_GT(rejected, 1000);
  EXPECT_LT(rejected, 20000);
}

template <class T>
std::string rejection(const Writer& writer) {
  try {
    static_cast<void>(fromBytes<T>(writer.bytes()));
  } catch (const ProtocolError& error) {
    return error.what();
  }
  return "accepted";
}

Writer numbers(std::initializer_list<std::int32_t> values) {
  Writer writer;
  for (const std::int32_t value : values) Wire<std::int32_t>::put(writer, value);
  return writer;
}

TEST(Wire, SaysWhatIsWrong) {
  EXPECT_EQ(rejection<double>(numbers({1})), "the message ends too early");
  EXPECT_EQ(rejection<std::int32_t>(numbers({1, 2})), "the message is longer than its content");
  EXPECT_EQ(rejection<std::string>(numbers({5, 0})), "a list is longer than its message");
  EXPECT_EQ(rejection<std::vector<double>>(numbers({-1, -1})), "a list is longer than its message");
  EXPECT_EQ(rejection<Eigen::MatrixXd>(numbers({1 << 30, 1 << 30})), "a matrix is larger than its message");
  EXPECT_EQ(rejection<Eigen::MatrixXd>(numbers({-1, 1})), "a matrix has a size that its type cannot have");
  EXPECT_EQ(rejection<Eigen::Vector3d>(numbers({4, 1})), "a matrix has a size that its type cannot have");
  EXPECT_EQ(rejection<SplitRng>(numbers({0, 0, 0, 0, 0, 0, 0, 0})), "a random generator has an empty state");
  Writer two;
  Wire<std::uint8_t>::put(two, 2);
  EXPECT_EQ(rejection<bool>(two), "a truth value is neither 0 nor 1");
}

}  // namespace rex::remote::wire_test
