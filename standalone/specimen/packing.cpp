// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "keys/mesh_file.hpp"
#include "laws/constants.hpp"
#include "model/error.hpp"
#include "neighbours/linked_cells.hpp"
#include "specimen/mesh_walls.hpp"
#include "specimen/ordering.hpp"
#include "specimen/quench.hpp"
#include "specimen/shape.hpp"
#include "specimen/walls.hpp"

namespace solidem {

namespace {

Domain domain_of(const TriangleMesh& mesh) {
  Domain domain;
  domain.shape = "mesh";
  std::tie(domain.lower, domain.upper) = bounds(mesh);
  domain.volume = volume(mesh);
  return domain;
}

constexpr double precision = 0.01;  // of the equilibrium, see SoftSpheres::relax
constexpr int most_steps = 20000;

// Contacts per sphere gained per unit of solid fraction, near the target.
constexpr double contacts_per_fraction = 57.0;
constexpr double tolerated_contacts = 0.02;

// Random numbers of our own: the standard's distributions differ between libraries. SplitMix64
// (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // Uniform in [0, 1).
  double next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

// Solid fraction at the target coordination, fitted to packings in cubes of 1000 to 100000 elements
// and in a periodic cell (none of it needs to be exact: the search for the target starts here).
double expected_fraction(const Domain& domain, double mean_radius, const FacetTree* surface) {
  const double walls = surface != nullptr ? area(surface->mesh()) : wall_area(domain);
  const double wall = std::min(mean_radius * walls / domain.volume, 0.36);
  return 0.640 - wall * (0.115 - 0.16 * wall);
}

// Mean volume of spheres with radii uniform in R_m (1 ± spread).
double mean_sphere_volume(double mean_radius, double spread) {
  return 4.0 / 3.0 * pi * mean_radius * mean_radius * mean_radius * (1.0 + spread * spread);
}

double radius_for(const Domain& domain, double elements, double spread, const FacetTree* surface) {
  double radius = 0;
  for (int pass = 0; pass < 30; ++pass) {
    const double fraction = expected_fraction(domain, radius, surface);
    radius = std::cbrt(fraction * domain.volume / (elements * mean_sphere_volume(1.0, spread)));
  }
  return radius;
}

void insist_on_room(const Domain& domain, double width, double mean_radius,
                    const SpecimenRecipe& recipe) {
  const double diameter = 2.0 * mean_radius * (1.0 + recipe.radius_spread);
  const std::string what =
      recipe.elements
          ? fmt::format("[specimen] elements = {} makes spheres up to {:.3g} m across",
                        recipe.elements, diameter)
          : fmt::format("[specimen] mean_radius = {} m makes spheres up to {:.3g} m across",
                        recipe.mean_radius, diameter);
  const char* const remedy = recipe.elements ? "take more elements" : "take a smaller mean radius";
  if (diameter > width)
    throw InputError(
        fmt::format("{}, but the body is only {:.3g} m thick: {}", what, width, remedy));
  if (2.1 * diameter > shortest_period(domain))
    throw InputError(
        fmt::format("{}, but the body repeats itself after {:.3g} m, under 2.1 diameters: {}", what,
                    shortest_period(domain), remedy));
}

void check_recipe(const SpecimenRecipe& recipe) {
  if (recipe.elements < 0 || recipe.elements > 2147483647)
    throw InputError(
        fmt::format("[specimen] elements = {}: expected 1 to 2147483647", recipe.elements));
  if (recipe.mean_radius != 0 && !(recipe.mean_radius > 0 && std::isfinite(recipe.mean_radius)))
    throw InputError(fmt::format("[specimen] mean_radius = {} m: expected a length above zero",
                                 recipe.mean_radius));
  if ((recipe.elements > 0) == (recipe.mean_radius > 0))
    throw InputError("[specimen]: expected either elements or mean_radius, one of them");
  if (!(recipe.radius_spread >= 0 && recipe.radius_spread <= 0.5))
    throw InputError(
        fmt::format("[specimen] radius_spread = {}: expected 0 to 0.5", recipe.radius_spread));
}

// A point of an annulus or wedge at least `margin` from its walls, as far as they leave room.
Vector random_point_between_rings(const Domain& domain, double margin, Random& random) {
  const double gap = std::min(margin, 0.5 * (domain.radius - domain.inner_radius));
  const double low = domain.inner_radius + gap, high = domain.radius - gap;
  double distance = 0, angle = 0;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    distance = std::sqrt(low * low + (high * high - low * low) * random.next());
    angle = domain.arc() * random.next();
    if (!(domain.angle > 0) || distance * std::sin(std::min(angle, domain.angle - angle)) > margin)
      break;
  }
  const double length = component(domain.upper - domain.lower, domain.axis);
  const double inset = domain.periodic[domain.axis] ? 0.0 : std::min(margin, 0.5 * length);
  Vector point = domain.axis_point() + distance * std::cos(angle) * domain.first_transverse() +
                 distance * std::sin(angle) * domain.second_transverse();
  component(point, domain.axis) += inset + (length - 2.0 * inset) * random.next();
  return point;
}

// A point of the body at least `margin` from its walls.
Vector random_point(const Domain& domain, double margin, Random& random) {
  if (domain.inner_radius > 0) return random_point_between_rings(domain, margin, random);
  const Vector extent = domain.upper - domain.lower;
  for (;;) {
    Vector point{};
    double across2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = component(domain.lower, axis), length = component(extent, axis);
      const double inset = domain.periodic[axis] ? 0.0 : std::min(margin, 0.5 * length);
      component(point, axis) = low + inset + (length - 2.0 * inset) * random.next();
      if (domain.radius > 0 && axis != domain.axis) {
        const double c = component(point, axis) - (low + 0.5 * length);
        across2 += c * c;
      }
    }
    const double free_radius = std::max(domain.radius - margin, 1e-9 * domain.radius);
    if (!(domain.radius > 0) || across2 <= free_radius * free_radius) return point;
  }
}

