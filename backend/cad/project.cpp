// Foot points on untrimmed surfaces and on edges: closed forms where the geometry has them, safeguarded Newton elsewhere.
// Everything evaluates Geom objects directly, which keep no caches, so any number of threads may ask at once.
#include <ElCLib.hxx>
#include <ElSLib.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cad/shape.h"
#include "cad/tuning.h"

namespace polycube {
namespace {

struct Local {
  Vec3 s, su, sv, suu, suv, svv;
};

Local evaluate(const FaceGeometry& face, const Vec2& uv) {
  gp_Pnt p;
  gp_Vec u, v, uu, vv, cross;
  face.surface->D2(uv[0], uv[1], p, u, v, uu, vv, cross);
  return {to_vec(p), to_vec(u), to_vec(v), to_vec(uu), to_vec(cross), to_vec(vv)};
}

Vec2 clamp(const FaceGeometry& face, Vec2 uv) {
  for (int k = 0; k < 2; ++k)
    if (face.period[k] == 0) uv[k] = std::clamp(uv[k], face.lower[k], face.upper[k]);
  return uv;
}

/// Minimises |S(u, v) - p|^2 / 2 from the seed: Newton with the full Hessian, Gauss-Newton where that is not convex, halved steps
/// where the distance does not fall; a parameter at its bound that wants to leave is held.
Vec2 newton_foot(const FaceGeometry& face, const Vec3& p, const Vec2& seed, bool* converged) {
  if (converged) *converged = false;
  Vec2 uv = clamp(face, seed);
  Local at = evaluate(face, uv);
  double energy = (at.s - p).squaredNorm();
  int jumps = 0;
  for (int step = 0; step < kCadTuning.newton_steps; ++step) {
    const Vec3 d = at.s - p;
    Vec2 gradient(d.dot(at.su), d.dot(at.sv));
    Eigen::Matrix2d first;
    first << at.su.squaredNorm(), at.su.dot(at.sv), at.su.dot(at.sv), at.sv.squaredNorm();
    Eigen::Matrix2d hessian = first;
    hessian(0, 0) += d.dot(at.suu);
    hessian(0, 1) += d.dot(at.suv);
    hessian(1, 0) = hessian(0, 1);
    hessian(1, 1) += d.dot(at.svv);
    bool jumped = false;
    for (int k = 0; k < 2; ++k) {
      const bool low = uv[k] <= face.lower[k] && gradient[k] > 0, high = uv[k] >= face.upper[k] && gradient[k] < 0;
      if (face.period[k] != 0 || !(low || high)) continue;
      if (face.closed[static_cast<std::size_t>(k)] && jumps < 4) {
        uv[k] = low ? face.upper[k] : face.lower[k];
        jumped = true;
        continue;
      }
      gradient[k] = 0;
      for (Eigen::Matrix2d* m : {&hessian, &first}) {
        (*m)(0, 1) = (*m)(1, 0) = 0;
        (*m)(k, k) = 1;
      }
    }
    if (jumped) {
      ++jumps;
      at = evaluate(face, uv);
      energy = (at.s - p).squaredNorm();
      continue;
    }
    const double size_u = at.su.norm(), size_v = at.sv.norm();
    const double reach = 1e-13 * (1 + at.s.norm() + p.norm());
    if (std::abs(gradient[0]) <= size_u * reach && std::abs(gradient[1]) <= size_v * reach) {
      if (converged) *converged = true;
      return uv;
    }
    const bool convex = hessian(0, 0) > 0 && hessian.determinant() > 1e-10 * first.determinant();
    if (!convex) {
      hessian = first;
      hessian(0, 0) += 1e-12 * (1 + first(0, 0));
      hessian(1, 1) += 1e-12 * (1 + first(1, 1));
    }
    const Vec2 move = -hessian.inverse() * gradient;
    double length = 1;
    bool fell = false;
    for (int half = 0; half < 30 && !fell; ++half, length /= 2) {
      const Vec2 next = clamp(face, uv + length * move);
      const Local there = evaluate(face, next);
      const double next_energy = (there.s - p).squaredNorm();
      if (next_energy < energy || (next_energy == energy && next != uv)) {
        fell = true;
        uv = next;
        at = there;
        const bool still = energy - next_energy <= 1e-16 * energy;
        energy = next_energy;
        if (still && length * move.cwiseAbs().dot(Vec2(size_u, size_v)) < 1e-10 * (1 + at.s.norm())) {
          if (converged) *converged = true;
          return uv;
        }
      }
    }
    if (!fell) {
      // Rounding is all that is left when even the smallest step along a descent direction does not help.
      if (converged) *converged = move.cwiseAbs().dot(Vec2(size_u, size_v)) < 1e-6 * (1 + at.s.norm());
      return uv;
    }
  }
  return uv;
}

/// The foot on the generatrix nearest to p of the nappe that holds the face; ElSLib's choice may lie on the other nappe or beyond the axis.
Vec2 cone_foot(const FaceGeometry& face, const gp_Cone& cone, const gp_Pnt& p) {
  const gp_XYZ d = p.XYZ() - cone.Location().XYZ();
  const double x = d.Dot(cone.Position().XDirection().XYZ()), y = d.Dot(cone.Position().YDirection().XYZ()), z = d.Dot(cone.Position().Direction().XYZ());
  const double slope_sin = std::sin(cone.SemiAngle()), slope_cos = std::cos(cone.SemiAngle());
  const bool beyond_tip = cone.RefRadius() + face.domain.center()[1] * slope_sin < 0;
  const double angle = std::atan2(y, x) + (beyond_tip ? std::numbers::pi : 0), radius = std::hypot(x, y) * (beyond_tip ? -1 : 1);
  return {angle, (radius - cone.RefRadius()) * slope_sin + z * slope_cos};
}

struct ClosedFormFoot {
  const FaceGeometry& face;
  const gp_Pnt p;
  Vec2 operator()(const gp_Cone& cone) const { return cone_foot(face, cone, p); }
  Vec2 operator()(const std::monostate&) const { return Vec2::Zero(); }
  template <class Surface>
  Vec2 operator()(const Surface& surface) const {
    double u = 0, v = 0;
    ElSLib::Parameters(surface, p, u, v);
    return {u, v};
  }
};

}  // namespace

Vec2 wrap(const FaceGeometry& face, const Vec2& uv) {
  Vec2 result = uv;
  for (int k = 0; k < 2; ++k) {
    const double period = face.period[k];
    if (period == 0) continue;
    const double low = face.domain.min()[k], high = face.domain.max()[k];
    result[k] -= period * std::floor((result[k] - low) / period);
    // Just below the lower end: rounding, or nearer to the domain from that side.
    if (result[k] > high && low - (result[k] - period) < result[k] - high) result[k] -= period;
  }
  return result;
}

Vec2 foot_on_surface(const FaceGeometry& face, const Vec3& p, const Vec2& seed, bool* converged) {
  if (face.closed_form.index() == 0) return wrap(face, newton_foot(face, p, seed, converged));
  if (converged) *converged = true;
  return wrap(face, std::visit(ClosedFormFoot{face, to_pnt(p)}, face.closed_form));
}

Vec3 surface_normal(const FaceGeometry& face, const Vec2& uv) {
  Vec2 at = uv;
  for (int attempt = 0; attempt < 8; ++attempt) {
    gp_Pnt p;
    gp_Vec u, v;
    face.surface->D1(at[0], at[1], p, u, v);
    const Vec3 normal = to_vec(u).cross(to_vec(v));
    const double scale = std::max(u.SquareMagnitude(), v.SquareMagnitude());
    if (normal.norm() > 1e-9 * scale) return normal.normalized();
    // A pole or a collapsed border: the limit from inside the face.
    at = uv + std::pow(10.0, attempt - 6) * (Vec2(face.domain.center()) - uv);
  }
  return Vec3::UnitZ();
}

namespace {

double clamp_periodic(const EdgeGeometry& edge, double t) {
  if (edge.period > 0) {
    t -= edge.period * std::floor((t - edge.first) / edge.period);
    if (t <= edge.last) return t;
    return t - edge.last < edge.first + edge.period - t ? edge.last : edge.first;
  }
  return std::clamp(t, edge.first, edge.last);
}

EdgePoint at_parameter(const EdgeGeometry& edge, const Vec3& p, double t) {
  const Vec3 point = to_vec(edge.curve->Value(t));
  return {point, t, (point - p).norm()};
}

/// Newton on (C - p) . C' within [low, high], Gauss-Newton where not convex.
EdgePoint newton_edge(const EdgeGeometry& edge, const Vec3& p, double seed, double low, double high) {
  double t = std::clamp(seed, low, high);
  gp_Pnt c;
  gp_Vec d1, d2;
  edge.curve->D2(t, c, d1, d2);
  double energy = (to_vec(c) - p).squaredNorm();
  for (int step = 0; step < kCadTuning.newton_steps; ++step) {
    const Vec3 d = to_vec(c) - p;
    const double gradient = d.dot(to_vec(d1)), first = d1.SquareMagnitude(), second = first + d.dot(to_vec(d2));
    if (std::abs(gradient) <= 1e-14 * std::sqrt(first) * (1 + to_vec(c).norm())) break;
    if ((t <= low && gradient > 0) || (t >= high && gradient < 0)) break;
    double move = -gradient / (second > 1e-6 * first ? second : first + 1e-300);
    bool fell = false;
    for (int half = 0; half < 40 && !fell; ++half, move /= 2) {
      const double next = std::clamp(t + move, low, high);
      if (next == t) break;
      gp_Pnt nc;
      gp_Vec n1, n2;
      edge.curve->D2(next, nc, n1, n2);
      const double next_energy = (to_vec(nc) - p).squaredNorm();
      if (next_energy >= energy) continue;
      fell = true;
      t = next, c = nc, d1 = n1, d2 = n2, energy = next_energy;
    }
    if (!fell) break;
  }
  return {to_vec(c), t, std::sqrt(energy)};
}

}  // namespace

EdgePoint nearest_on_edge(const EdgeGeometry& edge, const Vec3& p, const double* seed) {
  if (const gp_Lin* line = std::get_if<gp_Lin>(&edge.closed_form))
    return at_parameter(edge, p, std::clamp(ElCLib::Parameter(*line, to_pnt(p)), edge.first, edge.last));
  if (const gp_Circ* circle = std::get_if<gp_Circ>(&edge.closed_form))
    return at_parameter(edge, p, clamp_periodic(edge, ElCLib::Parameter(*circle, to_pnt(p))));
  if (seed) {
    EdgePoint found = newton_edge(edge, p, clamp_periodic(edge, *seed), edge.first, edge.last);
    if (!edge.closed || (found.t > edge.first && found.t < edge.last)) return found;
    const EdgePoint beyond = newton_edge(edge, p, found.t > edge.first ? edge.first : edge.last, edge.first, edge.last);
    return beyond.distance < found.distance ? beyond : found;
  }
  const int count = static_cast<int>(edge.samples.size());
  EdgePoint best;
  best.distance = std::numeric_limits<double>::infinity();
  // Every valley of the sampled distance that could hold the nearest point is followed down.
  std::vector<double> distance(edge.samples.size());
  for (std::size_t i = 0; i < distance.size(); ++i) distance[i] = (edge.samples[i] - p).norm();
  const double least = *std::min_element(distance.begin(), distance.end());
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) { return distance[static_cast<std::size_t>(k)]; };
    if ((i > 0 && at(i - 1) < at(i)) || (i + 1 < count && at(i + 1) < at(i))) continue;
    const auto gap = [&](int a, int b) { return (edge.samples[static_cast<std::size_t>(a)] - edge.samples[static_cast<std::size_t>(b)]).norm(); };
    const double reach = std::max(i > 0 ? gap(i - 1, i) : 0, i + 1 < count ? gap(i, i + 1) : 0);
    if (at(i) - reach > least) continue;
    const double step = (edge.last - edge.first) / (count - 1), t = edge.first + i * step;
    const EdgePoint candidate = newton_edge(edge, p, t, std::max(edge.first, t - step), std::min(edge.last, t + step));
    if (candidate.distance < best.distance) best = candidate;
  }
  return best;
}

}  // namespace polycube
