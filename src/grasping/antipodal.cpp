#include "grasping/antipodal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/require.h"

namespace rex {
namespace {

using Eigen::Vector3d;

void requireOptions(int tries, const AntipodalOptions& options) {
  requireCount("antipodal grasps: tries", tries, 0);
  requirePositive("antipodal grasps: friction", options.friction);
  requirePositive("antipodal grasps: largest width", options.maxWidth, kMetres);
}

// Evenly over the section of the friction cone.
Vector3d directionInCone(const Contact& contact, Rng& rng) {
  const double r = contact.friction * std::sqrt(rng.uniform());
  const double angle = rng.uniform(0, 2 * std::numbers::pi);
  return (contactFrame(contact) * Vector3d(1, r * std::cos(angle), r * std::sin(angle))).normalized();
}

}  // namespace

AntipodalGrasps sampleAntipodal(const ObjectSurface& surface, Rng& rng, int tries,
                                const AntipodalOptions& options) {
  requireOptions(tries, options);
  AntipodalGrasps result{.grasps = {}, .tries = tries};
  const double near = 1e-9 * std::sqrt(surface.area());
  const double steepest = 1 / std::sqrt(1 + options.friction * options.friction);
  for (const SurfacePoint& point : surface.sample(rng, tries)) {
    const Contact a{point.p_OQ, -point.normal_O, options.friction};
    const Vector3d direction = directionInCone(a, rng);
    const std::vector<LineHit> hits = surface.hits(a.p_OC, direction);
    const auto other = std::find_if(hits.begin(), hits.end(), [&](const LineHit& h) { return h.t > near; });
    if (other == hits.end() || direction.dot(other->normal_O) < steepest) {
      ++result.notOpposite;
      continue;
    }
    if (other->t > options.maxWidth) {
      ++result.tooWide;
      continue;
    }
    const double open = (options.maxWidth - other->t) / 2;
    const bool isBlocked = std::any_of(hits.begin(), hits.end(), [&](const LineHit& h) {
      return (h.t < -near && h.t >= -open) || (h.t > other->t + near && h.t <= other->t + open);
    });
    if (isBlocked) {
      ++result.blocked;
      continue;
    }
    const Contact b{a.p_OC + other->t * direction, -other->normal_O, options.friction};
    result.grasps.push_back({a, b, other->t});
  }
  return result;
}

std::vector<Contact> contactsAt(const std::vector<SurfacePoint>& points, double friction) {
  std::vector<Contact> contacts;
  for (const SurfacePoint& point : points) {
    contacts.push_back({point.p_OQ, -point.normal_O, friction});
    requireValid(contacts.back());
  }
  return contacts;
}

}  // namespace rex