// The same of a mesh; without the margin where it leaves no room.
Vector random_point(const FacetTree& surface, double margin, Random& random) {
  constexpr int most_throws = 100000;
  const auto [lower, upper] = bounds(surface.mesh());
  const Vector extent = upper - lower;
  for (int thrown = 0; thrown < most_throws; ++thrown) {
    Vector point = lower;
    for (int axis = 0; axis < 3; ++axis)
      component(point, axis) += component(extent, axis) * random.next();
    const double inset = thrown < most_throws / 100 ? margin : 0.0;
    if (surface.signed_distance(point) < -inset) return point;
  }
  throw InputError(
      "[specimen] mesh: its body fills less than a hundred-thousandth of the box around it, too "
      "little to be packed");
}

SoftSpheres throw_spheres(const Domain& domain, const FacetTree* surface, std::size_t elements,
                          double spread, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector> position(elements);
  for (Vector& point : position)
    point = surface != nullptr ? random_point(*surface, 1.0, random)
                               : random_point(domain, 1.0, random);
  // Evenly spaced radii; the points are random, so which point gets which radius is too.
  std::vector<double> radius(elements);
  for (std::size_t k = 0; k < elements; ++k)
    radius[k] =
        1.0 + spread * ((2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(elements) - 1.0);
  const std::vector<std::int32_t> order = hilbert_order(position);
  std::vector<Vector> sorted_position(elements);
  std::vector<double> sorted_radius(elements);
  for (std::size_t k = 0; k < elements; ++k) {
    sorted_position[k] = position[order[k]];
    sorted_radius[k] = radius[order[k]];
  }
  return {domain, std::move(sorted_position), std::move(sorted_radius), surface};
}

// Scales all radii, relaxing in between, until the target coordination or the largest overlap is
// met.
void compact(SoftSpheres& spheres, double fraction, double largest_factor,
             const ReportProgress& progress) {
  const auto tell = [&](double from, double to) {
    return [&progress, from, to](double done) {
      if (progress) progress(from + (to - from) * std::clamp(done, 0.0, 1.0), "packing spheres");
    };
  };
  double factor = 1.0, step = 1.0, last_change = 0.0;
  spheres.relax(precision, most_steps, tell(0.0, 0.8));
  while (spheres.separate_coinciding() > 0) spheres.relax(precision, most_steps);
  for (int round = 0; round < 40; ++round) {
    const double by_contacts =
        (target_coordination - spheres.coordination_number()) / contacts_per_fraction;
    const double by_overlap = 2.0 * fraction * (largest_mean_overlap - spheres.mean_overlap());
    const double change = std::clamp(std::min(by_contacts, by_overlap), -0.01, 0.01);
    if (std::abs(change) < tolerated_contacts / contacts_per_fraction) return;
    // Contacts jump where a packing just jams: overshooting halves the steps.
    if (change * last_change < 0) step *= 0.5;
    last_change = change;
    double growth = std::cbrt(1.0 + step * change / fraction);
    growth = std::min(growth, largest_factor / factor);
    if (growth == 1.0) return;  // a sphere as wide as the body
    spheres.inflate(growth);
    factor *= growth;
    fraction *= growth * growth * growth;
    const double left = 0.2 * std::pow(0.5, round);
    spheres.relax(precision, most_steps, tell(1.0 - left, 1.0 - 0.5 * left));
  }
}

}  // namespace

