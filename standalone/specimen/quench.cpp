// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/quench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/blocks.hpp"
#include "model/chunks.hpp"
#include "model/slots.hpp"
#include "specimen/listed_spheres.hpp"
#include "specimen/mesh_walls.hpp"

namespace solidem {

namespace {

// Blocks of eight spheres in a chunk of a sum: the sum is the same on any number of threads.
constexpr std::size_t chunk = 128, least_chunks = 4;

// Stands beside no sphere.
constexpr double nowhere = 1e30;

// FIRE's parameters. The largest step is .7 of the stable one of a sphere with a dozen contacts.
// Steering and patience are four times its authors': that took 30 % fewer steps, near jamming
// resets cost most.
constexpr double start_step = 0.1, largest_step = 0.5;
constexpr double start_steer = 0.2, steer_decay = 0.99, step_growth = 1.1, step_cut = 0.5;
constexpr int patience = 20;

}  // namespace

SoftSpheres::SoftSpheres(const Domain& domain, std::vector<Vector> position,
                         std::vector<double> radius, const FacetTree* surface)
    : domain_(domain),
      surface_(surface),
      size_(position.size()),
      extent_(domain.upper - domain.lower) {
  if (domain.radius > 0) axis_point_ = domain.axis_point();
  if (domain.angle > 0) {
    const Vector first = domain.first_transverse(), second = domain.second_transverse();
    first_normal_ = -second;
    last_normal_ = std::cos(domain.angle) * second - std::sin(domain.angle) * first;
  }
  // One more than there are at least: with it lists of neighbours are filled up.
  const std::size_t padded = (size_ / lanes + 1) * lanes;
  ball_ = Buffer<double>(4 * padded);
  listed_ = Buffer<double>(4 * padded);
  velocity_ = Buffer<double>(3 * padded);
  force_ = Buffer<double>(3 * padded);
  contact_force_ = Buffer<double>(padded);
  contacts_ = Buffer<double>(padded);
  first_of_chunk_.assign((padded / lanes - 1) / chunk + 2, 0);
  for (std::size_t i = 0; i < padded; ++i) {
    place(i, i < size_ ? position[i] : Vector{nowhere, nowhere, nowhere});
    ball_[4 * i + 3] = i < size_ ? radius[i] : 0.0;
  }
  build_lists();
}

void SoftSpheres::place(std::size_t i, const Vector& centre) {
  ball_[4 * i] = centre.x;
  ball_[4 * i + 1] = centre.y;
  ball_[4 * i + 2] = centre.z;
}

void SoftSpheres::inflate(double factor) {
  for (std::size_t i = 0; i < size_; ++i) ball_[4 * i + 3] *= factor;
  build_lists();
}

Vector SoftSpheres::nearest_image(Vector d) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain_.periodic[axis]) continue;
    double& c = component(d, axis);
    const double extent = component(extent_, axis);
    c -= c > 0.5 * extent ? extent : 0.0;
    c += c < -0.5 * extent ? extent : 0.0;
  }
  return d;
}

Vector SoftSpheres::image_inside(Vector point) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain_.periodic[axis]) continue;
    const double low = component(domain_.lower, axis), extent = component(extent_, axis);
    double& c = component(point, axis);
    c -= extent * std::floor((c - low) / extent);
  }
  return point;
}

void SoftSpheres::build_lists() {
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    place(i, image_inside(centre(i)));
    largest = std::max(largest, radius(i));
    sum += radius(i);
  }
  std::copy(ball_.begin(), ball_.end(), listed_.begin());
  mean_diameter_ = 2.0 * sum / static_cast<double>(size_);
  find_near_walls();
  list_spheres(
      {{domain_.lower, domain_.upper, domain_.periodic}, ball_.data(), size_, largest, skin_},
      first_row_, neighbour_);
}

