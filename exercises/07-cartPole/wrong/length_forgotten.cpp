// caught by: linear
// mistake: c2 without the length, which is 1 on the sheet.

// <solution rateOf>
const double c1 = 1 / (cart.poleMass + cart.cartMass), c2 = cart.poleMass * c1;
const double s = std::sin(x[2]), c = std::cos(x[2]), swing = c2 * x[3] * x[3] * s;
const double turn = (cart.g * s - c * (c1 * u + swing)) / (4 * cart.l / 3 - c2 * c * c);
return {x[1], c1* u + swing - c2* turn* c, x[3], turn};
// </solution>