FacetTree surface_of(const SpecimenRecipe& recipe) {
  TriangleMesh mesh = read_closed_mesh(recipe.mesh, recipe.mesh_unit);
  for (Vector& vertex : mesh.vertices) vertex += recipe.origin;
  return FacetTree(std::move(mesh));
}

Specimen make_packing(const SpecimenRecipe& recipe, const ReportProgress& progress,
                      const FacetTree* surface) {
  check_recipe(recipe);
  const double spread = recipe.radius_spread;
  Specimen specimen;
  specimen.domain = surface != nullptr ? domain_of(surface->mesh()) : shape_of(recipe);
  const Domain& domain = specimen.domain;

  double wanted = static_cast<double>(recipe.elements);
  if (recipe.mean_radius > 0)
    wanted = std::round(expected_fraction(domain, recipe.mean_radius, surface) * domain.volume /
                        mean_sphere_volume(recipe.mean_radius, spread));
  if (!(wanted <= 2147483647.0))
    throw InputError(fmt::format(
        "[specimen] mean_radius = {} m makes {:.3g} elements: at most 2147483647 can be numbered{}",
        recipe.mean_radius, wanted,
        surface != nullptr
            ? fmt::format(
                  "; the mesh is {:.3g} m from corner to corner with a mesh_unit of {:.3g} m",
                  norm(domain.upper - domain.lower), recipe.mesh_unit)
            : std::string()));
  const double elements = std::max(wanted, 1.0);
  const double unit = radius_for(domain, elements, spread, surface);
  const double width =
      surface != nullptr ? 2 * largest_inner_radius(*surface) : narrowest_width(domain);
  insist_on_room(domain, width, unit, recipe);

  const Domain body = scaled(domain, unit);
  std::optional<FacetTree> walls;
  if (surface != nullptr) walls.emplace(scaled(surface->mesh(), unit, domain.lower));
  SoftSpheres spheres = throw_spheres(body, walls ? &*walls : nullptr,
                                      static_cast<std::size_t>(elements), spread, recipe.seed);
  compact(spheres, expected_fraction(domain, unit, surface), 0.5 * width / unit / (1.0 + spread),
          progress);

  specimen.position = spheres.position();
  specimen.radius = spheres.radius();
  for (Vector& p : specimen.position) p = domain.lower + unit * p;
  for (double& r : specimen.radius) r *= unit;
  return specimen;
}

}  // namespace solidem