void SoftSpheres::find_near_walls() {
  const std::size_t chunks = first_of_chunk_.size() - 1;
  std::vector<std::vector<std::uint32_t>> found(chunks);
  for_blocks(chunks, least_chunks, [&](std::size_t from, std::size_t to) {
    for (std::size_t c = from; c < to; ++c)
      for (std::size_t i = c * chunk * lanes; i < std::min((c + 1) * chunk * lanes, size_); ++i) {
        const double reach = radius(i) + skin_;
        if (surface_ == nullptr ? may_reach_walls(centre(i), reach)
                                : surface_->signed_distance(centre(i)) > -reach)
          found[c].push_back(static_cast<std::uint32_t>(i));
      }
  });
  near_walls_.clear();
  for (std::size_t c = 0; c < chunks; ++c) {
    near_walls_.insert(near_walls_.end(), found[c].begin(), found[c].end());
    first_of_chunk_[c + 1] = near_walls_.size();
  }
}

bool SoftSpheres::may_reach_walls(const Vector& centre, double reach) const {
  const bool round = domain_.radius > 0;
  Vector from_axis{};
  bool reaches = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = component(centre, axis);
    if (round && axis != domain_.axis)
      component(from_axis, axis) = x - component(axis_point_, axis);
    else if (!domain_.periodic[axis])
      reaches = reaches || x - component(domain_.lower, axis) < reach ||
                component(domain_.upper, axis) - x < reach;
  }
  if (!round) return reaches;
  const double distance = norm(from_axis);
  reaches = reaches || domain_.radius - distance < reach || distance - domain_.inner_radius < reach;
  if (!(domain_.angle > 0)) return reaches;
  return reaches || dot(first_normal_, from_axis) > -reach || dot(last_normal_, from_axis) > -reach;
}

void SoftSpheres::wall_force(const Vector& centre, double radius, Vector& force) const {
  const bool round = domain_.radius > 0;
  Vector from_axis{};
  for (int axis = 0; axis < 3; ++axis) {
    const double x = component(centre, axis);
    const double low = component(domain_.lower, axis), high = component(domain_.upper, axis);
    if (round && axis != domain_.axis) {
      component(from_axis, axis) = x - component(axis_point_, axis);
    } else if (!domain_.periodic[axis]) {
      double& f = component(force, axis);
      f += std::max(0.0, low + radius - x);
      f -= std::max(0.0, x - (high - radius));
    }
  }
  if (!round) return;
  const double distance = norm(from_axis);
  const double outside = distance + radius - domain_.radius;
  if (outside > 0 && distance > 0) force -= (outside / distance) * from_axis;
  const double inside = domain_.inner_radius + radius - distance;
  if (domain_.inner_radius > 0 && inside > 0 && distance > 0)
    force += (inside / distance) * from_axis;
  if (!(domain_.angle > 0)) return;
  for (const Vector& normal : {first_normal_, last_normal_})
    force -= std::max(0.0, dot(normal, from_axis) + radius) * normal;
}

void SoftSpheres::add_walls(std::size_t chunk_number) {
  for (std::size_t k = first_of_chunk_[chunk_number]; k < first_of_chunk_[chunk_number + 1]; ++k) {
    const std::size_t i = near_walls_[k];
    double* const at = force_.data() + 3 * lanes * (i / lanes) + i % lanes;
    Vector force{at[0], at[lanes], at[2 * lanes]};
    if (surface_ == nullptr)
      wall_force(centre(i), radius(i), force);
    else
      force += push_of_walls(*surface_, centre(i), radius(i));
    at[0] = force.x;
    at[lanes] = force.y;
    at[2 * lanes] = force.z;
  }
}

SoftSphereColumns SoftSpheres::columns() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector period{infinity, infinity, infinity};
  for (int axis = 0; axis < 3; ++axis)
    if (domain_.periodic[axis]) component(period, axis) = component(extent_, axis);
  return {first_row_.data(),     neighbour_.data(), ball_.data(),
          listed_.data(),        velocity_.data(),  force_.data(),
          contact_force_.data(), contacts_.data(),  period,
          domain_.is_periodic()};
}

void SoftSpheres::compute_forces() {
  const std::size_t blocks = first_row_.size() - 1;
  const SoftSphereColumns spheres = columns();
  const SoftSphereKernels& kernels = soft_sphere_kernels();
  std::vector<SoftSphereSums> partial(blocks / chunk + 1);
  for_chunks(blocks, chunk, least_chunks, [&](std::size_t c, std::size_t first, std::size_t last) {
    kernels.find_forces(spheres, first, last);
    add_walls(c);
    kernels.add_up(spheres, first, last, partial[c]);
  });
  sums_ = {};
  for (const SoftSphereSums& s : partial) {
    sums_.power += s.power;
    sums_.force2 += s.force2;
    sums_.velocity2 += s.velocity2;
    sums_.contact_force += s.contact_force;
    sums_.contacts += s.contacts;
  }
}

