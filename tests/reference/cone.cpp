// Cone, and cylinder with caps.
#include <algorithm>

#include "shapes.h"

namespace reference {

Cone::Cone(Vector bottom, Vector top, Real radius, Real top_radius, bool caps)
    : bottom_(bottom),
      top_(top),
      axis_(unit(top - bottom)),
      radius_(radius),
      top_radius_(top_radius),
      height_(length(top - bottom)),
      caps_(caps) {}

Cone::Place Cone::place(Vector point) const {
  const Vector from_bottom = point - bottom_;
  const Real height = dot(from_bottom, axis_), rho = length(from_bottom - height * axis_);
  return {rho, height, (rho - radius_at(height)) * height_ / std::hypot(height_, top_radius_ - radius_)};
}

Crossings Cone::crossings(const Ray& ray) const {
  Crossings result;
  const Real speed = length(ray.direction);
  const Vector direction = 1 / speed * ray.direction;
  const Real start = dot(0.5L * (bottom_ + top_) - ray.origin, direction);
  const Vector from_bottom = ray.origin + start * direction - bottom_;
  const Real climb = dot(direction, axis_), height = dot(from_bottom, axis_);
  const Vector across = from_bottom - height * axis_, across_speed = direction - climb * axis_;
  const Real radius = radius_at(height), growth = (top_radius_ - radius_) / height_ * climb;
  const auto at = [&](Real t) { return bottom_ + from_bottom + t * direction; };

  // How far outside of the side the line is, sqrt(speed2 (t - t0)^2 + passing^2) - radius, has a minimum unless the
  // line is steeper than the cone: so much it must move before it crosses, or no longer does.
  const Real speed2 = dot(across_speed, across_speed), a = speed2 - growth * growth;
  if (a > 0) {
    const Real t0 = -dot(across, across_speed) / speed2, passing = length(across + t0 * across_speed);
    result.limit_clearance(std::fabs(place(at(t0 + growth * passing / std::sqrt(speed2 * a))).outside));
  }

  const Real b = dot(across, across_speed) - growth * radius;
  const Real c = dot(across, across) - radius * radius;
  const Real discriminant = b * b - a * c;
  std::vector<Real> found;
  if (discriminant >= 0) {
    const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
    for (const Real t : {q / a, c / q}) {
      if (!std::isfinite(t) || radius_at(height + t * climb) < 0) continue;
      const Real h = height + t * climb;
      const Real cosine = std::fabs(dot(side_normal(at(t)), direction));
      result.limit_clearance(std::fabs(h) * cosine);
      result.limit_clearance(std::fabs(h - height_) * cosine);
      if (h >= 0 && h <= height_) found.push_back(t);
    }
  }
  if (caps_) {
    for (const Real h : {Real(0), height_}) {
      const Real t = (h - height) / climb;
      if (!std::isfinite(t)) continue;
      const Real rho = length(across + t * across_speed);
      result.limit_clearance(std::fabs(rho - radius_at(h)) * std::fabs(climb));
      if (rho <= radius_at(h)) found.push_back(t);
    }
    if (climb == 0) result.limit_clearance(std::fmin(std::fabs(height), std::fabs(height - height_)));
  }
  std::sort(found.begin(), found.end());
  for (const Real t : found)
    if (result.count < 4) result.add((start + t) / speed);
  return result;
}

Real Cone::distance(Vector point) const {
  const Place p = place(point);
  return caps_ ? std::max({p.outside, -p.height, p.height - height_}) : p.outside;
}

Vector Cone::side_normal(Vector point) const {
  const Vector from_bottom = point - bottom_;
  const Vector across = from_bottom - dot(from_bottom, axis_) * axis_;
  const Real rho = length(across);  // 0 at a tip, whose normal is along the axis
  return unit((rho > 0 ? height_ / rho : 0) * across - (top_radius_ - radius_) * axis_);
}

Vector Cone::normal(Vector point) const {
  const Place p = place(point);
  if (!caps_ || p.outside >= std::fmax(-p.height, p.height - height_)) return side_normal(point);
  return p.height < height_ / 2 ? -axis_ : axis_;
}

Real Cone::smallest_extent() const {
  Real least = height_;
  for (const Real radius : {radius_, top_radius_})
    if (radius > 0) least = std::fmin(least, radius);
  return least;
}

std::string Cone::parameters() const {
  return vector_element("bottom", bottom_) + vector_element("top", top_) + number_element("radius", radius_) +
         number_element("topradius", top_radius_) + (caps_ ? "<caps>true</caps>" : "");
}

std::string CappedCylinder::parameters() const {
  return vector_element("bottom", bottom_) + vector_element("top", top_) + number_element("radius", radius_) +
         "<caps>true</caps>";
}

}  // namespace reference
