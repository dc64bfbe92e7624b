// caught by: impact, step, other-steps, gait
// mistake: the leg that stood is still the first after the impact.

// <solution impactOf>
const double l = walker.a + walker.b, m = walker.legMass, c = std::cos(x[0] - x[1]);
const double a = walker.a, b = walker.b;
Eigen::Matrix2d before, after;
before << (walker.hipMass * l * l + 2 * m * a * l) * c - m * a * b, -m *a *b, -m *a *b, 0;
after << (walker.hipMass + m) * l * l + m * a * a - m * l * b * c, m *b *(b - l * c), -m *l *b *c, m *b *b;
const Eigen::Vector2d rates = solve(after, Eigen::Vector2d(before* x.tail<2>()));
return {x[0], x[1], rates[1], rates[0]};
// </solution>
