// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/quench.hpp"

#include <algorithm>
#include <cmath>

#include "model/blocks.hpp"
#include "neighbours/linked_cells.hpp"
#include "specimen/mesh_walls.hpp"

namespace solidem {

namespace {

constexpr std::size_t block_size = 1024;

std::size_t block_count(std::size_t elements) {
  return (elements + block_size - 1) / block_size;
}

// FIRE's parameters. The largest step is .7 of the stable one of a sphere with a dozen contacts.
// Steering and patience are four times its authors': that took 30 % fewer steps, near jamming
// resets cost most.
constexpr double start_step = 0.1, largest_step = 0.5;
constexpr double start_steer = 0.2, steer_decay = 0.99, step_growth = 1.1, step_cut = 0.5;
constexpr int patience = 20;

}  // namespace

SoftSpheres::SoftSpheres(const Domain& domain, std::vector<Vector> position,
                         std::vector<double> radius, const FacetTree* surface)
    : domain_(domain), surface_(surface), extent_(domain.upper - domain.lower) {
  for (const bool periodic : domain.periodic) any_periodic_ = any_periodic_ || periodic;
  if (domain.radius > 0) axis_point_ = domain.axis_point();
  if (domain.angle > 0) {
    const Vector first = domain.first_transverse(), second = domain.second_transverse();
    first_normal_ = -second;
    last_normal_ = std::cos(domain.angle) * second - std::sin(domain.angle) * first;
  }
  ball_.resize(position.size());
  for (std::size_t i = 0; i < ball_.size(); ++i) ball_[i] = {position[i], radius[i]};
  velocity_.resize(ball_.size());
  force_.resize(ball_.size());
  build_lists();
}

void SoftSpheres::inflate(double factor) {
  for (Ball& ball : ball_) ball.radius *= factor;
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
  const std::size_t n = ball_.size();
  double largest = 0, sum = 0;
  listed_position_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    listed_position_[i] = ball_[i].centre = image_inside(ball_[i].centre);
    largest = std::max(largest, ball_[i].radius);
    sum += ball_[i].radius;
  }
  mean_diameter_ = 2.0 * sum / static_cast<double>(n);
  if (surface_ != nullptr) find_near_surface();
  LinkedCells cells({domain_.lower, domain_.upper, domain_.periodic}, 2.0 * largest + skin_, n);
  cells.sort(listed_position_);
  const std::size_t cell_count = cells.cell_count();
  const std::size_t blocks = std::min<std::size_t>(cell_count, 64);
  std::vector<std::vector<Pair>> found(blocks);
  for_each_part(blocks, n > 3000, [&](std::size_t block) {
    const std::size_t first = cell_count * block / blocks;
    const std::size_t last = cell_count * (block + 1) / blocks;
    cells.for_each_pair(first, last, [&](std::int32_t i, std::int32_t j, const Vector& chord) {
      const double reach = ball_[i].radius + ball_[j].radius + skin_;
      if (dot(chord, chord) < reach * reach) found[block].push_back({i, j});
    });
  });
  first_neighbour_.assign(n + 1, 0);
  for (const auto& list : found)
    for (const Pair& pair : list) {
      ++first_neighbour_[pair.i + 1];
      ++first_neighbour_[pair.j + 1];
    }
  for (std::size_t i = 0; i < n; ++i) first_neighbour_[i + 1] += first_neighbour_[i];
  neighbour_.resize(static_cast<std::size_t>(first_neighbour_[n]));
  std::vector<std::int32_t> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
  for (const auto& list : found)
    for (const Pair& pair : list) {
      neighbour_[next[pair.i]++] = pair.j;
      neighbour_[next[pair.j]++] = pair.i;
    }
}

void SoftSpheres::find_near_surface() {
  is_near_surface_.resize(ball_.size());
  for_blocks(ball_.size(), 3000, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      is_near_surface_[i] =
          surface_->signed_distance(ball_[i].centre) > -(ball_[i].radius + skin_) ? 1 : 0;
  });
}

void SoftSpheres::wall_force(const Ball& ball, Vector& force) const {
  const bool round = domain_.radius > 0;
  Vector from_axis{};
  for (int axis = 0; axis < 3; ++axis) {
    const double x = component(ball.centre, axis);
    const double low = component(domain_.lower, axis), high = component(domain_.upper, axis);
    if (round && axis != domain_.axis) {
      component(from_axis, axis) = x - component(axis_point_, axis);
    } else if (!domain_.periodic[axis]) {
      double& f = component(force, axis);
      f += std::max(0.0, low + ball.radius - x);
      f -= std::max(0.0, x - (high - ball.radius));
    }
  }
  if (!round) return;
  const double distance = norm(from_axis);
  const double outside = distance + ball.radius - domain_.radius;
  if (outside > 0 && distance > 0) force -= (outside / distance) * from_axis;
  const double inside = domain_.inner_radius + ball.radius - distance;
  if (domain_.inner_radius > 0 && inside > 0 && distance > 0)
    force += (inside / distance) * from_axis;
  if (!(domain_.angle > 0)) return;
  for (const Vector& normal : {first_normal_, last_normal_})
    force -= std::max(0.0, dot(normal, from_axis) + ball.radius) * normal;
}

