// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/stability.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <functional>
#include <limits>
#include <numeric>

#include "effects/pseudo_random.hpp"
#include "model/chunks.hpp"

namespace solidem {

namespace {

/// Lanczos' steps, and those over which the largest squared frequency no longer grows when enough
/// have been taken.
constexpr int most_iterations = 60, iterations_to_compare = 4;
constexpr double enough = 2e-3;

/// Elements in a chunk of a sum: the sum is the same on any number of threads.
constexpr std::size_t chunk = 1024, least_chunks = 4;

/// Calls work(element) for all, on all threads.
template <class Work>
void for_elements(std::size_t elements, const Work& work) {
  for_chunks(elements, chunk, least_chunks,
             [&](std::size_t /*chunk*/, std::size_t first, std::size_t last) {
               for (std::size_t i = first; i < last; ++i) work(i);
             });
}

/// What `join` makes, chunk by chunk, of what `part` makes of each element; from zero.
template <class Part, class Join>
double joined(std::size_t elements, const Part& part, const Join& join) {
  std::vector<double> parts((elements + chunk - 1) / chunk, 0.0);
  for_chunks(elements, chunk, least_chunks,
             [&](std::size_t c, std::size_t first, std::size_t last) {
               double whole = 0;
               for (std::size_t i = first; i < last; ++i) whole = join(whole, part(i));
               parts[c] = whole;
             });
  return std::accumulate(parts.begin(), parts.end(), 0.0, join);
}

/// The largest eigenvalue of a symmetric tridiagonal matrix, whose rows are as many as `diagonal`
/// has.
double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto rows = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), rows),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), rows - 1),
                                Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[rows - 1];
}

/// Elements near rest, whose displacements and turns are tried. Shapes have six numbers for each.
class NearRest {
 public:
  NearRest(const Mechanics& mechanics, Model& model)
      : mechanics_(mechanics),
        model_(model),
        elements_(model.elements()),
        has_rotation_(model.has(columns::angular_velocity)),
        amplitude_(mechanics.trial_displacement() * mean_radius(model.specimen())) {
    // Elements may press each other at rest: what counts is how displacements change that.
    place(std::vector<double>(6 * elements_, 0.0), 0);
    at_rest_.assign(velocity(), velocity() + model.size(columns::velocity));
  }

  std::vector<double> random_shape() const {
    std::vector<double> shape(6 * elements_, 0.0);
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const bool turns = k % 6 >= 3;
      if (turns && !has_rotation_) continue;
      shape[k] = pseudo_random(k) / (turns ? model_.specimen().radius[k / 6] : 1.0);
    }
    return shape;
  }

  /// M⁻¹ K shape, from the forces of the shape at a small size.
  void find_image(const std::vector<double>& shape, std::vector<double>& image) const {
    const double size = joined(
        elements_,
        [&](std::size_t i) {
          const double* u = &shape[6 * i];
          const double turn = std::max({std::fabs(u[3]), std::fabs(u[4]), std::fabs(u[5])});
          return std::max({std::fabs(u[0]), std::fabs(u[1]), std::fabs(u[2]),
                           turn * model_.specimen().radius[i]});
        },
        [](double a, double b) { return std::max(a, b); });
    place(shape, amplitude_ / size);
    const double scale = -size / amplitude_;
    const double* spin = has_rotation_ ? model_.data(columns::angular_velocity) : nullptr;
    for_elements(elements_, [&](std::size_t i) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t at = Model::at(columns::velocity, i, axis);
        const auto k = 6 * i + static_cast<std::size_t>(axis);
        image[k] = scale * (velocity()[at] - at_rest_[at]);
        if (has_rotation_) image[k + 3] = scale * spin[at];
      }
    });
  }

  /// Twice the kinetic energy of two shapes as velocities.
  double product(const std::vector<double>& a, const std::vector<double>& b) const {
    const double* inverse_mass = model_.data(columns::inverse_mass);
    const double* inverse_inertia = has_rotation_ ? model_.data(columns::inverse_inertia) : nullptr;
    return joined(
        elements_,
        [&](std::size_t i) {
          const double *u = &a[6 * i], *v = &b[6 * i];
          double sum = (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) / inverse_mass[i];
          if (has_rotation_) sum += (u[3] * v[3] + u[4] * v[4] + u[5] * v[5]) / inverse_inertia[i];
          return sum;
        },
        std::plus<double>());
  }

 private:
  double* velocity() const { return model_.data(columns::velocity); }

  /// Puts the elements at a multiple of a shape and finds their accelerations.
  void place(const std::vector<double>& shape, double scale) const {
    const auto positions = model_.positions();
    for_elements(elements_, [&](std::size_t i) {
      const double* u = &shape[6 * i];
      const Vector& rest = model_.specimen().position[i];
      double* row = positions[i];
      row[0] = rest.x + scale * u[0];
      row[1] = rest.y + scale * u[1];
      row[2] = rest.z + scale * u[2];
      if (!has_rotation_) return;
      const Vector half = (0.5 * scale) * Vector{u[3], u[4], u[5]};
      row[4] = std::sqrt(1 - dot(half, half));
      row[5] = half.x;
      row[6] = half.y;
      row[7] = half.z;
    });
    std::fill_n(velocity(), model_.size(columns::velocity), 0.0);
    if (has_rotation_)
      std::fill_n(model_.data(columns::angular_velocity), model_.size(columns::angular_velocity),
                  0.0);
    mechanics_.accelerate(model_);
  }

  const Mechanics& mechanics_;
  Model& model_;
  std::size_t elements_;
  bool has_rotation_;
  double amplitude_;
  std::vector<double> at_rest_;
};

