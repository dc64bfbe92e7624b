#include "locomotion/inverted_pendulum.h"

#include "base/require.h"

namespace rex {
namespace {

using Eigen::Vector2d;

void requireFiniteMotion(const CenterMotion& at) {
  requireFinite("inverted pendulum: position c", at.c);
  requireFinite("inverted pendulum: velocity v", at.v);
}

}  // namespace

double InvertedPendulum::omega() const {
  requirePositive("inverted pendulum: height", height);
  requirePositive("inverted pendulum: g", g);
  return std::sqrt(g / height);
}

Vector2d InvertedPendulum::acceleration(const Vector2d& c, const Vector2d& p) const {
  requireFinite("inverted pendulum: position c", c);
  requireFinite("inverted pendulum: zero moment point p", p);
  return omega() * omega() * (c - p);
}

Vector2d InvertedPendulum::zmp(const Vector2d& c, const Vector2d& acceleration) const {
  requireFinite("inverted pendulum: position c", c);
  requireFinite("inverted pendulum: acceleration", acceleration);
  return c - acceleration / (omega() * omega());
}

CenterMotion InvertedPendulum::after(const CenterMotion& start, const Vector2d& p, double t) const {
  requireFiniteMotion(start);
  requireFinite("inverted pendulum: zero moment point p", p);
  requireFinite("inverted pendulum: time t", t);
  const double w = omega();
  // The growing and the decaying part: cosh and sinh lose the small one in the large one.
  const Vector2d grows = (start.c - p + start.v / w) / 2, decays = (start.c - p - start.v / w) / 2;
  const double up = std::exp(w * t), down = std::exp(-w * t);
  return {.c = p + up * grows + down * decays, .v = w * (up * grows - down * decays)};
}

Vector2d InvertedPendulum::capturePoint(const CenterMotion& at) const {
  requireFiniteMotion(at);
  return at.c + at.v / omega();
}

Vector2d InvertedPendulum::orbitalEnergy(const CenterMotion& at, const Vector2d& p) const {
  requireFiniteMotion(at);
  requireFinite("inverted pendulum: zero moment point p", p);
  return (at.v.array().square() - omega() * omega() * (at.c - p).array().square()) / 2;
}

}  // namespace rex