template <bool periodic>
SoftSpheres::Sums SoftSpheres::forces_of_block(std::size_t first, std::size_t last) {
  Sums sums;
  for (std::size_t i = first; i < last; ++i) {
    const Ball ball = ball_[i];
    Vector force{};
    double contact_force = 0;
    std::int32_t contacts = 0;
    for (std::int32_t k = first_neighbour_[i]; k < first_neighbour_[i + 1]; ++k) {
      const Ball& other = ball_[neighbour_[k]];
      Vector chord = ball.centre - other.centre;
      if (periodic) chord = nearest_image(chord);
      const double reach = ball.radius + other.radius;
      const double depth = reach * reach - dot(chord, chord);
      // Twice the depth, or 0 when they do not touch: compilers make a branch of a maximum, and
      // whether a listed pair touches cannot be foretold.
      const double push = depth + std::abs(depth);
      force += push * chord;
      contact_force += push;
      contacts += depth > 0;
    }
    force = 0.0625 * force;
    if (surface_ == nullptr)
      wall_force(ball, force);
    else if (is_near_surface_[i] != 0)
      force += push_of_walls(*surface_, ball.centre, ball.radius);
    force_[i] = force;
    sums.power += dot(force, velocity_[i]);
    sums.force2 += dot(force, force);
    sums.velocity2 += dot(velocity_[i], velocity_[i]);
    sums.contact_force += 0.125 * contact_force;
    sums.contacts += contacts;
  }
  return sums;
}

void SoftSpheres::compute_forces() {
  std::vector<Sums> partial(block_count(size()));
  for_blocks(partial.size(), 4, [&](std::size_t from, std::size_t to) {
    for (std::size_t block = from; block < to; ++block) {
      const std::size_t first = block * block_size, last = std::min(first + block_size, size());
      partial[block] =
          any_periodic_ ? forces_of_block<true>(first, last) : forces_of_block<false>(first, last);
    }
  });
  sums_ = {};
  for (const Sums& s : partial) {
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
  std::vector<double> farthest2(block_count(size()), 0.0);
  for_blocks(farthest2.size(), 4, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from * block_size; i < std::min(to * block_size, size()); ++i) {
      velocity_[i] = keep * velocity_[i] + (steer + time_step) * force_[i];
      ball_[i].centre += time_step * velocity_[i];
      const Vector moved = ball_[i].centre - listed_position_[i];
      farthest2[from] = std::max(farthest2[from], dot(moved, moved));
    }
  });
  return *std::max_element(farthest2.begin(), farthest2.end());
}

int SoftSpheres::relax(double precision, int most_steps,
                       const std::function<void(double)>& progress) {
  std::fill(velocity_.begin(), velocity_.end(), Vector{});
  double time_step = start_step, steer = start_steer;
  int downhill = 0, listed = 0;
  compute_forces();
  double worst = 0;
  for (int step = 0; step < most_steps; ++step) {
    const double contacts = std::max<double>(1.0, static_cast<double>(sums_.contacts));
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
  for (std::size_t i = 0; i < size(); ++i)
    for (std::int32_t k = first_neighbour_[i]; k < first_neighbour_[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(neighbour_[k]);
      if (j < i) continue;
      const Vector chord = nearest_image(ball_[j].centre - ball_[i].centre);
      const double distance = norm(chord), reach = ball_[i].radius + ball_[j].radius;
      if (distance > 0.25 * reach) continue;
      // To the distance at which they push each other most, half their reach.
      const Vector along = distance > 0 ? (1 / distance) * chord : Vector{1, 0, 0};
      ball_[i].centre -= (0.25 * reach) * along;
      ball_[j].centre += (0.25 * reach) * along;
      ++found;
    }
  if (found > 0) build_lists();
  return found;
}

double SoftSpheres::coordination_number() const {
  return static_cast<double>(sums_.contacts) / static_cast<double>(size());
}

double SoftSpheres::mean_overlap() const {
  return sums_.contacts
             ? sums_.contact_force / (mean_diameter_ * static_cast<double>(sums_.contacts))
             : 0.0;
}

std::vector<Vector> SoftSpheres::position() const {
  std::vector<Vector> result(size());
  for (std::size_t i = 0; i < size(); ++i) result[i] = image_inside(ball_[i].centre);
  return result;
}

std::vector<double> SoftSpheres::radius() const {
  std::vector<double> result(size());
  for (std::size_t i = 0; i < size(); ++i) result[i] = ball_[i].radius;
  return result;
}

}  // namespace solidem