// v ← keep v + steer F, then a step; returns the largest squared distance from where the lists were
// made.
double SoftSpheres::move(double time_step, double keep, double steer) {
  const std::size_t blocks = first_row_.size() - 1;
  const SoftSphereColumns spheres = columns();
  std::vector<double> farthest2(blocks / chunk + 1, 0.0);
  for_chunks(blocks, chunk, least_chunks, [&](std::size_t c, std::size_t first, std::size_t last) {
    farthest2[c] =
        soft_sphere_kernels().move(spheres, first, last, time_step, keep, steer + time_step);
  });
  return *std::max_element(farthest2.begin(), farthest2.end());
}

int SoftSpheres::relax(double precision, int most_steps,
                       const std::function<void(double)>& progress) {
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  double time_step = start_step, steer = start_steer;
  int downhill = 0, listed = 0;
  compute_forces();
  double worst = 0;
  for (int step = 0; step < most_steps; ++step) {
    const double contacts = std::max(1.0, sums_.contacts);
    const double mean_force = sums_.contact_force / contacts;
    const double unbalance =
        mean_force > 0 ? std::sqrt(sums_.force2 / static_cast<double>(size())) / mean_force : 0.0;
    if (unbalance < precision || mean_force < 1e-12) return step;
    if (progress && step % 50 == 0) {
      worst = std::max(worst, unbalance);
      progress(std::log(worst / unbalance) / std::log(worst / precision));
    }

    double keep = 1.0, along_force = 0.0;
    if (sums_.power > 0 || step == 0) {
      keep = 1.0 - steer;
      along_force = steer * std::sqrt(sums_.velocity2 / std::max(sums_.force2, 1e-300));
      if (++downhill > patience) {
        time_step = std::min(time_step * step_growth, largest_step);
        steer *= steer_decay;
      }
    } else {
      keep = 0.0;
      downhill = 0;
      time_step *= step_cut;
      steer = start_steer;
    }
    if (move(time_step, keep, along_force) > 0.25 * skin_ * skin_) {
      // Longer lists cost every step, shorter ones are made more often.
      if (step - listed > 40) skin_ = std::max(0.7 * skin_, 0.08);
      if (step - listed < 10) skin_ = std::min(1.4 * skin_, 0.5);
      build_lists();
      listed = step;
    }
    compute_forces();
  }
  return most_steps;
}

int SoftSpheres::separate_coinciding() {
  int found = 0;
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t row = first_row_[i / lanes]; row < first_row_[i / lanes + 1]; ++row) {
      const auto j = static_cast<std::size_t>(neighbour_[row * lanes + i % lanes]);
      if (j < i || j >= size_) continue;
      const Vector chord = nearest_image(centre(j) - centre(i));
      const double distance = norm(chord), reach = radius(i) + radius(j);
      if (distance > 0.25 * reach) continue;
      // To the distance at which they push each other most, half their reach.
      const Vector along = distance > 0 ? (1 / distance) * chord : Vector{1, 0, 0};
      place(i, centre(i) - (0.25 * reach) * along);
      place(j, centre(j) + (0.25 * reach) * along);
      ++found;
    }
  if (found > 0) build_lists();
  return found;
}

double SoftSpheres::coordination_number() const {
  return sums_.contacts / static_cast<double>(size());
}

double SoftSpheres::mean_overlap() const {
  return sums_.contacts > 0 ? sums_.contact_force / (mean_diameter_ * sums_.contacts) : 0.0;
}

std::vector<Vector> SoftSpheres::position() const {
  std::vector<Vector> result(size());
  for (std::size_t i = 0; i < size(); ++i) result[i] = image_inside(centre(i));
  return result;
}

std::vector<double> SoftSpheres::radius() const {
  std::vector<double> result(size());
  for (std::size_t i = 0; i < size(); ++i) result[i] = radius(i);
  return result;
}

}  // namespace solidem
