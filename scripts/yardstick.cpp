// The yardstick of scripts/cost: how long this file takes to compile says how fast a machine is. It never
// changes, since figures of earlier builds are measured by it. So it needs only the standard library, and
// scripts/format leaves it alone.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace {

template <std::size_t N>
struct Point {
  std::array<double, N + 1> x{};
  bool operator<(const Point& other) const { return x < other.x; }
};

template <std::size_t N>
double sortedSum(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::map<Point<N>, std::vector<Point<N>>> groups;
  std::unordered_map<std::string, std::shared_ptr<Point<N>>> byName;
  std::vector<Point<N>> points(100);
  for (Point<N>& point : points)
    std::generate(point.x.begin(), point.x.end(), [&] { return uniform(random); });
  std::sort(points.begin(), points.end());
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return b.x.back() < a.x.back(); });
  std::nth_element(points.begin(), points.begin() + 50, points.end());
  for (const Point<N>& point : points) {
    groups[point].push_back(point);
    byName.emplace(std::to_string(point.x.front()), std::make_shared<Point<N>>(point));
  }
  double sum = 0.0;
  for (const auto& [key, group] : groups)
    for (const Point<N>& point : group)
      sum += std::inner_product(key.x.begin(), key.x.end(), point.x.begin(), 0.0);
  for (const auto& [name, point] : byName) sum += static_cast<double>(name.size()) * point->x.front();
  const std::function<double(double)> half = [sum](double y) { return sum + y / 2.0; };
  const std::variant<int, double, std::string, Point<N>> value = points.front();
  return half(std::visit([](const auto& v) { return static_cast<double>(sizeof v); }, value));
}

template <std::size_t... N>
double sums(std::mt19937_64& random, std::index_sequence<N...>) {
  return (sortedSum<N>(random) + ...);
}

std::ptrdiff_t words(const std::string& text) {
  const std::regex word("[a-z]+");
  return std::distance(std::sregex_iterator(text.begin(), text.end(), word), std::sregex_iterator());
}

}  // namespace

int main(int count, char** arguments) {
  std::mt19937_64 random(1);
  std::ostringstream line;
  for (int k = 0; k < count; ++k) line << arguments[k] << ' ';
  return sums(random, std::make_index_sequence<3>()) > 0.0 && words(line.str()) > 0 ? 0 : 1;
}
