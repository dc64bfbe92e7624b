#include "course/cart_pole_pictures.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "course/film.h"

namespace rex {
namespace {

constexpr double kHeight = 1;    // of the cart above the ground, metres
constexpr double kFarthest = 8;  // from the middle of the rail, in a film: beyond, a cart is only a dot
constexpr double kMetresPerNewton = 0.05, kShortestArrow = 0.02, kLongestArrow = 2;
constexpr Color kCartColor{0.0f, 0.45f, 0.7f}, kPoleColor{0.90f, 0.62f, 0.0f},
    kRailColor{0.45f, 0.48f, 0.52f};

// It begins and ends at whole metres, so that it seldom changes.
struct Rail {
  double begin = -2, end = 2;
  void reach(double position) {
    begin = std::min(begin, std::floor(position - 0.5));
    end = std::max(end, std::ceil(position + 0.5));
  }
};

void addRail(Picture& picture, const Rail& rail) {
  constexpr double kTop = kHeight - 0.1, kThickness = 0.06, kFoot = 0.08, kPost = kTop - kThickness;
  const Shape bar{.extent = {rail.end - rail.begin, 0.12, kThickness}}, post{.extent = {kFoot, kFoot, kPost}};
  const Pose X_WR = translation((rail.begin + rail.end) / 2, 0, kTop - kThickness / 2);
  picture.solids.push_back({bar, X_WR, kRailColor, "rail"});
  for (const double place : {rail.begin + kFoot, rail.end - kFoot})
    picture.solids.push_back({post, translation(place, 0, kPost / 2), kRailColor, "post"});
}

void addForce(Picture& picture, const CartPoleView& view) {
  const double length = std::clamp(view.u * kMetresPerNewton, -kLongestArrow, kLongestArrow);
  if (std::abs(length) < kShortestArrow) return;
  const Eigen::Vector3d from(view.x[0] + std::copysign(0.5, length), 0, kHeight);
  picture.arrows.push_back({from, from + length * Eigen::Vector3d::UnitX(), {0.84f, 0.37f, 0.0f}, 0.02});
}

Picture pictureOn(const Rail& rail, const CartPoleView& view) {
  requireFinite("cart pole: state", view.x);
  requireFinite("cart pole: control u", view.u);
  requirePositive("cart pole: half the length of the pole", view.l);
  Picture picture;
  addRail(picture, rail);
  const Pose X_WC = translation(view.x[0], 0, kHeight),
             X_WP = X_WC * rotation(view.x[2], Eigen::Vector3d::UnitY());
  picture.solids.push_back({{.extent = {1, 0.2, 0.2}}, X_WC, kCartColor, "cart"});
  picture.solids.push_back(
      {{.extent = {0.1, 0.1, 2 * view.l}}, X_WP * translation(0, 0, view.l), kPoleColor, "pole"});
  addForce(picture, view);
  if (!view.caption.empty()) picture.captions.push_back({.text = view.caption});
  return picture;
}

}  // namespace

Picture cartPolePicture(const CartPoleView& view) {
  Rail rail;
  rail.reach(view.x[0]);
  return pictureOn(rail, view);
}

Film cartPoleFilm(const std::vector<CartPoleView>& views, double step) {
  const auto isAway = [](const CartPoleView& view) { return std::abs(view.x[0]) > kFarthest; };
  const auto end = std::find_if(views.begin() + (views.empty() ? 0 : 1), views.end(), isAway);
  Rail rail;
  for (auto view = views.begin(); view != end; ++view) rail.reach(view->x[0]);
  return makeFilm(static_cast<int>(end - views.begin()), step,
                  [&](int i) { return pictureOn(rail, views[static_cast<std::size_t>(i)]); });
}

}  // namespace rex
