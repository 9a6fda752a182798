// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_TESTS_SOLVE_HEAT_NETWORK_HPP
#define SOLIDEM_TESTS_SOLVE_HEAT_NETWORK_HPP

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <functional>
#include <string>
#include <vector>

#include "solve/heat/heat_equation.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

/// A network of elements with everything a heat equation may hold: a source, an exchange with a
/// fluid, imposed temperatures, capacities and conductivities that grow with temperature. Accounts:
/// source, exchange. Enthalpies count from 0 K.
struct HeatNetwork : HeatEquation {
  struct Link {
    std::size_t i, j;
    double conductance;  // at 0 K
  };
  using Function = std::function<double(double)>;

  std::vector<double> heat_capacity;  // at 0 K
  std::vector<Link> links;
  double capacity_growth = 0, conductance_growth = 0;  // 1/K
  std::vector<double> source, exchange;                // W and W/K of each element
  Function source_shape = [](double) { return 1.0; };
  Function fluid_temperature = [](double) { return 0.0; };
  std::vector<std::int32_t> imposed_elements;
  Function imposed_temperature = [](double) { return 0.0; };

  std::size_t elements() const override { return heat_capacity.size(); }
  std::size_t accounts() const override { return 2; }
  bool is_linear() const override { return capacity_growth == 0 && conductance_growth == 0; }

  double growth(const double* t, const Link& link) const {
    return 1 + conductance_growth * 0.5 * (t[link.i] + t[link.j]);
  }
  void powers(double time, const double* t, double* power, double* account) override {
    std::fill(power, power + elements(), 0.0);
    for (const Link& link : links) {
      const double flow = link.conductance * growth(t, link) * (t[link.j] - t[link.i]);
      power[link.i] += flow;
      power[link.j] -= flow;
    }
    account[0] = account[1] = 0;
    for (std::size_t i = 0; i < elements(); ++i) {
      const double heating = source[i] * source_shape(time);
      const double exchanged = exchange[i] * (fluid_temperature(time) - t[i]);
      power[i] += heating + exchanged;
      account[0] += heating;
      account[1] += exchanged;
    }
  }
  const std::vector<std::int32_t>& imposed() const override { return imposed_elements; }
  void impose(double time, double* t) const override {
    for (const std::int32_t i : imposed_elements) t[i] = imposed_temperature(time);
  }
  double enthalpy(std::size_t i, double t) const override {
    return heat_capacity[i] * (t + 0.5 * capacity_growth * t * t);
  }
  double temperature(std::size_t i, double h) const override {
    const double x = h / heat_capacity[i];
    return 2 * x / (1 + std::sqrt(1 + 2 * capacity_growth * x));
  }
  double capacity(std::size_t i, double t) const override {
    return heat_capacity[i] * (1 + capacity_growth * t);
  }
  Eigen::SparseMatrix<double> conductance_matrix(double, const double* t) const override {
    std::vector<Eigen::Triplet<double>> entries;
    for (const Link& link : links) {
      const double k = link.conductance * growth(t, link);
      const int i = static_cast<int>(link.i), j = static_cast<int>(link.j);
      entries.insert(entries.end(), {{i, i, k}, {j, j, k}, {i, j, -k}, {j, i, -k}});
    }
    for (std::size_t i = 0; i < elements(); ++i)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(i), exchange[i]);
    const auto n = static_cast<Eigen::Index>(elements());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
  /// By Gershgorin's circles.
  double stable_step(double, const double* t) const override {
    std::vector<double> sum(exchange);
    for (const Link& link : links) {
      sum[link.i] += 2 * link.conductance * growth(t, link);
      sum[link.j] += 2 * link.conductance * growth(t, link);
    }
    double rate = 0;
    for (std::size_t i = 0; i < elements(); ++i) rate = std::max(rate, sum[i] / capacity(i, t[i]));
    return 2 / rate;
  }

  double total_enthalpy(const std::vector<double>& t) const {
    long double sum = 0;
    for (std::size_t i = 0; i < elements(); ++i) sum += enthalpy(i, t[i]);
    return static_cast<double>(sum);
  }
};

/// Rod of unit length, diffusivity and section in n equal finite volumes; with `hot_end` the first
/// is imposed.
inline HeatNetwork rod(std::size_t n, bool hot_end) {
  HeatNetwork network;
  network.heat_capacity.assign(n, 1.0 / static_cast<double>(n));
  network.source.assign(n, 0.0);
  network.exchange.assign(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i)
    network.links.push_back({i, i + 1, static_cast<double>(n)});
  if (hot_end) network.imposed_elements = {0};
  return network;
}

