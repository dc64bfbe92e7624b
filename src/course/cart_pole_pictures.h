#pragma once

#include <string>
#include <vector>

#include "render/film.h"

namespace rex {

/// The content of a picture of a cart pole.
struct CartPoleView {
  Eigen::Vector4d x{0, 0, 0, 0};  ///< state, as in CartPole
  double u = 0;                   ///< the force, an arrow of 5 cm per newton
  std::string caption{};          ///< in the top left corner
  double l = 1;                   ///< from the hinge to the centre of the pole, which is 2 l long [m]
};

/// The cart on its rail, 1 m above the ground; the rail is as long as it has to be. Throws Error for
/// numbers that are not finite, and unless l > 0.
[[nodiscard]] Picture cartPolePicture(const CartPoleView& view);

/// The views, `step` seconds apart, on one rail. The film ends when the cart is more than 8 m away. Throws
/// Error as cartPolePicture() does.
[[nodiscard]] Film cartPoleFilm(const std::vector<CartPoleView>& views, double step = 1. / 60);

}  // namespace rex