/// The largest of M⁻¹ K, by Lanczos (1950): of all shapes that a power iteration of as many steps
/// goes through and their sums, that of the largest frequency.
double largest_squared_frequency(const NearRest& body) {
  std::vector<double> shape = body.random_shape();
  std::vector<double> last(shape.size(), 0.0), image(shape.size(), 0.0);
  const auto for_numbers = [&](const auto& work) {
    for_elements(shape.size() / 6, [&](std::size_t i) {
      for (std::size_t k = 6 * i; k < 6 * i + 6; ++k) work(k);
    });
  };
  std::vector<double> diagonal, beside, found;
  double norm = std::sqrt(body.product(shape, shape));
  while (norm > 0) {
    const double scale = 1 / norm;
    for_numbers([&](std::size_t k) { shape[k] *= scale; });
    body.find_image(shape, image);
    diagonal.push_back(body.product(shape, image));
    const double along = diagonal.back(), before = beside.empty() ? 0 : beside.back();
    for (std::size_t k = 0; k < shape.size(); ++k) image[k] -= along * shape[k] + before * last[k];
    found.push_back(largest_eigenvalue(diagonal, beside));
    const std::size_t step = found.size();
    if (step == most_iterations) break;
    if (step > iterations_to_compare &&
        found.back() <= (1 + enough) * found[step - 1 - iterations_to_compare])
      break;
    norm = std::sqrt(body.product(image, image));
    // What is left is round-off once the shapes hold all that the body does.
    if (!(norm > 1e-6 * found.back())) break;
    beside.push_back(norm);
    std::swap(last, shape);
    std::swap(shape, image);
  }
  return found.empty() ? 0 : found.back();
}

}  // namespace

double stable_time_step(const Mechanics& mechanics, Model& model) {
  double* velocity = model.data(columns::velocity);
  const bool has_rotation = model.has(columns::angular_velocity);
  double* spin = has_rotation ? model.data(columns::angular_velocity) : nullptr;
  // Springs leave all that turns at zero.
  const std::size_t spins = has_rotation ? model.size(columns::angular_velocity) : 0;
  double* positions = model.positions()[0];
  const std::vector<double> saved_positions(positions,
                                            positions + model.size(model.position_column()));
  const std::vector<double> saved_velocity(velocity, velocity + model.size(columns::velocity));
  const std::vector<double> saved_spin(spin, spin + spins);
  const double squared_frequency = largest_squared_frequency(NearRest(mechanics, model));
  std::copy(saved_positions.begin(), saved_positions.end(), positions);
  std::copy(saved_velocity.begin(), saved_velocity.end(), velocity);
  std::copy(saved_spin.begin(), saved_spin.end(), spin);
  return squared_frequency > 0 ? mechanics.longest_time_step(squared_frequency)
                               : std::numeric_limits<double>::infinity();
}

}  // namespace solidem