/// Cube of m³ elements on a simple cubic lattice, capacities and conductances uneven by a factor of
/// three, the layer x = 0 imposed.
inline HeatNetwork uneven_cube(std::size_t m) {
  HeatNetwork network;
  const std::size_t n = m * m * m;
  const auto uneven = [](std::size_t k) {
    return 1 + 0.5 * std::sin(static_cast<double>(k * k % 1009));
  };
  for (std::size_t i = 0; i < n; ++i) network.heat_capacity.push_back(uneven(i + 7));
  network.source.assign(n, 0.0);
  network.exchange.assign(n, 0.0);
  const std::size_t stride[3] = {m * m, m, 1};
  for (std::size_t i = 0; i < n; ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (i / stride[axis] % m + 1 < m)
        network.links.push_back({i, i + stride[axis], uneven(3 * i + stride[axis])});
  for (std::size_t i = 0; i < m * m; ++i)
    network.imposed_elements.push_back(static_cast<std::int32_t>(i));
  return network;
}

/// Exact course of a linear network whose loads are a constant plus a sine of one frequency in
/// time, from its eigenvectors: the imposed temperature, the fluid's and the source's shape are
/// mean + amplitude·sin(ωt), each given as {mean, amplitude}.
class ExactNetwork {
 public:
  struct Load {
    double mean = 0, amplitude = 0;
  };
  ExactNetwork(const HeatNetwork& network, const std::vector<double>& start, double omega,
               Load source, Load fluid, Load imposed)
      : network_(network), omega_(omega), imposed_(imposed) {
    const std::size_t n = network.elements();
    std::vector<char> is_imposed(n, 0);
    for (const std::int32_t i : network.imposed_elements)
      is_imposed[static_cast<std::size_t>(i)] = 1;
    for (std::size_t i = 0; i < n; ++i)
      if (is_imposed[i] == 0) free_.push_back(static_cast<Eigen::Index>(i));
    const Eigen::MatrixXd k = network.conductance_matrix(0, start.data()).toDense();
    const auto count = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd matrix(count, count);
    Eigen::VectorXd mean(count), sine(count), at_start(count);
    root_.resize(count);
    for (Eigen::Index a = 0; a < count; ++a)
      root_[a] = std::sqrt(network.heat_capacity[static_cast<std::size_t>(free_[a])]);
    for (Eigen::Index a = 0; a < count; ++a) {
      const auto i = static_cast<std::size_t>(free_[a]);
      for (Eigen::Index b = 0; b < count; ++b)
        matrix(a, b) = k(free_[a], free_[b]) / (root_[a] * root_[b]);
      double from_imposed = 0;
      for (const std::int32_t j : network.imposed_elements) from_imposed -= k(free_[a], j);
      mean[a] = (network.source[i] * source.mean + network.exchange[i] * fluid.mean +
                 from_imposed * imposed.mean) /
                root_[a];
      sine[a] = (network.source[i] * source.amplitude + network.exchange[i] * fluid.amplitude +
                 from_imposed * imposed.amplitude) /
                root_[a];
      at_start[a] = start[i] * root_[a];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    vectors_ = eigen.eigenvectors();
    rates_ = eigen.eigenvalues();
    mean_ = vectors_.transpose() * mean;
    sine_ = vectors_.transpose() * sine;
    start_ = vectors_.transpose() * at_start;
  }

  std::vector<double> operator()(double t) const {
    Eigen::VectorXd mode(rates_.size());
    for (Eigen::Index m = 0; m < rates_.size(); ++m) {
      const double rate = rates_[m], decay = std::exp(-rate * t);
      const double steady = std::fabs(rate * t) < 1e-9 ? t : -std::expm1(-rate * t) / rate;
      const double swing =
          (rate * std::sin(omega_ * t) - omega_ * std::cos(omega_ * t) + omega_ * decay) /
          (rate * rate + omega_ * omega_);
      mode[m] = start_[m] * decay + mean_[m] * steady + sine_[m] * (omega_ > 0 ? swing : 0);
    }
    const Eigen::VectorXd values = vectors_ * mode;
    std::vector<double> result(network_.elements(),
                               imposed_.mean + imposed_.amplitude * std::sin(omega_ * t));
    for (Eigen::Index a = 0; a < values.size(); ++a)
      result[static_cast<std::size_t>(free_[a])] = values[a] / root_[a];
    return result;
  }

 private:
  const HeatNetwork& network_;
  double omega_;
  Load imposed_;
  std::vector<Eigen::Index> free_;
  Eigen::MatrixXd vectors_;
  Eigen::VectorXd rates_, root_, mean_, sine_, start_;
};

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i] - b[i])) return HUGE_VAL;
    largest = std::max(largest, std::fabs(a[i] - b[i]));
  }
  return largest;
}

struct NamedIntegration {
  const char* name;
  HeatIntegration choice;
  double tolerance;
};

}  // namespace solidem

#endif
